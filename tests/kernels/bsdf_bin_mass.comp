// The integral of the density over each bin of one side, by midcount: count x count of them.
#include "tests/kernels/bsdf_case.glsl"
#include "tests/kernels/direction_bins.glsl"

layout(local_size_x = 64) in;

layout(std430, binding = 0) buffer MassBlock { float mass[BIN_REST + 1]; };

void main() {
    int bin = int(gl_GlobalInvocationID.x);
    int sides = transmissive != 0 ? 2 : 1;
    if (bin >= sides * BIN_ROWS * BIN_COLUMNS) return;
    int row = (bin / BIN_COLUMNS) % BIN_ROWS;
    if (by_slopes != 0 && row == BIN_ROWS - 1) return;
    Surface s = case_surface();
    float sum = 0.0;
    for (int k = 0; k < count * count; ++k) {
        vec2 inside = (vec2(k / count, k % count) + 0.5) / float(count);
        vec2 at = (vec2(row, bin % BIN_COLUMNS) + inside) / vec2(BIN_ROWS, BIN_COLUMNS);
        vec3 wi;
        float solid_angle = direction_of(wo, at, bin >= BIN_ROWS * BIN_COLUMNS, wi);
        vec3 f_cos;
        float pdf = 0.0;
        if (solid_angle > 0.0) case_eval(s, wo, wi, f_cos, pdf);
        sum += pdf * solid_angle;
    }
    mass[bin] = sum / float(count * count * BIN_ROWS * BIN_COLUMNS);
}
