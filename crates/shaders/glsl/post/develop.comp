// Last pass: lens, exposure and tone curve, to 8 bits. Twin: `develop` and `Lens` of lumbre/src/output.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "post/post.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// 0..1 as 8 bits.
uint code(float x) {
    return min(uint(x * 255.0 + 0.5), 255u);
}

// Where an enlargement about the centre looks: four pixels and the shares of the farther ones.
struct Taps {
    uint at[4];
    vec2 share;
};

Taps taps(vec2 offset, float shrink) {
    // In units of pixels, the centre of the first one at 0. `precise` and without a quotient: beside a spark, a place that is off by
    // a rounding would show another brightness.
    precise vec2 place = offset * shrink + push.center - 0.5;
    vec2 at = clamp(place, vec2(0.0), vec2(push.size - 1u));
    uvec2 low = uvec2(at);
    uvec2 high = min(low + 1u, push.size - 1u);
    uint w = push.size.x;
    uint[4] all = uint[4](low.y * w + low.x, low.y * w + high.x, high.y * w + low.x, high.y * w + high.x);
    return Taps(all, at - vec2(low));
}

float mixed(Taps t, float a, float b, float c, float d) {
    float top = a * (1.0 - t.share.x) + b * t.share.x;
    float bottom = c * (1.0 - t.share.x) + d * t.share.x;
    return top * (1.0 - t.share.y) + bottom * t.share.y;
}

// What an enlargement about the centre brings to a place, of one band.
float bilinear_band(vec2 offset, uint band) {
    Taps t = taps(offset, push.shrinks[band]);
    return mixed(
        t, film_radiance(t.at[0])[band], film_radiance(t.at[1])[band], film_radiance(t.at[2])[band],
        film_radiance(t.at[3])[band]);
}

float bilinear_alpha(vec2 offset, float shrink) {
    Taps t = taps(offset, shrink);
    return mixed(t, film_alpha(t.at[0]), film_alpha(t.at[1]), film_alpha(t.at[2]), film_alpha(t.at[3]));
}

Rgb lens_color(uint at, vec2 offset) {
    Rgb c = push.aberrates == 0u
        ? film_radiance(at)
        : Rgb(bilinear_band(offset, 0u), bilinear_band(offset, 1u), bilinear_band(offset, 2u));
    return push.vignette == 0.0 ? c : c * vignette(push.vignette, offset / push.half_diagonal);
}

// The most that any band has of it, so that fringes are not cut off.
float lens_alpha(uint at, vec2 offset) {
    if (push.aberrates == 0u) {
        return film_alpha(at);
    }
    float red_green = max(bilinear_alpha(offset, push.shrinks.r), bilinear_alpha(offset, push.shrinks.g));
    return max(red_green, bilinear_alpha(offset, push.shrinks.b));
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x >= push.size.x || pixel.y >= push.size.y) {
        return;
    }
    uint at = pixel.y * push.size.x + pixel.x;
    vec2 offset = vec2(pixel) + 0.5 - push.center;
    Rgb color = lens_color(at, offset) * push.state.factor;
    uint shown = 255u;
    if (push.transparent == 1u) {
        float alpha = lens_alpha(at, offset);
        shown = code(alpha);
        color = alpha > 0.0 ? color * (1.0 / alpha) : BLACK;
    }
    color = tone_display(push.tone, color);
    push.display.at[at] = code(color.r) | code(color.g) << 8 | code(color.b) << 16 | shown << 24;
}
