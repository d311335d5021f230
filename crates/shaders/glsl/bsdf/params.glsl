// What a material says at one point. Twin: core/src/bsdf/params.rs, where each value is described; an `Option` becomes a flag
// and members with its name before theirs.
#ifndef BSDF_PARAMS_GLSL
#define BSDF_PARAMS_GLSL

#include "rgb.glsl"
#include "bsdf/lambert.glsl"

// Factors are clamped to [0, 1].
struct BsdfParams {
    Spectrum base_color;
    float metallic;
    float roughness;
    float ior;
    float specular;
    Spectrum specular_color;
    float transmission;
    bool thin;
    float eta;
    bool inside;
    bool has_eta_fresnel;
    float eta_fresnel;
    uint diffuse_sampling;
    float diffuse_roughness;
    float diffuse_transmission;
    Spectrum diffuse_transmission_color;
    float anisotropy;
    bool has_film;
    float film_factor;
    float film_ior;
    float film_thickness_nm;
    bool has_gloss;
    Spectrum gloss_specular;
    float gloss_exponent;
    bool gloss_fresnel;
    bool has_sheen;
    Spectrum sheen_color;
    float sheen_roughness;
    bool has_coat;
    float coat_factor;
    float coat_roughness;
    vec3 coat_normal;
};

// A rough white dielectric with index 1.5, opaque.
BsdfParams bsdf_params_default() {
    BsdfParams p;
    p.base_color = WHITE;
    p.metallic = 0.0;
    p.roughness = 1.0;
    p.ior = 1.5;
    p.specular = 1.0;
    p.specular_color = WHITE;
    p.transmission = 0.0;
    p.thin = true;
    p.eta = 1.5;
    p.inside = false;
    p.has_eta_fresnel = false;
    p.eta_fresnel = 1.5;
    p.diffuse_sampling = DIFFUSE_SAMPLING_COSINE;
    p.diffuse_roughness = 0.0;
    p.diffuse_transmission = 0.0;
    p.diffuse_transmission_color = WHITE;
    p.anisotropy = 0.0;
    p.has_film = false;
    p.film_factor = 0.0;
    p.film_ior = 1.0;
    p.film_thickness_nm = 0.0;
    p.has_gloss = false;
    p.gloss_specular = BLACK;
    p.gloss_exponent = 0.0;
    p.gloss_fresnel = false;
    p.has_sheen = false;
    p.sheen_color = BLACK;
    p.sheen_roughness = 1.0;
    p.has_coat = false;
    p.coat_factor = 0.0;
    p.coat_roughness = 0.0;
    p.coat_normal = vec3(0.0, 0.0, 1.0);
    return p;
}

#endif
