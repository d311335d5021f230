// Twin test of all of bsdf/: testkit/tests/twins/bsdf.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "twins/bsdf_params.glsl"

struct Input {
    PackedParams params;
    vec3 wo;
    vec3 wi;
    float u_lobe;
    vec2 u;
    uint mode;
};
struct Output {
    // Value and density between the two directions.
    vec3 f;
    float pdf;
    // The direction drawn, if one was.
    uint found;
    vec3 wi;
    vec3 weight;
    float sample_pdf;
    uint lobe;
    float eta_scale;
    // The rest of what a surface is asked.
    vec3 albedo;
    vec3 thin_transmittance;
    vec3 straight_transmittance;
    uint has_smooth_lobes;
    uint has_one_lobe;
};

#include "twins/kernel.glsl"
#include "bsdf/layered.glsl"

BsdfParams unpacked(PackedParams p) {
    return BsdfParams(
        p.base_color, p.metallic, p.roughness, p.ior, p.specular, p.specular_color, p.transmission, p.thin != 0, p.eta,
        p.inside != 0, p.has_eta_fresnel != 0, p.eta_fresnel, p.diffuse_sampling, p.diffuse_roughness,
        p.diffuse_transmission, p.diffuse_transmission_color, p.anisotropy, p.has_film != 0, p.film_factor, p.film_ior,
        p.film_thickness_nm, p.has_gloss != 0, p.gloss_specular, p.gloss_exponent, p.gloss_fresnel != 0,
        p.has_sheen != 0, p.sheen_color, p.sheen_roughness, p.has_coat != 0, p.coat_factor, p.coat_roughness,
        p.coat_normal
    );
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Bsdf bsdf = bsdf_new(unpacked(it.params));
    Output o;
    o.f = bsdf_eval_pdf(bsdf, it.wo, it.wi, it.mode, o.pdf);
    BsdfSample drawn;
    bool found = bsdf_sample(bsdf, it.wo, it.u_lobe, it.u, it.mode, drawn);
    o.found = uint(found);
    o.wi = drawn.wi;
    o.weight = drawn.weight;
    o.sample_pdf = drawn.pdf;
    o.lobe = drawn.lobe;
    o.eta_scale = drawn.eta_scale;
    o.albedo = bsdf_albedo(bsdf);
    o.thin_transmittance = bsdf_thin_transmittance(bsdf, it.wo);
    o.straight_transmittance = bsdf_straight_transmittance(bsdf, it.wo);
    o.has_smooth_lobes = uint(bsdf_has_smooth_lobes(bsdf));
    o.has_one_lobe = uint(bsdf_has_one_lobe(bsdf));
    push.outputs.at[i] = o;
}
