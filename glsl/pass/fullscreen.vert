// One triangle over the whole picture; the eye's ray is interpolated over it.
#include "lib/camera.glsl"

layout(location = 0) out vec3 ray_dir;

void main() {
    vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray_dir = camera_ray(ndc);
    gl_Position = vec4(ndc, 0.0, 1.0);
}
