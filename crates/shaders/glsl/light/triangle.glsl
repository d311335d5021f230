// Triangle light: one triangle of an emissive surface, in world space. Twin: core/src/light/triangle.rs.
#ifndef LIGHT_TRIANGLE_GLSL
#define LIGHT_TRIANGLE_GLSL

#include "rgb.glsl"
#include "warp.glsl"

// Geometry of an emissive triangle.
struct TriangleLight {
    // First vertex.
    vec3 p0;
    // Second and third vertex less the first.
    vec3 e1;
    vec3 e2;
};

// A point drawn on a triangle.
struct TriangleSample {
    // The point, world space.
    vec3 point;
    // Barycentric coordinates of the second and third vertex.
    vec2 barycentrics;
    // Unit direction from the shading point.
    vec3 wi;
    // Distance, metres.
    float distance;
    // Density, sr⁻¹.
    float pdf_solid_angle;
};

// Unit normal by winding times twice the area.
vec3 triangle_light_scaled_normal(TriangleLight self_) {
    return cross(self_.e1, self_.e2);
}

// Density of triangle_light_sample for a point of it seen in direction `wi` at squared distance `d2`: d² / (A |cos|), infinite edge-on.
float triangle_light_pdf_solid_angle(TriangleLight self_, vec3 wi, float d2) {
    // The scaled normal has length 2A, so its dot product is 2A cos.
    return 2.0 * d2 / abs(dot(triangle_light_scaled_normal(self_), wi));
}

// A uniform point of the triangle as seen from `p`; false where it is seen edge-on or touches `p`.
bool triangle_light_sample(TriangleLight self_, vec3 p, vec2 u, out TriangleSample s) {
    vec2 b = uniform_triangle(u);
    vec3 point = self_.p0 + self_.e1 * b.x + self_.e2 * b.y;
    vec3 to = point - p;
    float d2 = dot(to, to);
    float d = sqrt(d2);
    vec3 wi = to / d;
    float pdf = triangle_light_pdf_solid_angle(self_, wi, d2);
    s = TriangleSample(point, b, wi, d, pdf);
    return is_finite(pdf) && d > 0.0;
}

#endif
