// Directional albedo of GGX reflection with one width or two. Twin: core/src/bsdf/aniso_albedo.rs, where the tables are explained.
#ifndef BSDF_ANISO_ALBEDO_GLSL
#define BSDF_ANISO_ALBEDO_GLSL

#include "math.glsl"
#include "microfacet.glsl"
#include "bsdf/albedo.glsl"

// Nodes: larger width, share of the smaller one, xz profile, yz profile.
const uint ANISO_SIZE[4] = uint[4](10, 6, 12, 12);
// Hemispherical averages for each step of the two widths, and in all.
const float ANISO_AVERAGES_PER_STEP = 4.0;
const uint ANISO_AVERAGES[2] = uint[2](37, 21);
// Unit of the stored integers.
const float ANISO_UNIT = 1e-4;

// The tables at one pair of widths.
struct AnisoRow {
    float alpha_x;
    float alpha_y;
    // Position among the larger widths, in steps of the table.
    float u;
    // Position among the smaller widths.
    float v;
};

// For widths from ALPHA_SMOOTH to 1, the larger one along x.
AnisoRow aniso_row_new(Ggx ggx) {
    float x = sqrt(ggx.alpha_x);
    float y = sqrt(ggx.alpha_y);
    float range = max(x - FIRST_ROUGHNESS, 0.0);
    float v = range > 1e-6 ? clamp((y - FIRST_ROUGHNESS) / range, 0.0, 1.0) : 1.0;
    float u = range * (float(ANISO_SIZE[0] - 1) / (1.0 - FIRST_ROUGHNESS));
    return AnisoRow(ggx.alpha_x, ggx.alpha_y, u, v * float(ANISO_SIZE[1] - 1));
}

// Cell of a position among `n` nodes, and the fraction beyond it.
uint aniso_cell(float p, uint n, out float t) {
    p = clamp(p, 0.0, float(n - 1));
    uint i = min(uint(p), n - 2);
    t = p - float(i);
    return i;
}

// Cosine of the angle that the projection of `w` onto a vertical plane makes with the normal; `tangent` is its part along the surface.
float aniso_profile(vec3 w, float tangent) {
    float len = sqrt(tangent * tangent + w.z * w.z);
    return len > 0.0 ? min(abs(w.z) / len, 1.0) : 1.0;
}

// One of the 16-bit integers of a table: 1 - E, or the residual of B/E.
float aniso_node(bool schlick, uint index) {
    uint word = schlick ? push.tables.aniso_schlick_residual[index >> 1] : push.tables.aniso_deficit[index >> 1];
    return float(bitfieldExtract(int(word), int(index & 1u) * 16, 16));
}

float aniso_lookup(AnisoRow self_, bool schlick, vec3 w, vec2 warp) {
    vec4 t;
    uvec4 at = uvec4(
        aniso_cell(self_.u, ANISO_SIZE[0], t.x),
        aniso_cell(self_.v, ANISO_SIZE[1], t.y),
        albedo_column(aniso_profile(w, w.x), warp.x, ANISO_SIZE[2], t.z),
        albedo_column(aniso_profile(w, w.y), warp.y, ANISO_SIZE[3], t.w)
    );
    float sum = 0.0;
    for (uint corner = 0; corner < 16; corner++) {
        uvec4 far = uvec4(corner, corner >> 1, corner >> 2, corner >> 3) & 1u;
        uvec4 node = at + far;
        uint index = ((node.x * ANISO_SIZE[1] + node.y) * ANISO_SIZE[2] + node.z) * ANISO_SIZE[3] + node.w;
        vec4 weight = mix(1.0 - t, t, vec4(far));
        sum += weight.x * weight.y * weight.z * weight.w * aniso_node(schlick, index);
    }
    return sum * ANISO_UNIT;
}

// 1 - E towards `w`, on either side.
float aniso_row_deficit(AnisoRow self_, vec3 w) {
    return clamp(aniso_lookup(self_, false, w, vec2(self_.alpha_x, self_.alpha_y)), 0.0, 1.0);
}

// Width of the profile in the vertical plane of `w`: α² = αx² cos²φ + αy² sin²φ.
float aniso_width_along(AnisoRow self_, vec3 w) {
    float r2 = w.x * w.x + w.y * w.y;
    if (r2 < 1e-12) {
        return self_.alpha_x;
    }
    float x = self_.alpha_x * w.x;
    float y = self_.alpha_y * w.y;
    return sqrt((x * x + y * y) / r2);
}

// Both towards `w`.
Directional aniso_row_directional(AnisoRow self_, vec3 w) {
    float deficit = aniso_row_deficit(self_, w);
    Directional along = albedo_row_directional(albedo_row_new(aniso_width_along(self_, w)), abs(w.z));
    float residual = aniso_lookup(self_, true, w, vec2(sqrt(self_.alpha_x), sqrt(self_.alpha_y)));
    float share = along.schlick / (1.0 - along.deficit) + residual;
    return Directional(deficit, (1.0 - deficit) * clamp(share, 0.0, 1.0));
}

// Both averaged over the hemisphere with the cosine.
Directional aniso_row_average(AnisoRow self_) {
    float s, t;
    uint i = aniso_cell(self_.u * ANISO_AVERAGES_PER_STEP, ANISO_AVERAGES[0], s);
    uint j = aniso_cell(self_.v * ANISO_AVERAGES_PER_STEP, ANISO_AVERAGES[1], t);
    float deficit_a = lerp(push.tables.aniso_deficit_average[i][j], push.tables.aniso_deficit_average[i][j + 1], t);
    float deficit_b = lerp(push.tables.aniso_deficit_average[i + 1][j], push.tables.aniso_deficit_average[i + 1][j + 1], t);
    float schlick_a = lerp(push.tables.aniso_schlick_average[i][j], push.tables.aniso_schlick_average[i][j + 1], t);
    float schlick_b = lerp(push.tables.aniso_schlick_average[i + 1][j], push.tables.aniso_schlick_average[i + 1][j + 1], t);
    // Stored over α^1.5, which changes slowly.
    float deficit = lerp(deficit_a, deficit_b, s) * self_.alpha_x * sqrt(self_.alpha_x);
    return Directional(deficit, lerp(schlick_a, schlick_b, s));
}

// The same for both kinds of surface, found anew from the widths (Rust: `Albedo`).

// 1 - E towards `w`, on either side.
float albedo_deficit(Ggx ggx, vec3 w) {
    if (ggx_is_anisotropic(ggx)) {
        return aniso_row_deficit(aniso_row_new(ggx), w);
    }
    return albedo_row_deficit(albedo_row_new(ggx.alpha_x), abs(w.z));
}

// E and B towards `w`, on either side.
Directional albedo_directional(Ggx ggx, vec3 w) {
    if (ggx_is_anisotropic(ggx)) {
        return aniso_row_directional(aniso_row_new(ggx), w);
    }
    return albedo_row_directional(albedo_row_new(ggx.alpha_x), abs(w.z));
}

// Both averaged over the hemisphere with the cosine.
Directional albedo_average(Ggx ggx) {
    if (ggx_is_anisotropic(ggx)) {
        return aniso_row_average(aniso_row_new(ggx));
    }
    return albedo_row_average(albedo_row_new(ggx.alpha_x));
}

#endif
