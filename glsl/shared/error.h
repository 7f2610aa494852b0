// How the estimate of the picture's error is summed: workgroups, and lanes of each (a power of two).
#ifndef TARN_SHARED_ERROR
#define TARN_SHARED_ERROR

#define ERROR_GROUPS 64
#define ERROR_LANES 256
// Pixels looked at, at most about.
#define ERROR_PIXELS 32768

#endif
