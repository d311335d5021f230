// Sheen: upright fibres that shine at grazing angles. Twin: core/src/bsdf/sheen.rs, where the model is explained.
#ifndef BSDF_SHEEN_GLSL
#define BSDF_SHEEN_GLSL

#include "math.glsl"
#include "rgb.glsl"

const uint SHEEN_N_ROUGHNESS = 32;
const uint SHEEN_N_MU = 32;
// Narrower fibres are not told apart.
const float SHEEN_MIN_ROUGHNESS = 0.05;

// Added to the albedo when choosing: interpolation may round a faint sheen to none.
const float SHEEN_ALBEDO_FLOOR = 0.01;

// A layer of fibres.
struct Sheen {
    // Black where there is none.
    Spectrum color;
    float roughness;
};

// `color` in [0, 1]; `roughness` perceptual.
Sheen sheen_new(Spectrum color, float roughness) {
    return Sheen(color, roughness > SHEEN_MIN_ROUGHNESS ? min(roughness, 1.0) : SHEEN_MIN_ROUGHNESS);
}

// p = 1/α.
float sheen_exponent(Sheen self_) {
    return 1.0 / (self_.roughness * self_.roughness);
}

// Row of the tables, and the fraction beyond it.
uint sheen_row(Sheen self_, out float frac) {
    float p = (self_.roughness - SHEEN_MIN_ROUGHNESS) * (float(SHEEN_N_ROUGHNESS - 1) / (1.0 - SHEEN_MIN_ROUGHNESS));
    uint row = min(uint(p), SHEEN_N_ROUGHNESS - 2);
    frac = p - float(row);
    return row;
}

// What white fibres return of light from all around, at `mu` in [0, 1].
float sheen_directional(Sheen self_, float mu) {
    float frac;
    uint i = sheen_row(self_, frac);
    float s = sqrt(mu * (1.0 + self_.roughness) / (mu + self_.roughness));
    float p = min(s * float(SHEEN_N_MU - 1), float(SHEEN_N_MU - 1));
    uint j = min(uint(p), SHEEN_N_MU - 2);
    float t = p - float(j);
    float a = lerp(push.tables.sheen_directional[i][j], push.tables.sheen_directional[i][j + 1], t);
    float b = lerp(push.tables.sheen_directional[i + 1][j], push.tables.sheen_directional[i + 1][j + 1], t);
    return lerp(a, b, frac);
}

// The same averaged over the hemisphere with the cosine.
float sheen_average(Sheen self_) {
    float frac;
    uint i = sheen_row(self_, frac);
    return lerp(push.tables.sheen_average[i], push.tables.sheen_average[i + 1], frac);
}

// Hemispherical albedo.
Spectrum sheen_albedo(Sheen self_) {
    return self_.color * sheen_average(self_);
}

// Share of light that the layer leaves to what lies beneath, given `sheen_directional`: by the strongest band.
float sheen_passed(Sheen self_, float directional) {
    return 1.0 - max_component(self_.color) * directional;
}

// The share of light for choosing a layer, given `sheen_directional`.
float sheen_importance(Sheen self_, float directional) {
    return average(self_.color) * (directional + SHEEN_ALBEDO_FLOOR);
}

// f · cos θi; both directions above the surface.
Spectrum sheen_eval(Sheen self_, vec3 wo, vec3 wi) {
    float exponent = sheen_exponent(self_);
    float scale = (2.0 + exponent) * (0.125 * INV_PI);
    float k = sqr(2.0 + exponent) * INV_PI / (2.0 * exponent + 5.0) - 0.25;
    // sin² of the half vector from its part along the surface: 1 less a cosine would be made of a card's roundings about the mirror direction.
    vec3 h = wo + wi;
    float sin2 = dot(h.xy, h.xy) / dot(h, h);
    float eta_o = sqrt(0.25 + k * max((1.0 - wo.z) * (1.0 + wo.z), 0.0));
    float eta_i = sqrt(0.25 + k * max((1.0 - wi.z) * (1.0 + wi.z), 0.0));
    float shown = wo.z * eta_i + wi.z * eta_o;
    return self_.color * (scale * pow_(sin2, 0.5 * exponent) * wi.z / shown);
}

// Rate of the exponential by which heights are drawn.
float sheen_rate(Sheen self_, float mu) {
    return 0.5 / self_.roughness + 0.12 * sheen_exponent(self_) * mu;
}

// Width γ of the azimuth about that of `wo`, at the cosines `mu` and `cosine` with sines `sin_o` and `sin_i`.
float sheen_width(Sheen self_, float mu, float sin_o, float cosine, float sin_i) {
    float sines = sin_o * sin_i;
    float beta = 0.5 * sheen_exponent(self_) * sines * sqr((mu + cosine) / (1.0 + mu * cosine + sines));
    return 1.0 / sqrt(1.0 + 3.0 * beta);
}

// A direction above the surface (or on its horizon), with density `sheen_pdf`.
vec3 sheen_sample(Sheen self_, vec3 wo, vec2 u) {
    float rate = sheen_rate(self_, wo.z);
    float cosine = clamp(-ln(1.0 - u.x * (1.0 - exp(-rate))) / rate, 0.0, 1.0);
    float sin_o = length(wo.xy);
    float sin_i = safe_sqrt((1.0 - cosine) * (1.0 + cosine));
    float gamma = sheen_width(self_, wo.z, sin_o, cosine, sin_i);
    // x = γ tan ψ, and the azimuth from x without its angle.
    float s, c;
    sin_cos(PI * (u.y - 0.5), s, c);
    float a = c * c;
    float b = sqr(gamma * s);
    float cos_phi = (a - b) / (a + b);
    float sin_phi = 2.0 * gamma * s * c / (a + b);
    vec2 x = sin_o > 0.0 ? wo.xy / sin_o : vec2(1.0, 0.0);
    return vec3(sin_i * (x.x * cos_phi - x.y * sin_phi), sin_i * (x.y * cos_phi + x.x * sin_phi), cosine);
}

// Density of `sheen_sample`, sr⁻¹; `wi.z > 0`.
float sheen_pdf(Sheen self_, vec3 wo, vec3 wi) {
    float rate = sheen_rate(self_, wo.z);
    float height = rate * exp(-rate * wi.z) / (1.0 - exp(-rate));
    float sin_o = length(wo.xy);
    float sin_i = length(wi.xy);
    float gamma = sheen_width(self_, wo.z, sin_o, wi.z, sin_i);
    float sines = sin_o * sin_i;
    float cos_phi = sines > 0.0 ? clamp(dot(wo.xy, wi.xy) / sines, -1.0, 1.0) : 1.0;
    return height * gamma * INV_PI / (sqr(gamma) * (1.0 + cos_phi) + (1.0 - cos_phi));
}

#endif
