// Light of pixels, added by many invocations in any order to the same bits: quanta of 2^-24, as the film has them.
#ifndef HYBRID_SUMS_GLSL
#define HYBRID_SUMS_GLSL

#extension GL_EXT_shader_atomic_int64 : require

#include "hybrid/frame.glsl"

void sums_begin(uint pixel, Spectrum light) {
    FrameSums sums = push.frame.sums;
    for (uint i = 0u; i < 3u; ++i) {
        sums.at[3u * pixel + i] = uint64_t(film_quantise(light[i]));
    }
}

void sums_add(uint pixel, Spectrum light) {
    FrameSums sums = push.frame.sums;
    for (uint i = 0u; i < 3u; ++i) {
        if (light[i] != 0.0) {
            atomicAdd(sums.at[3u * pixel + i], uint64_t(film_quantise(light[i])));
        }
    }
}

#endif
