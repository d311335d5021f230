// The boundary of a solid, clear dielectric: reflection and refraction, smooth or rough. Twin: core/src/bsdf/dielectric.rs, where it is
// explained.
#ifndef BSDF_DIELECTRIC_GLSL
#define BSDF_DIELECTRIC_GLSL

#include "fresnel.glsl"
#include "math.glsl"
#include "microfacet.glsl"
#include "bsdf/compensation.glsl"
#include "bsdf/sample.glsl"
#include "bsdf/thin_film.glsl"

// Below this value of α |eta - 1| the boundary counts as smooth.
const float DIELECTRIC_SMOOTH_SPREAD = 1e-4;

// A boundary between two clear media.
struct Dielectric {
    float eta;
    // The index ratio in Fresnel's law: `eta` but where the solid disperses.
    float eta_fresnel;
    ThinFilm film;
    Spectrum tint;
    // Smooth unless `ggx_is_rough`.
    Ggx ggx;
};

// The facets as the boundary counts them.
Ggx dielectric_facets(float eta, Ggx ggx) {
    float spread = abs(eta - 1.0);
    if (!ggx_is_rough(ggx) || ggx.alpha_x * spread < DIELECTRIC_SMOOTH_SPREAD) {
        return Ggx(0.0, 0.0);
    }
    // Beside a rough axis the other is as smooth as digits allow, the same from both sides.
    float least = DIELECTRIC_SMOOTH_SPREAD / spread * max(eta, 1.0);
    return Ggx(ggx.alpha_x, max(ggx.alpha_y, min(least, ggx.alpha_x)));
}

// `eta` > 0: index beyond over index on the side of `wo`; `film` over the reflectance of `eta_fresnel`; `tint` in [0, 1] per crossing.
Dielectric dielectric_new(float eta, float eta_fresnel, ThinFilm film, Spectrum tint, Ggx ggx) {
    return Dielectric(eta, eta_fresnel, film, tint, dielectric_facets(eta, ggx));
}

// Reflectance with the film, given that without, `cosine` on the side of `wo`; and the probability of following the reflection.
Spectrum dielectric_filmed(Dielectric self_, float plain, float cosine, out float prob) {
    prob = plain;
    if (thin_film_is_some(self_.film) && plain < 1.0) {
        // The film asks for the angle on the thinner side.
        float outside = cosine;
        if (self_.eta < 1.0) {
            dielectric_refracted(cosine, self_.eta, outside);
        }
        Spectrum f = thin_film_reflectance(self_.film, Spectrum(plain), outside);
        prob = average(f);
        return f;
    }
    return Spectrum(plain);
}

// Reflected plus transmitted part at normal incidence.
Spectrum dielectric_albedo(Dielectric self_) {
    float prob;
    Spectrum f = dielectric_filmed(self_, fresnel_dielectric(1.0, self_.eta_fresnel), 1.0, prob);
    return f + (WHITE - f) * self_.tint;
}

// What passes when the ray is let straight through: tint and Fresnel at the angle in the thinner medium, on whichever side the
// ray is. Black when rough.
Spectrum dielectric_straight_transmittance(Dielectric self_, float cosine) {
    if (ggx_is_rough(self_.ggx)) {
        return BLACK;
    }
    float plain = fresnel_dielectric(cosine, max(self_.eta_fresnel, 1.0 / self_.eta_fresnel));
    self_.eta = 1.0;
    float prob;
    return self_.tint * (WHITE - dielectric_filmed(self_, plain, cosine, prob));
}

// Scale of radiance across the boundary.
float dielectric_eta_scale(Dielectric self_, uint mode) {
    return mode == TRANSPORT_RADIANCE ? 1.0 / (self_.eta * self_.eta) : 1.0;
}

