// Maps from the unit square to directions and areas, with their densities. Twin: core/src/warp.rs.
#ifndef WARP_GLSL
#define WARP_GLSL

#include "math.glsl"

// Concentric map of the unit square to the unit disk, area preserving; density 1/pi. Shirley and Chiu 1997.
vec2 concentric_disk(vec2 u) {
    float x = 2.0 * u.x - 1.0;
    float y = 2.0 * u.y - 1.0;
    if (x == 0.0 && y == 0.0) {
        return vec2(0.0);
    }
    bool wide = abs(x) > abs(y);
    float r = wide ? x : y;
    float phi = wide ? PI / 4.0 * (y / x) : PI / 2.0 - PI / 4.0 * (x / y);
    float s, c;
    sin_cos(phi, s, c);
    return vec2(r * c, r * s);
}

// Cosine-weighted direction about +z by Malley's method: a point of the disk, lifted.
vec3 cosine_hemisphere(vec2 u) {
    vec2 d = concentric_disk(u);
    return vec3(d, safe_sqrt(1.0 - d.x * d.x - d.y * d.y));
}

// Density of cosine_hemisphere, sr^-1.
float cosine_hemisphere_pdf(float cos_theta) {
    return max(cos_theta, 0.0) * INV_PI;
}

// The direction of polar cosine `z` at `u` of a full turn.
vec3 turned(float z, float u) {
    // `precise`: near the poles the root would show whether the square was rounded.
    precise float r2 = 1.0 - z * z;
    float r = safe_sqrt(r2);
    float s, c;
    sin_cos(2.0 * PI * u, s, c);
    return vec3(r * c, r * s, z);
}

// Uniform direction about +z.
vec3 uniform_hemisphere(vec2 u) {
    return turned(1.0 - u.x, u.y);
}

// Density of uniform_hemisphere, sr^-1.
const float UNIFORM_HEMISPHERE_PDF = 0.5 * INV_PI;

// Uniform direction on the sphere.
vec3 uniform_sphere(vec2 u) {
    return turned(1.0 - 2.0 * u.x, u.y);
}

// Uniform direction in the cone of half-angle theta about +z, given 1 - cos theta (exact for small cones).
vec3 uniform_cone(vec2 u, float one_minus_cos_max) {
    // The disk's radius squared is uniform, so it stands in for u: concentric, so that stratification survives.
    vec2 d = concentric_disk(u);
    float r2 = d.x * d.x + d.y * d.y;
    float h = r2 * one_minus_cos_max; // 1 - cos
    float scale = safe_sqrt(one_minus_cos_max * (2.0 - h)); // sin / r
    return vec3(d.x * scale, d.y * scale, 1.0 - h);
}

// Density of uniform_cone, sr^-1.
float uniform_cone_pdf(float one_minus_cos_max) {
    return 0.5 * INV_PI / one_minus_cos_max;
}

// Barycentric coordinates (b1, b2) uniform over a triangle, with low distortion.
// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
vec2 uniform_triangle(vec2 u) {
    float b1, b2;
    if (u.y > u.x) {
        b1 = u.x * 0.5;
        b2 = u.y - b1;
    } else {
        b2 = u.y * 0.5;
        b1 = u.x - b2;
    }
    b1 = clamp(b1, 0.0, ONE_MINUS_EPSILON);
    b2 = clamp(b2, 0.0, 1.0 - b1);
    return vec2(b1, b2);
}

#endif
