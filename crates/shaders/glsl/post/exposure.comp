// Second pass: one work group makes the exposure factor of all blocks. Twin: `Exposure::factor` of core/src/color.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "post/post.glsl"

const uint THREADS = 256u;
layout(local_size_x = 256) in;

shared vec2 part[THREADS];

// The sum over all threads, for all of them.
vec2 sum_of_all(vec2 x) {
    uint local = gl_LocalInvocationID.x;
    part[local] = x;
    for (uint half_ = THREADS / 2u; half_ > 0u; half_ >>= 1) {
        barrier();
        if (local < half_) {
            part[local] += part[local + half_];
        }
    }
    barrier();
    vec2 sum = part[0];
    barrier();
    return sum;
}

// 0.5 over the average luminance.
float thesis_factor() {
    vec2 sum = vec2(0.0);
    for (uint i = gl_LocalInvocationID.x; i < push.block_count.x * push.block_count.y; i += THREADS) {
        sum += push.blocks.at[i];
    }
    sum = sum_of_all(sum);
    float mean = sum.y > 0.0 ? sum.x / sum.y : 1.0;
    return 0.5 / clamp(mean, 0.1, 1.0);
}

// The log-average luminance of what is lit becomes middle grey.
float auto_factor() {
    uint count = push.block_count.x * push.block_count.y;
    vec2 lit = vec2(0.0);
    for (uint i = gl_LocalInvocationID.x; i < count; i += THREADS) {
        vec2 block = push.blocks.at[i];
        lit += block.x > 0.0 ? vec2(block.x / block.y, 1.0) : vec2(0.0);
    }
    lit = sum_of_all(lit);
    // A thousandth of the mean floors the logarithm, so that near-black areas do not rule.
    float floor_ = 1e-3 * (lit.x / max(lit.y, 1.0));
    vec2 logs = vec2(0.0);
    for (uint i = gl_LocalInvocationID.x; i < count; i += THREADS) {
        vec2 block = push.blocks.at[i];
        logs.x += block.x > 0.0 ? ln(max(block.x / block.y, floor_)) : 0.0;
    }
    logs = sum_of_all(logs);
    return lit.y > 0.0 ? clamp(0.18 / exp(logs.x / lit.y), AUTO_LOW, AUTO_HIGH) : 1.0;
}

void main() {
    float target = push.factor;
    if (push.exposure == EXPOSURE_THESIS) {
        target *= thesis_factor();
    } else if (push.exposure == EXPOSURE_AUTO) {
        target *= auto_factor();
    }
    if (gl_LocalInvocationID.x == 0u) {
        bool known = push.state.known == 1u;
        push.state.factor = known ? exposure_eased(push.state.factor, target, push.ease) : target;
        push.state.known = 1u;
    }
}
