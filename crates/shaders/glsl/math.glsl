// Scalar functions used everywhere. GPUs' own sine, cosine, logarithm and their kin differ from card to card and are inexact; these are made of
// additions, multiplications and divisions only, within a few units in the last place of the `libm` functions that core uses.
// Where a name is also that of a built-in function, a macro hides the built-in one. Twin: core/src/math.rs.
//
// Polynomials and the splitting of constants are those of FreeBSD's msun (the source of `libm` too) and of Cephes (Moshier 1989). `precise` keeps
// compilers from reordering steps whose order is what makes them exact.
#ifndef MATH_GLSL
#define MATH_GLSL

const float PI = 3.14159265358979;
const float INV_PI = 0.318309886183791;
// The largest float below 1: random numbers lie in [0, ONE_MINUS_EPSILON].
const float ONE_MINUS_EPSILON = 0.999999940395355;
// The least normal float, 2^-126.
const float MIN_POSITIVE = 1.17549435e-38;

// True for ∞; by its bits, since compilers may take it that it does not occur. `x` is not negative.
bool is_infinite(float x) {
    return floatBitsToUint(x) == 0x7f800000u;
}

// x².
float sqr(float x) {
    return x * x;
}

// √max(x, 0): for quantities that rounding may push below zero.
float safe_sqrt(float x) {
    return sqrt(max(x, 0.0));
}

// Linear interpolation, `a` at t = 0, `b` at t = 1.
float lerp(float a, float b, float t) {
    return a + (b - a) * t;
}

// The magnitude of `x` with the sign of `s`; zeros have one too.
float copysign(float x, float s) {
    return uintBitsToFloat((floatBitsToUint(x) & 0x7fffffffu) | (floatBitsToUint(s) & 0x80000000u));
}

// Sine and cosine of an angle in radians. Full precision up to 8192; beyond, digits are lost as the angle grows (nothing asks there for
// what it then uses: films so thick do not interfere).
void sin_cos(float x, out float sine, out float cosine) {
    // The angle less the nearest multiple of π/2, whose parts have so few bits that products with the count are exact.
    precise float n = floor(x * (2.0 / PI) + 0.5);
    precise float r = x - n * 1.5703125;
    r = r - n * 4.837512969970703e-4;
    r = r - n * 7.549789948768648e-8;
    // Rounding of the count may leave huge angles out of reach of the polynomials.
    r = clamp(r, -1.0, 1.0);
    float z = r * r;
    float s = r + r * z * (-0.16666667 + z * (0.008333329 + z * (-0.00019839335 + z * 2.7183115e-6)));
    float c = 1.0 + z * (-0.5 + z * (0.041666623 + z * (-0.0013886763 + z * 2.4390449e-5)));
    // Signs and roles by the quarter of the circle; the count modulo 4 stays exact as a float.
    int quarter = int(n - 4.0 * floor(n * 0.25));
    bool swapped = (quarter & 1) != 0;
    sine = swapped ? c : s;
    cosine = swapped ? s : c;
    cosine = quarter == 1 || quarter == 2 ? -cosine : cosine;
    sine = quarter >= 2 ? -sine : sine;
}

// Tangent of an angle in radians.
float tan_by_parts(float x) {
    float s, c;
    sin_cos(x, s, c);
    return s / c;
}
#define tan(x) tan_by_parts(x)

// The arc sine's part beyond its argument, over it, for z = x² up to 1/4: msun's rational function.
float asin_tail(float z) {
    float p = z * (1.6666586697e-1 + z * (-4.2743422091e-2 + z * -8.6563630030e-3));
    return p / (1.0 + z * -7.0662963390e-1);
}

// Arc cosine with its argument clamped to [-1, 1].
float acos_by_parts(float x) {
    x = clamp(x, -1.0, 1.0);
    if (abs(x) < 0.5) {
        return 1.5707963 - (x + x * asin_tail(x * x));
    }
    // Near ±1 by half the angle: acos x = 2 asin √((1 - x) / 2).
    float z = 0.5 * (1.0 - abs(x));
    float s = sqrt(z);
    float half_angle = s + s * asin_tail(z);
    return x > 0.0 ? 2.0 * half_angle : PI - 2.0 * half_angle;
}
#define acos(x) acos_by_parts(x)

