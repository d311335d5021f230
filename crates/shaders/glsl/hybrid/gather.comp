// The picture and the planes of each pixel to a film of one sample.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/frame.glsl"
#include "label.glsl"

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.frame.shown_size))) {
        return;
    }
    uint place = at.y * push.frame.shown_size.x + at.x;
    // The frame may have fewer pixels.
    uvec2 seen = min(at * push.view.size / push.frame.shown_size, push.view.size - 1u);
    uint pixel = seen.y * push.view.size.x + seen.x;
    vec4 normal = uintBitsToFloat(PLANE(PLANE_NORMAL, pixel));
    uvec4 position = PLANE(PLANE_POSITION, pixel);
    FilmSample s;
    // Passes after `drawn`: with none it is what is shown.
    bool is_shown = push.sample_count > 0u;
    s.radiance = is_shown ? push.frame.shown[push.frame.turn].at[place].xyz : push.frame.drawn.at[place].xyz;
    s.has_hit = position.w != NONE;
    s.alpha = s.has_hit ? 1.0 : 0.0;
    s.normal = normal.xyz;
    s.depth = normal.w;
    s.position = uintBitsToFloat(position.xyz);
    s.albedo = push.view.object_colors != 0u ? label(position.w) : uintBitsToFloat(PLANE(PLANE_ALBEDO, pixel).xyz);
    PixelSums sums;
    sums.radiance = int64_t[3](0l, 0l, 0l);
    sums.luminance = 0l;
    sums.luminance_squared = uint64_t[2](0ul, 0ul);
    sums.albedo = sums.radiance;
    sums.normal = sums.radiance;
    sums.position = sums.radiance;
    sums.depth = 0l;
    sums.alpha = 0l;
    sums.samples = 0u;
    sums.hits = 0u;
    sums.saturated = 0u;
    sums.unused = uint[3](0u, 0u, 0u);
    NonFiniteList non_finite = push.view.non_finite;
    film_add(sums, non_finite, push.view.origin + at, push.first_sample, s);
    FilmPixels film = push.view.film;
    film.at[place] = sums;
}
