// What rays skip by: a word of two uints for every brick and medium (air, full water), and the clear rooms of bricks
// ahead of it. C++ and GLSL. Kept by pass/brick_occupancy.comp and pass/brick_rooms.comp, read by lib/traversal.glsl.
#ifndef TARN_SHARED_ROOMS
#define TARN_SHARED_ROOMS
#include "shared/language.h"
TARN_SHARED_BEGIN

// A brick that holds anything but the medium: a bit for every voxel that does, x + 4 y + 16 z, the lower 32 in x. A set
// bit may stand for a voxel of the medium all the same; a bit that is not set never stands for another.
// A brick of the medium alone: y = ROOM_CLEAR, and x < ROOM_LEVELS_END holds the level of the room ahead of it in each
// octant, 3 bits each from bit 3 (a + 2 b + 4 c), where a, b, c are 1 for rays that rise along x, y, z.
TARN_CONSTANT TARN_UINT ROOM_CLEAR = 0xffffffffu;
TARN_CONSTANT TARN_UINT ROOM_LEVELS_END = 0x1000000u;

// A room has the brick in its corner and is of the medium alone; beyond the world all is air. Sides in bricks: flat
// first, as ground and water are (primary rays over a lake take 7 steps, with cubes 11), then upright, for the open
// sky. A change renews every room that it lies in: hence no longer ones. With up to 32 across, rays at 512^3 took 8 to
// 17 % fewer steps and about as long, a stroke of the brush twice as long (`tarn bench --suite rays,edit --sizes 512`).
TARN_CONSTANT int ROOM_LEVELS = 8;
TARN_FUNCTION int room_across(int level) { return level < 4 ? 1 << level : 16; }
TARN_FUNCTION int room_up(int level) { return ((1 << level) + 3) >> 2; }

// The word of a brick whose voxels that are not the medium are `mask`; of a clear one before its rooms are known.
TARN_FUNCTION TARN_UINT room_word_x(TARN_UINT mask_x, TARN_UINT mask_y) {
    return mask_y == ROOM_CLEAR && mask_x < ROOM_LEVELS_END ? mask_x | 0x80000000u : mask_x;
}

// Lines of bricks that an invocation of brick_rooms.comp looks at, of which few are marked.
TARN_CONSTANT int ROOM_LINES_AN_INVOCATION = 8;

// Words of a line of bricks in what lib/room_lines.glsl keeps, by axis.
TARN_FUNCTION int room_line_ways(int axis) { return axis == 1 ? 1 : axis == 0 ? 2 : 4; }
TARN_FUNCTION int room_line_words(int axis) { return 1 + 2 * 3 * room_line_ways(axis); }

TARN_SHARED_END
#endif
