// The diffuse base, Lambert or rough, and the share that leaves on the other side. Twin: core/src/bsdf/diffuse.rs, where it is explained.
#ifndef BSDF_DIFFUSE_GLSL
#define BSDF_DIFFUSE_GLSL

#include "math.glsl"
#include "rgb.glsl"
#include "bsdf/features.glsl"
#include "bsdf/lambert.glsl"
#include "bsdf/oren_nayar.glsl"
#include "bsdf/params.glsl"
#include "bsdf/sample.glsl"

// A diffuse base.
struct Diffuse {
    // Albedo ρ of the reflecting part.
    Spectrum rho;
    // What leaves on the other side: t c.
    Spectrum transmitted;
    // 1 - t.
    float reflecting;
    // 0 is Lambert.
    float roughness;
    // Scale of radiance that crosses: 1/eta².
    float crossing;
    // DIFFUSE_SAMPLING_...
    uint sampling;
    // Neither rough nor transmitting: Lambert's, and nothing above but ρ and the sampling is read.
    bool plain;
};

// Lambert's.
Diffuse diffuse_lambert(Spectrum rho, uint sampling) {
    return Diffuse(rho, BLACK, 1.0, 0.0, 1.0, sampling, true);
}

// The base of a material whose clamped base colour is `rho`.
Diffuse diffuse_new(BsdfParams params, Spectrum rho) {
    bool rough = HAS_OREN_NAYAR && params.diffuse_roughness > 0.0;
    bool transmits = HAS_DIFFUSE_TRANSMISSION && params.diffuse_transmission > 0.0;
    if (!rough && !transmits) {
        return diffuse_lambert(rho, params.diffuse_sampling);
    }
    float eta2 = params.thin ? 1.0 : params.eta * params.eta;
    float share = unit_interval(params.diffuse_transmission) * min(eta2, 1.0);
    return Diffuse(
        rho,
        unit_interval(params.diffuse_transmission_color) * share,
        1.0 - share,
        unit_interval(params.diffuse_roughness),
        1.0 / eta2,
        params.diffuse_sampling,
        false
    );
}

// The same with all that it scatters times `s` in [0, 1].
Diffuse diffuse_darkened(Diffuse self_, float s) {
    self_.rho *= s;
    self_.transmitted *= s;
    return self_;
}

// True for plain Lambert: sampling does not look at the number that chooses a lobe.
bool diffuse_is_lambert(Diffuse self_) {
    return !(HAS_OREN_NAYAR || HAS_DIFFUSE_TRANSMISSION) || self_.plain;
}

bool diffuse_is_rough(Diffuse self_) {
    return HAS_OREN_NAYAR && self_.roughness > 0.0;
}

// True when it scatters nothing.
bool diffuse_is_black(Diffuse self_) {
    return (is_black(self_.rho) || self_.reflecting == 0.0) && is_black(self_.transmitted);
}

Spectrum diffuse_reflected(Diffuse self_) {
    Spectrum albedo = self_.rho;
    if (diffuse_is_rough(self_)) {
        albedo = oren_nayar_albedo(self_.rho, self_.roughness);
    }
    return albedo * self_.reflecting;
}

// Hemispherical albedo, both sides.
Spectrum diffuse_albedo(Diffuse self_) {
    if (diffuse_is_lambert(self_)) {
        return self_.rho;
    }
    return diffuse_reflected(self_) + self_.transmitted;
}

// Scale of radiance that crosses.
float diffuse_crossing(Diffuse self_, uint mode) {
    return mode == TRANSPORT_RADIANCE ? self_.crossing : 1.0;
}

// Probability of drawing a direction on the other side.
float diffuse_prob_transmitted(Diffuse self_) {
    if (!HAS_DIFFUSE_TRANSMISSION || self_.reflecting == 1.0) {
        return 0.0;
    }
    float r = average(self_.rho) * self_.reflecting;
    float t = average(self_.transmitted);
    return r + t > 0.0 ? t / (r + t) : 0.0;
}

Spectrum diffuse_eval_pdf_general(Diffuse self_, vec3 wo, vec3 wi, uint mode, out float pdf) {
    float p = diffuse_prob_transmitted(self_);
    pdf = 0.0;
    if (wi.z < 0.0) {
        pdf = p * diffuse_sampling_pdf(self_.sampling, -wi.z);
        return self_.transmitted * (lambert_eval(-wi.z) * diffuse_crossing(self_, mode));
    }
    if (wi.z == 0.0) {
        return BLACK;
    }
    Spectrum f;
    if (diffuse_is_rough(self_)) {
        f = oren_nayar_eval(self_.rho, self_.roughness, wo, wi);
    } else {
        f = self_.rho * lambert_eval(wi.z);
    }
    if (diffuse_is_rough(self_) && self_.sampling == DIFFUSE_SAMPLING_COSINE) {
        pdf = oren_nayar_pdf(self_.roughness, wo, wi);
    } else {
        pdf = diffuse_sampling_pdf(self_.sampling, wi.z);
    }
    pdf *= 1.0 - p;
    return f * self_.reflecting;
}

// f · |cos θi| and the density of `diffuse_sample`, sr⁻¹. `wo.z > 0`.
Spectrum diffuse_eval_pdf(Diffuse self_, vec3 wo, vec3 wi, uint mode, out float pdf) {
    if (!diffuse_is_lambert(self_)) {
        return diffuse_eval_pdf_general(self_, wo, wi, mode, pdf);
    }
    if (wi.z > 0.0) {
        pdf = diffuse_sampling_pdf(self_.sampling, wi.z);
        return self_.rho * lambert_eval(wi.z);
    }
    pdf = 0.0;
    return BLACK;
}

// Draws a direction.
vec3 diffuse_sample(Diffuse self_, vec3 wo, float u_lobe, vec2 u) {
    vec3 v = diffuse_sampling_sample(self_.sampling, u);
    if (diffuse_is_lambert(self_)) {
        return v;
    }
    float p = diffuse_prob_transmitted(self_);
    if (u_lobe < p) {
        return vec3(v.x, v.y, -v.z);
    }
    if (diffuse_is_rough(self_) && self_.sampling == DIFFUSE_SAMPLING_COSINE) {
        u_lobe = clamp((u_lobe - p) / (1.0 - p), 0.0, ONE_MINUS_EPSILON);
        return oren_nayar_sample(self_.roughness, wo, u_lobe, v);
    }
    return v;
}

// The lobe of a direction it drew.
uint diffuse_lobe(vec3 wi) {
    return wi.z > 0.0 ? LOBE_DIFFUSE_REFLECTION : LOBE_DIFFUSE_TRANSMISSION;
}

#endif
