// Whether next to no path has told of what a pixel shows, so that it takes more of them (settings, new_pixel_samples).
// Reads the images `previous_radiance` and `previous_surface` of the pass that includes it.
#include "lib/camera.glsl"
#include "lib/surface.glsl"

// With so many samples a pixel is new no more.
const float SAMPLES_OF_NEW = 4.0;

bool is_new_pixel(uint code, vec3 point_vox) {
    if (code == SURFACE_CODE_SKY) return false;
    vec2 ndc;
    if (frame.world_size_vox.w == 0 || !previous_ndc(point_vox, ndc) || any(greaterThanEqual(abs(ndc), vec2(1.0))))
        return true;
    ivec2 before = ivec2((ndc * 0.5 + 0.5) * vec2(imageSize(previous_surface)));
    return !lies_on(code, imageLoad(previous_surface, before).r) ||
           imageLoad(previous_radiance, before).a < SAMPLES_OF_NEW;
}
