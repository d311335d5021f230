// Next-event estimation: choose a light of a group, mostly by power, a point on it, and know the density with which scattered rays would
// have been matched against it. Twin: cpu/src/light_sampling.rs.
#ifndef PATH_LIGHT_SAMPLING_GLSL
#define PATH_LIGHT_SAMPLING_GLSL

#include "path/surface.glsl"
#include "path/coverage.glsl"
#include "distribution.glsl"
#include "light/directional.glsl"
#include "light/environment.glsl"
#include "light/point.glsl"
#include "light/spot.glsl"
#include "light/sun.glsl"
#include "light/triangle.glsl"

// Groups of lights, in the order in which a vertex asks them; those that the scene has are FIRST_GROUP up to END_GROUP.
const uint GROUP_FAR = 0u;
const uint GROUP_NEAR = 1u;
const uint FIRST_GROUP = HAS_FAR_LIGHTS ? GROUP_FAR : GROUP_NEAR;
const uint END_GROUP = HAS_NEAR_LIGHTS ? 2u : 1u;
const bool HAS_BOTH_GROUPS = HAS_NEAR_LIGHTS && HAS_FAR_LIGHTS;

// Light that may arrive at a point.
struct LightSample {
    uint light;
    // Unit direction to it.
    vec3 wi;
    // Radiance; for lights that cannot be hit, irradiance on a surface that faces them.
    Spectrum radiance;
    // Probability of the light in its group times, for lights that can be hit, the density of wi in sr⁻¹.
    float pdf;
    // It cannot be hit: no density, no competing technique.
    bool is_delta;
    // It lies on a surface: `point` with the normal `ng` and the bound `extent`; otherwise the shadow ray ends at `distance`.
    bool on_surface;
    float distance;
    vec3 point;
    vec3 ng;
    float extent;
};

// Below this probability a light leaves too few digits of the number that chose it for a point on it.
const float FEW_DIGITS = 1.0 / 4096.0;

SunDisc scene_sun() {
    return SunDisc(push.scene.sun.direction, push.scene.sun.one_minus_cos, push.scene.sun.radiance);
}

EnvironmentLight scene_environment() {
    return EnvironmentLight(
        push.scene.environment.width, push.scene.environment.height, push.scene.environment.rotation,
        push.scene.environment_pixels, push.scene.environment_row_cdf, push.scene.environment_cell_cdf);
}

// Probability that the light sampler picks this light among those of its group.
float prob_light(uint light) {
    uint near = push.scene.near_lights;
    if (light < near) {
        return push.scene.near_light_cdf.at[light + 1u] - push.scene.near_light_cdf.at[light];
    }
    uint at = light - near;
    return push.scene.far_light_cdf.at[at + 1u] - push.scene.far_light_cdf.at[at];
}

// What a triangle light emits at a point of it that has a texture or coverage.
Spectrum textured_emission(TriangleLightRecord record, uint mesh, uint material, vec2 b) {
    Hit hit = Hit(0.0, record.instance, mesh, record.triangle, b);
    HitAttributes at = hit_attributes(hit);
    Spectrum factor = TEXTURE(MATERIAL(material).emissive_texture, at, SRGB).rgb;
    // Where the surface is there only in part, a scattered ray finds it only in part.
    if ((MATERIAL(material).flags & (FLAG_ALPHA_MASK | FLAG_ALPHA_BLEND)) != 0u) {
        factor *= surface_coverage(material, at);
    }
    return factor;
}

bool sample_triangle(uint index, vec3 p, vec2 u, inout LightSample s) {
    TriangleLightRecord record = push.scene.triangle_lights.at[index];
    TriangleLight geometry = TriangleLight(record.p0, record.e1, record.e2);
    TriangleSample t;
    if (!triangle_light_sample(geometry, p, u, t)) {
        return false;
    }
    vec3 n = triangle_light_scaled_normal(geometry);
    // Light leaves on the side of the normal when it travels along it, against wi.
    if (record.side * dot(n, t.wi) > 0.0) {
        return false;
    }
    s.radiance = record.radiance;
    uint mesh = push.scene.instances.at[record.instance].mesh;
    uint material = push.scene.meshes.at[mesh].triangle_materials.at[record.triangle];
    if (record.textured == 1u || (MATERIAL(material).flags & (FLAG_ALPHA_MASK | FLAG_ALPHA_BLEND)) != 0u) {
        s.radiance *= textured_emission(record, mesh, material, t.barycentrics);
    }
    vec3 a = abs(record.e1);
    vec3 b = abs(record.e2);
    s.wi = t.wi;
    s.pdf *= t.pdf_solid_angle;
    s.on_surface = true;
    s.point = t.point;
    s.ng = normalize_or(n, -t.wi);
    s.extent = max(max(a.x, a.y), a.z) + max(max(b.x, b.y), b.z);
    return !is_black(s.radiance);
}

