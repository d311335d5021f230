// Sharp light and filtered soft light of each pixel, together.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/filter/soft.glsl"

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.view.size))) {
        return;
    }
    uint pixel = at.y * push.view.size.x + at.x;
    Spectrum light = sums_read(CHANNEL_SHARP, pixel);
    // Passes of the filter; without any, soft light is the frame's sample.
    uint passes = push.sample_count;
    if (passes > 0u) {
        light += push.frame.soft[passes % 2u].at[pixel].xyz * plane_albedo(pixel);
    } else {
        light += sums_read(CHANNEL_SOFT, pixel) + sums_read(CHANNEL_GATHERED, pixel);
    }
    float covered = PLANE(PLANE_POSITION, pixel).w != NONE ? 1.0 : 0.0;
    FrameFloats drawn = push.frame.drawn;
    drawn.at[pixel] = vec4(light, covered);
}
