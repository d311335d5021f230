// What a ray finds that shows something to the camera, as Whitted's method has it: emitted light, lights, ambient light for all that no ray brings,
// and further rays along each delta lobe.
#ifndef HYBRID_SHOW_GLSL
#define HYBRID_SHOW_GLSL

#include "hybrid/soft_lights.glsl"
#include "bsdf/branches.glsl"

// Rays that carry less are not traced.
const float LEAST_BETA = 1.0 / 1024.0;

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
    ray_add(list, ray_new(interaction_leave(it, wi), wi, 0.0), RayKind(a.kind.depth + 1u, false, 0.0), beta, a.pixel, media);
}

// Light on the surface by its lobes that are no delta lobes. Returns what takes no ray.
Spectrum show_lit(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    bool first = a.kind.depth == 0u;
    // The penumbra of the sun counts where the camera sees it itself.
    bool soft_sun_here = SOFT_SHADOWS && HAS_SUN && first;
    Spectrum light = sharp_lights(list, a, it, surface, soft_sun_here);
    if (soft_sun_here) {
        soft_sun(list, a, it, surface, smp);
    }
    if (SOFT_SHADOWS && HAS_TRIANGLE_LIGHTS) {
        soft_lamp(list, a, it, surface, smp);
    }
    if (GLOBAL_ILLUMINATION) {
        soft_gather(list, a, it, surface, smp);
        return light;
    }
    Spectrum ambient = a.beta * frame_ambient() * bsdf_smooth_albedo(surface.bsdf);
    if (AMBIENT_OCCLUSION && first) {
        soft_ambient(list, a, it, surface, ambient, smp);
        return light;
    }
    return light + ambient;
}

// What the surface sends back along the ray by itself; asks for its shadow rays and for the rays that it scatters, in lists of this number.
Spectrum show_surface(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    uint flags = MATERIAL(it.material).flags;
    if (HAS_UNLIT && (flags & FLAG_UNLIT) != 0u) {
        return a.beta * surface.base_color;
    }
    Spectrum light = a.beta * surface_emission(it);
    if (a.kind.depth >= push.frame.depth) {
        return light;
    }
    vec3 wo = -a.ray.dir;
    if (bsdf_has_smooth_lobes(surface.bsdf)) {
        light += show_lit(list, a, it, surface, smp);
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
