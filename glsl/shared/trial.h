// How a shown picture is tried by fresh exact samples: workgroups, and lanes of each (a power of two).
#ifndef TARN_SHARED_TRIAL
#define TARN_SHARED_TRIAL

#define TRIAL_GROUPS 16
#define TRIAL_LANES 256
// Pixels tried, at most about; the stride is odd: of 640x360 every ninth along x and y, 72 x 40.
#define TRIAL_PIXELS 4096

#endif
