// What lies beneath the layers: a mixture of metal, opaque dielectric and transmissive dielectric with fixed weights.
// Twin: core/src/bsdf/mixture.rs, where it is explained.
//
// Registers decide the speed of a GPU, so the mixture holds what a point of a material says, brought into its domain, and the few derived
// values that are dear; `mixture_metal` and its kin make the models from it where they are used. A component without weight is absent.
#ifndef BSDF_MIXTURE_GLSL
#define BSDF_MIXTURE_GLSL

#include "bsdf/compensation.glsl"
#include "bsdf/dielectric.glsl"
#include "bsdf/dielectric_base.glsl"
#include "bsdf/diffuse.glsl"
#include "bsdf/features.glsl"
#include "bsdf/metal.glsl"
#include "bsdf/params.glsl"
#include "bsdf/phong.glsl"
#include "bsdf/sample.glsl"
#include "bsdf/thin.glsl"

// Rays closer to the surface than this cosine do not scatter: half vectors would lose all digits.
const float MIN_COS = 1e-6;

// Added to each component's albedo when choosing, so that none with weight is ever out of reach.
const float MIXTURE_ALBEDO_FLOOR = 0.05;

const bool HAS_TRANSMISSIVE = HAS_SOLID || HAS_THIN;
const bool HAS_MIXTURE = HAS_METAL || HAS_TRANSMISSIVE;

// A mixture of at most three models: metal, opaque dielectric, transmissive dielectric.
struct Mixture {
    // Shares of the components; they sum to 1.
    vec3 weights;
    // Probabilities of their being chosen.
    vec3 probs;
    Spectrum base_color;
    Ggx ggx;
    // 1 - E over the hemisphere where the facets are rough.
    float deficit_average;
    // Average reflectance of the metal; read under a film, and found anew without.
    Spectrum metal_average;
    // Beneath gloss already darkened.
    Diffuse diffuse;
    // Reflectance of the base's interface at normal incidence before its strength, which is that at grazing incidence; or of the gloss.
    Spectrum base_f0;
    float base_f90;
    float base_scale;
    bool gloss;
    bool gloss_fresnel;
    float gloss_exponent;
    bool thin;
    // The index of a thin wall, or the ratio of a solid's.
    float eta;
    float eta_fresnel;
    float film_factor;
    float film_ior;
    float film_thickness_nm;
};

bool mixture_has_metal(Mixture self_) {
    return HAS_METAL && self_.weights.x > 0.0;
}

bool mixture_has_base(Mixture self_) {
    return !HAS_MIXTURE || self_.weights.y > 0.0;
}

bool mixture_has_solid(Mixture self_) {
    return HAS_SOLID && self_.weights.z > 0.0 && !(HAS_THIN && self_.thin);
}

bool mixture_has_thin(Mixture self_) {
    return HAS_THIN && self_.weights.z > 0.0 && (!HAS_SOLID || self_.thin);
}

bool mixture_is_gloss(Mixture self_) {
    return HAS_GLOSS && self_.gloss;
}

// True for one component alone.
bool mixture_is_single(Mixture self_) {
    return !HAS_MIXTURE || max(max(self_.weights.x, self_.weights.y), self_.weights.z) == 1.0;
}

// The film over an interface that reflects `f0` at normal incidence.
ThinFilm mixture_film(Mixture self_, Spectrum f0) {
    return thin_film_new(self_.film_factor, self_.film_ior, self_.film_thickness_nm, f0);
}

Metal mixture_metal(Mixture self_) {
    ThinFilm film = mixture_film(self_, self_.base_color);
    Spectrum mean = self_.metal_average;
    if (!thin_film_is_some(film)) {
        mean = metal_average_reflectance(self_.base_color, film);
    }
    return metal_new(self_.base_color, film, self_.ggx, mean, self_.deficit_average);
}

Interface mixture_interface(Mixture self_) {
    return interface_new(self_.base_f0, self_.base_f90, mixture_film(self_, self_.base_f0), self_.ggx);
}

DielectricBase mixture_base(Mixture self_) {
    return dielectric_base_new(self_.diffuse, mixture_interface(self_), self_.base_scale);
}

Phong mixture_gloss(Mixture self_) {
    return phong_new(self_.diffuse, self_.base_f0, self_.gloss_exponent, self_.gloss_fresnel);
}

Dielectric mixture_solid(Mixture self_) {
    ThinFilm film = mixture_film(self_, Spectrum(f0_from_ior(self_.eta_fresnel)));
    return dielectric_new(self_.eta, self_.eta_fresnel, film, self_.base_color, self_.ggx);
}

