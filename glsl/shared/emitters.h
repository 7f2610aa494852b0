// The tree of emissive voxels that the passes which keep and sample it agree on; C++ and GLSL.
#ifndef TARN_SHARED_EMITTERS
#define TARN_SHARED_EMITTERS

// Levels from bricks to the root: sides of up to 256 bricks
#define EMITTER_LEVELS_MAX 9

// Storage buffers
#define STORAGE_EMITTER_TREE 1
#define STORAGE_EMITTER_MASKS 2
#define STORAGE_EMITTER_GROUPS 3

#endif
