// What a BSDF hands out when it draws a direction. Twin: core/src/bsdf/mod.rs.
//
// In Rust each model draws and then weighs its direction. Here models draw only (`metal_draw` and so on) and leave weight and density of
// smooth lobes open, and `bsdf_sample` weighs the direction once, whichever drew it: the numbers are the same, and the code that
// evaluates is there once instead of once for each model.
#ifndef BSDF_SAMPLE_GLSL
#define BSDF_SAMPLE_GLSL

#include "rgb.glsl"

// Which way light is followed: radiance from the camera, or importance-carrying light paths from the lights.
const uint TRANSPORT_RADIANCE = 0u;
const uint TRANSPORT_IMPORTANCE = 1u;

// What kind of scattering a sample took.
const uint LOBE_DIFFUSE_REFLECTION = 0u;
const uint LOBE_DIFFUSE_TRANSMISSION = 1u;
const uint LOBE_GLOSSY_REFLECTION = 2u;
const uint LOBE_SPECULAR_REFLECTION = 3u;
const uint LOBE_GLOSSY_TRANSMISSION = 4u;
const uint LOBE_SPECULAR_TRANSMISSION = 5u;
const uint LOBE_THIN_TRANSMISSION = 6u;

// True for directions chosen from a finite set; evaluation leaves these out.
bool lobe_is_delta(uint self_) {
    return self_ == LOBE_SPECULAR_REFLECTION || self_ == LOBE_SPECULAR_TRANSMISSION || self_ == LOBE_THIN_TRANSMISSION;
}

// True when `wi` leaves on the other side of the surface.
bool lobe_is_transmission(uint self_) {
    return self_ == LOBE_DIFFUSE_TRANSMISSION || self_ >= LOBE_GLOSSY_TRANSMISSION;
}

// Clamps to [0, 1]; NaN becomes 0.
float unit_interval(float x) {
    return x > 0.0 ? min(x, 1.0) : 0.0;
}

// The same for each band.
Spectrum unit_interval(Spectrum x) {
    return Spectrum(unit_interval(x.r), unit_interval(x.g), unit_interval(x.b));
}

// A direction drawn by `bsdf_sample`.
struct BsdfSample {
    // Local direction, unit.
    vec3 wi;
    // f · |cos θi| / pdf. For delta lobes the lobe's weight over the probability of having chosen it.
    Spectrum weight;
    // Density in sr⁻¹, all smooth lobes together. For delta lobes the probability of the choice.
    float pdf;
    // The lobe chosen.
    uint lobe;
    // (ηi/ηt)² scaling already inside `weight`: 1 for reflection; roulette divides it out.
    float eta_scale;
};

// A direction of a smooth lobe; weight and density are found by whoever asked for it.
BsdfSample bsdf_sample_open(vec3 wi, uint lobe) {
    return BsdfSample(wi, BLACK, 0.0, lobe, 1.0);
}

// From the weight of a delta lobe and the probability of having chosen it.
BsdfSample bsdf_sample_delta(vec3 wi, Spectrum value, float prob, uint lobe) {
    return BsdfSample(wi, value * (1.0 / prob), prob, lobe, 1.0);
}

#endif
