// The sRGB transfer curve (IEC 61966-2-1) and exposure. Twin: core/src/color.rs.
#ifndef COLOR_GLSL
#define COLOR_GLSL

#include "math.glsl"

// Linear 0..1 to sRGB 0..1; values outside are clamped.
float srgb_encode(float x) {
    x = clamp(x, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow_(x, 1.0 / 2.4) - 0.055;
}

// sRGB 0..1 to linear 0..1.
float srgb_decode(float x) {
    return x <= 0.04045 ? x / 12.92 : pow_((x + 0.055) / 1.055, 2.4);
}

// Values of push.exposure: `Exposure`. EXPOSURE_FACTOR stands for `Ev`, whose factor the host knows.
const uint EXPOSURE_AUTO = 0u;
const uint EXPOSURE_THESIS = 1u;
const uint EXPOSURE_FACTOR = 2u;

// Bounds of the automatic factor.
const float AUTO_LOW = 1e-6;
const float AUTO_HIGH = 1e6;

// A factor on its way from the last frame's to `target`: `share` of the way in the logarithm.
float exposure_eased(float previous, float target, float share) {
    return share >= 1.0 ? target : previous * pow_(target / previous, share);
}

#endif
