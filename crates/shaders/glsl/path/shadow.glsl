// Shadow rays: how much light passes between two points in a straight line. Twin: cpu/src/shadow.rs.
#ifndef PATH_SHADOW_GLSL
#define PATH_SHADOW_GLSL

#include "path/shadow_ray.glsl"
#include "path/tracer.glsl"

// Most transmissive surfaces that one shadow ray passes.
const uint MOST_SURFACES = 64u;

// Follows the ray from one transmissive surface to the next. Black when something stands in between.
Spectrum shadow_pass_through(ShadowRay shadow, uint key, out bool through_solid) {
    Ray ray = shadow.ray;
    MediumStack media = shadow.media;
    uint walls = shadow.wall_budget;
    Spectrum factor = vec3(1.0);
    through_solid = false;
    for (uint i = 0u; i < MOST_SURFACES; ++i) {
        Hit hit;
        if (!tracer_closest_hit(ray, key, hit)) {
            return factor * medium_transmittance(medium_stack_current(media), ray.t_max - ray.t_min);
        }
        Interaction it = interaction_new(ray, hit);
        Surface surface = surface_new(it, -ray.dir, media, shadow.hue);
        factor *= medium_transmittance(medium_stack_current(media), hit.t - ray.t_min);
        vec3 wo = frame_to_local(surface.frame, -ray.dir);
        if (surface.is_solid) {
            through_solid = true;
            factor *= bsdf_straight_transmittance(surface.bsdf, wo);
            medium_stack_cross(media, surface.beyond, it.material, it.front);
        } else if (walls == 0u) {
            return vec3(0.0);
        } else {
            factor *= bsdf_thin_transmittance(surface.bsdf, wo);
            walls -= 1u;
        }
        if (is_black(factor)) {
            return vec3(0.0);
        }
        ray.t_min = hit.t;
    }
    return vec3(0.0);
}

// How much of the light arrives. `through_solid`: it came straight through the surface of a solid, so that paths which refract
// through it leave this light out.
Spectrum shadow_transmittance(ShadowRay shadow, uint key, out bool through_solid) {
    through_solid = false;
    uint state = tracer_shadow(shadow.ray, key, shadow.solids_pass);
    if ((state & SHADOW_BLOCKED) != 0u) {
        return vec3(0.0);
    }
    if (HAS_TRANSMISSION && (state & SHADOW_MEETS_TRANSMISSIVE) != 0u) {
        return shadow_pass_through(shadow, key, through_solid);
    }
    return medium_transmittance(medium_stack_current(shadow.media), shadow.ray.t_max);
}

#endif
