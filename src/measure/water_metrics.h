// Figures of a world of water, read from its cells alone, and the tick from which something holds for good.
// Knows no rule and no GL.
#pragma once
#include <cstdint>
#include <optional>

#include "world/scene.h"

namespace tarn {

struct Heights {  // in voxels of water per column
    double sd = 0, lowest = 0, highest = 0;
};
// Over the columns of `region`; its volume is not 0.
Heights column_heights(const Cells& cells, const Box& region);

// Voxels of water in `region` over the columns of its footprint.
double mean_depth_vox(const Cells& cells, const Box& region);

// How evenly water spread around the vertical axis through (x, z), by its amount in each column.
struct Spread {
    double volume_vox = 0;
    double xx_over_zz = 0;  // second moments
    double d1_over_d2 = 0;  // the same along x+z and x-z
    double c4 = 0;          // <r^4 cos 4a> / <r^4>: above 0 it reaches farther along the axes
    double axis_over_diagonal =
        0;  // farthest water within 11.25 degrees of an axis over that near a diagonal
};
Spread spread_around(const Cells& cells, double x_vox, double z_vox);

struct SandPile {
    int peak_vox = 0;
    int steep_pairs = 0;           // neighbouring columns whose tops differ by more than 1
    std::uint64_t over_fluid = 0;  // sand with air or water straight below
};
SandPile sand_pile(const Cells& cells);

// Water with air straight below.
std::uint64_t hanging_water(const Cells& cells);

// What a tick did. `moved_quanta` is half the sum of the changes of all cells: what passed through a cell
// whole does not count.
struct CellsDifference {
    std::uint64_t changed_cells = 0, moved_quanta = 0;
};
CellsDifference difference(const Cells& before, const Cells& after);  // of one size

struct Mass {
    std::uint64_t water_quanta = 0, sand_voxels = 0;
    bool operator==(const Mass&) const = default;
};
Mass mass_of(const Cells& cells);

// The first tick from which a condition has held without a break.
class HeldSince {
  public:
    // Ticks come in order, none left out.
    void look(int tick, bool holds) {
        if (!holds)
            since_.reset();
        else if (!since_)
            since_ = tick;
        last_ = tick;
    }
    std::optional<int> since() const { return since_; }
    int ticks() const { return since_ ? last_ - *since_ + 1 : 0; }

  private:
    std::optional<int> since_;
    int last_ = 0;
};

}  // namespace tarn
