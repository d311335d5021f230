// Twin test of film.glsl: testkit/tests/twins/film.rs. Each invocation adds a few samples to a pixel of its own; non-finite samples are named
// in a list of its own too, which has room for all of them.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "film.glsl"

const uint SAMPLES = 8u;

struct Sample {
    vec3 radiance;
    uint has_hit;
    vec3 albedo;
    vec3 normal;
    vec3 position;
    float depth;
    float alpha;
};
struct Input {
    PixelSums start;
    uvec2 pixel;
    Sample samples[SAMPLES];
    uint unused[2];
};
struct Output {
    PixelSums sums;
    uint count;
    NonFinite named[SAMPLES];
    uint unused[3];
};

#include "twins/kernel.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    PixelSums sums = push.inputs.at[i].start;
    push.outputs.at[i].count = 0u;
    // The list lies in the output, behind the pixel.
    const uint64_t STRIDE = 160ul + 4ul + 12ul * uint64_t(SAMPLES) + 12ul;
    uint64_t address = uint64_t(push.outputs) + STRIDE * uint64_t(i);
    NonFiniteList list = NonFiniteList(address + 160ul);
    for (uint k = 0u; k < SAMPLES; ++k) {
        Sample s = push.inputs.at[i].samples[k];
        FilmSample added = FilmSample(
            s.radiance, s.has_hit == 1u, s.albedo, s.normal, s.position, s.depth, s.alpha);
        film_add(sums, list, push.inputs.at[i].pixel, 7u + k, added);
    }
    push.outputs.at[i].sums = sums;
}
