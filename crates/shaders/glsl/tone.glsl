// Tone curves: from exposed linear radiance to what a display is sent, each band 0 to 1. Twin: core/src/tone.rs, which has the sources.
#ifndef TONE_GLSL
#define TONE_GLSL

#include "color.glsl"
#include "math.glsl"
#include "rgb.glsl"

// `ToneCurve`, in its order.
const uint TONE_LINEAR = 0u;
const uint TONE_SRGB = 1u;
const uint TONE_REINHARD = 2u;
const uint TONE_ACES = 3u;
const uint TONE_AGX = 4u;
const uint TONE_NEUTRAL = 5u;

// Brighter than this looks no brighter.
const float BRIGHTEST = 1e6;

// Rows of a 3x3 matrix times a colour.
Rgb transformed(vec3 r, vec3 g, vec3 b, Rgb c) {
    return Rgb(
        r.x * c.r + r.y * c.g + r.z * c.b,
        g.x * c.r + g.y * c.g + g.z * c.b,
        b.x * c.r + b.y * c.g + b.z * c.b
    );
}

// Luminance L becomes L / (1 + L), hue and saturation stay.
Rgb reinhard(Rgb c) {
    return c * (1.0 / (1.0 + luminance(c)));
}

float aces_fit(float v) {
    float above = v * (v + 0.0245786) - 0.000090537;
    float below = v * (0.983729 * v + 0.4329510) + 0.238081;
    return above / below;
}

// Reference rendering transform and output transform for sRGB of ACES 1.0, Hill's fit, linear.
Rgb aces(Rgb c) {
    c = transformed(
        vec3(0.59719, 0.35458, 0.04823), vec3(0.07600, 0.90834, 0.01566), vec3(0.02840, 0.13383, 0.83777), c);
    c = Rgb(aces_fit(c.r), aces_fit(c.g), aces_fit(c.b));
    c = transformed(
        vec3(1.60475, -0.53108, -0.07367), vec3(-0.10208, 1.10813, -0.00605), vec3(-0.00327, -0.07276, 1.07602), c);
    return clamp(c, 0.0, 1.0);
}

float agx_contrast(float x) {
    const float LOW = -12.47393;
    const float HIGH = 4.026069;
    const float LOG2_E = 1.44269504088896;
    // log2; black is below the lowest stop whatever its logarithm.
    float stops = ln(max(x, 1e-10)) * LOG2_E;
    float t = (clamp(stops, LOW, HIGH) - LOW) / (HIGH - LOW);
    return (((((15.5 * t - 40.14) * t + 31.96) * t - 6.868) * t + 0.4298) * t + 0.1191) * t - 0.00232;
}

// AgX with its default look, Wrensch's fit: already what a display of gamma 2.2 is sent.
Rgb agx(Rgb c) {
    c = transformed(
        vec3(0.842479062253094, 0.0784335999999992, 0.0792237451477643),
        vec3(0.0423282422610123, 0.878468636469772, 0.0791661274605434),
        vec3(0.0423756549057051, 0.0784336, 0.879142973793104), c);
    c = Rgb(agx_contrast(c.r), agx_contrast(c.g), agx_contrast(c.b));
    c = transformed(
        vec3(1.19687900512017, -0.0980208811401368, -0.0990297440797205),
        vec3(-0.0528968517574562, 1.15190312990417, -0.0989611768448433),
        vec3(-0.0529716355144438, -0.0980434501171241, 1.15107367264116), c);
    return clamp(c, 0.0, 1.0);
}

// Khronos PBR Neutral, linear.
Rgb neutral(Rgb c) {
    const float F90 = 0.04;
    const float START = 0.8 - F90;
    const float DESATURATION = 0.15;
    float least = min(min(c.r, c.g), c.b);
    // Meets the constant with the same slope at 0.08.
    float offset = least < 2.0 * F90 ? least - least * least / (4.0 * F90) : F90;
    c -= offset;
    float peak = max_component(c);
    if (peak < START) {
        return c;
    }
    const float ROOM = 1.0 - START;
    float compressed = 1.0 - ROOM * ROOM / (peak + ROOM - START);
    float white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    c *= compressed / peak;
    return c + (compressed - c) * white;
}

// A band between 0 and the brightest; what is no number is 0.
float tone_band(float x) {
    return x > 0.0 ? min(x, BRIGHTEST) : 0.0;
}

// What a display is sent for an exposed colour, 0 to 1. `curve` is one of TONE_...
Rgb tone_display(uint curve, Rgb exposed) {
    Rgb c = Rgb(tone_band(exposed.r), tone_band(exposed.g), tone_band(exposed.b));
    if (curve == TONE_LINEAR) {
        c = min(c, 1.0);
        return Rgb(pow_(c.r, 1.0 / 2.2), pow_(c.g, 1.0 / 2.2), pow_(c.b, 1.0 / 2.2));
    }
    if (curve == TONE_AGX) {
        return agx(c);
    }
    if (curve == TONE_REINHARD) {
        c = reinhard(c);
    } else if (curve == TONE_ACES) {
        c = aces(c);
    } else if (curve == TONE_NEUTRAL) {
        c = neutral(c);
    }
    return Rgb(srgb_encode(c.r), srgb_encode(c.g), srgb_encode(c.b));
}

// Darkening towards the corners: the factor at a point measured from the centre of the picture in halves of its diagonal.
float vignette(float strength, vec2 at) {
    return max(1.0 - strength * (at.x * at.x + at.y * at.y), 0.0);
}

#endif
