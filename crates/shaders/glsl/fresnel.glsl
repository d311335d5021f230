// Fresnel reflectance of smooth interfaces, unpolarised, and Snell's law. `eta` is always the index on the far side over the index on the side
// of the ray. Twin: core/src/fresnel.rs, where the sources stand.
#ifndef FRESNEL_GLSL
#define FRESNEL_GLSL

#include "math.glsl"
#include "rgb.glsl"

// Mean of (1 - cos θ)⁵ over the cosine-weighted hemisphere.
const float SCHLICK_AVERAGE = 1.0 / 21.0;

// Reflectance of a dielectric interface and the cosine of the refracted ray. `cos_i` in [0, 1], `eta` > 0. Total reflection
// gives 1 and 0; equal indices give 0 and `cos_i`.
float dielectric_refracted(float cos_i, float eta, out float cos_t) {
    if (eta == 1.0) {
        cos_t = cos_i;
        return 0.0;
    }
    // g = η cos θt, with η² - 1 factored so that indices close to each other lose no digits at grazing angles.
    float g2 = (eta - 1.0) * (eta + 1.0) + cos_i * cos_i;
    if (g2 <= 0.0) {
        cos_t = 0.0;
        return 1.0;
    }
    float g = sqrt(g2);
    float r_s = (cos_i - g) / (cos_i + g);
    float c_p = eta * eta * cos_i;
    float r_p = (c_p - g) / (c_p + g);
    cos_t = min(g / eta, 1.0);
    return 0.5 * (r_s * r_s + r_p * r_p);
}

// Reflectance of a dielectric interface; see `dielectric_refracted`. (Rust: `fresnel::dielectric`.)
float fresnel_dielectric(float cos_i, float eta) {
    float cos_t;
    return dielectric_refracted(cos_i, eta, cos_t);
}

// The refracted direction of `wo` at an interface with normal `m`, given the cosine from `dielectric_refracted`.
// `wo · m > 0`; the result is unit and on the other side. (Rust: `fresnel::refract`; GLSL's own `refract` is another function.)
vec3 refract_at(vec3 wo, vec3 m, float cos_t, float eta) {
    float inv = 1.0 / eta;
    return m * (dot(wo, m) * inv - cos_t) - wo * inv;
}

// Reflectance of a conductor with index `eta` + i `k` (both relative to the medium of the ray), for one wavelength.
float conductor(float cos_i, float eta, float k) {
    float c2 = cos_i * cos_i;
    float s2 = 1.0 - c2;
    float eta2 = eta * eta;
    float k2 = k * k;
    // a² + b² and a of the complex refracted component a + ib, squared length √(t0² + 4η²k²).
    float t0 = eta2 - k2 - s2;
    float a2_b2 = sqrt(t0 * t0 + 4.0 * eta2 * k2);
    float two_a_c = 2.0 * safe_sqrt(0.5 * (a2_b2 + t0)) * cos_i;
    float r_s = (a2_b2 + c2 - two_a_c) / (a2_b2 + c2 + two_a_c);
    float p = c2 * a2_b2 + s2 * s2;
    float q = two_a_c * s2;
    return 0.5 * (r_s + r_s * (p - q) / (p + q));
}

// (1 - cos θ)⁵, the weight of the grazing reflectance in Schlick's approximation.
float schlick_weight(float cos_i) {
    float x = clamp(1.0 - cos_i, 0.0, 1.0);
    float x2 = x * x;
    return x2 * x2 * x;
}

// Schlick's approximation between the reflectance at normal incidence and at grazing incidence.
Spectrum schlick(Spectrum f0, float f90, float cos_i) {
    float s = schlick_weight(cos_i);
    return f0 * (1.0 - s) + Spectrum(f90 * s);
}

// Reflectance at normal incidence of an interface with relative index `ior`. An index of 0 stands for an infinite one and gives 1.
float f0_from_ior(float ior) {
    return sqr((ior - 1.0) / (ior + 1.0));
}

#endif
