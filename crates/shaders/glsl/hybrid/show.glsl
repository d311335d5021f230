// What a ray finds, as Whitted's method shows it: emitted light, lights with sharp shadows, ambient light for all that no ray brings, and
// further rays along each delta lobe.
#ifndef HYBRID_SHOW_GLSL
#define HYBRID_SHOW_GLSL

#include "hybrid/sharp_lights.glsl"
#include "bsdf/branches.glsl"

// Rays that carry less are not traced.
const float LEAST_BETA = 1.0 / 1024.0;

// A ray that has been traced.
struct Arrived {
    uint pixel;
    // Scattering events so far.
    uint depth;
    Ray ray;
    Spectrum beta;
    MediumStack media;
};

// Dispersed colours would need a ray each: all bands take the index of the d line.
const Hue ONE_INDEX = Hue(HUE_STRAIGHT, 0.0, Sampler(0u, 0u));

// Sky and sun, where a ray leaves the scene.
Spectrum show_sky(Arrived a) {
    Spectrum light = BLACK;
    Spectrum beta = a.beta * medium_transmittance(medium_stack_current(a.media), INFINITY);
    if (HAS_SUN && sun_contains(scene_sun(), a.ray.dir)) {
        light += push.scene.sun.radiance;
    }
    if (HAS_ENVIRONMENT) {
        light += environment_radiance(scene_environment(), a.ray.dir);
    }
    return beta * light;
}

// A ray along a delta lobe.
void show_branch(uint list, Arrived a, Interaction it, Surface surface, Branch branch, bool through, bool refracted) {
    Spectrum beta = a.beta * branch.weight;
    if (max_component(beta) < LEAST_BETA) {
        return;
    }
    vec3 wi = normalize(frame_to_world(surface.frame, branch.wi));
    // Interpolated normals: directions on the wrong side of the triangle carry nothing.
    if ((dot(wi, surface.ng) > 0.0) == through || !(is_finite(wi) && is_finite(beta))) {
        return;
    }
    MediumStack media = a.media;
    if (refracted) {
        medium_stack_cross(media, surface.beyond, it.material, it.front);
    }
    ray_add(list, ray_new(interaction_leave(it, wi), wi, 0.0), a.depth + 1u, beta, a.pixel, media);
}

// What the surface sends back along the ray by itself; asks for its shadow rays and for the rays that it scatters, in lists of this number.
Spectrum show_surface(uint list, Arrived a, Interaction it, Surface surface) {
    uint flags = MATERIAL(it.material).flags;
    if (HAS_UNLIT && (flags & FLAG_UNLIT) != 0u) {
        return a.beta * surface.base_color;
    }
    Spectrum light = a.beta * surface_emission(it);
    if (a.depth >= push.frame.depth) {
        return light;
    }
    vec3 wo = -a.ray.dir;
    if (bsdf_has_smooth_lobes(surface.bsdf)) {
        light += sharp_lights(list, it, surface, wo, a.depth, a.beta, a.pixel, a.media);
        light += a.beta * push.frame.ambient * bsdf_smooth_albedo(surface.bsdf);
    }
    Branches b = bsdf_branches(surface.bsdf, frame_to_local(surface.frame, wo), TRANSPORT_RADIANCE);
    show_branch(list, a, it, surface, b.mirrored, false, false);
    show_branch(list, a, it, surface, b.through, true, b.refracted);
    if (HAS_COAT) {
        show_branch(list, a, it, surface, b.varnish, false, false);
    }
    return light;
}

#endif
