// Environment light: a latitude-longitude map, sampled in proportion to its radiance. Twin: core/src/light/environment.rs.
#ifndef LIGHT_ENVIRONMENT_GLSL
#define LIGHT_ENVIRONMENT_GLSL

#include "distribution.glsl"
#include "math.glsl"
#include "rgb.glsl"
#include "scene/layout.glsl"

// A map with the tables that sample it. Its centre lies at -z, row 0 at +y, +x a quarter of the width right of the centre.
struct EnvironmentLight {
    // Columns and rows.
    uint width;
    uint height;
    // Turns the map about +y: its content moves by this angle towards +x, radians.
    float rotation;
    // Radiance, row by row.
    Vectors pixels;
    // Distribution over rows: `height + 1` values from 0 to 1.
    Floats row_cdf;
    // Distribution within each row: `height` times `width + 1` values.
    Floats cell_cdf;
};

// Cosine of the polar angle at the top of a row.
float environment_cos(uint row, uint height) {
    if (2u * row == height) {
        return 0.0;
    }
    float s, c;
    sin_cos(PI * (float(row) / float(height)), s, c);
    return c;
}

// Map coordinates of a unit direction: u wraps in [0, 1), v in [0, 1].
vec2 environment_uv(EnvironmentLight self_, vec3 d) {
    // At the poles any azimuth will do, but not one that depends on the sign of a zero, which devices may lose.
    float azimuth = d.x == 0.0 && d.z == 0.0 ? 0.0 : atan2(d.x, -d.z);
    float u = 0.5 + (azimuth - self_.rotation) * (0.5 / PI);
    float v = atan2(safe_sqrt(d.x * d.x + d.z * d.z), d.y) / PI;
    return vec2(u - floor(u), v);
}

// A texel: rows end at the poles, columns wrap around. `i` is at most one step outside.
Rgb environment_texel(EnvironmentLight self_, int i, int j) {
    int w = int(self_.width);
    int row = clamp(j, 0, int(self_.height) - 1);
    int column = i < 0 ? i + w : i >= w ? i - w : i;
    return self_.pixels.at[row * w + column];
}

// Radiance from direction `d` (unit), bilinear.
Spectrum environment_radiance(EnvironmentLight self_, vec3 d) {
    if (self_.width * self_.height == 1u) {
        return self_.pixels.at[0];
    }
    vec2 uv = environment_uv(self_, d);
    float x = uv.x * float(self_.width) - 0.5;
    float y = uv.y * float(self_.height) - 0.5;
    float x0 = floor(x);
    float y0 = floor(y);
    int i = int(x0);
    int j = int(y0);
    Rgb a = environment_texel(self_, i, j);
    Rgb b = environment_texel(self_, i, j + 1);
    Rgb top = a + (environment_texel(self_, i + 1, j) - a) * (x - x0);
    Rgb bottom = b + (environment_texel(self_, i + 1, j + 1) - b) * (x - x0);
    return top + (bottom - top) * (y - y0);
}

// A direction and its density, sr⁻¹; false for a black map.
bool environment_sample(EnvironmentLight self_, vec2 u, out vec3 wi, out float pdf) {
    CdfSample row, cell;
    if (!sample_cdf(self_.row_cdf, 0u, self_.height, u.y, row)) {
        return false;
    }
    if (!sample_cdf(self_.cell_cdf, row.index * (self_.width + 1u), self_.width, u.x, cell)) {
        return false;
    }
    float top = environment_cos(row.index, self_.height);
    float bottom = environment_cos(row.index + 1u, self_.height);
    float y = lerp(top, bottom, row.remainder);
    float phi = ((float(cell.index) + cell.remainder) / float(self_.width) - 0.5) * (2.0 * PI) + self_.rotation;
    float s, c;
    sin_cos(phi, s, c);
    float r = safe_sqrt(1.0 - y * y);
    wi = vec3(r * s, y, -r * c);
    pdf = row.probability * cell.probability * float(self_.width) / (2.0 * PI * (top - bottom));
    return true;
}

// Density of environment_sample at `d`, sr⁻¹.
float environment_pdf(EnvironmentLight self_, vec3 d) {
    vec2 uv = environment_uv(self_, d);
    uint x = min(uint(uv.x * float(self_.width)), self_.width - 1u);
    uint y = min(uint(uv.y * float(self_.height)), self_.height - 1u);
    uint cells = y * (self_.width + 1u) + x;
    float top = environment_cos(y, self_.height);
    float bottom = environment_cos(y + 1u, self_.height);
    float probability = (self_.row_cdf.at[y + 1u] - self_.row_cdf.at[y])
        * (self_.cell_cdf.at[cells + 1u] - self_.cell_cdf.at[cells]);
    return probability * float(self_.width) / (2.0 * PI * (top - bottom));
}

#endif
