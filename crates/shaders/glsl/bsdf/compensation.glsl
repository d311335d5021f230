// Rough interfaces and the light that single scattering loses. Twin: core/src/bsdf/compensation.rs, where the lobe is explained.
#ifndef BSDF_COMPENSATION_GLSL
#define BSDF_COMPENSATION_GLSL

#include "math.glsl"
#include "microfacet.glsl"
#include "rgb.glsl"
#include "bsdf/albedo.glsl"
#include "bsdf/aniso_albedo.glsl"

// The microfacets for a perceptual roughness, α = roughness², and the strength of its anisotropy in [0, 1], which widens the facets
// along x. Where both widths are below ALPHA_SMOOTH the surface is perfectly smooth: Rust's `None`, here `!ggx_is_rough`.
Ggx rough_new(float roughness, float anisotropy) {
    float alpha = min(roughness * roughness, 1.0);
    if (HAS_ANISOTROPY && anisotropy > 0.0) {
        return ggx_stretched(alpha, anisotropy);
    }
    return ggx_isotropic(alpha);
}

// True when there are facets.
bool ggx_is_rough(Ggx self_) {
    return self_.alpha_x >= ALPHA_SMOOTH;
}

// E and B of the interface towards `w`, on either side; of a mirror where it is smooth.
Directional rough_directional(Ggx ggx, vec3 w) {
    if (ggx_is_rough(ggx)) {
        return albedo_directional(ggx, w);
    }
    return directional_smooth(abs(w.z));
}

// The same averaged over the hemisphere.
Directional rough_average(Ggx ggx) {
    if (ggx_is_rough(ggx)) {
        return albedo_average(ggx);
    }
    return Directional(0.0, SCHLICK_AVERAGE);
}

// The lobe of multiply scattered light, for reflectance 1; models scale it by `multiple_scattering`.
struct Compensation {
    // The larger width.
    float alpha;
    // 1 / (π (1 - Eavg)).
    float scale;
    // ln(1 + 1/α²): integral of 2μ / (μ² + α²).
    float log_norm;
};

// For one interface, whose 1 - E over the hemisphere is `deficit_average`.
Compensation compensation_new(Ggx ggx, float deficit_average) {
    float alpha = ggx.alpha_x;
    return Compensation(alpha, INV_PI / deficit_average, ln(1.0 + 1.0 / (alpha * alpha)));
}

// f · cos θi, given 1 - E towards both sides; `cos_i > 0`.
float compensation_eval(Compensation self_, float deficit_o, float deficit_i, float cos_i) {
    return deficit_o * deficit_i * self_.scale * cos_i;
}

// A direction above the surface.
vec3 compensation_sample(Compensation self_, vec2 u) {
    float cosine = min(self_.alpha * safe_sqrt(exp(u.x * self_.log_norm) - 1.0), 1.0);
    float sine = safe_sqrt(1.0 - cosine * cosine);
    float s, c;
    sin_cos(2.0 * PI * u.y, s, c);
    return vec3(sine * c, sine * s, cosine);
}

// Density of `compensation_sample`, sr⁻¹.
float compensation_pdf(Compensation self_, float cos_i) {
    return INV_PI * cos_i / (self_.log_norm * (cos_i * cos_i + self_.alpha * self_.alpha));
}

// Share of the lost light that comes back when each further bounce keeps `f_avg`.
Spectrum multiple_scattering(Spectrum f_avg, float deficit_avg) {
    return f_avg * f_avg * (1.0 - deficit_avg) / (1.0 - f_avg * deficit_avg);
}

// What models with facets share between two directions: found once for all components of a mixture.
struct Facets {
    // E and B towards both.
    Directional at_o;
    Directional at_i;
    // Cosine between `wo` and the half vector.
    float cos_d;
    // f · cos θi and density of the reflection at facets of reflectance 1; 0 where smooth.
    float value;
    float pdf;
};

// `wi` on either side: what is transmitted by a thin wall is the reflection lobe seen in the mirror of the wall. `wo.z > 0`; `at_o` is
// `rough_directional` there.
Facets facets_between(Ggx ggx, Directional at_o, vec3 wo, vec3 wi) {
    Facets facets;
    facets.at_o = at_o;
    facets.at_i = rough_directional(ggx, wi);
    facets.cos_d = 0.0;
    facets.value = 0.0;
    facets.pdf = 0.0;
    if (ggx_is_rough(ggx)) {
        vec3 mirrored = vec3(wi.xy, abs(wi.z));
        vec3 m = normalize(wo + mirrored);
        facets.cos_d = dot(wo, m);
        facets.value = ggx_reflection(ggx, wo, mirrored, m, facets.pdf);
    }
    return facets;
}

#endif