bool sample_punctual(uint kind, uint index, vec3 p, inout LightSample s) {
    PunctualRecord light = push.scene.punctual_lights.at[index];
    DeltaSample d;
    bool found = true;
    if (kind == LIGHT_POINT) {
        found = point_sample(light.position, light.intensity, p, d);
    } else if (kind == LIGHT_SPOT) {
        found = spot_sample(light.position, light.intensity, Cone(light.axis, light.cos_inner, light.cos_outer), p, d);
    } else {
        d = directional_sample(light.axis, light.intensity);
    }
    s.wi = d.wi;
    s.radiance = d.irradiance;
    s.distance = d.distance;
    s.is_delta = true;
    return found;
}

// Draws a light of a group and a point on it, as seen from p. The first number of `point` chooses the light, and what is left of it the
// point: so a lamp of many triangles is stratified as a whole. For a light of small probability `smp` gives that coordinate anew.
bool sample_light(uint group, vec3 p, vec2 point, Sampler smp, uint vertex, out LightSample s) {
    bool near = group == GROUP_NEAR;
    uint first = near ? 0u : push.scene.near_lights;
    uint count = near ? push.scene.near_lights : push.scene.far_lights;
    Floats cdf = push.scene.far_light_cdf;
    if (near) {
        cdf = push.scene.near_light_cdf;
    }
    CdfSample choice;
    if (!sample_cdf(cdf, 0u, count, point.x, choice)) {
        return false;
    }
    vec2 u = vec2(choice.probability < FEW_DIGITS ? sampler_light(smp, vertex) : choice.remainder, point.y);
    s.light = first + choice.index;
    s.pdf = choice.probability;
    s.is_delta = false;
    s.on_surface = false;
    s.distance = INFINITY;
    LightRecord record = push.scene.lights.at[s.light];
    if (HAS_TRIANGLE_LIGHTS && record.kind == LIGHT_TRIANGLE) {
        return sample_triangle(record.index, p, u, s);
    }
    if (HAS_SUN && record.kind == LIGHT_SUN) {
        SunDisc sun = scene_sun();
        s.wi = sun_sample(sun, u);
        s.pdf *= uniform_cone_pdf(sun.one_minus_cos);
        s.radiance = sun.radiance;
        return true;
    }
    if (HAS_ENVIRONMENT && record.kind == LIGHT_ENVIRONMENT) {
        EnvironmentLight environment = scene_environment();
        float pdf;
        if (!environment_sample(environment, u, s.wi, pdf)) {
            return false;
        }
        s.pdf *= pdf;
        s.radiance = environment_radiance(environment, s.wi);
        return true;
    }
    return HAS_PUNCTUAL_LIGHTS && sample_punctual(record.kind, record.index, p, s);
}

// Density, sr⁻¹, with which sample_light from p would have drawn the direction wi to a triangle light hit at squared distance d2.
float pdf_triangle(uint light, vec3 wi, float d2) {
    TriangleLightRecord record = push.scene.triangle_lights.at[push.scene.lights.at[light].index];
    return prob_light(light) * triangle_light_pdf_solid_angle(TriangleLight(record.p0, record.e1, record.e2), wi, d2);
}

// The same for the sun.
float pdf_sun(vec3 wi) {
    return prob_light(push.scene.sun.light) * sun_pdf(scene_sun(), wi);
}

// The same for the environment.
float pdf_environment(vec3 wi) {
    return prob_light(push.scene.environment.light) * environment_pdf(scene_environment(), wi);
}

#endif
