// Light of pixels, added by many invocations in any order to the same bits: quanta of 2^-24, as the film has them.
#ifndef HYBRID_SUMS_GLSL
#define HYBRID_SUMS_GLSL

#extension GL_EXT_shader_atomic_int64 : require

#include "hybrid/frame.glsl"

const float QUANTUM = 1.0 / 16777216.0;

uint sum_place(uint channel, uint band, uint pixel) {
    return (3u * channel + band) * frame_pixels() + pixel;
}

// All channels of a pixel: this light in the sharp one.
void sums_begin(uint pixel, Spectrum light) {
    FrameSums sums = push.frame.sums;
    for (uint i = 0u; i < 3u; ++i) {
        sums.at[sum_place(CHANNEL_SHARP, i, pixel)] = uint64_t(film_quantise(light[i]));
        sums.at[sum_place(CHANNEL_SOFT, i, pixel)] = 0ul;
        sums.at[sum_place(CHANNEL_GATHERED, i, pixel)] = 0ul;
    }
}

void sums_add(uint channel, uint pixel, Spectrum light) {
    FrameSums sums = push.frame.sums;
    for (uint i = 0u; i < 3u; ++i) {
        if (light[i] != 0.0) {
            atomicAdd(sums.at[sum_place(channel, i, pixel)], uint64_t(film_quantise(light[i])));
        }
    }
}

Spectrum sums_read(uint channel, uint pixel) {
    Spectrum light;
    for (uint i = 0u; i < 3u; ++i) {
        light[i] = float(int64_t(push.frame.sums.at[sum_place(channel, i, pixel)])) * QUANTUM;
    }
    return light;
}

#endif
