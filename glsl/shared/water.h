// Constants of the water's rules that the GPU passes and the CPU references share; C++ and GLSL.
#ifndef TARN_SHARED_WATER
#define TARN_SHARED_WATER

// Blocks of the level and pressure tiers, in voxels: tall ones, in which water and sand fall and flow, and wide ones
// of two layers, whose upper layer levels.
#define TALL_SIDE 16
#define TALL_HEIGHT 8
#define WIDE_SIDE 64
#define WIDE_HEIGHT 2

// Side of the cubes, in voxels, by which the blocks of the block tier run.
#define BLOCK_TILE 8

// Ticks (steps, where a tick has several) for which a brick and its 26 neighbours must lie unchanged before it
// sleeps. Every offset of a block along an axis comes up within 16 of them, every third one is diagonal.
#define SLEEP_TICKS 64

// Sides of workgroups: active bricks that one takes, and lines or cells along a side of one over the head field
#define ACTIVE_PER_GROUP 64
#define HEAD_GROUP_SIDE 8
// Invocations of a tall block: each takes several columns and lines, as llvmpipe pays 0.4 us for every 8 of them
#define TALL_INVOCATIONS 64

// Quanta per cell that a wide block must find to level water over dry ground: lines this long along x and z would
// spread thin films into crosses.
#define WIDE_LEAST_QUANTA 8

// The head of confined water: sweeps after which what has been found acts at the latest, and the ticks in which a
// free surface under a head of n voxels rises by n voxels at most.
#define HEAD_SWEEPS_MAX 192
#define HEAD_RISE_TICKS 64

// Salts of the hashes
#define SALT_WIDE 0x51a3c7d9u
#define SALT_DIAGONAL 0x2e8b16f3u

#endif