ThinFilm mixture_film_of_wall(Mixture self_) {
    return mixture_film(self_, Spectrum(f0_from_ior(self_.eta)));
}

Thin mixture_thin(Mixture self_) {
    return thin_new(self_.eta, mixture_film_of_wall(self_), self_.base_color, self_.ggx, self_.deficit_average);
}

// Albedo of each component that has weight.
void mixture_albedos(Mixture self_, out Spectrum metal, out Spectrum base, out Spectrum transmissive) {
    metal = BLACK;
    base = BLACK;
    transmissive = BLACK;
    if (mixture_has_metal(self_)) {
        metal = metal_albedo(self_.base_color, mixture_film(self_, self_.base_color), self_.ggx);
    }
    if (mixture_has_base(self_)) {
        if (mixture_is_gloss(self_)) {
            base = phong_albedo(mixture_gloss(self_));
        } else {
            base = dielectric_base_albedo(mixture_base(self_));
        }
    }
    if (mixture_has_solid(self_)) {
        transmissive = dielectric_albedo(mixture_solid(self_));
    }
    if (mixture_has_thin(self_)) {
        transmissive = thin_albedo(self_.eta, mixture_film_of_wall(self_), self_.base_color);
    }
}

// The diffuse base and what lies over it.
void mixture_set_base(inout Mixture self_, BsdfParams params) {
    self_.diffuse = diffuse_new(params, self_.base_color);
    self_.gloss = HAS_GLOSS && params.has_gloss;
    self_.gloss_fresnel = params.gloss_fresnel;
    self_.gloss_exponent = params.gloss_exponent;
    self_.base_f0 = BLACK;
    self_.base_f90 = 0.0;
    self_.base_scale = 1.0;
    if (mixture_is_gloss(self_)) {
        Spectrum specular = unit_interval(params.gloss_specular);
        float scale = phong_scale(self_.diffuse, specular);
        self_.diffuse = diffuse_darkened(self_.diffuse, scale);
        self_.base_f0 = specular * scale;
    } else if (HAS_BASE) {
        self_.base_f90 = unit_interval(params.specular);
        if (self_.base_f90 > 0.0) {
            self_.base_f0 = unit_interval(f0_from_ior(params.ior) * params.specular_color);
            self_.base_scale = dielectric_base_scale(interface_average_passed(mixture_interface(self_)));
        }
    }
}

// Hemispherical albedo, given that of the components.
Spectrum mixture_albedo_of(Mixture self_, Spectrum metal, Spectrum base, Spectrum transmissive) {
    return min(metal * self_.weights.x + base * self_.weights.y + transmissive * self_.weights.z, 1.0);
}

// The surface with the given parameters. With `layered` its albedo is found, which layers over it ask for; else that is black.
Mixture mixture_new(BsdfParams params, bool layered, out Spectrum albedo) {
    Mixture self_;
    self_.base_color = unit_interval(params.base_color);
    float metallic = HAS_METAL ? unit_interval(params.metallic) : 0.0;
    float transmission = HAS_TRANSMISSIVE ? unit_interval(params.transmission) : 0.0;
    self_.weights = vec3(metallic, (1.0 - metallic) * (1.0 - transmission), (1.0 - metallic) * transmission);
    if (HAS_MIXTURE) {
        // One of 1 leaves the others nothing but rounding.
        vec3 whole = vec3(equal(self_.weights, vec3(1.0)));
        self_.weights = whole == vec3(0.0) ? self_.weights : whole;
    }
    self_.probs = self_.weights;
    self_.ggx = rough_new(params.roughness, params.anisotropy);
    self_.thin = params.thin;
    self_.eta = params.thin ? params.ior : params.eta;
    self_.eta_fresnel = params.has_eta_fresnel ? params.eta_fresnel : params.eta;
    self_.film_factor = params.has_film ? params.film_factor : 0.0;
    self_.film_ior = params.film_ior;
    self_.film_thickness_nm = params.film_thickness_nm;
    self_.deficit_average = rough_average(self_.ggx).deficit;
    self_.metal_average = BLACK;
    if (HAS_FILM && mixture_has_metal(self_)) {
        self_.metal_average = metal_average_reflectance(self_.base_color, mixture_film(self_, self_.base_color));
    }
    if (mixture_has_base(self_)) {
        mixture_set_base(self_, params);
    } else {
        self_.diffuse = diffuse_lambert(BLACK, params.diffuse_sampling);
        self_.gloss = false;
        self_.gloss_fresnel = false;
        self_.gloss_exponent = 0.0;
        self_.base_f0 = BLACK;
        self_.base_f90 = 0.0;
        self_.base_scale = 1.0;
    }
    albedo = BLACK;
    if (layered || !mixture_is_single(self_)) {
        Spectrum metal, base, transmissive;
        mixture_albedos(self_, metal, base, transmissive);
        albedo = mixture_albedo_of(self_, metal, base, transmissive);
        if (mixture_is_single(self_)) {
            return self_;
        }
        vec3 means = vec3(average(metal), average(base), average(transmissive));
        self_.probs = self_.weights * (means + MIXTURE_ALBEDO_FLOOR);
        self_.probs /= self_.probs.x + self_.probs.y + self_.probs.z;
    }
    return self_;
}

