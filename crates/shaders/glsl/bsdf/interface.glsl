// The interface over the diffuse base of an opaque dielectric: what it reflects, and what it leaves to the base.
// Twin: core/src/bsdf/interface.rs, where it is explained.
#ifndef BSDF_INTERFACE_GLSL
#define BSDF_INTERFACE_GLSL

#include "fresnel.glsl"
#include "math.glsl"
#include "microfacet.glsl"
#include "bsdf/compensation.glsl"
#include "bsdf/thin_film.glsl"

// Azimuths over which a film on an anisotropic interface is averaged, in a quarter turn.
const uint INTERFACE_AZIMUTHS = 4;

// Points of the unit square, a lattice, at which visible facets are drawn to average a film.
const vec2 INTERFACE_FACETS[5] =
    vec2[5](vec2(0.1, 0.1), vec2(0.3, 0.5), vec2(0.5, 0.9), vec2(0.7, 0.3), vec2(0.9, 0.7));

// Added to the mean over INTERFACE_FACETS: what it lacks at most, and a little.
const float INTERFACE_MARGIN = 0.015;

// A dielectric interface, smooth or rough.
struct Interface {
    Spectrum f0;
    float f90;
    ThinFilm film;
    Ggx ggx;
};

// How the light of one direction is shared out.
struct Shares {
    // Reflected by the interface, mean over the bands: for choosing the lobe.
    float reflected;
    // Left to what lies beneath: 1 less the largest band of the albedo.
    float passed;
};

// `f0` at normal incidence, in [0, 1], before `strength`, which scales everything and is the reflectance at grazing incidence; `film`
// over `f0`.
Interface interface_new(Spectrum f0, float strength, ThinFilm film, Ggx ggx) {
    return Interface(f0 * strength, strength, film, ggx);
}

// True when it is not there.
bool interface_is_none(Interface self_) {
    return !HAS_BASE || self_.f90 == 0.0;
}

// Reflectance at one facet.
Spectrum interface_reflectance(Interface self_, float cosine) {
    Spectrum plain = schlick(self_.f0, self_.f90, cosine);
    if (thin_film_is_some(self_.film)) {
        // The strength counts for plain and filmed alike.
        return thin_film_reflectance(self_.film, plain * (1.0 / self_.f90), cosine) * self_.f90;
    }
    return plain;
}

// Reflectance at visible facets, by what each reflects; at the one facet of a smooth interface, and where none of the facets counts. The loop
// asks for a reflectance in one place: a film's is long, and compilers copy it to each.
Spectrum interface_mean_over_facets(Interface self_, vec3 w) {
    Spectrum sum = BLACK;
    float weights = 0.0;
    for (int k = ggx_is_rough(self_.ggx) ? 0 : 5; k < 6; k++) {
        float weight = 0.0;
        float cosine = w.z;
        if (k < 5) {
            vec3 m = ggx_sample_visible_normal(self_.ggx, w, INTERFACE_FACETS[k]);
            vec3 wi = mirror_about(w, m);
            if (wi.z > 0.0) {
                // G2/G1, Heitz 2018.
                weight = wi.z * (w.z + ggx_stretched_length(self_.ggx, w)) * 2.0 * ggx_visibility(self_.ggx, w, wi);
                cosine = dot(w, m);
            }
        } else if (weights == 0.0) {
            weight = 1.0;
        }
        if (weight > 0.0) {
            sum += interface_reflectance(self_, cosine) * weight;
            weights += weight;
        }
    }
    return sum * (1.0 / weights);
}

Shares interface_shares_of_film(Interface self_, Directional at, vec3 w) {
    w.z = abs(w.z);
    Spectrum f = interface_mean_over_facets(self_, w);
    float most = max_component(f);
    if (ggx_is_rough(self_.ggx)) {
        most = min(most + INTERFACE_MARGIN, 1.0);
    }
    float kept = 1.0 - at.deficit;
    return Shares(kept * average(f), at.deficit + kept * (1.0 - most));
}

// How it shares out the light towards `w`, on either side; `at` is `rough_directional` there.
Shares interface_shares(Interface self_, Directional at, vec3 w) {
    if (thin_film_is_some(self_.film)) {
        return interface_shares_of_film(self_, at, w);
    }
    return Shares(
        directional_reflected(at, average(self_.f0), self_.f90),
        directional_passed(at, max_component(self_.f0), self_.f90)
    );
}

float interface_average_passed_by_film(Interface self_) {
    bool stretched = ggx_is_rough(self_.ggx) && ggx_is_anisotropic(self_.ggx);
    uint azimuths = stretched ? INTERFACE_AZIMUTHS : 1;
    float sum = 0.0;
    for (uint node = 0; node < FILM_NODES; node++) {
        float cosine = FILM_AVERAGE[node].x;
        float weight = FILM_AVERAGE[node].y;
        float sine = sqrt(1.0 - cosine * cosine);
        for (uint k = 0; k < azimuths; k++) {
            float s, c;
            sin_cos(0.5 * PI * (float(k) + 0.5) / float(azimuths), s, c);
            vec3 w = vec3(sine * c, sine * s, cosine);
            sum += weight / float(azimuths) * interface_shares_of_film(self_, rough_directional(self_.ggx, w), w).passed;
        }
    }
    return sum;
}

// What it passes, averaged over the hemisphere with the cosine.
float interface_average_passed(Interface self_) {
    if (thin_film_is_some(self_.film)) {
        return interface_average_passed_by_film(self_);
    }
    return directional_passed(rough_average(self_.ggx), max_component(self_.f0), self_.f90);
}

// Hemispherical albedo.
Spectrum interface_albedo(Interface self_) {
    Directional mean = rough_average(self_.ggx);
    if (thin_film_is_some(self_.film)) {
        Spectrum sum = BLACK;
        for (uint k = 0; k < FILM_NODES; k++) {
            sum += interface_reflectance(self_, FILM_AVERAGE[k].x) * FILM_AVERAGE[k].y;
        }
        return sum * (1.0 - mean.deficit);
    }
    return self_.f0 * (1.0 - mean.deficit - mean.schlick) + self_.f90 * mean.schlick;
}

#endif
