// How a shown picture is tried by fresh exact samples: workgroups, and lanes of each (a power of two).
#ifndef TARN_SHARED_TRIAL
#define TARN_SHARED_TRIAL

#define TRIAL_GROUPS 16
#define TRIAL_LANES 256
// Pixels tried, at most about: 3600 of 640x360.
#define TRIAL_PIXELS 4096

#endif
