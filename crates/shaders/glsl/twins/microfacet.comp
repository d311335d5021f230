// Twin test of microfacet.glsl: testkit/tests/twins/microfacet.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    float alpha;
    float strength;
    vec3 wo;
    vec3 wi;
    vec2 u;
};
struct Output {
    float alpha_x;
    float alpha_y;
    float g1;
    float visibility;
    vec3 normal;
    vec3 mirrored;
    // At a facet given by `wi`, and the reflection about the half vector.
    float d;
    float pdf_normal;
    float reflected;
    float pdf_reflected;
};

#include "twins/kernel.glsl"
#include "microfacet.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Ggx ggx = ggx_isotropic(it.alpha);
    if (it.strength > 0.0) {
        ggx = ggx_stretched(it.alpha, it.strength);
    }
    Output o;
    o.alpha_x = ggx.alpha_x;
    o.alpha_y = ggx.alpha_y;
    o.g1 = ggx_g1(ggx, it.wi);
    o.visibility = ggx_visibility(ggx, it.wo, it.wi);
    o.normal = ggx_sample_visible_normal(ggx, it.wo, it.u);
    o.mirrored = mirror_about(it.wo, o.normal);
    o.d = ggx_d(ggx, it.wi);
    o.pdf_normal = ggx_pdf_visible_normal(ggx, it.wo, it.wi);
    o.reflected = ggx_reflection(ggx, it.wo, it.wi, normalize(it.wo + it.wi), o.pdf_reflected);
    push.outputs.at[i] = o;
}
