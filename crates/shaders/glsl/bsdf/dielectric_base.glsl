// The opaque dielectric of glTF 2.0: a GGX interface over a diffuse base. Twin: core/src/bsdf/dielectric_base.rs, where it is explained.
#ifndef BSDF_DIELECTRIC_BASE_GLSL
#define BSDF_DIELECTRIC_BASE_GLSL

#include "bsdf/diffuse.glsl"
#include "bsdf/interface.glsl"

// Smallest probability with which the interface is chosen.
const float BASE_MIN_PROB = 1e-7;

// A dielectric interface over a diffuse base.
struct DielectricBase {
    Diffuse diffuse;
    Interface over;
    // Mean of the base's albedo over the bands, for choosing the lobe; not read without an interface.
    float diffuse_mean;
    // 1 / (1 - Eavg), or 0 where the interface lets nothing through.
    float scale;
};

// 1 over what the interface passes.
float dielectric_base_scale(float average_passed) {
    return average_passed > 1e-7 ? 1.0 / average_passed : 0.0;
}

// The base beneath an interface; `scale` is `dielectric_base_scale`.
DielectricBase dielectric_base_new(Diffuse diffuse, Interface over, float scale) {
    return DielectricBase(diffuse, over, average(diffuse_albedo(diffuse)), scale);
}

// True when nothing lies over the diffuse base.
bool dielectric_base_is_bare(DielectricBase self_) {
    return interface_is_none(self_.over);
}

// True when the base or a rough interface scatters by a density.
bool dielectric_base_is_smooth_lobe(DielectricBase self_) {
    return !diffuse_is_black(self_.diffuse) || (ggx_is_rough(self_.over.ggx) && !dielectric_base_is_bare(self_));
}

// Hemispherical albedo.
Spectrum dielectric_base_albedo(DielectricBase self_) {
    Spectrum diffuse = diffuse_albedo(self_.diffuse);
    if (dielectric_base_is_bare(self_)) {
        return diffuse;
    }
    return interface_albedo(self_.over) + diffuse * interface_average_passed(self_.over);
}

// Probability of drawing from the interface: its share of the reflected light.
float dielectric_base_prob_specular(DielectricBase self_, Shares at_o) {
    float prob = at_o.reflected / (at_o.reflected + self_.diffuse_mean * at_o.passed);
    // Shares that no random number can meet are dropped, 0/0 (nothing reflects) with them.
    return prob > BASE_MIN_PROB ? prob : 0.0;
}

// f · |cos θi| and density. `facets` are those between `wo` and `wi`; `wo.z > 0`.
Spectrum dielectric_base_eval_pdf(DielectricBase self_, Facets facets, vec3 wo, vec3 wi, uint mode, out float pdf) {
    if (wi.z <= 0.0 && diffuse_is_lambert(self_.diffuse)) {
        pdf = 0.0;
        return BLACK;
    }
    float pdf_base;
    Spectrum base = diffuse_eval_pdf(self_.diffuse, wo, wi, mode, pdf_base);
    if (dielectric_base_is_bare(self_)) {
        pdf = pdf_base;
        return base;
    }
    Shares at_o = interface_shares(self_.over, facets.at_o, wo);
    float p = dielectric_base_prob_specular(self_, at_o);
    float passed = at_o.passed * interface_shares(self_.over, facets.at_i, wi).passed;
    Spectrum f = base * (passed * self_.scale);
    pdf = (1.0 - p) * pdf_base;
    if (ggx_is_rough(self_.over.ggx) && wi.z > 0.0) {
        f += interface_reflectance(self_.over, facets.cos_d) * facets.value;
        pdf += p * facets.pdf;
    }
    return f;
}

// Draws a direction; `at_o` is `rough_directional` towards `wo`, `m` a visible normal drawn with `u`. The scale of radiance that crosses is
// left to the caller.
bool dielectric_base_draw(DielectricBase self_, Directional at_o, vec3 wo, vec3 m, float u_lobe, vec2 u, out BsdfSample drawn) {
    if (!dielectric_base_is_bare(self_)) {
        float p = dielectric_base_prob_specular(self_, interface_shares(self_.over, at_o, wo));
        if (u_lobe < p) {
            if (!ggx_is_rough(self_.over.ggx)) {
                vec3 mirror = vec3(-wo.x, -wo.y, wo.z);
                drawn = bsdf_sample_delta(mirror, interface_reflectance(self_.over, wo.z), p, LOBE_SPECULAR_REFLECTION);
                return true;
            }
            drawn = bsdf_sample_open(mirror_about(wo, m), LOBE_GLOSSY_REFLECTION);
            return drawn.wi.z > 0.0;
        }
        u_lobe = min((u_lobe - p) / (1.0 - p), ONE_MINUS_EPSILON);
    }
    vec3 wi = diffuse_sample(self_.diffuse, wo, u_lobe, u);
    drawn = bsdf_sample_open(wi, diffuse_lobe(wi));
    return true;
}

#endif
