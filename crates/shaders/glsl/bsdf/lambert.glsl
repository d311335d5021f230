// Lambert's diffuse reflection, f = ρ/π. Twin: core/src/bsdf/lambert.rs.
#ifndef BSDF_LAMBERT_GLSL
#define BSDF_LAMBERT_GLSL

#include "math.glsl"
#include "warp.glsl"
#include "bsdf/features.glsl"

// How diffuse directions are drawn.
const uint DIFFUSE_SAMPLING_COSINE = 0u;
const uint DIFFUSE_SAMPLING_UNIFORM = 1u;

// A direction above the surface.
vec3 diffuse_sampling_sample(uint self_, vec2 u) {
    if (HAS_UNIFORM_DIFFUSE && self_ == DIFFUSE_SAMPLING_UNIFORM) {
        return uniform_hemisphere(u);
    }
    return cosine_hemisphere(u);
}

// Density of `diffuse_sampling_sample`, sr⁻¹; `cos_i > 0`.
float diffuse_sampling_pdf(uint self_, float cos_i) {
    if (HAS_UNIFORM_DIFFUSE && self_ == DIFFUSE_SAMPLING_UNIFORM) {
        return UNIFORM_HEMISPHERE_PDF;
    }
    return cosine_hemisphere_pdf(cos_i);
}

// f · cos θi of a Lambert surface of albedo 1; `cos_i > 0`.
float lambert_eval(float cos_i) {
    return INV_PI * cos_i;
}

#endif
