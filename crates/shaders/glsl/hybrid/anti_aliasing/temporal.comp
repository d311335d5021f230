// Anti-aliasing over time: each frame looks through other places of its pixels, and what it sees joins what the same points showed before. Where the
// picture that is shown has more pixels than the frame, it also becomes sharper than a frame. Karis 2014, "High-Quality Temporal Supersampling";
// Salvi 2016, "An Excursion in Temporal Supersampling" (clipping by the variance of the neighbours).
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/frame.glsl"

// Share of a new frame where it shows just this place.
const float NEW_SHARE = 0.1;
// Standard deviations of the neighbours that a history may lie off their mean.
const float CLIP_SIGMAS = 1.25;
// Most frames that are averaged while nothing changes.
const float LONGEST_STILL = 64.0;

// Luminance and two differences; of colours whose range is compressed, so that a bright neighbour does not decide alone.
vec3 to_ycocg(vec3 c) {
    return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * c.r - 0.5 * c.b, -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}

vec3 from_ycocg(vec3 c) {
    float t = c.x - c.z;
    return vec3(t + c.y, c.x + c.z, t - c.y);
}

vec3 compressed(vec3 c, float white) {
    return to_ycocg(c / (1.0 + max_component(c) / white));
}

vec3 expanded(vec3 c, float white) {
    vec3 rgb = max(from_ycocg(c), 0.0);
    return rgb / max(1.0 - max_component(rgb) / white, 1e-4);
}

ivec2 within(ivec2 at, uvec2 size) {
    return clamp(at, ivec2(0), ivec2(size) - 1);
}

vec4 drawn_at(ivec2 at) {
    at = within(at, push.view.size);
    return push.frame.drawn.at[uint(at.y) * push.view.size.x + uint(at.x)];
}

vec4 shown_at(ivec2 at) {
    at = within(at, push.frame.shown_size);
    return push.frame.shown[1u - push.frame.turn].at[uint(at.y) * push.frame.shown_size.x + uint(at.x)];
}

// Weights of four neighbours, of a cubic that passes through them (Catmull and Rom).
vec4 cubic_weights(float f) {
    return vec4(
        f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (-2.5 + 1.5 * f), f * (0.5 + f * (2.0 - 1.5 * f)), f * f * (-0.5 + 0.5 * f));
}

// What was shown at a place, pixels; the fourth: frames that it holds.
vec4 history_at(vec2 place) {
    vec2 low = floor(place - 0.5);
    vec2 f = place - 0.5 - low;
    vec4 wx = cubic_weights(f.x);
    vec4 wy = cubic_weights(f.y);
    vec4 sum = vec4(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            sum += wx[i] * wy[j] * shown_at(ivec2(low) + ivec2(i - 1, j - 1));
        }
    }
    float frames = shown_at(ivec2(floor(place))).w;
    return vec4(max(sum.xyz, 0.0), frames);
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.frame.shown_size))) {
        return;
    }
    vec2 uv = (vec2(at) + 0.5) / vec2(push.frame.shown_size);
    // In pixels of the frame, whose samples lie at whole numbers.
    vec2 place = uv * vec2(push.view.size) - 0.5 - push.frame.jitter;
    ivec2 centre = ivec2(round(place));
    float ratio = float(push.frame.shown_size.y) / float(push.view.size.y);
    vec4 around[9];
    float white = 0.0;
    for (int i = 0; i < 9; ++i) {
        around[i] = drawn_at(centre + ivec2(i % 3 - 1, i / 3 - 1));
        white += luminance(around[i].xyz) / 9.0;
    }
    white = max(8.0 * white, 1e-9);
    // The frame here, by the distance of its samples; their mean and spread; and which of them is nearest to the camera: its motion is that of the edge.
    vec3 now = vec3(0.0);
    float weights = 0.0;
    vec3 mean = vec3(0.0);
    vec3 square = vec3(0.0);
    float nearest = INFINITY;
    vec2 motion = vec2(0.0);
    float closeness = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 tap = centre + ivec2(i % 3 - 1, i / 3 - 1);
        vec3 c = compressed(around[i].xyz, white);
        vec2 d = (vec2(tap) - place) * ratio;
        // A Gaussian of about a pixel of what is shown.
        float w = exp(-2.0 * dot(d, d));
        now += w * c;
        weights += w;
        closeness = max(closeness, w);
        mean += c / 9.0;
        square += c * c / 9.0;
        ivec2 pixel = within(tap, push.view.size);
        uint index = uint(pixel.y) * push.view.size.x + uint(pixel.x);
        float distance = uintBitsToFloat(PLANE(PLANE_NORMAL, index).w);
        if (distance < nearest || i == 0) {
            nearest = distance;
            motion = uintBitsToFloat(PLANE(PLANE_MOTION, index).xy);
        }
    }
    now /= max(weights, 1e-6);
    FrameFloats shown = push.frame.shown[push.frame.turn];
    uint out_pixel = at.y * push.frame.shown_size.x + at.x;
    vec2 uv_then = uv + motion / vec2(push.view.size);
    bool known = push.frame.has_history != 0u && all(greaterThanEqual(uv_then, vec2(0.0))) && all(lessThan(uv_then, vec2(1.0)));
    if (!known) {
        shown.at[out_pixel] = vec4(expanded(now, white), closeness);
        return;
    }
    vec4 then = history_at(uv_then * vec2(push.frame.shown_size));
    vec3 past = compressed(then.xyz, white);
    float frames = then.w + closeness;
    float share = closeness / frames;
    if (push.frame.is_still != 0u) {
        frames = min(frames, LONGEST_STILL);
        share = closeness / frames;
    } else {
        // Towards the mean until it is as near to it as the neighbours are.
        vec3 sigma = sqrt(max(square - mean * mean, 0.0));
        vec3 off = (past - mean) / max(CLIP_SIGMAS * sigma, 1e-5);
        float most = max_component(abs(off));
        past = most > 1.0 ? mean + (past - mean) / most : past;
        frames = min(frames, 1.0 / NEW_SHARE);
        share = max(closeness / frames, NEW_SHARE * closeness);
    }
    shown.at[out_pixel] = vec4(expanded(mix(past, now, clamp(share, 0.0, 1.0)), white), frames);
}
