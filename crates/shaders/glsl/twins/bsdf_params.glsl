// Parameters of a BSDF as tests hand them over: `Params` of testkit/tests/twins/bsdf.rs. Booleans have no layout in memory, so they are words.
#ifndef TWINS_BSDF_PARAMS_GLSL
#define TWINS_BSDF_PARAMS_GLSL

struct PackedParams {
    vec3 base_color;
    float metallic;
    float roughness;
    float ior;
    float specular;
    vec3 specular_color;
    float transmission;
    uint thin;
    float eta;
    uint inside;
    uint has_eta_fresnel;
    float eta_fresnel;
    uint diffuse_sampling;
    float diffuse_roughness;
    float diffuse_transmission;
    vec3 diffuse_transmission_color;
    float anisotropy;
    uint has_film;
    float film_factor;
    float film_ior;
    float film_thickness_nm;
    uint has_gloss;
    vec3 gloss_specular;
    float gloss_exponent;
    uint gloss_fresnel;
    uint has_sheen;
    vec3 sheen_color;
    float sheen_roughness;
    uint has_coat;
    float coat_factor;
    float coat_roughness;
    vec3 coat_normal;
};

#endif
