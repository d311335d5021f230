// Twin test of camera.glsl, filter.glsl and ray.glsl: testkit/tests/twins/camera.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "camera.glsl"

struct Input {
    CameraRecord camera;
    vec2 film;
    vec2 lens;
    float time;
    uint filter_kind;
    vec2 in_pixel;
    vec3 p;
    vec3 ng;
    vec3 towards;
    float extent;
};
struct Output {
    Ray ray;
    vec2 offset;
    vec3 left;
};

#include "twins/kernel.glsl"
#include "filter.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    push.outputs.at[i] = Output(
        camera_ray(it.camera, it.film, it.lens, it.time),
        filter_sample(it.filter_kind, it.in_pixel),
        offset_ray_origin(it.p, it.ng, it.towards, it.extent)
    );
}
