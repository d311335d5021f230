// Varnish over a surface. Twin: core/src/bsdf/coat.rs, where it is explained.
#ifndef BSDF_COAT_GLSL
#define BSDF_COAT_GLSL

#include "frame.glsl"
#include "fresnel.glsl"
#include "math.glsl"
#include "microfacet.glsl"
#include "bsdf/compensation.glsl"
#include "bsdf/sample.glsl"

// Reflectance at normal incidence, of index 1.5.
const float COAT_F0 = 0.04;

// A layer of varnish.
struct Coat {
    // 0 where there is none.
    float factor;
    // A mirror unless `ggx_is_rough`.
    Ggx ggx;
    vec3 normal;
};

// `factor` in [0, 1]; `roughness` perceptual; `normal` unit, in the local frame of the surface.
Coat coat_new(float factor, float roughness, vec3 normal) {
    return Coat(factor, rough_new(roughness, 0.0), normal);
}

float coat_reflectance(float cosine) {
    return lerp(COAT_F0, 1.0, schlick_weight(cosine));
}

// Hemispherical albedo.
float coat_albedo(Coat self_) {
    return self_.factor * directional_reflected(rough_average(self_.ggx), COAT_F0, 1.0);
}

// Share of the light of a direction that reaches what lies beneath, or comes from there. Directions below the horizon of the varnish
// count as grazing ones; a direction on the other side of the surface meets the same varnish there.
float coat_passed(Coat self_, vec3 w) {
    float mu = clamp(dot(self_.normal, w) * copysign(1.0, w.z), 0.0, 1.0);
    Directional at = rough_directional(self_.ggx, vec3(0.0, 0.0, mu));
    return lerp(1.0, directional_passed(at, COAT_F0, 1.0), self_.factor);
}

// f · cos θi, with the cosine to its own normal, and density; both directions above the surface.
float coat_eval_pdf(Coat self_, vec3 wo, vec3 wi, out float pdf) {
    pdf = 0.0;
    if (!ggx_is_rough(self_.ggx)) {
        return 0.0;
    }
    Frame frame = frame_from_normal(self_.normal);
    wo = frame_to_local(frame, wo);
    wi = frame_to_local(frame, wi);
    if (wo.z <= 0.0 || wi.z <= 0.0) {
        return 0.0;
    }
    vec3 m = normalize(wo + wi);
    float f = ggx_reflection(self_.ggx, wo, wi, m, pdf);
    return self_.factor * coat_reflectance(dot(wo, m)) * f;
}

// Draws a direction; a delta lobe's weight is given, a smooth one's is left to the caller. False below a horizon.
bool coat_draw(Coat self_, vec3 wo, vec2 u, out BsdfSample drawn) {
    if (!ggx_is_rough(self_.ggx)) {
        float cosine = dot(self_.normal, wo);
        vec3 wi = mirror_about(wo, self_.normal);
        drawn = bsdf_sample_delta(wi, Spectrum(self_.factor * coat_reflectance(cosine)), 1.0, LOBE_SPECULAR_REFLECTION);
        return cosine > 0.0 && wi.z > 0.0;
    }
    Frame frame = frame_from_normal(self_.normal);
    wo = frame_to_local(frame, wo);
    vec3 local = mirror_about(wo, ggx_sample_visible_normal(self_.ggx, wo, u));
    vec3 wi = frame_to_world(frame, local);
    drawn = bsdf_sample_open(wi, LOBE_GLOSSY_REFLECTION);
    return wo.z > 0.0 && local.z > 0.0 && wi.z > 0.0;
}

#endif
