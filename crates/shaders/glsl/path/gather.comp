// Adds the finished samples of a slice to the film: one invocation for each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 64) in;

#include "path/push.glsl"
#include "path/state.glsl"

// A pixel's record has ten times four words. A group moves its records together, neighbouring invocations neighbouring words: as structs
// they would be a record apart, and each of ten loads and stores would touch as many lines of memory as there are invocations.
const uint RECORD_QUADS = 10u;
// First words of all quads, then second ones, …; a record 11 and not 10 places apart. So neither invocations that move neighbouring quads nor
// those that each read their own record meet in a bank of the memory.
const uint STRIDE = RECORD_QUADS + 1u;
shared uint staged[4u * gl_WorkGroupSize.x * STRIDE];
// The film's pixel of each invocation; NONE outside of the slice.
shared uint pixels[gl_WorkGroupSize.x];

uint staged_at(uint record, uint word) {
    return ((word & 3u) * gl_WorkGroupSize.x + record) * STRIDE + (word >> 2);
}

// Four words of a record of this group, in the film and here.
void stage(uint quad, bool to_film) {
    uint record = quad / RECORD_QUADS;
    if (pixels[record] == NONE) {
        return;
    }
    Quads sums = Quads(uint64_t(push.view.film) + 16ul * RECORD_QUADS * uint64_t(pixels[record]));
    uint place = quad % RECORD_QUADS;
    uvec4 words = to_film ? uvec4(0u) : sums.at[place];
    for (uint i = 0u; i < 4u; ++i) {
        uint at = staged_at(record, 4u * place + i);
        if (to_film) {
            words[i] = staged[at];
        } else {
            staged[at] = words[i];
        }
    }
    if (to_film) {
        sums.at[place] = words;
    }
}

// All of the group's records.
void stage_all(bool to_film) {
    barrier();
    for (uint i = 0u; i < RECORD_QUADS; ++i) {
        stage(i * gl_WorkGroupSize.x + gl_LocalInvocationID.x, to_film);
    }
    barrier();
}

// The `i`-th number of 64 bits of this invocation's record.
uint64_t sum_at(uint i) {
    uint record = gl_LocalInvocationID.x;
    return packUint2x32(uvec2(staged[staged_at(record, 2u * i)], staged[staged_at(record, 2u * i + 1u)]));
}

void set_sum(uint i, uint64_t value) {
    uint record = gl_LocalInvocationID.x;
    uvec2 words = unpackUint2x32(value);
    staged[staged_at(record, 2u * i)] = words.x;
    staged[staged_at(record, 2u * i + 1u)] = words.y;
}

int64_t[3] three_at(uint i) {
    return int64_t[3](int64_t(sum_at(i)), int64_t(sum_at(i + 1u)), int64_t(sum_at(i + 2u)));
}

void set_three(uint i, int64_t[3] values) {
    for (uint k = 0u; k < 3u; ++k) {
        set_sum(i + k, uint64_t(values[k]));
    }
}

// PixelSums, member by member.
PixelSums sums_here() {
    uvec2 counts = unpackUint2x32(sum_at(17u));
    return PixelSums(
        three_at(0u), int64_t(sum_at(3u)), uint64_t[2](sum_at(4u), sum_at(5u)), three_at(6u), three_at(9u), three_at(12u),
        int64_t(sum_at(15u)), int64_t(sum_at(16u)), counts.x, counts.y, unpackUint2x32(sum_at(18u)).x, uint[3](0u, 0u, 0u));
}

void set_sums_here(PixelSums sums) {
    set_three(0u, sums.radiance);
    set_sum(3u, uint64_t(sums.luminance));
    set_sum(4u, sums.luminance_squared[0]);
    set_sum(5u, sums.luminance_squared[1]);
    set_three(6u, sums.albedo);
    set_three(9u, sums.normal);
    set_three(12u, sums.position);
    set_sum(15u, uint64_t(sums.depth));
    set_sum(16u, uint64_t(sums.alpha));
    set_sum(17u, packUint2x32(uvec2(sums.samples, sums.hits)));
    set_sum(18u, packUint2x32(uvec2(sums.saturated, 0u)));
}

// What a path has brought.
FilmSample sample_of(uint id) {
    vec4 radiance = STATE(STATE_RADIANCE, id);
    FilmSample result;
    uint asked = path_load_asked(id, result.has_hit);
    result.radiance = radiance.xyz + pending_brought(id, asked, 0u) + pending_brought(id, asked, 1u);
    result.alpha = radiance.w;
    result.normal = vec3(0.0);
    result.albedo = vec3(0.0);
    result.position = vec3(0.0);
    result.depth = 0.0;
    if (result.has_hit) {
        vec4 albedo = STATE(STATE_ALBEDO, id);
        result.albedo = albedo.xyz;
        result.depth = albedo.w;
        result.normal = STATE(STATE_NORMAL, id).xyz;
        result.position = STATE(STATE_POSITION, id).xyz;
    }
    return result;
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    uint paths = paths_per_sample();
    uvec2 within = path_pixel(place);
    bool inside = place < paths && all(lessThan(within, push.size));
    uvec2 at = push.first_pixel + within;
    pixels[gl_LocalInvocationID.x] = inside ? at.y * push.view.size.x + at.x : NONE;
    stage_all(false);
    if (inside) {
        PixelSums sums = sums_here();
        NonFiniteList non_finite = push.view.non_finite;
        for (uint i = 0u; i < push.sample_count; ++i) {
            film_add(sums, non_finite, push.view.origin + at, push.first_sample + i, sample_of(i * paths + place));
        }
        set_sums_here(sums);
    }
    stage_all(true);
}