// Angle of the point (x, y) in (-π, π]; 0 for the origin.
float atan2(float y, float x) {
    float ax = abs(x);
    float ay = abs(y);
    float most = max(ax, ay);
    if (most == 0.0) {
        return floatBitsToInt(x) < 0 ? copysign(PI, y) : y;
    }
    // In an eighth of the circle, brought to within tan π/8 of 0.
    float t = is_infinite(most) ? (ax == ay ? 1.0 : 0.0) : min(ax, ay) / most;
    bool far = t > 0.41421356;
    float r = far ? (t - 1.0) / (t + 1.0) : t;
    float z = r * r;
    float angle = r + r * z * (-3.33329491539e-1 + z * (1.99777106478e-1 + z * (-1.38776856032e-1 + z * 8.05374449538e-2)));
    angle = far ? angle + 0.78539816 : angle;
    angle = ay > ax ? 1.5707963 - angle : angle;
    angle = floatBitsToInt(x) < 0 ? PI - angle : angle;
    return copysign(angle, y);
}

// 2ᵏ x for whole k: in two steps, since 2ᵏ alone may be out of range.
float scaled_by_power(float x, int k) {
    int a = k / 2;
    int b = k - a;
    return x * intBitsToFloat((a + 127) << 23) * intBitsToFloat((b + 127) << 23);
}

// eˣ.
float exp_by_parts(float x) {
    // Beyond these it is infinite, or 0.
    x = clamp(x, -104.0, 89.0);
    precise float k = floor(x * 1.4426950216 + 0.5);
    precise float hi = x - k * 6.9314575195e-1;
    precise float lo = k * 1.4286067653e-6;
    precise float r = hi - lo;
    float rr = r * r;
    float c = r - rr * (1.6666625440e-1 + rr * -2.7667332906e-3);
    precise float y = 1.0 + (r * c / (2.0 - c) - lo + hi);
    return scaled_by_power(y, int(k));
}
#define exp(x) exp_by_parts(x)

// 2ˣ.
float exp2_by_parts(float x) {
    x = clamp(x, -151.0, 129.0);
    float k = floor(x + 0.5);
    return scaled_by_power(exp((x - k) * 0.69314718), int(k));
}
#define exp2(x) exp2_by_parts(x)

// Natural logarithm; -∞ at 0.
float ln(float x) {
    if (!(x > 0.0) || is_infinite(x)) {
        return x == 0.0 ? uintBitsToFloat(0xff800000u) : is_infinite(x) ? x : uintBitsToFloat(0x7fc00000u);
    }
    int k = 0;
    int bits = floatBitsToInt(x);
    if (bits < 0x00800000) {
        // A subnormal number, where they are not taken as 0.
        bits = floatBitsToInt(x * 33554432.0);
        k = -25;
    }
    // x = 2ᵏ (1 + f) with 1 + f within [√½, √2].
    bits += 0x3f800000 - 0x3f3504f3;
    k += (bits >> 23) - 0x7f;
    float f = intBitsToFloat((bits & 0x007fffff) + 0x3f3504f3) - 1.0;
    float s = f / (2.0 + f);
    float z = s * s;
    float w = z * z;
    float r = z * (0.66666662693 + w * 0.28498786688) + w * (0.40000972152 + w * 0.24279078841);
    float half_square = 0.5 * f * f;
    float dk = float(k);
    precise float y = s * (half_square + r) + dk * 9.0580006145e-6 - half_square + f + dk * 6.9313812256e-1;
    return y;
}

// xʸ for x >= 0. The relative error is at most about 1.2e-7 (1 + |y ln x|).
float pow_(float x, float y) {
    if (y == 0.0 || x == 1.0) {
        return 1.0;
    }
    return exp(y * ln(x));
}

#endif
