// Metal: GGX reflection with Schlick's reflectance, plus the light of multiple scattering. Twin: core/src/bsdf/metal.rs.
#ifndef BSDF_METAL_GLSL
#define BSDF_METAL_GLSL

#include "fresnel.glsl"
#include "microfacet.glsl"
#include "bsdf/compensation.glsl"
#include "bsdf/sample.glsl"
#include "bsdf/thin_film.glsl"

// A metal interface.
struct Metal {
    Spectrum f0;
    ThinFilm film;
    // A mirror unless rough.
    Ggx ggx;
    Compensation compensation;
    // What multiple scattering keeps, per band.
    Spectrum f_ms;
};

// At one facet.
Spectrum metal_reflectance(Spectrum f0, ThinFilm film, float cosine) {
    Spectrum plain = schlick(f0, 1.0, cosine);
    if (thin_film_is_some(film)) {
        return thin_film_reflectance(film, plain, cosine);
    }
    return plain;
}

// Over the cosine-weighted hemisphere.
Spectrum metal_average_reflectance(Spectrum f0, ThinFilm film) {
    if (thin_film_is_some(film)) {
        Spectrum sum = BLACK;
        for (uint k = 0; k < FILM_NODES; k++) {
            sum += metal_reflectance(f0, film, FILM_AVERAGE[k].x) * FILM_AVERAGE[k].y;
        }
        return sum;
    }
    return f0 * (1.0 - SCHLICK_AVERAGE) + Spectrum(SCHLICK_AVERAGE);
}

// `f0` in [0, 1] per band; `average_reflectance` is that of `metal_average_reflectance`, `deficit_average` 1 - E over the hemisphere.
Metal metal_new(Spectrum f0, ThinFilm film, Ggx ggx, Spectrum average_reflectance, float deficit_average) {
    Compensation compensation = compensation_new(ggx, deficit_average);
    return Metal(f0, film, ggx, compensation, multiple_scattering(average_reflectance, deficit_average));
}

// Hemispherical albedo.
Spectrum metal_albedo(Spectrum f0, ThinFilm film, Ggx ggx) {
    Spectrum average_reflectance = metal_average_reflectance(f0, film);
    if (!ggx_is_rough(ggx)) {
        return average_reflectance;
    }
    Directional mean = albedo_average(ggx);
    Spectrum single;
    if (thin_film_is_some(film)) {
        single = average_reflectance * (1.0 - mean.deficit);
    } else {
        single = f0 * (1.0 - mean.deficit - mean.schlick) + mean.schlick;
    }
    return single + multiple_scattering(average_reflectance, mean.deficit) * mean.deficit;
}

// Probability of drawing from the multiple scattering lobe: its share of the reflected light, without a film.
float metal_prob_multiple(Metal self_, Directional at_o) {
    float multiple = at_o.deficit * average(self_.f_ms);
    float single = directional_reflected(at_o, average(self_.f0), 1.0);
    float sum = multiple + single;
    return sum > 0.0 ? multiple / sum : 0.0;
}

// f · cos θi and density. `facets` are those between `wo` and `wi`; `wo.z > 0`.
Spectrum metal_eval_pdf(Metal self_, Facets facets, vec3 wi, out float pdf) {
    if (!ggx_is_rough(self_.ggx) || wi.z <= 0.0) {
        pdf = 0.0;
        return BLACK;
    }
    float multiple = compensation_eval(self_.compensation, facets.at_o.deficit, facets.at_i.deficit, wi.z);
    float p = metal_prob_multiple(self_, facets.at_o);
    pdf = (1.0 - p) * facets.pdf + p * compensation_pdf(self_.compensation, wi.z);
    return metal_reflectance(self_.f0, self_.film, facets.cos_d) * facets.value + self_.f_ms * multiple;
}

// Draws a direction; `at_o` is `rough_directional` towards `wo`, `m` a visible normal drawn with `u`.
bool metal_draw(Metal self_, Directional at_o, vec3 wo, vec3 m, float u_lobe, vec2 u, out BsdfSample drawn) {
    if (!ggx_is_rough(self_.ggx)) {
        vec3 mirror = vec3(-wo.x, -wo.y, wo.z);
        Spectrum f = metal_reflectance(self_.f0, self_.film, wo.z);
        drawn = bsdf_sample_delta(mirror, f, 1.0, LOBE_SPECULAR_REFLECTION);
        return true;
    }
    vec3 wi;
    if (u_lobe < metal_prob_multiple(self_, at_o)) {
        wi = compensation_sample(self_.compensation, u);
    } else {
        wi = mirror_about(wo, m);
    }
    drawn = bsdf_sample_open(wi, LOBE_GLOSSY_REFLECTION);
    return wi.z > 0.0;
}

#endif