// True for a plain Lambert surface: sampling does not look at the number that chooses a lobe.
bool mixture_has_one_lobe(Mixture self_) {
    return mixture_is_single(self_) && mixture_has_base(self_) && !mixture_is_gloss(self_)
        && (!HAS_BASE || self_.base_f90 == 0.0) && diffuse_is_lambert(self_.diffuse);
}

// False when every lobe is a delta: light sampling has nothing to find here.
bool mixture_has_smooth_lobes(Mixture self_) {
    bool rough = ggx_is_rough(self_.ggx);
    bool smooth_lobe = rough && (mixture_has_metal(self_) || mixture_has_thin(self_));
    if (mixture_has_base(self_)) {
        if (mixture_is_gloss(self_)) {
            smooth_lobe = smooth_lobe || phong_is_smooth_lobe(mixture_gloss(self_));
        } else {
            smooth_lobe = smooth_lobe || dielectric_base_is_smooth_lobe(mixture_base(self_));
        }
    }
    if (mixture_has_solid(self_)) {
        smooth_lobe = smooth_lobe || ggx_is_rough(dielectric_facets(self_.eta, self_.ggx));
    }
    return smooth_lobe;
}

// Hemispherical albedo, approximately, in [0, 1]: a guide for denoisers.
Spectrum mixture_albedo(Mixture self_) {
    Spectrum metal, base, transmissive;
    mixture_albedos(self_, metal, base, transmissive);
    return mixture_albedo_of(self_, metal, base, transmissive);
}

// True where a component asks for the albedo of the facets.
bool mixture_asks_for_albedo(Mixture self_) {
    bool over_base = HAS_BASE && mixture_has_base(self_) && !mixture_is_gloss(self_) && self_.base_f90 > 0.0;
    return mixture_has_metal(self_) || mixture_has_thin(self_) || over_base;
}

// E and B of the facets towards `wo`, if a component asks: what drawing and evaluating share.
Directional mixture_towards(Mixture self_, vec3 wo) {
    if (mixture_asks_for_albedo(self_)) {
        return rough_directional(self_.ggx, wo);
    }
    return Directional(0.0, 0.0);
}

// f · |cos θi| and the density of sampling, sr⁻¹, smooth lobes only. `at_o` is `mixture_towards` there.
Spectrum mixture_eval_pdf(Mixture self_, Directional at_o, vec3 wo, vec3 wi, uint mode, out float pdf) {
    pdf = 0.0;
    Spectrum f = BLACK;
    if (wo.z < MIN_COS) {
        return f;
    }
    Facets facets = Facets(at_o, at_o, 0.0, 0.0, 0.0);
    if (mixture_asks_for_albedo(self_)) {
        facets = facets_between(self_.ggx, at_o, wo, wi);
    }
    float pdf_c;
    if (mixture_has_metal(self_)) {
        f += metal_eval_pdf(mixture_metal(self_), facets, wi, pdf_c) * self_.weights.x;
        pdf += pdf_c * self_.probs.x;
    }
    if (mixture_has_base(self_)) {
        Spectrum f_c;
        if (mixture_is_gloss(self_)) {
            f_c = phong_eval_pdf(mixture_gloss(self_), wo, wi, mode, pdf_c);
        } else {
            f_c = dielectric_base_eval_pdf(mixture_base(self_), facets, wo, wi, mode, pdf_c);
        }
        f += HAS_MIXTURE ? f_c * self_.weights.y : f_c;
        pdf += HAS_MIXTURE ? pdf_c * self_.probs.y : pdf_c;
    }
    if (mixture_has_solid(self_)) {
        f += dielectric_eval_pdf(mixture_solid(self_), wo, wi, mode, pdf_c) * self_.weights.z;
        pdf += pdf_c * self_.probs.z;
    }
    if (mixture_has_thin(self_)) {
        f += thin_eval_pdf(mixture_thin(self_), facets, wi, pdf_c) * self_.weights.z;
        pdf += pdf_c * self_.probs.z;
    }
    return f;
}

