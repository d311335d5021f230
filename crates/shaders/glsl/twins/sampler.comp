// Twin test of sampler.glsl: testkit/tests/twins/sampler.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    uint seed;
    uint frame;
    uvec2 pixel;
    uint index;
    uint vertex;
    uint which;
    uint parts;
    uint part;
};
struct Output {
    // The four dimensions of one set.
    uint bits[4];
    vec2 filter_;
    vec2 lens;
    float time;
    float wavelength;
    vec2 direction;
    vec2 light_point;
    vec2 second_light_point;
    float light_roulette;
    float lobe;
    float light;
    float roulette;
    uint coverage_key;
    // First direction of a split stream.
    vec2 split;
};

#include "twins/kernel.glsl"
#include "sampler.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Sampler s = sampler_new(it.seed, it.frame, it.pixel, it.index);
    Set set = sampler_set(s, it.vertex);
    uint k = it.vertex;
    push.outputs.at[i] = Output(
        uint[4](set_bits(set, 0u), set_bits(set, 1u), set_bits(set, 2u), set_bits(set, 3u)),
        sampler_filter(s),
        sampler_lens(s),
        sampler_time(s),
        sampler_wavelength(s),
        sampler_direction(s, k),
        sampler_light_point(s, k),
        sampler_second_light_point(s, k),
        sampler_light_roulette(s, k),
        sampler_lobe(s, k),
        sampler_light(s, k),
        sampler_roulette(s, k),
        sampler_coverage_key(s),
        sampler_direction(sampler_split(s, it.which, it.parts, it.part), 0u)
    );
}
