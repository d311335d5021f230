// Twin test of wavelength.glsl: testkit/tests/twins/wavelength.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    float u;
    float ior;
    float dispersion;
    float nm;
};
struct Output {
    float nm;
    vec3 weight;
    float index;
};

#include "twins/kernel.glsl"
#include "wavelength.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Wavelength w = wavelength_sample(it.u);
    push.outputs.at[i] = Output(w.nm, w.weight, dispersed_index(it.ior, it.dispersion, it.nm));
}
