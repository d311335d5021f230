// The film: exact sums of camera samples, the same bits as those of the Rust twin, without 64-bit floats. Twins: core/src/film.rs; of the
// lists shaders/src/film.rs. One invocation at a time may add to a pixel.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#ifndef FILM_GLSL
#define FILM_GLSL

#include "rgb.glsl"

// Fractional bits of the sums.
const int FRACTION_BITS = 24;

const int64_t I64_MAX = 0x7fffffffffffffffl;
const int64_t I64_MIN = -I64_MAX - 1l;

// What one camera sample brings to its pixel.
struct FilmSample {
    // Radiance along the camera ray.
    Rgb radiance;
    // The ray met something; otherwise it left the scene, and the next four say nothing.
    bool has_hit;
    // Directional albedo, 0 to 1.
    Rgb albedo;
    // Shading normal, world space, towards the camera.
    vec3 normal;
    // Metres, world space.
    vec3 position;
    // Distance from the camera along the ray, metres.
    float depth;
    // How much the background is covered along the straight line from the camera.
    float alpha;
};

// Sums of one pixel, in quanta of 2^-24 (squares: 2^-48, the low half first).
struct PixelSums {
    int64_t radiance[3];
    int64_t luminance;
    uint64_t luminance_squared[2];
    int64_t albedo[3];
    int64_t normal[3];
    int64_t position[3];
    int64_t depth;
    int64_t alpha;
    uint samples;
    uint hits;
    uint saturated;
    uint unused[3];
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FilmPixels {
    PixelSums at[];
};

// A camera sample that was not finite.
struct NonFinite {
    uint row;
    uint column;
    // Sample index.
    uint index;
};

// Most samples that a list names; all are counted.
const uint NON_FINITE_ROOM = 4096u;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer NonFiniteList {
    uint count;
    NonFinite at[];
};

// x in quanta, rounded half away from zero; what is out of range saturates.
int64_t film_quantise(float x) {
    uint bits = floatBitsToUint(x);
    uint exponent = (bits >> 23) & 0xffu;
    uint mantissa = bits & 0x007fffffu;
    // |x| is `mantissa` times 2 to the power of `shift` quanta.
    mantissa |= exponent == 0u ? 0u : 0x00800000u;
    int shift = int(max(exponent, 1u)) - 150 + FRACTION_BITS;
    bool negative = (bits & 0x80000000u) != 0u;
    if (shift >= 40) {
        return negative ? I64_MIN : I64_MAX;
    }
    int64_t value = 0l;
    if (shift >= 0) {
        value = int64_t(mantissa) << shift;
    } else if (shift >= -24) {
        // Below, it is less than half a quantum.
        uint s = uint(-shift);
        value = int64_t((mantissa + (1u << (s - 1u))) >> s);
    }
    return negative ? -value : value;
}

// Adds a value to a sum, which stops at the ends of its range; 1 if it did or the value was out of range itself, otherwise 0.
uint film_add_to(inout int64_t sum, int64_t value) {
    int64_t total = sum + value;
    bool overflow = ((sum ^ total) & (value ^ total)) < 0l;
    sum = overflow ? (value < 0l ? I64_MIN : I64_MAX) : total;
    return overflow || value == I64_MAX || value == I64_MIN ? 1u : 0u;
}

uint film_add_three(inout int64_t sums[3], vec3 values) {
    uint saturated = film_add_to(sums[0], film_quantise(values.x));
    saturated += film_add_to(sums[1], film_quantise(values.y));
    return saturated + film_add_to(sums[2], film_quantise(values.z));
}

// Adds the square of a number of quanta to a sum of 128 bits, which stops at the end of its range.
void film_add_square(inout uint64_t sum[2], int64_t value) {
    // Of the least value too the negation is its magnitude when read without a sign.
    uint64_t y = uint64_t(value < 0l ? -value : value);
    uint64_t high = y >> 32;
    uint64_t low = y & 0xfffffffful;
    uint64_t middle = high * low;
    uint64_t square = low * low;
    uint64_t square_low = square + (middle << 33);
    uint64_t square_high = high * high + (middle >> 31) + (square_low < square ? 1ul : 0ul);
    uint64_t total_low = sum[0] + square_low;
    uint64_t carry = total_low < square_low ? 1ul : 0ul;
    // The square's high half is at most 2^62: the carry fits.
    square_high += carry;
    uint64_t total_high = sum[1] + square_high;
    bool overflow = total_high < square_high;
    sum[0] = overflow ? ~0ul : total_low;
    sum[1] = overflow ? ~0ul : total_high;
}

bool film_is_finite(FilmSample s) {
    return is_finite(s.radiance) && is_finite(s.alpha)
        && (!s.has_hit
            || (is_finite(s.albedo) && is_finite(s.depth) && is_finite(s.normal) && is_finite(s.position)));
}

// Adds a finite sample.
void film_add_finite(inout PixelSums sums, FilmSample s) {
    uint saturated = film_add_three(sums.radiance, s.radiance);
    // `precise`: no step may be joined with the next, which would round once where Rust rounds twice.
    precise float luminance_ = 0.2126 * s.radiance.r + 0.7152 * s.radiance.g + 0.0722 * s.radiance.b;
    int64_t y = film_quantise(luminance_);
    saturated += film_add_to(sums.luminance, y);
    film_add_square(sums.luminance_squared, y);
    saturated += film_add_to(sums.alpha, film_quantise(s.alpha));
    sums.samples += 1u;
    if (s.has_hit) {
        sums.hits += 1u;
        saturated += film_add_three(sums.albedo, s.albedo);
        saturated += film_add_three(sums.normal, s.normal);
        saturated += film_add_three(sums.position, s.position);
        saturated += film_add_to(sums.depth, film_quantise(s.depth));
    }
    sums.saturated += min(saturated, 0xffffffffu - sums.saturated);
}

// Adds sample `index` of the pixel at column and row `pixel` of the picture. One that is not finite is counted and named instead: it enters
// the sample count as black.
void film_add(inout PixelSums sums, NonFiniteList non_finite, uvec2 pixel, uint index, FilmSample s) {
    if (film_is_finite(s)) {
        film_add_finite(sums, s);
        return;
    }
    sums.samples += 1u;
    uint place = atomicAdd(non_finite.count, 1u);
    if (place < NON_FINITE_ROOM) {
        non_finite.at[place] = NonFinite(pixel.y, pixel.x, index);
    }
}

#endif