// Chooses a component and stretches the number that chose it over [0, 1) again: 0 metal, 1 base, 2 transmissive.
uint mixture_choose(Mixture self_, inout float u_lobe) {
    if (mixture_is_single(self_)) {
        return self_.weights.x > 0.0 ? 0 : self_.weights.y > 0.0 ? 1 : 2;
    }
    // The last component with weight takes what rounding leaves.
    uint chosen = 2;
    float below = self_.probs.x + self_.probs.y;
    float prob = self_.probs.z;
    if (u_lobe < self_.probs.x) {
        chosen = 0;
        below = 0.0;
        prob = self_.probs.x;
    } else if (u_lobe < below || self_.weights.z <= 0.0) {
        chosen = 1;
        below = self_.probs.x;
        prob = self_.probs.y;
    }
    u_lobe = clamp((u_lobe - below) / prob, 0.0, ONE_MINUS_EPSILON);
    return chosen;
}

// Draws a direction. False when the path ends here. Weight and density of a smooth lobe are left to the caller. `at_o` is
// `mixture_towards` for `wo`.
bool mixture_draw(Mixture self_, Directional at_o, vec3 wo, float u_lobe, vec2 u, uint mode, out BsdfSample drawn) {
    drawn = bsdf_sample_open(vec3(0.0, 0.0, 1.0), LOBE_DIFFUSE_REFLECTION);
    if (wo.z < MIN_COS) {
        return false;
    }
    uint chosen = HAS_MIXTURE ? mixture_choose(self_, u_lobe) : 1;
    // One visible normal serves whichever component was chosen.
    Ggx ggx = self_.ggx;
    bool solid = chosen == 2 && mixture_has_solid(self_);
    if (solid) {
        ggx = dielectric_facets(self_.eta, ggx);
    }
    vec3 m = vec3(0.0, 0.0, 1.0);
    if ((HAS_MIXTURE || HAS_BASE) && ggx_is_rough(ggx)) {
        m = ggx_sample_visible_normal(ggx, wo, u);
    }
    bool found = false;
    if (chosen == 0 && HAS_METAL) {
        found = metal_draw(mixture_metal(self_), at_o, wo, m, u_lobe, u, drawn);
    } else if (chosen == 1) {
        if (mixture_is_gloss(self_)) {
            found = phong_draw(mixture_gloss(self_), wo, u_lobe, u, drawn);
        } else {
            found = dielectric_base_draw(mixture_base(self_), at_o, wo, m, u_lobe, u, drawn);
        }
        if (HAS_DIFFUSE_TRANSMISSION && drawn.lobe == LOBE_DIFFUSE_TRANSMISSION) {
            drawn.eta_scale = diffuse_crossing(self_.diffuse, mode);
        }
    } else if (solid) {
        found = dielectric_draw(mixture_solid(self_), wo, m, u_lobe, mode, drawn);
    } else if (HAS_THIN) {
        found = thin_draw(mixture_thin(self_), at_o, wo, m, u_lobe, u, drawn);
    }
    if (HAS_MIXTURE && found && lobe_is_delta(drawn.lobe) && !mixture_is_single(self_)) {
        float weight = chosen == 0 ? self_.weights.x : chosen == 1 ? self_.weights.y : self_.weights.z;
        float prob = chosen == 0 ? self_.probs.x : chosen == 1 ? self_.probs.y : self_.probs.z;
        drawn.weight *= weight / prob;
        drawn.pdf *= prob;
    }
    return found;
}

// What a smooth thin wall lets straight through at this cosine to the normal, for shadow rays; black for everything else.
Spectrum mixture_thin_transmittance(Mixture self_, float cosine) {
    if (!mixture_has_thin(self_) || ggx_is_rough(self_.ggx)) {
        return BLACK;
    }
    return thin_slab(self_.eta, mixture_film_of_wall(self_), self_.base_color, cosine).transmitted * self_.weights.z;
}

// What crosses the smooth boundary of a solid when refraction is ignored, for shadow rays that may pass straight; black for everything
// else. `cosine` is taken in the thinner medium on both sides.
Spectrum mixture_straight_transmittance(Mixture self_, float cosine) {
    if (!mixture_has_solid(self_)) {
        return BLACK;
    }
    return dielectric_straight_transmittance(mixture_solid(self_), cosine) * self_.weights.z;
}

#endif
