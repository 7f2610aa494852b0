// Rays of the eye, this frame's and the previous one's.
#include "shared/frame.h"

// Not normalised; ndc in [-1,1]^2, y up.
vec3 camera_ray(vec2 ndc) {
    return frame.camera_dir.xyz + ndc.x * frame.camera_right.xyz + ndc.y * frame.camera_up.xyz;
}

// Likewise, through a point of a picture of `size` pixels, in pixels from its corner.
vec3 pixel_ray(vec2 at, vec2 size) { return camera_ray((2.0 * at - size) / size); }

// Where the previous frame showed a point; false behind the eye. Right and up are orthogonal to dir.
bool previous_ndc(vec3 position_vox, out vec2 ndc) {
    vec3 to_point = position_vox - frame.previous_position_vox.xyz;
    float depth = dot(to_point, frame.previous_dir.xyz);
    vec3 right = frame.previous_right.xyz;
    vec3 up = frame.previous_up.xyz;
    ndc = vec2(dot(to_point, right) / dot(right, right), dot(to_point, up) / dot(up, up)) / max(depth, 1e-20);
    return depth > 0.0;
}
