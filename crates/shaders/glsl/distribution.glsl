// Discrete distributions as cumulative tables, sampled by bisection. Twin: core/src/distribution.rs.
#ifndef DISTRIBUTION_GLSL
#define DISTRIBUTION_GLSL

#include "math.glsl"
#include "scene/layout.glsl"

// An entry drawn from a table: `Choice`.
struct CdfSample {
    // Which entry.
    uint index;
    // Its probability.
    float probability;
    // Where in the entry the number fell, in [0, 1): as good a random number as the one spent.
    float remainder;
};

// Steps of a table: as many as a random number has.
const float CDF_STEPS = 16777216.0;

// The entry that `u` in [0, 1) falls into, of the `count` entries (`count` + 1 values) that begin at `first`; never one of probability 0.
// False for a table of zeros.
bool sample_cdf(Floats cdf, uint first, uint count, float u, out CdfSample chosen) {
    // The first value above u.
    uint end = 0u;
    uint beyond = count + 1u;
    while (end < beyond) {
        uint middle = (end + beyond) >> 1;
        if (cdf.at[first + middle] <= u) {
            end = middle + 1u;
        } else {
            beyond = middle;
        }
    }
    if (end == 0u || end > count) {
        return false;
    }
    float low = cdf.at[first + end - 1u];
    float high = cdf.at[first + end];
    // The middle of the step that `u` stands for. `precise`: in this order the difference is exact.
    precise float inside = u - low;
    inside = inside + 0.5 / CDF_STEPS;
    chosen = CdfSample(end - 1u, high - low, min(inside / (high - low), ONE_MINUS_EPSILON));
    return true;
}

#endif
