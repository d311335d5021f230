// The gloss of MTL materials: Phong's lobe, or a mirror, over a diffuse base. Twin: core/src/bsdf/phong.rs, where it is explained.
#ifndef BSDF_PHONG_GLSL
#define BSDF_PHONG_GLSL

#include "frame.glsl"
#include "fresnel.glsl"
#include "math.glsl"
#include "bsdf/diffuse.glsl"

// From this exponent on the lobe is a mirror.
const float PHONG_MIRROR = 2e6;

// How far the albedo of the lobe would exceed 1 at n = 0.
const float PHONG_EXCESS_AT_ZERO = 0.086;

// Gloss over a diffuse base.
struct Phong {
    // Already darkened where both together exceed 1.
    Diffuse diffuse;
    Spectrum specular;
    // From PHONG_MIRROR on a mirror.
    float exponent;
    bool fresnel;
};

// What diffuse base and gloss are both multiplied by, so that they do not exceed 1 together.
float phong_scale(Diffuse diffuse, Spectrum specular) {
    float sum = max_component(diffuse_albedo(diffuse) + specular);
    return sum > 1.0 ? 1.0 / sum : 1.0;
}

// Gloss over `diffuse`, both already scaled.
Phong phong_new(Diffuse diffuse, Spectrum specular, float exponent, bool fresnel) {
    return Phong(diffuse, specular, max(exponent, 0.0), fresnel);
}

bool phong_is_mirror(Phong self_) {
    return self_.exponent >= PHONG_MIRROR;
}

// True when the base or the lobe scatters by a density.
bool phong_is_smooth_lobe(Phong self_) {
    return !diffuse_is_black(self_.diffuse)
        || (!phong_is_mirror(self_) && (self_.fresnel || !is_black(self_.specular)));
}

// Hemispherical albedo, what the lobe loses at grazing angles not counted.
Spectrum phong_albedo(Phong self_) {
    Spectrum diffuse = diffuse_albedo(self_.diffuse);
    if (!self_.fresnel) {
        return diffuse + self_.specular;
    }
    Spectrum reflected = self_.specular * (1.0 - SCHLICK_AVERAGE) + Spectrum(SCHLICK_AVERAGE);
    return reflected + diffuse * ((1.0 - max_component(self_.specular)) * (1.0 - SCHLICK_AVERAGE));
}

Spectrum phong_reflectance(Phong self_, float cosine) {
    return self_.fresnel ? schlick(self_.specular, 1.0, cosine) : self_.specular;
}

// Factor on the base: what passes on the way in and out over its mean.
float phong_passed(Phong self_, float cos_o, float cos_i) {
    if (!self_.fresnel) {
        return 1.0;
    }
    float o = 1.0 - schlick_weight(cos_o);
    float i = 1.0 - schlick_weight(cos_i);
    return (1.0 - max_component(self_.specular)) * o * i * (1.0 / (1.0 - SCHLICK_AVERAGE));
}

// Probability of drawing from the lobe: its share of the reflected light.
float phong_prob_specular(Phong self_, float cos_o) {
    float specular = average(phong_reflectance(self_, cos_o));
    float passed = self_.fresnel ? (1.0 - max_component(self_.specular)) * (1.0 - schlick_weight(cos_o)) : 1.0;
    float sum = specular + average(diffuse_albedo(self_.diffuse)) * passed;
    return sum > 0.0 ? specular / sum : 0.0;
}

// (n + 2) / (n + 1), lowered where the lobe would exceed 1.
float phong_normalisation(float n) {
    return (n + 2.0) / ((n + 1.0) * (1.0 + PHONG_EXCESS_AT_ZERO * max(1.0 - n, 0.0)));
}

// (n + 1) / 2π cosⁿ α: the density of `phong_about`, sr⁻¹.
float phong_lobe_density(float n, vec3 wo, vec3 wi) {
    // 1 - cos α from the chord between unit vectors, which keeps its digits at small angles.
    vec3 chord = wi - vec3(-wo.x, -wo.y, wo.z);
    float x = 0.5 * dot(chord, chord);
    if (x >= 1.0) {
        return 0.0;
    }
    float ln_cos = x < 1e-2 ? -x * (1.0 + x * (0.5 + x * (1.0 / 3.0))) : ln(1.0 - x);
    return (n + 1.0) * (0.5 * INV_PI) * exp(n * ln_cos);
}

// A direction about the unit `axis`, its cosine to it drawn in proportion to cosⁿ.
vec3 phong_about(vec3 axis, float n, vec2 u) {
    float cosine = pow_(1.0 - u.x, 1.0 / (n + 1.0));
    float sine = safe_sqrt((1.0 - cosine) * (1.0 + cosine));
    float s, c;
    sin_cos(2.0 * PI * u.y, s, c);
    return normalize(frame_to_world(frame_from_normal(axis), vec3(sine * c, sine * s, cosine)));
}

// f · |cos θi| and density; `wo.z > 0`.
Spectrum phong_eval_pdf(Phong self_, vec3 wo, vec3 wi, uint mode, out float pdf) {
    float p = phong_prob_specular(self_, wo.z);
    float pdf_base;
    Spectrum f = diffuse_eval_pdf(self_.diffuse, wo, wi, mode, pdf_base) * phong_passed(self_, wo.z, abs(wi.z));
    pdf = (1.0 - p) * pdf_base;
    if (!phong_is_mirror(self_) && wi.z > 0.0) {
        float n = self_.exponent;
        float lobe = phong_lobe_density(n, wo, wi);
        float most = max(wo.z, wi.z);
        f += phong_reflectance(self_, most) * (lobe * phong_normalisation(n) * (wi.z / most));
        pdf += p * lobe;
    }
    return f;
}

// Draws a direction. The scale of radiance that crosses is left to the caller.
bool phong_draw(Phong self_, vec3 wo, float u_lobe, vec2 u, out BsdfSample drawn) {
    float p = phong_prob_specular(self_, wo.z);
    if (u_lobe < p) {
        vec3 mirror = vec3(-wo.x, -wo.y, wo.z);
        if (phong_is_mirror(self_)) {
            drawn = bsdf_sample_delta(mirror, phong_reflectance(self_, wo.z), p, LOBE_SPECULAR_REFLECTION);
            return true;
        }
        drawn = bsdf_sample_open(phong_about(mirror, self_.exponent, u), LOBE_GLOSSY_REFLECTION);
        return drawn.wi.z > 0.0;
    }
    u_lobe = clamp((u_lobe - p) / (1.0 - p), 0.0, ONE_MINUS_EPSILON);
    vec3 wi = diffuse_sample(self_.diffuse, wo, u_lobe, u);
    drawn = bsdf_sample_open(wi, diffuse_lobe(wi));
    return true;
}

#endif
