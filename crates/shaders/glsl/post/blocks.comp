// First pass of the automatic exposure: luminance summed over each block of the picture; a work group is a block.
// Twin: `block_means` of core/src/color.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "post/post.glsl"

layout(local_size_x = 64) in;

shared vec2 part[64];

void main() {
    uint local = gl_LocalInvocationID.x;
    uvec2 first = gl_WorkGroupID.xy * push.block_side;
    uvec2 size = min(push.size - first, uvec2(push.block_side));
    vec2 sum = vec2(0.0);
    for (uint i = local; i < size.x * size.y; i += 64u) {
        uvec2 pixel = first + uvec2(i % size.x, i / size.x);
        float y = luminance(film_radiance(pixel.y * push.size.x + pixel.x));
        sum += is_finite(y) ? vec2(y, 1.0) : vec2(0.0);
    }
    part[local] = sum;
    for (uint half_ = 32u; half_ > 0u; half_ >>= 1) {
        barrier();
        if (local < half_) {
            part[local] += part[local + half_];
        }
    }
    if (local == 0u) {
        push.blocks.at[gl_WorkGroupID.y * push.block_count.x + gl_WorkGroupID.x] = part[0];
    }
}
