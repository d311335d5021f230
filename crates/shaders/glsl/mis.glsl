// Multiple importance sampling. Twin: core/src/mis.rs.
#ifndef MIS_GLSL
#define MIS_GLSL

// Power heuristic with exponent 2 for one sample of each of two techniques; `pdf_a` is the one that made the sample. Both in the
// same measure. Veach 1997, eq. 9.13. Written as a ratio, so that squares of large densities do not overflow.
float power_heuristic(float pdf_a, float pdf_b) {
    if (pdf_a <= 0.0) {
        return 0.0;
    }
    float r = pdf_b / pdf_a;
    return 1.0 / (1.0 + r * r);
}

#endif
