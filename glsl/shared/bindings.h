// Binding points that every pass agrees on; C++ and GLSL.
#ifndef TARN_SHARED_BINDINGS
#define TARN_SHARED_BINDINGS

// Uniform blocks
#define BINDING_FRAME 0
#define BINDING_MATERIALS 1
// Textures that every ray needs; a pass's own inputs are 4 to 11
#define BINDING_CELLS 0
#define BINDING_ALBEDO_TABLE 2
#define BINDING_BRICK_CHANGED 3
#define BINDING_FIRST_INPUT 4
#define BINDING_METAL_ALBEDO_TABLE 12
#define BINDING_GLASS_ALBEDO_TABLE 13

// Images of the passes that change cells, and of rays: cells and brick rooms
#define IMAGE_CELLS 0
#define IMAGE_BRICK_CHANGED 1
#define IMAGE_ACTING_HEAD 2
#define IMAGE_BUILDING_HEAD 3
#define IMAGE_BRICK_ROOMS 4
#define IMAGE_BENCH_RAYS 5
// Images of the passes over pixels
#define IMAGE_PREVIOUS_RADIANCE 2
#define IMAGE_PREVIOUS_SURFACE 3
#define IMAGE_RADIANCE 6
#define IMAGE_SURFACE 7
// Storage buffers of theirs; 0 is a pass's own
#define STORAGE_CHANGED_TICK 1
#define STORAGE_ACTIVE_NEXT 2
#define STORAGE_ACTIVE 3
#define STORAGE_BLOCKS 4
#define STORAGE_AWAKE_BLOCKS 5
#define STORAGE_AWAKE_BLOCKS_WIDE 4
#define STORAGE_BLOCK_MARKS 6
#define STORAGE_HEAD_CLOCK 7
#define STORAGE_CHANGES 8
// And of those that look at what changed
#define STORAGE_NEW_CHANGES 9
#define STORAGE_MATTER 10
#define STORAGE_ROOM_GROUPS 1
#define STORAGE_ROOM_LINES 2
#define STORAGE_STALE_TILES 1
#define STORAGE_TILE_LISTED 2
#define STORAGE_TILE_COUNTS 3

// Bricks that a workgroup of theirs takes
#define CHANGES_PER_GROUP 64
// Side in voxels of the tiles by which cells are counted: 1 KiB of counts each
#define CENSUS_TILE 32

// Side of a brick in voxels, and its logarithm. 4: a primary ray over the lake takes 17 steps, with 8 it took 28
#define BRICK_SIDE 4
#define BRICK_SHIFT 2

#endif
