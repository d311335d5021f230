// One pass of the filter over space: a kernel of 3 x 3 with holes, twice as wide as the one before, that stops at edges of surfaces and where light
// differs by more than its noise. Dammertz et al. 2010, "Edge-Avoiding À-Trous Wavelet Transform"; Schied et al. 2017.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/filter/soft.glsl"

// Light that differs by so many standard deviations is of another place.
const float LUMINANCE_SIGMAS = 4.0;
// Power of the cosine between normals; and in the first frame of a place, where bumps of a surface would stand alone with their noise.
const float NORMAL_POWER = 64.0;
const float FIRST_NORMAL_POWER = 8.0;
// Frames after which it is the former.
const float FIRST_FRAMES = 4.0;

// The standard deviation, from a variance that is itself noisy: smoothed over neighbours.
float smooth_sigma(uvec2 at, FrameFloats soft) {
    float sum = 0.0;
    float weights = 0.0;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            ivec2 tap = clamp(ivec2(at) + ivec2(x, y), ivec2(0), ivec2(push.view.size) - 1);
            float w = exp2(-float(abs(x) + abs(y)));
            sum += w * soft.at[uint(tap.y) * push.view.size.x + uint(tap.x)].w;
            weights += w;
        }
    }
    return sqrt(sum / weights);
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.view.size))) {
        return;
    }
    // The pass: 0, 1, 2, …
    uint pass = push.sample_count;
    int stride = 1 << pass;
    uint pixel = at.y * push.view.size.x + at.x;
    FrameFloats from = push.frame.soft[pass % 2u];
    FrameFloats to = push.frame.soft[1u - pass % 2u];
    Guide here = guide_at(pixel);
    vec4 light = from.at[pixel];
    vec4 result = light;
    if (here.instance != NONE) {
        float y_here = luminance(light.xyz);
        float sigma_here = smooth_sigma(at, from);
        float frames = push.frame.moments[push.frame.turn].at[pixel].z;
        float power = mix(FIRST_NORMAL_POWER, NORMAL_POWER, clamp((frames - 1.0) / FIRST_FRAMES, 0.0, 1.0));
        // B-spline of three taps, over the centre.
        vec4 sum = light;
        float weights = 1.0;
        for (int i = 0; i < 9; ++i) {
            ivec2 offset = ivec2(i % 3 - 1, i / 3 - 1);
            ivec2 tap = ivec2(at) + stride * offset;
            bool inside = all(greaterThanEqual(tap, ivec2(0))) && all(lessThan(tap, ivec2(push.view.size)));
            if (i == 4 || !inside) {
                continue;
            }
            uint there = uint(tap.y) * push.view.size.x + uint(tap.x);
            Guide other = guide_at(there);
            if (other.instance == NONE) {
                continue;
            }
            vec4 l = from.at[there];
            // The noisier of both decides: a pixel that has found nothing yet does not know how much there is to find.
            float sigma = max(sigma_here, sqrt(l.w));
            float tolerance = LUMINANCE_SIGMAS * sigma + 1e-4 * y_here + 1e-12;
            float kernel = (offset.x == 0 ? 1.0 : 0.5) * (offset.y == 0 ? 1.0 : 0.5);
            float w = kernel * pow(max(dot(here.normal, other.normal), 0.0), power)
                * exp(-abs(luminance(l.xyz) - y_here) / tolerance - off_plane(here, other.position, float(stride)));
            sum += vec4(w * l.xyz, w * w * l.w);
            weights += w;
        }
        result = vec4(sum.xyz / weights, sum.w / (weights * weights));
    }
    to.at[pixel] = result;
    if (pass == 0u) {
        FrameFloats history = push.frame.soft_history;
        history.at[pixel] = result;
    }
}
