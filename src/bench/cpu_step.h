// The `level` tier on the CPU as fast as threads and vectors make it: what the GPU's tick is measured
// against, used nowhere else. Byte for byte the rule of src/reference, everything awake.
#pragma once
#include <cstdint>

#include "world/cells.h"

namespace tarn {

enum class CpuVectors { Plain, Avx2 };

// Whether this machine has them.
bool has_vectors(CpuVectors vectors);

struct CpuStep {
    std::uint32_t seed = 0;
    int film_threshold = 3;  // quanta
    int threads = 1;
    CpuVectors vectors = CpuVectors::Plain;
};

// One tick, in place.
void cpu_block_tick(Cells& cells, std::uint32_t tick, const CpuStep& step);
void cpu_level_tick(Cells& cells, std::uint32_t tick, const CpuStep& step);

}  // namespace tarn
