// A thin wall of clear or tinted dielectric. Twin: core/src/bsdf/thin.rs, where it is explained.
#ifndef BSDF_THIN_GLSL
#define BSDF_THIN_GLSL

#include "fresnel.glsl"
#include "microfacet.glsl"
#include "bsdf/compensation.glsl"
#include "bsdf/sample.glsl"
#include "bsdf/thin_film.glsl"

// Cosine at which multiply scattered light is split between the two sides: the mean over the cosine-weighted hemisphere.
const float THIN_TYPICAL_COS = 2.0 / 3.0;

// What a slab reflects and transmits.
struct Slab {
    // Back to the side of the ray.
    Spectrum reflected;
    // To the other side.
    Spectrum transmitted;
};

// A thin wall.
struct Thin {
    float ior;
    ThinFilm film;
    Spectrum tint;
    // Smooth unless `ggx_is_rough`; what follows is only read then.
    Ggx ggx;
    Compensation compensation;
    // Multiply scattered light, by side.
    Slab multiple;
    // The share of single scattering at a typical angle, mean over the bands.
    float single_mean;
};

float slab_series(float f, float a) {
    // At F = 1 nothing enters; the clear slab's 0/0 is avoided.
    return f < 1.0 ? (1.0 - f) * (1.0 - f) * a / (1.0 - f * f * a * a) : 0.0;
}

// Reflection and transmission of a slab whose faces reflect `f`, with transmittance `a` per pass, all orders.
Slab slab_new(Spectrum f, Spectrum a) {
    Spectrum transmitted = Spectrum(slab_series(f.r, a.r), slab_series(f.g, a.g), slab_series(f.b, a.b));
    return Slab(f + transmitted * a * f, transmitted);
}

// Probability of following the reflection.
float slab_prob_reflected(Slab slab) {
    float r = average(slab.reflected);
    float t = average(slab.transmitted);
    return r + t > 0.0 ? r / (r + t) : 0.0;
}

// The slab between two faces of index `ior` under a film.
Slab thin_slab(float ior, ThinFilm film, Spectrum tint, float cosine) {
    Spectrum f = Spectrum(fresnel_dielectric(cosine, ior));
    if (thin_film_is_some(film)) {
        f = thin_film_reflectance(film, f, cosine);
    }
    return slab_new(f, tint);
}

// `ior` > 0 relative to the outside; `tint` in [0, 1] per pass; `deficit_average` is 1 - E over the hemisphere where rough.
Thin thin_new(float ior, ThinFilm film, Spectrum tint, Ggx ggx, float deficit_average) {
    Thin self_;
    self_.ior = ior;
    self_.film = film;
    self_.tint = tint;
    self_.ggx = ggx;
    if (ggx_is_rough(ggx)) {
        Slab typical = thin_slab(ior, film, tint, THIN_TYPICAL_COS);
        Spectrum kept = typical.reflected + typical.transmitted;
        Spectrum f_ms = multiple_scattering(kept, deficit_average);
        self_.compensation = compensation_new(ggx, deficit_average);
        // Black stays black: R and T over their sum, without dividing zero by zero.
        Spectrum most = max(kept, 1e-9);
        self_.multiple = Slab(f_ms * typical.reflected / most, f_ms * typical.transmitted / most);
        self_.single_mean = average(kept);
    } else {
        self_.compensation = Compensation(0.0, 0.0, 1.0);
        self_.multiple = Slab(BLACK, BLACK);
        self_.single_mean = 0.0;
    }
    return self_;
}

// Reflected plus transmitted part at normal incidence.
Spectrum thin_albedo(float ior, ThinFilm film, Spectrum tint) {
    Slab slab = thin_slab(ior, film, tint, 1.0);
    return slab.reflected + slab.transmitted;
}

float thin_prob_multiple(Thin self_, Directional at_o) {
    float multiple = at_o.deficit * average(self_.multiple.reflected + self_.multiple.transmitted);
    float sum = multiple + (1.0 - at_o.deficit) * self_.single_mean;
    return sum > 0.0 ? multiple / sum : 0.0;
}

// f · |cos θi| and density. `facets` are those between `wo` and `wi`; `wo.z > 0`.
Spectrum thin_eval_pdf(Thin self_, Facets facets, vec3 wi, out float pdf) {
    if (!ggx_is_rough(self_.ggx) || wi.z == 0.0) {
        pdf = 0.0;
        return BLACK;
    }
    Slab slab = thin_slab(self_.ior, self_.film, self_.tint, facets.cos_d);
    float prob_side = slab_prob_reflected(slab);
    float prob_side_multiple = slab_prob_reflected(self_.multiple);
    Spectrum part = slab.reflected;
    Spectrum multiple = self_.multiple.reflected;
    if (wi.z <= 0.0) {
        prob_side = 1.0 - prob_side;
        prob_side_multiple = 1.0 - prob_side_multiple;
        part = slab.transmitted;
        multiple = self_.multiple.transmitted;
    }
    float cos_i = abs(wi.z);
    float p = thin_prob_multiple(self_, facets.at_o);
    pdf = (1.0 - p) * prob_side * facets.pdf + p * prob_side_multiple * compensation_pdf(self_.compensation, cos_i);
    return part * facets.value
        + multiple * compensation_eval(self_.compensation, facets.at_o.deficit, facets.at_i.deficit, cos_i);
}

// Draws a direction; `at_o` is `rough_directional` towards `wo`, `m` a visible normal drawn with `u`. The slab's reflectance chooses between the two sides.
bool thin_draw(Thin self_, Directional at_o, vec3 wo, vec3 m, float u_lobe, vec2 u, out BsdfSample drawn) {
    if (!ggx_is_rough(self_.ggx)) {
        Slab slab = thin_slab(self_.ior, self_.film, self_.tint, min(wo.z, 1.0));
        float prob = slab_prob_reflected(slab);
        if (u_lobe < prob) {
            drawn = bsdf_sample_delta(vec3(-wo.x, -wo.y, wo.z), slab.reflected, prob, LOBE_SPECULAR_REFLECTION);
        } else {
            drawn = bsdf_sample_delta(-wo, slab.transmitted, 1.0 - prob, LOBE_THIN_TRANSMISSION);
        }
        return true;
    }
    float p = thin_prob_multiple(self_, at_o);
    vec3 wi;
    float prob;
    float u_side;
    if (u_lobe < p) {
        wi = compensation_sample(self_.compensation, u);
        prob = slab_prob_reflected(self_.multiple);
        u_side = u_lobe / p;
    } else {
        wi = mirror_about(wo, m);
        prob = slab_prob_reflected(thin_slab(self_.ior, self_.film, self_.tint, clamp(dot(wo, m), 0.0, 1.0)));
        u_side = (u_lobe - p) / (1.0 - p);
    }
    bool above = wi.z > 0.0;
    uint lobe = LOBE_GLOSSY_REFLECTION;
    if (min(u_side, ONE_MINUS_EPSILON) >= prob) {
        wi.z = -wi.z;
        lobe = LOBE_GLOSSY_TRANSMISSION;
    }
    drawn = bsdf_sample_open(wi, lobe);
    return above;
}

#endif
