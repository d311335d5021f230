// Adds the finished samples of a slice to the film: one invocation for each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 64) in;

#include "path/push.glsl"
#include "path/state.glsl"

void main() {
    uint place = gl_GlobalInvocationID.x;
    uint paths = paths_per_sample();
    if (place >= paths) {
        return;
    }
    uvec2 within = path_pixel(place);
    if (any(greaterThanEqual(within, push.size))) {
        return;
    }
    uvec2 at = push.first_pixel + within;
    FilmPixels sums = push.view.film;
    NonFiniteList non_finite = push.view.non_finite;
    for (uint i = 0u; i < push.sample_count; ++i) {
        uint id = i * paths + place;
        vec4 radiance = STATE(STATE_RADIANCE, id);
        vec4 normal = STATE(STATE_NORMAL, id);
        FilmSample result;
        result.radiance = radiance.xyz + pending_brought(id, path_load_asked(id), 0u) + pending_brought(id, path_load_asked(id), 1u);
        result.alpha = radiance.w;
        result.has_hit = normal.w != 0.0;
        result.normal = normal.xyz;
        result.albedo = vec3(0.0);
        result.position = vec3(0.0);
        result.depth = 0.0;
        if (result.has_hit) {
            vec4 albedo = STATE(STATE_ALBEDO, id);
            result.albedo = albedo.xyz;
            result.depth = albedo.w;
            result.position = STATE(STATE_POSITION, id).xyz;
        }
        film_add(sums, non_finite, at.y * push.view.size.x + at.x, push.view.origin + at, push.first_sample + i, result);
    }
}
