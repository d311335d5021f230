// Multiple importance sampling. Twin: core/src/mis.rs.
#ifndef MIS_GLSL
#define MIS_GLSL

#include "math.glsl"

// A density as far as it tells: devices may take numbers below the normal ones for 0, and need not divide by what is above 2^126 (here: 2^125).
float pdf_within(float pdf) {
    const float LARGEST = 4.2535296e37;
    return pdf < MIN_POSITIVE ? 0.0 : pdf > LARGEST ? LARGEST : pdf;
}

// Power heuristic with exponent 2 for one sample of each of two techniques; `pdf_a` is the one that made the sample. Both in the
// same measure. Veach 1997, eq. 9.13. Written as a ratio, so that squares of large densities do not overflow.
float power_heuristic(float pdf_a, float pdf_b) {
    float a = pdf_within(pdf_a);
    float b = pdf_within(pdf_b);
    if (a == 0.0) {
        return 0.0;
    }
    float r = b / a;
    return 1.0 / (1.0 + r * r);
}

#endif
