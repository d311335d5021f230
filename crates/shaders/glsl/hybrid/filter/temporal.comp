// Soft light over time: this frame's sample joins what the same points of surfaces had in the frames before.
// Schied et al. 2017, "Spatiotemporal Variance-Guided Filtering". Beyond that: a sample is no brighter than the brightest of its neighbours, and the
// history is cut short where light changes more than its noise does.
#version 460
#extension GL_GOOGLE_include_directive : require

#extension GL_EXT_shader_atomic_int64 : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/filter/soft.glsl"

// Most frames that count while something moves, and while nothing does.
const float LONGEST_HISTORY = 32.0;
const float LONGEST_STILL = 256.0;
// Frames before the spread over time is trusted.
const float SHORT_HISTORY = 4.0;

// What a place had before.
struct Past {
    vec3 light;
    vec2 moments;
    float frames;
    // Mean difference of new samples from the history, smoothed.
    float change;
};

// Whether a pixel of the frame before showed the point.
bool is_same(Guide now, float distance_then, uint pixel) {
    uint pixels = frame_pixels();
    uvec4 normal = push.frame.previous_planes.at[PREVIOUS_NORMAL * pixels + pixel];
    uvec4 position = push.frame.previous_planes.at[PREVIOUS_POSITION * pixels + pixel];
    Guide then = guide_of(normal, position);
    // Seen at a slant a pixel spans more depth.
    float slope = max(abs(dot(now.normal, normalize(push.view.camera.origin - now.position))), 0.05);
    return then.instance == now.instance && abs(then.distance - distance_then) < 0.01 * distance_then / slope
        && dot(then.normal, now.normal) > 0.9;
}

bool find_past(uvec2 at, Guide now, out Past past) {
    uint pixel = at.y * push.view.size.x + at.x;
    vec4 motion = uintBitsToFloat(PLANE(PLANE_MOTION, pixel));
    vec2 place = vec2(at) + motion.xy + push.frame.jitter - push.frame.previous_jitter;
    vec2 low = floor(place);
    vec2 f = place - low;
    past = Past(vec3(0.0), vec2(0.0), 0.0, 0.0);
    float sum = 0.0;
    if (push.frame.has_history == 0u || now.instance == NONE) {
        return false;
    }
    for (int i = 0; i < 4; ++i) {
        ivec2 tap = ivec2(low) + ivec2(i & 1, i >> 1);
        if (any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(push.view.size)))) {
            continue;
        }
        uint there = uint(tap.y) * push.view.size.x + uint(tap.x);
        vec2 w = mix(1.0 - f, f, vec2(i & 1, i >> 1));
        float weight = w.x * w.y;
        if (weight < 1e-3 || !is_same(now, motion.z, there)) {
            continue;
        }
        vec4 light = push.frame.soft_history.at[there];
        vec4 moments = push.frame.moments[1u - push.frame.turn].at[there];
        past.light += weight * light.xyz;
        past.moments += weight * moments.xy;
        past.frames += weight * moments.z;
        past.change += weight * moments.w;
        sum += weight;
    }
    if (sum < 0.01) {
        return false;
    }
    past.light /= sum;
    past.moments /= sum;
    past.frames /= sum;
    past.change /= sum;
    return true;
}

// Light over albedo of each invocation, and whether it counts.
shared vec4 of_group[64];

