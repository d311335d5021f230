// Reconstruction filters, by importance sampling. Twin: core/src/filter.rs. The tables of the inverses are in push.tables.
#ifndef FILTER_GLSL
#define FILTER_GLSL

#include "math.glsl"

// `FilterKind`, in its order.
const uint FILTER_BOX = 0u;
const uint FILTER_TENT = 1u;
const uint FILTER_GAUSSIAN = 2u;
const uint FILTER_BLACKMAN_HARRIS = 3u;
const uint FILTER_POINT = 4u;

// Intervals of the tabulated inverse.
const uint FILTER_TABLE = 256u;

// Offset from the pixel's centre along one axis, pixels.
float filter_sample_axis(uint kind, float u) {
    if (kind == FILTER_POINT) {
        return 0.0;
    }
    if (kind == FILTER_BOX) {
        return u - 0.5;
    }
    if (kind == FILTER_TENT) {
        return u < 0.5 ? safe_sqrt(2.0 * u) - 1.0 : 1.0 - safe_sqrt(2.0 - 2.0 * u);
    }
    uint table = kind - FILTER_GAUSSIAN;
    float signed_ = 2.0 * u - 1.0;
    float x = safe_sqrt(1.0 - abs(signed_)) * float(FILTER_TABLE);
    uint i = min(uint(x), FILTER_TABLE - 1u);
    float a = push.tables.filter_distance[table][i];
    float b = push.tables.filter_distance[table][i + 1u];
    return copysign(lerp(a, b, x - float(i)), signed_);
}

// Offset from the pixel's centre for a point of the unit square, pixels. `kind` is one of FILTER_...
vec2 filter_sample(uint kind, vec2 u) {
    return vec2(filter_sample_axis(kind, u.x), filter_sample_axis(kind, u.y));
}

#endif
