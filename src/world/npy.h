// Cells as NumPy files: `.npy` format 1.0, uint8, C order, shape (z, y, x): material ids, and quanta of
// water.
#pragma once
#include <filesystem>

#include "world/cells.h"

namespace tarn {

// Water is written as MATERIAL_WATER whatever its amount. Throws Error naming the file when it cannot be
// written, and leaves no part of it.
void write_npy(const std::filesystem::path& path, const Cells& cells);

// The quanta of water in each cell, 0..16, in the same shape; errors as above.
void write_amounts_npy(const std::filesystem::path& path, const Cells& cells);

// Reads a file of material ids back. Throws Error naming the file and what is wrong with it.
Cells read_npy(const std::filesystem::path& path);

}  // namespace tarn
