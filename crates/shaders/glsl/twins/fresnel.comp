// Twin test of fresnel.glsl: testkit/tests/twins/fresnel.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    float cosine;
    // Index, or ratio of indices.
    float eta;
    // Absorption of a conductor.
    float k;
    float f90;
    vec3 f0;
    // Unit, at that cosine to +z.
    vec3 wo;
};
struct Output {
    float reflected;
    float cos_t;
    vec3 refracted;
    float conductor;
    float weight;
    vec3 schlick;
    float f0;
};

#include "twins/kernel.glsl"
#include "fresnel.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Output o;
    o.reflected = dielectric_refracted(it.cosine, it.eta, o.cos_t);
    o.refracted = refract_at(it.wo, vec3(0.0, 0.0, 1.0), o.cos_t, it.eta);
    o.conductor = conductor(it.cosine, it.eta, it.k);
    o.weight = schlick_weight(it.cosine);
    o.schlick = schlick(it.f0, it.f90, it.cosine);
    o.f0 = f0_from_ior(it.eta);
    push.outputs.at[i] = o;
}
