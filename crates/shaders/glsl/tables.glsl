// Tables of numbers that functions look up: one buffer, filled by `lumbre_shaders::tables` from those of lumbre-core. Shaders name its
// address `push.tables`; declare push constants before including what uses it (see twins/kernel.glsl). Twin: shaders/src/tables.rs.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#ifndef TABLES_GLSL
#define TABLES_GLSL

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Tables {
    // core/src/bsdf/albedo.rs: by width and warped cosine, and averages by width.
    float albedo_deficit[32][32];
    float albedo_schlick_excess[32][32];
    float albedo_deficit_average[125];
    float albedo_schlick_average[125];
    // core/src/bsdf/sheen.rs: by roughness and warped cosine, and averages by roughness.
    float sheen_directional[32][32];
    float sheen_average[32];
    // core/src/bsdf/aniso_albedo.rs: two 16-bit integers a word, the first in the lower half; averages by both widths.
    uint aniso_deficit[4320];
    uint aniso_schlick_residual[4320];
    float aniso_deficit_average[37][21];
    float aniso_schlick_average[37][21];
    // core/src/wavelength.rs: responses of the three bands at each node, and the integral of their mean up to it.
    vec3 wavelength_response[63];
    float wavelength_cdf[63];
    // core/src/filter.rs: inverses of the Gaussian and the Blackman-Harris filter.
    float filter_distance[2][257];
    // core/src/color.rs: linear value of each 8-bit sRGB code.
    float srgb_decode[256];
};

#endif
