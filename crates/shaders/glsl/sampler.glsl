// The one random stream: a camera sample is a pure function of (frame, pixel, sample index, dimension, seed).
// Twin: core/src/sampler/mod.rs, where the table of dimensions is. The integers are the same, to the bit. Only the numbers that are
// asked for are made.
#ifndef SAMPLER_GLSL
#define SAMPLER_GLSL

#include "hash.glsl"
#include "sampler/sobol.glsl"

const uint SAMPLER_SOBOL = 0u;
const uint SAMPLER_INDEPENDENT = 1u;
// How the unit hypercube is sampled: `SamplerKind`.
layout(constant_id = 30) const uint SAMPLER_KIND = SAMPLER_SOBOL;

// Sets before the first vertex.
const uint CAMERA_SETS = 2u;
// Sets of a vertex.
const uint VERTEX_SETS = 3u;

// The stream of one camera sample.
struct Sampler {
    uint key;
    uint index;
};

// The stream of sample `index` at `pixel`.
Sampler sampler_new(uint seed, uint frame, uvec2 pixel, uint index) {
    uint key = hash_combine(hash_combine(hash_combine(hash_u32(seed), frame), pixel.x), pixel.y);
    return Sampler(key, index);
}

// One set of four numbers.
struct Set {
    // The place in the shuffled sequence; for independent numbers the hash that they come from.
    uint at;
    uint key;
};

Set sampler_set(Sampler self_, uint set) {
    uint key = hash_combine(self_.key, set);
    if (SAMPLER_KIND == SAMPLER_INDEPENDENT) {
        return Set(hash_combine(key, self_.index), key);
    }
    return Set(sobol_shuffled(self_.index, key), key);
}

// The raw integer of dimension `d` (0 to 3, known when compiled).
uint set_bits(Set self_, uint d) {
    if (SAMPLER_KIND == SAMPLER_INDEPENDENT) {
        return hash_combine(self_.at, d);
    }
    return sobol_scrambled(sobol_reversed(self_.at, d), self_.key, d);
}

// Dimension `d` as a number in [0, 1).
float set_number(Set self_, uint d) {
    return to_unit(set_bits(self_, d));
}

// Dimensions `d` and `d + 1`.
vec2 set_pair(Set self_, uint d) {
    return vec2(set_number(self_, d), set_number(self_, d + 1u));
}

// Position within the pixel's filter.
vec2 sampler_filter(Sampler self_) {
    return set_pair(sampler_set(self_, 0u), 0u);
}

// Position on the lens.
vec2 sampler_lens(Sampler self_) {
    return set_pair(sampler_set(self_, 1u), 0u);
}

// Moment in the shutter interval.
float sampler_time(Sampler self_) {
    return set_number(sampler_set(self_, 1u), 2u);
}

// Wavelength.
float sampler_wavelength(Sampler self_) {
    return set_number(sampler_set(self_, 1u), 3u);
}

// Direction in which the path goes on from vertex `k` (0 is the first surface hit).
vec2 sampler_direction(Sampler self_, uint k) {
    return set_pair(sampler_set(self_, CAMERA_SETS + VERTEX_SETS * k), 0u);
}

// Point on a light as seen from vertex `k`.
vec2 sampler_light_point(Sampler self_, uint k) {
    return set_pair(sampler_set(self_, k == 0u ? 0u : CAMERA_SETS + VERTEX_SETS * (k - 1u)), 2u);
}

// Point on a light of the second group as seen from vertex `k`, where both groups have lights.
vec2 sampler_second_light_point(Sampler self_, uint k) {
    return set_pair(sampler_set(self_, CAMERA_SETS + VERTEX_SETS * k + 2u), 2u);
}

// The key that stochastic coverage hashes together with vertex, instance and primitive.
uint sampler_coverage_key(Sampler self_) {
    return hash_combine(self_.key, self_.index ^ 0x5bd1e995u);
}

// Whether light of a faint group is asked for at vertex `k`. Apart from the table, since it is rarely needed.
float sampler_light_roulette(Sampler self_, uint k) {
    return to_unit(hash_combine(sampler_coverage_key(self_) ^ 0x3c6ef372u, k));
}

Set sampler_choices(Sampler self_, uint k) {
    return sampler_set(self_, CAMERA_SETS + VERTEX_SETS * k + 1u);
}

// Which lobe scatters at vertex `k`.
float sampler_lobe(Sampler self_, uint k) {
    return set_number(sampler_choices(self_, k), 0u);
}

// Where on a light of small probability, as seen from vertex `k`.
float sampler_light(Sampler self_, uint k) {
    return set_number(sampler_choices(self_, k), 1u);
}

// Russian roulette after vertex `k`.
float sampler_roulette(Sampler self_, uint k) {
    return set_number(sampler_choices(self_, k), 2u);
}

// Stream `which` of the `part`-th of `parts` draws that this sample takes apart from the table, for what needs many numbers at one
// vertex. Where `parts` is a power of two, those of one sample are stratified among themselves.
Sampler sampler_split(Sampler self_, uint which, uint parts, uint part) {
    uint key = hash_combine(self_.key, hash_u32(which ^ 0x9e3779b9u));
    return Sampler(key, self_.index * parts + part);
}

#endif
