// Twin test of warp.glsl, frame.glsl and mis.glsl: testkit/tests/twins/warp.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    vec2 u;
    float one_minus_cos;
    float cos_theta;
    vec3 normal;
    vec3 tangent;
    vec3 v;
    vec2 pdfs;
};
struct Output {
    vec2 disk;
    vec3 cosine;
    vec3 hemisphere;
    vec3 sphere;
    vec3 cone;
    vec2 triangle;
    float cosine_pdf;
    float cone_pdf;
    vec3 frame_t;
    vec3 frame_b;
    vec3 tangent_t;
    vec3 tangent_b;
    vec3 local;
    vec3 world;
    float heuristic;
};

#include "twins/kernel.glsl"
#include "frame.glsl"
#include "mis.glsl"
#include "warp.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Frame frame = frame_from_normal(it.normal);
    Frame along = frame_from_normal_tangent(it.normal, it.tangent);
    push.outputs.at[i] = Output(
        concentric_disk(it.u),
        cosine_hemisphere(it.u),
        uniform_hemisphere(it.u),
        uniform_sphere(it.u),
        uniform_cone(it.u, it.one_minus_cos),
        uniform_triangle(it.u),
        cosine_hemisphere_pdf(it.cos_theta),
        uniform_cone_pdf(it.one_minus_cos),
        frame.t,
        frame.b,
        along.t,
        along.b,
        frame_to_local(frame, it.v),
        frame_to_world(frame, it.v),
        power_heuristic(it.pdfs.x, it.pdfs.y)
    );
}
