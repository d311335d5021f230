// Directional albedo of GGX reflection, tabulated. Twin: core/src/bsdf/albedo.rs, where the tables are explained.
#ifndef BSDF_ALBEDO_GLSL
#define BSDF_ALBEDO_GLSL

#include "fresnel.glsl"
#include "math.glsl"

const uint ALBEDO_N_ALPHA = 32;
const uint ALBEDO_N_MU = 32;
const uint ALBEDO_AVERAGES_PER_ROW = 4;
const uint ALBEDO_N_AVERAGE = ALBEDO_AVERAGES_PER_ROW * (ALBEDO_N_ALPHA - 1) + 1;
// √ALPHA_SMOOTH: the roughness of the first row.
const float FIRST_ROUGHNESS = 0.031622776;

// E and B at one cosine.
struct Directional {
    // 1 - E: what is lost at reflectance 1.
    float deficit;
    // B: what Schlick's grazing weight returns.
    float schlick;
};

// A perfectly smooth mirror.
Directional directional_smooth(float mu) {
    return Directional(0.0, schlick_weight(mu));
}

// Albedo of an interface with reflectance `f0` at normal and `f90` at grazing incidence.
float directional_reflected(Directional self_, float f0, float f90) {
    return f0 * (1.0 - self_.deficit - self_.schlick) + f90 * self_.schlick;
}

// 1 - `directional_reflected` as a sum of terms that are not negative for f0 <= f90 <= 1, so that nothing cancels.
float directional_passed(Directional self_, float f0, float f90) {
    return (1.0 - f90) + f90 * self_.deficit + (f90 - f0) * (1.0 - self_.deficit - self_.schlick);
}

// The tables at one width.
struct AlbedoRow {
    float alpha;
    float roughness;
    uint row;
    float frac;
};

// For a width from ALPHA_SMOOTH to 1.
AlbedoRow albedo_row_new(float alpha) {
    float roughness = sqrt(alpha);
    float p = (roughness - FIRST_ROUGHNESS) * (float(ALBEDO_N_ALPHA - 1) / (1.0 - FIRST_ROUGHNESS));
    uint row = min(uint(max(p, 0.0)), ALBEDO_N_ALPHA - 2);
    return AlbedoRow(alpha, roughness, row, clamp(p - float(row), 0.0, 1.0));
}

// Column of a cosine among `n` with warp `w`, and the fraction beyond it.
uint albedo_column(float mu, float w, uint n, out float t) {
    float s = sqrt(mu * (1.0 + w) / (mu + w));
    // The same as 1 - (1 - s) where s is near 1, which roots and quotients of a card may miss: there a table may fall to almost nothing
    // in its last column, and at normal incidence it is that column that counts.
    float rest = w * (1.0 - mu) / ((mu + w) * (1.0 + s));
    float last = float(n - 1);
    float p = clamp(s < 0.5 ? s * last : last - rest * last, 0.0, last);
    uint j = min(uint(p), n - 2);
    t = p - float(j);
    return j;
}

// 1 - E at `mu` in [0, 1].
float albedo_row_deficit(AlbedoRow self_, float mu) {
    float t;
    uint j = albedo_column(mu, self_.alpha, ALBEDO_N_MU, t);
    uint i = self_.row;
    float a = lerp(push.tables.albedo_deficit[i][j], push.tables.albedo_deficit[i][j + 1], t);
    float b = lerp(push.tables.albedo_deficit[i + 1][j], push.tables.albedo_deficit[i + 1][j + 1], t);
    return lerp(a, b, self_.frac);
}

float albedo_row_schlick_excess(AlbedoRow self_, float mu) {
    float t;
    uint j = albedo_column(mu, self_.roughness, ALBEDO_N_MU, t);
    uint i = self_.row;
    float a = lerp(push.tables.albedo_schlick_excess[i][j], push.tables.albedo_schlick_excess[i][j + 1], t);
    float b = lerp(push.tables.albedo_schlick_excess[i + 1][j], push.tables.albedo_schlick_excess[i + 1][j + 1], t);
    return lerp(a, b, self_.frac);
}

// Both at `mu` in [0, 1].
Directional albedo_row_directional(AlbedoRow self_, float mu) {
    float deficit = albedo_row_deficit(self_, mu);
    float excess = albedo_row_schlick_excess(self_, mu);
    return Directional(deficit, (1.0 - deficit) * max(schlick_weight(mu) + excess, 0.0));
}

// Both averaged over the hemisphere with the cosine.
Directional albedo_row_average(AlbedoRow self_) {
    float p = (float(self_.row) + self_.frac) * float(ALBEDO_AVERAGES_PER_ROW);
    uint k = min(uint(p), ALBEDO_N_AVERAGE - 2);
    float t = p - float(k);
    float deficit = lerp(push.tables.albedo_deficit_average[k], push.tables.albedo_deficit_average[k + 1], t);
    float schlick = lerp(push.tables.albedo_schlick_average[k], push.tables.albedo_schlick_average[k + 1], t);
    // Stored over α^1.5, which changes slowly from row to row.
    return Directional(deficit * self_.alpha * self_.roughness, schlick);
}

#endif
