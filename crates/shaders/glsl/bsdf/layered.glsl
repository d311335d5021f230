// The surface as integrators see it: the mixture of mixture.glsl, sheen over it, varnish over both.
// Twin: core/src/bsdf/layered.rs, where it is explained. This is the file to include: `bsdf_new`, `bsdf_eval_pdf`, `bsdf_sample` and so on.
#ifndef BSDF_LAYERED_GLSL
#define BSDF_LAYERED_GLSL

#include "bsdf/coat.glsl"
#include "bsdf/mixture.glsl"
#include "bsdf/sheen.glsl"

// Added to the albedo of the mixture when choosing.
const float LAYERS_ALBEDO_FLOOR = 0.05;

const bool HAS_LAYERS = HAS_COAT || HAS_SHEEN;

// Scattering at one point; made anew at each hit.
struct Bsdf {
    Mixture mixture;
    Coat coat;
    Sheen sheen;
    // The side of `wo` has layers.
    bool here;
    // The other side has them.
    bool beyond;
    // Hemispherical albedo of the mixture, mean over the bands; found beneath layers only.
    float mixture_mean;
};

bool bsdf_has_coat(Bsdf self_) {
    return HAS_COAT && self_.coat.factor > 0.0;
}

bool bsdf_has_sheen(Bsdf self_) {
    return HAS_SHEEN && !is_black(self_.sheen.color);
}

bool bsdf_has_layers(Bsdf self_) {
    return bsdf_has_coat(self_) || bsdf_has_sheen(self_);
}

// The surface with the given parameters.
Bsdf bsdf_new(BsdfParams params) {
    Bsdf self_;
    float factor = HAS_COAT && params.has_coat ? unit_interval(params.coat_factor) : 0.0;
    self_.coat = coat_new(factor, params.coat_roughness, params.coat_normal);
    Spectrum color = BLACK;
    if (HAS_SHEEN && params.has_sheen) {
        color = unit_interval(params.sheen_color);
    }
    self_.sheen = sheen_new(color, params.sheen_roughness);
    bool solid = !params.thin;
    self_.here = !(solid && params.inside);
    self_.beyond = !solid || params.inside;
    Spectrum albedo;
    self_.mixture = mixture_new(params, bsdf_has_layers(self_), albedo);
    self_.mixture_mean = average(albedo);
    return self_;
}

// A Lambert surface; `albedo` in [0, 1].
Bsdf bsdf_lambert(Spectrum albedo, uint sampling) {
    BsdfParams params = bsdf_params_default();
    params.base_color = albedo;
    params.specular = 0.0;
    params.diffuse_sampling = sampling;
    return bsdf_new(params);
}

// What the layers do to the light of one direction.
struct Toward {
    // Share that passes the coat.
    float coat;
    // Albedo of the sheen, colour left out.
    float sheen;
};

// Shares of the light of `w` that pass the coat, and the albedo of the sheen; 1 and 0 on a side without layers.
Toward layers_toward(Bsdf self_, vec3 w) {
    bool covered = w.z > 0.0 ? self_.here : self_.beyond;
    Toward toward = Toward(1.0, 0.0);
    if (covered && bsdf_has_coat(self_)) {
        toward.coat = coat_passed(self_.coat, w);
    }
    if (covered && bsdf_has_sheen(self_)) {
        toward.sheen = sheen_directional(self_.sheen, min(abs(w.z), 1.0));
    }
    return toward;
}

// The layers seen from `wo`.
struct LayersView {
    Toward o;
    float prob_coat;
    float prob_sheen;
    float prob_mixture;
};

// With the probabilities of choosing them: by the light that they return, about.
LayersView layers_at(Bsdf self_, vec3 wo) {
    Toward o = layers_toward(self_, wo);
    float sheen = 0.0;
    float beneath = o.coat;
    if (bsdf_has_sheen(self_) && self_.here) {
        sheen = o.coat * sheen_importance(self_.sheen, o.sheen);
        beneath *= sheen_passed(self_.sheen, o.sheen);
    }
    // Whatever lies beneath may turn into a mirror at grazing angles.
    beneath *= lerp(self_.mixture_mean, 1.0, schlick_weight(wo.z)) + LAYERS_ALBEDO_FLOOR;
    float coat = 1.0 - o.coat;
    float scale = 1.0 / (coat + sheen + beneath);
    return LayersView(o, coat * scale, sheen * scale, beneath * scale);
}

