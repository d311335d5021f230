// Twin test of tone.glsl and color.glsl: testkit/tests/twins/tone.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    vec3 color;
    float strength;
    vec2 at;
    // Exposure: last frame's, this one's, share of the way.
    vec3 exposure;
};
struct Output {
    vec3 display[6];
    float vignette;
    float encoded;
    float decoded;
    float eased;
};

#include "twins/kernel.glsl"
#include "tone.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    vec3[6] display;
    for (uint curve = 0u; curve < 6u; ++curve) {
        display[curve] = tone_display(curve, it.color);
    }
    push.outputs.at[i] = Output(
        display,
        vignette(it.strength, it.at),
        srgb_encode(it.color.r),
        srgb_decode(it.at.x),
        exposure_eased(it.exposure.x, it.exposure.y, it.exposure.z)
    );
}
