// What the passes from a film to what a display is sent have in common: blocks.comp, exposure.comp, develop.comp, in this order.
// Twins: lumbre/src/output.rs; of the push constants shaders/src/post.rs.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#ifndef POST_GLSL
#define POST_GLSL

#include "film.glsl"
#include "tone.glsl"

// Sum of the luminances of a block's pixels, and their number.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer BlockSums {
    vec2 at[];
};
// The exposure, kept from frame to frame; all zero before the first.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ExposureState {
    float factor;
    // 1 once there was a frame.
    uint known;
};
// 8 bits each of red, green, blue and alpha, red in the low byte.
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer DisplayPixels {
    uint at[];
};

layout(push_constant, scalar) uniform PostPush {
    FilmPixels film;
    BlockSums blocks;
    ExposureState state;
    DisplayPixels display;
    // Of the film, pixels.
    uvec2 size;
    // Side of a block, pixels, and how many there are along each axis.
    uint block_side;
    uvec2 block_count;
    // One of EXPOSURE_..., and the factor of EXPOSURE_FACTOR; on the others, a factor on what they find.
    uint exposure;
    float factor;
    // How far the exposure goes from the last frame's to this one's: 1 all the way.
    float ease;
    // One of TONE_...
    uint tone;
    float vignette;
    // From the film's top left corner to the centre of the picture, pixels.
    vec2 center;
    float half_diagonal;
    // 1: bands are enlarged about the centre, each by one over `shrinks`.
    uint aberrates;
    vec3 shrinks;
    // 1: colours are those of what is there, with alpha.
    uint transparent;
} push;

float film_mean(int64_t sum, uint n) {
    return n == 0u ? 0.0 : float(sum) * (1.0 / 16777216.0) / float(n);
}

// Mean radiance of a pixel.
Rgb film_radiance(uint at) {
    uint n = push.film.at[at].samples;
    return Rgb(
        film_mean(push.film.at[at].radiance[0], n),
        film_mean(push.film.at[at].radiance[1], n),
        film_mean(push.film.at[at].radiance[2], n)
    );
}

// How much of the background is covered, 0 to 1.
float film_alpha(uint at) {
    return clamp(film_mean(push.film.at[at].alpha, push.film.at[at].samples), 0.0, 1.0);
}

#endif
