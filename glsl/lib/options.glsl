// The bits of frame.trace_options.w, OPTION_* of shared/trace.h.
#include "shared/frame.h"
#include "shared/trace.h"

bool option(int bit) { return (frame.trace_options.w & bit) != 0; }