// T for coat and sheen between the direction of `view` and `wi`, and for the coat alone.
float layers_passed(Bsdf self_, LayersView view, vec3 wi, out float coat) {
    Toward i = layers_toward(self_, wi);
    coat = min(view.o.coat, i.coat);
    float sheen = 1.0;
    if (bsdf_has_sheen(self_)) {
        sheen = sheen_passed(self_.sheen, max(view.o.sheen, i.sheen));
    }
    return coat * sheen;
}

// Everything together, given value and density of the mixture.
Spectrum layers_eval_pdf(Bsdf self_, LayersView view, vec3 wo, vec3 wi, Spectrum f, inout float pdf) {
    float coat_passed;
    f *= layers_passed(self_, view, wi, coat_passed);
    pdf *= view.prob_mixture;
    if (wi.z > 0.0 && self_.here) {
        if (bsdf_has_sheen(self_)) {
            f += sheen_eval(self_.sheen, wo, wi) * coat_passed;
            pdf += sheen_pdf(self_.sheen, wo, wi) * view.prob_sheen;
        }
        if (bsdf_has_coat(self_)) {
            float pdf_coat;
            f += Spectrum(coat_eval_pdf(self_.coat, wo, wi, pdf_coat));
            pdf += pdf_coat * view.prob_coat;
        }
    }
    return f;
}

// f · |cos θi| and the density of `bsdf_sample`, sr⁻¹, smooth lobes only.
Spectrum bsdf_eval_pdf(Bsdf self_, vec3 wo, vec3 wi, uint mode, out float pdf) {
    Spectrum f = mixture_eval_pdf(self_.mixture, mixture_towards(self_.mixture, wo), wo, wi, mode, pdf);
    if (!bsdf_has_layers(self_)) {
        return f;
    }
    if (wo.z < MIN_COS || wi.z == 0.0) {
        pdf = 0.0;
        return BLACK;
    }
    return layers_eval_pdf(self_, layers_at(self_, wo), wo, wi, f, pdf);
}

// f · |cos θi|, smooth lobes only.
Spectrum bsdf_eval(Bsdf self_, vec3 wo, vec3 wi, uint mode) {
    float pdf;
    return bsdf_eval_pdf(self_, wo, wi, mode, pdf);
}

// Density of `bsdf_sample`, sr⁻¹, smooth lobes only.
float bsdf_pdf(Bsdf self_, vec3 wo, vec3 wi) {
    float pdf;
    bsdf_eval_pdf(self_, wo, wi, TRANSPORT_RADIANCE, pdf);
    return pdf;
}

// True for a plain Lambert surface: `bsdf_sample` does not look at the number that chooses a lobe.
bool bsdf_has_one_lobe(Bsdf self_) {
    return !bsdf_has_layers(self_) && mixture_has_one_lobe(self_.mixture);
}

// Draws a direction, of a coat, of sheen or of what lies beneath; `prob` is that of this choice. `view` is read where there are layers;
// `at_o` is `mixture_towards` for `wo`.
bool layers_draw(
    Bsdf self_, LayersView view, Directional at_o, vec3 wo, float u_lobe, vec2 u, uint mode, out float prob, out BsdfSample drawn
) {
    float below = view.prob_coat + view.prob_sheen;
    if (bsdf_has_coat(self_) && u_lobe < view.prob_coat) {
        prob = view.prob_coat;
        return coat_draw(self_.coat, wo, u, drawn);
    }
    if (bsdf_has_sheen(self_) && u_lobe < below) {
        prob = view.prob_sheen;
        drawn = bsdf_sample_open(sheen_sample(self_.sheen, wo, u), LOBE_DIFFUSE_REFLECTION);
        return true;
    }
    prob = view.prob_mixture;
    u_lobe = clamp((u_lobe - below) / view.prob_mixture, 0.0, ONE_MINUS_EPSILON);
    if (!mixture_draw(self_.mixture, at_o, wo, u_lobe, u, mode, drawn)) {
        return false;
    }
    if (lobe_is_delta(drawn.lobe)) {
        float coat_alone;
        drawn.weight *= layers_passed(self_, view, drawn.wi, coat_alone);
    }
    return true;
}

