// What a cell holds, for the rules of the water, ordered so that comparisons say it all: 0..FULL quanta of water
// (0: air), SAND, CLOSED (solid, or beyond the world).
#include "shared/materials.h"

const int FULL = int(QUANTA_PER_VOXEL);
const int SAND = 32;
const int CLOSED = 64;

int content_of(uint cell) {
    int water = int(cell) - int(MATERIAL_WATER) + 1;
    if (cell == MATERIAL_AIR) return 0;
    if (cell == MATERIAL_SAND) return SAND;
    return water >= 1 && water <= FULL ? water : CLOSED;
}

uint cell_of(int content) { return content == SAND ? MATERIAL_SAND : water_cell(uint(content)); }

bool is_open(int content) { return content <= FULL; }
bool supports(int content) { return content >= FULL; }
