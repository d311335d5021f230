// Twin test of light/environment.glsl and distribution.glsl: testkit/tests/twins/environment.rs. Each input is a small map with its tables
// and a few questions.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

const uint QUESTIONS = 16u;

struct Input {
    vec2 u[QUESTIONS];
    vec3 direction[QUESTIONS];
    uint width;
    uint height;
    float rotation;
    vec3 pixels[32];
    float row_cdf[5];
    float cell_cdf[36];
};
struct Answer {
    vec3 radiance;
    float pdf;
    uint found;
    vec3 wi;
    float sample_pdf;
    uint found_row;
    uint row;
    float probability;
    float remainder;
};
struct Output {
    Answer answers[QUESTIONS];
};

#include "twins/kernel.glsl"
#include "light/environment.glsl"

// Words of an input, and the places of its arrays.
const uint U_WORDS = 2u * QUESTIONS;
const uint DIRECTION_WORDS = 3u * QUESTIONS;
const uint PIXELS = U_WORDS + DIRECTION_WORDS + 3u;
const uint ROW_CDF = PIXELS + 3u * 32u;
const uint CELL_CDF = ROW_CDF + 5u;
const uint WORDS = CELL_CDF + 36u;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    uint64_t base = uint64_t(push.inputs) + 4ul * uint64_t(WORDS) * uint64_t(i);
    EnvironmentLight light = EnvironmentLight(
        push.inputs.at[i].width, push.inputs.at[i].height, push.inputs.at[i].rotation,
        Vectors(base + 4ul * uint64_t(PIXELS)),
        Floats(base + 4ul * uint64_t(ROW_CDF)),
        Floats(base + 4ul * uint64_t(CELL_CDF)));
    for (uint k = 0u; k < QUESTIONS; ++k) {
        vec2 u = push.inputs.at[i].u[k];
        vec3 d = push.inputs.at[i].direction[k];
        Answer a;
        a.radiance = environment_radiance(light, d);
        a.pdf = environment_pdf(light, d);
        // Where nothing is found, what is returned beside is undefined.
        vec3 wi;
        float sample_pdf;
        bool found = environment_sample(light, u, wi, sample_pdf);
        a.found = uint(found);
        a.wi = found ? wi : vec3(0.0);
        a.sample_pdf = found ? sample_pdf : 0.0;
        CdfSample row;
        bool found_row = sample_cdf(light.row_cdf, 0u, light.height, u.y, row);
        a.found_row = uint(found_row);
        a.row = found_row ? row.index : 0u;
        a.probability = found_row ? row.probability : 0.0;
        a.remainder = found_row ? row.remainder : 0.0;
        push.outputs.at[i].answers[k] = a;
    }
}
