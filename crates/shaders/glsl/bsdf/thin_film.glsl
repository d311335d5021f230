// Interference in a thin transparent film over a surface. Twin: core/src/bsdf/thin_film.rs, where theory and constants are explained.
#ifndef BSDF_THIN_FILM_GLSL
#define BSDF_THIN_FILM_GLSL

#include "math.glsl"
#include "rgb.glsl"
#include "bsdf/features.glsl"
#include "bsdf/params.glsl"

// Wavenumbers of the Gaussians, nm⁻¹.
const float FILM_WAVENUMBER[5] = float[5](1.64455e-3, 1.76324e-3, 1.88564e-3, 2.09798e-3, 2.20825e-3);
// Their standard deviations, nm⁻¹.
const float FILM_DEVIATION[5] = float[5](0.07131e-3, 0.10431e-3, 0.08053e-3, 0.12846e-3, 0.10364e-3);
// Their shares in each band; those of a band sum to 1.
const vec3 FILM_SHARE[5] = vec3[5](
    vec3(1.24021, -0.27798, 0.01440),
    vec3(0.42638, 0.76040, -0.11550),
    vec3(-0.57694, 0.50461, -0.03385),
    vec3(-0.36439, 0.24865, 0.02742),
    vec3(0.27474, -0.23568, 1.10753)
);

// Orders of interference at most, and the contribution below which they stop.
const uint FILM_ORDERS = 64;
const float FILM_NEGLIGIBLE = 1e-4;

// Largest root of the reflectance of a base at normal incidence: n3 is infinite at 1.
const float FILM_MAX_AMPLITUDE = 0.999;

// A film over a base.
struct ThinFilm {
    // 0 where there is none.
    float factor;
    float ior;
    // Twice the thickness, nm.
    float path_nm;
    // Index of the base, n3.
    Spectrum base;
};

// The film over a base that reflects `f0` at normal incidence. None where the film does nothing: no share, no thickness, the index of
// air or a smaller one.
ThinFilm thin_film_new(float factor, float ior, float thickness_nm, Spectrum f0) {
    bool seen = HAS_FILM && factor > 0.0 && ior > 1.0 && thickness_nm > 0.0;
    if (!seen) {
        return ThinFilm(0.0, 1.0, 0.0, WHITE);
    }
    Spectrum r = min(sqrt(max(f0, 0.0)), FILM_MAX_AMPLITUDE);
    // Where interference has long averaged out, more thickness changes nothing.
    return ThinFilm(min(factor, 1.0), min(ior, 100.0), 2.0 * min(thickness_nm, 1e5), (1.0 + r) / (1.0 - r));
}

// True where there is one.
bool thin_film_is_some(ThinFilm self_) {
    return HAS_FILM && self_.factor > 0.0;
}

// Cosine in a medium of index `n`. Snell's law; n² - 1 is factored so that indices close to 1 lose no digits at grazing angles.
Spectrum film_refracted(Spectrum n, float cos1) {
    return sqrt((n - 1.0) * (n + 1.0) + cos1 * cos1) / n;
}

// 1 + 2 Σ pᵐ Sₘ over the orders of one polarisation. `path` is the optical path; `scale` is what the sum will be multiplied by,
// which tells when to stop.
Spectrum film_sum(float first_cos[5], float first_damping[5], Spectrum p, float scale) {
    // cos mφ by its recurrence; damping^(m²) by its: the ratio of neighbours grows by damping² each step.
    float before[5] = float[5](1.0, 1.0, 1.0, 1.0, 1.0);
    float cosine[5] = first_cos;
    float damping[5] = first_damping;
    float ratio[5] = first_damping;
    Spectrum power = p * 2.0;
    Spectrum sum = WHITE;
    for (uint order = 0; order < FILM_ORDERS; order++) {
        Spectrum transform = BLACK;
        float most = 0.0;
        for (int k = 0; k < 5; k++) {
            transform += FILM_SHARE[k] * (cosine[k] * damping[k]);
            most = max(most, damping[k]);
            float next = 2.0 * first_cos[k] * cosine[k] - before[k];
            before[k] = cosine[k];
            cosine[k] = next;
            ratio[k] *= first_damping[k] * first_damping[k];
            damping[k] *= ratio[k];
        }
        sum += power * transform;
        power *= p;
        if (scale * most * max_component(abs(power)) < FILM_NEGLIGIBLE) {
            break;
        }
    }
    return sum;
}

// T / T13, with both polarisations summed in each.
Spectrum film_passed(ThinFilm self_, float cos1) {
    float n2 = self_.ior;
    float cos2 = film_refracted(Spectrum(n2), cos1).r;
    Spectrum cos3 = film_refracted(self_.base, cos1);
    // The cosine transforms of the Gaussians at the optical path, and their damping.
    float path_nm = self_.path_nm * n2 * cos2;
    float first_cos[5];
    float first_damping[5];
    for (int k = 0; k < 5; k++) {
        float s;
        sin_cos(2.0 * PI * (path_nm * FILM_WAVENUMBER[k]), s, first_cos[k]);
        float x = PI * FILM_DEVIATION[k] * path_nm;
        first_damping[k] = exp(-2.0 * x * x);
    }
    Spectrum film = BLACK;
    Spectrum alone = BLACK;
    for (int polarisation = 0; polarisation < 2; polarisation++) {
        // Admittances of the three sides, perpendicular and parallel: an amplitude is (a - b) / (a + b), a transmittance 4ab / (a + b)².
        bool perpendicular = polarisation == 0;
        float y1 = perpendicular ? cos1 : 1.0 / cos1;
        float y2 = perpendicular ? n2 * cos2 : n2 / cos2;
        Spectrum y3 = perpendicular ? self_.base * cos3 : self_.base * (1.0 / cos3);
        float sum12 = y1 + y2;
        float r12 = (y1 - y2) / sum12;
        float t12 = 4.0 * y1 * y2 / sqr(sum12);
        Spectrum sum23 = y2 + y3;
        Spectrum p = -r12 * ((y2 - y3) / sum23);
        Spectrum t23 = 4.0 * y2 * y3 / (sum23 * sum23);
        // 1 - p² without cancellation.
        Spectrum direct = t12 * t23 / (t12 + t23 - t12 * t23);
        film += direct * film_sum(first_cos, first_damping, p, max_component(direct));
        Spectrum sum13 = y1 + y3;
        alone += 4.0 * y1 * y3 / (sum13 * sum13);
    }
    return film * (1.0 / alone);
}

// Reflectance of the surface with the film, each band in [0, 1]. `plain` is its reflectance without, in [0, 1], at the same
// angle; `cosine` that of the angle in the air outside.
Spectrum thin_film_reflectance(ThinFilm self_, Spectrum plain, float cosine) {
    Spectrum passed = film_passed(self_, clamp(cosine, 1e-6, 1.0));
    return plain + (clamp(1.0 - (1.0 - plain) * passed, 0.0, 1.0) - plain) * self_.factor;
}

// Nodes and weights of the mean over the cosine-weighted hemisphere.
const uint FILM_NODES = 6;
const vec2 FILM_AVERAGE[6] = vec2[6](
    vec2(0.1837532, 0.085662246),
    vec2(0.4115766, 0.18038079),
    vec2(0.6170011, 0.23395697),
    vec2(0.7869623, 0.23395697),
    vec2(0.9113752, 0.18038079),
    vec2(0.9829724, 0.085662246)
);

#endif