// Adds what gathering rays brought to pixels of this group to the sums of the frame. A single bright find counts no more than so many times the mean
// before it.
void measure(bool inside, uint pixel) {
    const float MOST = 64.0;
    vec4 mine = vec4(0.0);
    if (inside && PLANE(PLANE_POSITION, pixel).w != NONE) {
        Spectrum light = sums_read(CHANNEL_GATHERED, pixel) / plane_albedo(pixel);
        float largest = max_component(light);
        float most = MOST * max_component(frame_ambient());
        light *= most > 0.0 && largest > most ? most / largest : 1.0;
        mine = is_finite(light) ? vec4(light, 1.0) : vec4(0.0);
    }
    of_group[gl_LocalInvocationIndex] = mine;
    barrier();
    if (gl_LocalInvocationIndex < 4u) {
        float sum = 0.0;
        for (uint i = 0u; i < 64u; ++i) {
            sum += of_group[i][gl_LocalInvocationIndex];
        }
        AmbientSums measured = push.frame.measured[push.frame.turn];
        if (gl_LocalInvocationIndex < 3u) {
            atomicAdd(measured.light[gl_LocalInvocationIndex], uint64_t(film_quantise(sum)));
        } else {
            atomicAdd(measured.pixels, uint64_t(sum));
        }
    }
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    bool inside = all(lessThan(at, push.view.size));
    if (GLOBAL_ILLUMINATION) {
        measure(inside, at.y * push.view.size.x + at.x);
    }
    if (!inside) {
        return;
    }
    uint pixel = at.y * push.view.size.x + at.x;
    Guide now = guide_at(pixel);
    FrameFloats soft = push.frame.soft[0];
    FrameFloats moments = push.frame.moments[push.frame.turn];
    if (now.instance == NONE) {
        soft.at[pixel] = vec4(0.0);
        moments.at[pixel] = vec4(0.0);
        return;
    }
    vec3 light = soft_sample(pixel);
    // Its neighbours on the same surface: how much they differ, and how bright they are.
    float brightest = 0.0;
    vec3 around = vec3(0.0);
    vec2 spread = vec2(0.0);
    float count = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 tap = ivec2(at) + ivec2(x, y);
            bool inside = all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, ivec2(push.view.size)));
            if (!inside || (x == 0 && y == 0)) {
                continue;
            }
            uint there = uint(tap.y) * push.view.size.x + uint(tap.x);
            Guide other = guide_at(there);
            if (other.instance == NONE || dot(other.normal, now.normal) < 0.8 || off_plane(now, other.position, 4.0) > 1.0) {
                continue;
            }
            vec3 l = soft_sample(there);
            float y = luminance(l);
            brightest = max(brightest, y);
            around += l;
            spread += vec2(y, y * y);
            count += 1.0;
        }
    }
    float y = luminance(light);
    if (count > 0.0 && y > brightest) {
        light *= brightest / y;
        y = brightest;
    }
    Past past;
    bool found = find_past(at, now, past);
    vec2 sampled = vec2(y, y * y);
    float frames = 1.0;
    float change = 0.0;
    vec3 mean = light;
    vec2 second = sampled;
    if (found) {
        float sigma = sqrt(max(past.moments.y - past.moments.x * past.moments.x, 0.0));
        change = mix(past.change, y - past.moments.x, 0.125);
        float changed = clamp(abs(change) / max(sigma, 1e-3 * past.moments.x + 1e-12) - 0.75, 0.0, 1.0);
        float longest = push.frame.is_still != 0u ? LONGEST_STILL : mix(LONGEST_HISTORY, SHORT_HISTORY, changed);
        frames = min(past.frames + 1.0, longest);
        mean = mix(past.light, light, 1.0 / frames);
        second = mix(past.moments, sampled, max(1.0 / frames, push.frame.is_still != 0u ? 0.0 : 0.05));
    }
    float variance = max(second.y - second.x * second.x, 0.0);
    if (frames < SHORT_HISTORY && count > 0.0) {
        // Too few to say over time: over space.
        vec2 local = (spread + sampled) / (count + 1.0);
        variance = max(variance, max(local.y - local.x * local.x, 0.0)) * (SHORT_HISTORY / frames);
        if (frames < 1.5) {
            mean = (around + light) / (count + 1.0);
        }
    }
    // Of the mean over the frames that count.
    variance /= frames;
    soft.at[pixel] = vec4(mean, variance);
    moments.at[pixel] = vec4(second, frames, change);
}
