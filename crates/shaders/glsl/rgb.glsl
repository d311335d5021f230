// Linear RGB with Rec. 709 primaries and D65 white. Twin: core/src/rgb.rs.
//
// Arithmetic is that of vec3, except that `Rgb / f32` multiplies by the reciprocal: write `c * (1.0 / s)`.
#ifndef RGB_GLSL
#define RGB_GLSL

// A texture value, a film value.
#define Rgb vec3
// Radiance, throughput, emission and BSDF weights.
#define Spectrum vec3

const vec3 BLACK = vec3(0.0);
const vec3 WHITE = vec3(1.0);

// Relative luminance Y, Rec. 709 weights.
float luminance(Rgb c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

// The largest component.
float max_component(Rgb c) {
    return max(max(c.r, c.g), c.b);
}

// Mean of the three components.
float average(Rgb c) {
    return (c.r + c.g + c.b) * (1.0 / 3.0);
}

// True when every component is exactly zero.
bool is_black(Rgb c) {
    return c.r == 0.0 && c.g == 0.0 && c.b == 0.0;
}

// True for what is neither NaN nor infinite. By its bits: compilers may take it that neither occurs.
bool is_finite(float x) {
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

// True when no component is NaN or infinite.
bool is_finite(Rgb c) {
    return is_finite(c.r) && is_finite(c.g) && is_finite(c.b);
}

#endif