// Draws a direction. False when the path ends here: the light of that sample is 0.
bool bsdf_sample(Bsdf self_, vec3 wo, float u_lobe, vec2 u, uint mode, out BsdfSample drawn) {
    drawn = bsdf_sample_open(vec3(0.0, 0.0, 1.0), LOBE_DIFFUSE_REFLECTION);
    if (wo.z < MIN_COS) {
        return false;
    }
    bool layers = bsdf_has_layers(self_);
    LayersView view = LayersView(Toward(1.0, 0.0), 0.0, 0.0, 1.0);
    if (layers) {
        view = layers_at(self_, wo);
    }
    Directional at_o = mixture_towards(self_.mixture, wo);
    float prob;
    if (!layers_draw(self_, view, at_o, wo, u_lobe, u, mode, prob, drawn)) {
        return false;
    }
    if (lobe_is_delta(drawn.lobe)) {
        drawn.weight *= 1.0 / prob;
        drawn.pdf *= prob;
        return true;
    }
    if (bsdf_has_one_lobe(self_) && self_.mixture.diffuse.sampling == DIFFUSE_SAMPLING_COSINE) {
        // The cosine and the density cancel exactly.
        drawn.weight = self_.mixture.diffuse.rho;
        drawn.pdf = diffuse_sampling_pdf(DIFFUSE_SAMPLING_COSINE, drawn.wi.z);
        return drawn.wi.z > 0.0;
    }
    if (layers && drawn.wi.z == 0.0) {
        return false;
    }
    float pdf;
    Spectrum f = mixture_eval_pdf(self_.mixture, at_o, wo, drawn.wi, mode, pdf);
    if (layers) {
        f = layers_eval_pdf(self_, view, wo, drawn.wi, f, pdf);
    }
    drawn.weight = f * (1.0 / pdf);
    drawn.pdf = pdf;
    return pdf > 0.0;
}

// False when every lobe is a delta: light sampling has nothing to find here.
bool bsdf_has_smooth_lobes(Bsdf self_) {
    bool in_layers = bsdf_has_sheen(self_) || (bsdf_has_coat(self_) && ggx_is_rough(self_.coat.ggx));
    return mixture_has_smooth_lobes(self_.mixture) || (self_.here && in_layers);
}

// Hemispherical albedo, approximately, in [0, 1]: a guide for denoisers.
Spectrum bsdf_albedo(Bsdf self_) {
    Spectrum covered = mixture_albedo(self_.mixture);
    if (!bsdf_has_layers(self_) || !self_.here) {
        return covered;
    }
    if (bsdf_has_sheen(self_)) {
        covered = sheen_albedo(self_.sheen) + covered * sheen_passed(self_.sheen, sheen_average(self_.sheen));
    }
    float coat = bsdf_has_coat(self_) ? coat_albedo(self_.coat) : 0.0;
    return min(covered * (1.0 - coat) + Spectrum(coat), 1.0);
}

Spectrum bsdf_straight(Bsdf self_, vec3 wo, Spectrum beneath) {
    if (bsdf_has_layers(self_) && !is_black(beneath)) {
        float coat_alone;
        return beneath * layers_passed(self_, layers_at(self_, wo), -wo, coat_alone);
    }
    return beneath;
}

// What a smooth thin wall lets straight through, for shadow rays; black for everything else. `wo.z > 0`.
Spectrum bsdf_thin_transmittance(Bsdf self_, vec3 wo) {
    return bsdf_straight(self_, wo, mixture_thin_transmittance(self_.mixture, wo.z));
}

// What crosses the smooth boundary of a solid when refraction is ignored, for shadow rays that may pass straight; black for everything
// else. `wo` is taken in the thinner medium on both sides.
Spectrum bsdf_straight_transmittance(Bsdf self_, vec3 wo) {
    return bsdf_straight(self_, wo, mixture_straight_transmittance(self_.mixture, wo.z));
}

#endif
