// The GGX distribution of microfacet normals with Smith's masking and shadowing. Directions are local, the macroscopic normal at +z.
// Everything is written so that nothing is divided by a grazing cosine. Twin: core/src/microfacet.rs, where the sources stand.
#ifndef MICROFACET_GLSL
#define MICROFACET_GLSL

#include "math.glsl"
#include "warp.glsl"
#include "bsdf/features.glsl"

// Below this width a surface counts as perfectly smooth.
const float ALPHA_SMOOTH = 1e-3;

// A GGX distribution. Both widths at least ALPHA_SMOOTH; equal ones are the isotropic case.
struct Ggx {
    float alpha_x;
    float alpha_y;
};

// The same width in all directions.
Ggx ggx_isotropic(float alpha) {
    return Ggx(alpha, alpha);
}

// `alpha` along y, widened along x by `strength` in (0, 1] towards 1 by its square. Perfectly smooth only where both are:
// then `alpha_x` is below ALPHA_SMOOTH; a smaller `alpha` beside a rough axis counts as that.
Ggx ggx_stretched(float alpha, float strength) {
    strength = min(strength, 1.0);
    return Ggx(alpha + (1.0 - alpha) * strength * strength, max(alpha, ALPHA_SMOOTH));
}

// True when the widths differ.
bool ggx_is_anisotropic(Ggx self_) {
    return HAS_ANISOTROPY && self_.alpha_x != self_.alpha_y;
}

// Density of normals D(m) per solid angle and area of the macroscopic surface; `m.z >= 0`.
float ggx_d(Ggx self_, vec3 m) {
    float x = m.x / self_.alpha_x;
    float y = m.y / self_.alpha_y;
    float k = x * x + y * y + m.z * m.z;
    return INV_PI / (self_.alpha_x * self_.alpha_y * k * k);
}

// Length of `w` in the space where the roughness is 1: |cos θ| (1 + 2Λ).
float ggx_stretched_length(Ggx self_, vec3 w) {
    float x = self_.alpha_x * w.x;
    float y = self_.alpha_y * w.y;
    return sqrt(x * x + y * y + w.z * w.z);
}

// Masking G1(w) over |cos θ|: 2 / (|cos θ| + stretched length).
float ggx_g1_over_cos(Ggx self_, vec3 w) {
    return 2.0 / (abs(w.z) + ggx_stretched_length(self_, w));
}

// Masking G1(w): the part of the microfacets turned towards `w` that is seen.
float ggx_g1(Ggx self_, vec3 w) {
    return abs(w.z) * ggx_g1_over_cos(self_, w);
}

// Height-correlated masking and shadowing of two directions on the same side, over 4 cos θo cos θi.
float ggx_visibility(Ggx self_, vec3 wo, vec3 wi) {
    return 0.5 / (wi.z * ggx_stretched_length(self_, wo) + wo.z * ggx_stretched_length(self_, wi));
}

// A normal seen from `wo` (`wo.z >= 0`), with density `ggx_pdf_visible_normal`.
vec3 ggx_sample_visible_normal(Ggx self_, vec3 wo, vec2 u) {
    vec3 w = normalize(vec3(self_.alpha_x * wo.x, self_.alpha_y * wo.y, wo.z));
    vec3 h = uniform_cone(u, 1.0 + w.z) + w;
    return normalize(vec3(self_.alpha_x * h.x, self_.alpha_y * h.y, max(h.z, 1e-9)));
}

// Density of visible normals, sr⁻¹ around `m`: G1(wo) max(0, wo·m) D(m) / cos θo.
float ggx_pdf_visible_normal(Ggx self_, vec3 wo, vec3 m) {
    return ggx_g1_over_cos(self_, wo) * max(dot(wo, m), 0.0) * ggx_d(self_, m);
}

// Mirror reflection at microfacets with reflectance 1: f · cos θi, and the density of `wi` when the normal is drawn by
// `ggx_sample_visible_normal`. `m` is the unit half vector; both directions above the surface.
float ggx_reflection(Ggx self_, vec3 wo, vec3 wi, vec3 m, out float pdf) {
    float d = ggx_d(self_, m);
    // d ωm / d ωi = 1 / (4 wo·m).
    pdf = 0.25 * d * ggx_g1_over_cos(self_, wo);
    return d * ggx_visibility(self_, wo, wi) * wi.z;
}

// The mirror image of `wo` about the unit normal `m`. (Rust: `microfacet::reflect`; GLSL's own `reflect` has the other sign.)
vec3 mirror_about(vec3 wo, vec3 m) {
    return m * (2.0 * dot(wo, m)) - wo;
}

#endif
