// Anti-aliasing of one frame by its own edges: finds how far an edge runs and blends across it by where in its step the pixel lies.
// Lottes 2009, "FXAA". Edges are found in the logarithm of luminance, so that exposure does not matter.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/frame.glsl"

// Contrast of an edge, stops.
const float EDGE_STOPS = 0.25;
// Steps along an edge, and pixels of each.
const uint STEPS = 10u;
const float STRIDES[STEPS] = float[STEPS](1.0, 1.0, 1.0, 1.0, 1.5, 2.0, 2.0, 2.0, 4.0, 8.0);
// How much of what is left single pixels lose.
const float SUBPIXEL = 0.75;

vec3 color_at(ivec2 at) {
    at = clamp(at, ivec2(0), ivec2(push.view.size) - 1);
    return push.frame.drawn.at[uint(at.y) * push.view.size.x + uint(at.x)].xyz;
}

float stops_of(vec3 c) {
    return log2(max(luminance(c), 1e-9));
}

float stops_at(ivec2 at) {
    return stops_of(color_at(at));
}

vec3 color_between(vec2 place) {
    vec2 low = floor(place);
    vec2 f = place - low;
    ivec2 at = ivec2(low);
    return mix(
        mix(color_at(at), color_at(at + ivec2(1, 0)), f.x), mix(color_at(at + ivec2(0, 1)), color_at(at + ivec2(1, 1)), f.x), f.y);
}

// The picture at a pixel, edges smoothed.
vec3 smoothed(ivec2 at) {
    vec3 here = color_at(at);
    float m = stops_of(here);
    float n = stops_at(at + ivec2(0, -1));
    float s = stops_at(at + ivec2(0, 1));
    float w = stops_at(at + ivec2(-1, 0));
    float e = stops_at(at + ivec2(1, 0));
    float highest = max(m, max(max(n, s), max(w, e)));
    float range = highest - min(m, min(min(n, s), min(w, e)));
    if (range < EDGE_STOPS) {
        return here;
    }
    float nw = stops_at(at + ivec2(-1, -1));
    float ne = stops_at(at + ivec2(1, -1));
    float sw = stops_at(at + ivec2(-1, 1));
    float se = stops_at(at + ivec2(1, 1));
    // Single pixels: how far the pixel lies off the mean around it.
    float mean = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
    float off = clamp(abs(mean - m) / range, 0.0, 1.0);
    float single = off * off * (3.0 - 2.0 * off);
    single = single * single * SUBPIXEL;
    // Which way the edge runs.
    float across_rows = abs(nw - 2.0 * w + sw) + 2.0 * abs(n - 2.0 * m + s) + abs(ne - 2.0 * e + se);
    float across_columns = abs(nw - 2.0 * n + ne) + 2.0 * abs(w - 2.0 * m + e) + abs(sw - 2.0 * s + se);
    bool horizontal = across_rows >= across_columns;
    float low = horizontal ? n : w;
    float high = horizontal ? s : e;
    bool towards_low = abs(low - m) >= abs(high - m);
    float step_ = towards_low ? -1.0 : 1.0;
    float gradient = 0.25 * max(abs(low - m), abs(high - m));
    float edge = 0.5 * ((towards_low ? low : high) + m);
    vec2 across = horizontal ? vec2(0.0, step_) : vec2(step_, 0.0);
    vec2 along = horizontal ? vec2(1.0, 0.0) : vec2(0.0, 1.0);
    vec2 start = vec2(at) + 0.5 * across;
    // To both ends of the edge.
    vec2 ends = vec2(0.0);
    vec2 delta = vec2(0.0);
    for (int side = 0; side < 2; ++side) {
        float sign_ = side == 0 ? -1.0 : 1.0;
        float reached = 0.0;
        for (uint i = 0u; i < STEPS; ++i) {
            reached += STRIDES[i];
            delta[side] = stops_of(color_between(start + along * (sign_ * reached))) - edge;
            if (abs(delta[side]) >= gradient) {
                break;
            }
        }
        ends[side] = reached;
    }
    bool first = ends.x < ends.y;
    float nearer = first ? ends.x : ends.y;
    float at_end = first ? delta.x : delta.y;
    // Only where the nearer end turns to the other side of the edge.
    float shift = (at_end < 0.0) != (m < edge) ? 0.5 - nearer / (ends.x + ends.y) : 0.0;
    return color_between(vec2(at) + across * max(shift, single));
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.view.size))) {
        return;
    }
    FrameFloats shown = push.frame.shown[push.frame.turn];
    shown.at[at.y * push.view.size.x + at.x] = vec4(smoothed(ivec2(at)), 1.0);
}