// Reflectance and the cosine of the refracted ray.
float dielectric_fresnel_refracted(Dielectric self_, float cosine, out float cos_t) {
    float fresnel = dielectric_refracted(cosine, self_.eta, cos_t);
    if (self_.eta_fresnel == self_.eta) {
        return fresnel;
    }
    return fresnel_dielectric(cosine, self_.eta_fresnel);
}

// f · |cos θi| and density; `wo.z > 0`. Walter et al. 2007, eq. 16, 17, 21.
Spectrum dielectric_eval_pdf(Dielectric self_, vec3 wo, vec3 wi, uint mode, out float pdf) {
    pdf = 0.0;
    if (!ggx_is_rough(self_.ggx) || wi.z == 0.0) {
        return BLACK;
    }
    // The half vector of a reflection or of a refraction.
    bool reflects = wi.z > 0.0;
    vec3 h = reflects ? wo + wi : wo + wi * self_.eta;
    float len2 = dot(h, h);
    if (!reflects && len2 < 1e-18) {
        return BLACK;
    }
    vec3 m = reflects ? normalize(h) : h * (copysign(1.0, h.z) / sqrt(len2));
    float cos_o = dot(wo, m);
    float cos_i = -dot(wi, m);
    // Facets seen from behind on either side do not refract between these directions.
    if (!reflects && (cos_o <= 0.0 || cos_i <= 0.0)) {
        return BLACK;
    }
    float prob;
    Spectrum fresnel = dielectric_filmed(self_, fresnel_dielectric(cos_o, self_.eta_fresnel), cos_o, prob);
    if (reflects) {
        float f = ggx_reflection(self_.ggx, wo, wi, m, pdf);
        pdf *= prob;
        return fresnel * f;
    }
    // d ωm / d ωi; the denominator (wo·m + eta wi·m)² is the squared length of the unnormalised half vector.
    float jacobian = self_.eta * self_.eta * cos_i / len2;
    pdf = ggx_pdf_visible_normal(self_.ggx, wo, m) * jacobian;
    float f = pdf * ggx_g1(self_.ggx, wi) * dielectric_eta_scale(self_, mode);
    pdf *= 1.0 - prob;
    return self_.tint * (WHITE - fresnel) * f;
}

// Draws a direction; `m` is a visible normal drawn from `self_.ggx`, +z where that is smooth. Fresnel's reflectance chooses between the
// two sides.
bool dielectric_draw(Dielectric self_, vec3 wo, vec3 m, float u_lobe, uint mode, out BsdfSample drawn) {
    bool rough = ggx_is_rough(self_.ggx);
    float cosine = rough ? clamp(dot(wo, m), 0.0, 1.0) : min(wo.z, 1.0);
    float cos_t;
    float plain = dielectric_fresnel_refracted(self_, cosine, cos_t);
    float prob;
    Spectrum fresnel = dielectric_filmed(self_, plain, cosine, prob);
    if (u_lobe < prob) {
        if (rough) {
            drawn = bsdf_sample_open(mirror_about(wo, m), LOBE_GLOSSY_REFLECTION);
            return drawn.wi.z > 0.0;
        }
        drawn = bsdf_sample_delta(vec3(-wo.x, -wo.y, wo.z), fresnel, prob, LOBE_SPECULAR_REFLECTION);
        return true;
    }
    float eta_scale = dielectric_eta_scale(self_, mode);
    if (rough) {
        drawn = bsdf_sample_open(normalize(refract_at(wo, m, cos_t, self_.eta)), LOBE_GLOSSY_TRANSMISSION);
        drawn.eta_scale = eta_scale;
        return drawn.wi.z < 0.0;
    }
    float inv = 1.0 / self_.eta;
    vec3 wi = vec3(-wo.x * inv, -wo.y * inv, -cos_t);
    drawn = bsdf_sample_delta(wi, self_.tint * (WHITE - fresnel) * eta_scale, 1.0 - prob, LOBE_SPECULAR_TRANSMISSION);
    drawn.eta_scale = eta_scale;
    return true;
}

#endif
