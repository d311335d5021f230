// Rough diffuse reflection that keeps its energy (EON). Twin: core/src/bsdf/oren_nayar.rs, where model and sampling are explained.
#ifndef BSDF_OREN_NAYAR_GLSL
#define BSDF_OREN_NAYAR_GLSL

#include "math.glsl"
#include "rgb.glsl"

// 1/2 - 2/(3π), the largest value of g, at grazing angles.
const float OREN_NAYAR_C1 = 0.5 - 2.0 / (3.0 * PI);
// 2/3 - 28/(15π), the mean of g over the cosine-weighted hemisphere.
const float OREN_NAYAR_C2 = 2.0 / 3.0 - 28.0 / (15.0 * PI);

// Directional albedo of s/t alone, over π.
float oren_nayar_g(float mu) {
    float s = safe_sqrt(1.0 - mu * mu);
    // (1 - sin³)/cos with 1 - sin = cos²/(1 + sin): nothing is divided by a grazing cosine.
    float tail = mu * (1.0 + s + s * s) / (1.0 + s) - 1.0;
    return INV_PI * s * (acos(mu) - s * mu + (2.0 / 3.0) * tail);
}

// Albedo of single scattering at ρ = 1, averaged over the hemisphere.
float oren_nayar_average(float roughness) {
    return (1.0 + OREN_NAYAR_C2 * roughness) / (1.0 + OREN_NAYAR_C1 * roughness);
}

// Share that comes back of what single scattering loses: the series of further bounces, each keeping `rho`.
Spectrum oren_nayar_rho_multiple(Spectrum rho, float roughness) {
    float mean = oren_nayar_average(roughness);
    return rho * rho * mean / (1.0 - rho * (1.0 - mean));
}

// f · cos θi for diffuse albedo `rho` and `roughness` in (0, 1]; both directions above the surface.
Spectrum oren_nayar_eval(Spectrum rho, float roughness, vec3 wo, vec3 wi) {
    float a = 1.0 / (1.0 + OREN_NAYAR_C1 * roughness);
    float s = wo.x * wi.x + wo.y * wi.y;
    float ratio = s > 0.0 ? s / max(wo.z, wi.z) : s;
    // At opposite grazing directions 1 + s vanishes, up to rounding.
    float single = a * max(1.0 + roughness * ratio, 0.0);
    float lost_o = max(OREN_NAYAR_C1 - oren_nayar_g(wo.z), 0.0);
    float lost_i = max(OREN_NAYAR_C1 - oren_nayar_g(wi.z), 0.0);
    float multiple = a * roughness * lost_o * lost_i * (1.0 / (OREN_NAYAR_C1 - OREN_NAYAR_C2));
    return (rho * single + oren_nayar_rho_multiple(rho, roughness) * multiple) * (INV_PI * wi.z);
}

// Hemispherical albedo.
Spectrum oren_nayar_albedo(Spectrum rho, float roughness) {
    float mean = oren_nayar_average(roughness);
    return rho * mean + oren_nayar_rho_multiple(rho, roughness) * (1.0 - mean);
}

// Probability of drawing about the direction of `wo` along the surface.
float oren_nayar_prob_towards_viewer(float roughness, vec3 wo) {
    float share = 0.5 * roughness * safe_sqrt((1.0 - wo.z * wo.z) * (1.0 - wo.z));
    return share / (1.0 + share);
}

// Unit direction of `wo` along the surface; any one at normal incidence, where it is not drawn about.
vec3 oren_nayar_along_surface(vec3 wo) {
    float len2 = wo.x * wo.x + wo.y * wo.y;
    // Smaller squares are not told from 0 on every card.
    return len2 > 1e-37 ? vec3(wo.xy * (1.0 / sqrt(len2)), 0.0) : vec3(1.0, 0.0, 0.0);
}

// A direction above the surface, with density `oren_nayar_pdf`. `u_lobe` chooses between the two cosines; `v` is drawn by the cosine.
vec3 oren_nayar_sample(float roughness, vec3 wo, float u_lobe, vec3 v) {
    if (u_lobe >= oren_nayar_prob_towards_viewer(roughness, wo)) {
        return v;
    }
    vec3 x = oren_nayar_along_surface(wo);
    vec3 y = vec3(-x.y, x.x, 0.0);
    return x * v.z + y * v.y + vec3(0.0, 0.0, 1.0) * abs(v.x);
}

// Density of `oren_nayar_sample`, sr⁻¹; `wi.z > 0`.
float oren_nayar_pdf(float roughness, vec3 wo, vec3 wi) {
    float p = oren_nayar_prob_towards_viewer(roughness, wo);
    return INV_PI * ((1.0 - p) * wi.z + p * 2.0 * max(dot(oren_nayar_along_surface(wo), wi), 0.0));
}

#endif
