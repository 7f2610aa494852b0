// The state of the head field as it is built; src/passes/head_field.h owns the buffer. The arguments of the sweep and
// of the publishing are read by indirect dispatch.
layout(std430, binding = STORAGE_HEAD_CLOCK) coherent buffer HeadClock {
    uint sweep_groups[3];
    uint publish_groups[3];
    uint sweeps;        // since the field began to be built
    uint quiet_sweeps;  // that found nothing new, up to the last but one
    uint found;         // 1 once the last found something
};

// Up and down first: that is where the surfaces are.
int axis_of_sweep(uint sweep) { return sweep % 3u == 0u ? 1 : sweep % 3u == 1u ? 0 : 2; }
