// The path tracer: radiance along a camera ray, by next-event estimation and scattering, joined by multiple importance sampling.
// Twin: cpu/src/path.rs, with the same named steps. Here they are passes over all paths under way (vulkan/src/path/passes.rs says why), so that
// one thing is done in another order, which changes no result: the BSDF is sampled before the shadow rays are traced.
#ifndef PATH_PATH_GLSL
#define PATH_PATH_GLSL

#include "path/shadow_ray.glsl"
#include "path/begin.glsl"
#include "path/state.glsl"
#include "mis.glsl"

// Largest probability of surviving roulette: a path without absorption ends some day too.
const float MAX_SURVIVAL = 0.95;
// Most shadow catchers that one path passes; a further one is met as the plain surface that it is.
const uint MOST_CATCHERS = 64u;
// A group whose light is below this share of both groups', shadows left out, is not asked for at every vertex.
const float FAINT = 0.05;
// But with this probability at least: an unshadowed share may mislead.
const float LEAST_ASKED = 0.1;

// Light that arrives at a surface if nothing is in its way.
struct Candidate {
    bool present;
    // It comes from the side that the surface reflects to.
    bool reflects;
    bool solids_pass;
    Ray line;
    // What the surface makes of it, over its density.
    Spectrum unshadowed;
    // Weight against scattering, unless it comes straight through a solid.
    float mis_weight;
};

Hue path_hue(Path path) {
    if (HAS_DISPERSION && path.wavelength > 0.0) {
        return Hue(HUE_ONE, path.wavelength, path.smp);
    }
    return Hue(HUE_ALL, 0.0, path.smp);
}

// Adds light met by the path itself.
void path_add(inout Path path, Spectrum radiance, float mis_weight) {
    path.radiance += path_clamped(path.beta * radiance * mis_weight, path.depth);
}

// Whether light met by scattering must be weighed against light sampling.
bool path_competes(Path path) {
    return LIGHT_SAMPLING && path.arrival_pdf >= 0.0;
}

// True when shadow rays have already brought this light straight through the solid that the path refracted through.
bool path_counted_by_straight_shadows(Path path, uint mode) {
    return LIGHT_SAMPLING && path.through_solid && TRANSMISSIVE_SHADOWS == mode;
}

// Adds sun and environment to a ray that left the scene.
void path_add_sky(inout Path path) {
    vec3 dir = path.ray.dir;
    path.beta *= medium_transmittance(medium_stack_current(path.media), INFINITY);
    if (path.straight) {
        // Its mean is right though a throughput may exceed 1 where a pane chose to transmit.
        path.alpha = 1.0 - luminance(path.beta);
        if (TRANSPARENT_BACKGROUND) {
            return;
        }
    }
    bool straight = path_counted_by_straight_shadows(path, SHADOWS_STRAIGHT);
    bool straight_sun = straight || path_counted_by_straight_shadows(path, SHADOWS_AUTO);
    if (HAS_SUN && !straight_sun && sun_contains(scene_sun(), dir)) {
        float weight = path_competes(path) ? power_heuristic(path.arrival_pdf, pdf_sun(dir)) : 1.0;
        path_add(path, push.scene.sun.radiance, weight);
    }
    if (HAS_ENVIRONMENT && !straight) {
        float weight = path_competes(path) ? power_heuristic(path.arrival_pdf, pdf_environment(dir)) : 1.0;
        path_add(path, environment_radiance(scene_environment(), dir), weight);
    }
}

// Adds the emission of a surface; true when the path ends there.
bool path_add_emission(inout Path path, Interaction it, Rgb base_color) {
    uint flags = MATERIAL(it.material).flags;
    if (HAS_UNLIT && (flags & FLAG_UNLIT) != 0u) {
        // It shows itself, directly and in mirrors and panes, and lights nothing.
        if (path.seen_by_camera) {
            path_add(path, base_color, 1.0);
        }
        return true;
    }
    Spectrum radiance = surface_emission(it);
    if (is_black(radiance) || path_counted_by_straight_shadows(path, SHADOWS_STRAIGHT)) {
        return false;
    }
    float weight = 1.0;
    if (path_competes(path)) {
        float pdf_light = 0.0;
        uint first_light = push.scene.instances.at[it.instance].first_light;
        uint first_rank = push.scene.meshes.at[it.mesh].first_emissive_rank;
        if (first_light != NONE && first_rank != NONE) {
            uint rank = push.scene.emissive_ranks.at[first_rank + it.triangle];
            if (rank != NONE) {
                vec3 to = it.p - path.arrival_p;
                pdf_light = pdf_triangle(first_light + rank, path.ray.dir, dot(to, to));
            }
        }
        weight = power_heuristic(path.arrival_pdf, pdf_light);
    }
    path_add(path, radiance, weight);
    return false;
}

// True when the surface is a shadow catcher seen straight from the camera.
bool path_meets_catcher(Path path, Interaction it) {
    return HAS_CATCHERS && path.straight && path.caught < MOST_CATCHERS
        && (MATERIAL(it.material).flags & FLAG_SHADOW_CATCHER) != 0u;
}

// A light sample with what the surface makes of it.
Candidate path_candidate(Path path, Interaction it, Surface surface, vec3 wo_local, uint group, vec2 point) {
    Candidate c;
    c.present = false;
    c.unshadowed = vec3(0.0);
    LightSample light;
    if (!sample_light(group, it.p, point, path.smp, path.depth, light)) {
        return c;
    }
    vec3 wi_local = frame_to_local(surface.frame, light.wi);
    // Reflection and transmission are told apart by the shading normal; the geometric one must agree.
    c.reflects = dot(light.wi, surface.ng) > 0.0;
    if (c.reflects != (wi_local.z > 0.0)) {
        return c;
    }
    float pdf_bsdf;
    Spectrum f = bsdf_eval_pdf(surface.bsdf, wo_local, wi_local, TRANSPORT_RADIANCE, pdf_bsdf);
    if (is_black(f)) {
        return c;
    }
    // Light that crosses here into a solid that disperses has the wavelength that the path would take.
    if (HAS_DISPERSION && !c.reflects && surface.takes == TAKES_CROSSING) {
        f *= surface.wavelength.weight;
    }
    c.present = true;
    c.unshadowed = f * light.radiance / light.pdf;
    c.mis_weight = light.is_delta ? 1.0 : power_heuristic(light.pdf, pdf_bsdf);
    c.solids_pass = HAS_TRANSMISSION && shadow_solids_pass(light);
    c.line = shadow_line(it, light);
    return c;
}

// Probability that the light of a candidate is asked for, where both groups have some.
float path_prob_asked(Spectrum unshadowed, float both) {
    float share = average(unshadowed) / (FAINT * both);
    return share < 1.0 ? max(share, LEAST_ASKED) : 1.0;
}

// Moves on along the sampled direction.
void path_step(inout Path path, Interaction it, Surface surface, BsdfSample s, vec3 wi) {
    bool transmits = lobe_is_transmission(s.lobe);
    if (HAS_DISPERSION && transmits && surface.takes == TAKES_CROSSING) {
        path_take(path, surface.wavelength);
    }
    path.straight = path.straight && s.lobe == LOBE_THIN_TRANSMISSION;
    path.beta *= s.weight;
    path.eta_scale *= s.eta_scale;
    path.depth += 1u;
    path.ray = ray_new(interaction_leave(it, wi), wi, path.ray.time);
    if (surface.is_solid && transmits) {
        medium_stack_cross(path.media, surface.beyond, it.material, it.front);
    }
    // Straight through a thin wall the direction did not change: to light sampling the last vertex still sees what comes.
    if (s.lobe == LOBE_THIN_TRANSMISSION) {
        return;
    }
    path.arrival_p = it.p;
    if (s.lobe == LOBE_SPECULAR_TRANSMISSION) {
        path.through_solid = path.through_solid || path.arrival_pdf >= 0.0;
        path.arrival_pdf = -1.0;
    } else if (s.lobe == LOBE_SPECULAR_REFLECTION) {
        path.through_solid = false;
        path.arrival_pdf = -1.0;
    } else {
        path.through_solid = false;
        path.arrival_pdf = s.pdf;
        path.seen_by_camera = false;
        path.rough += 1u;
    }
}

// Russian roulette on the throughput, without the scaling that refraction will undo.
bool path_survives(inout Path path) {
    if (path.depth < push.view.roulette) {
        return true;
    }
    float survival = min(max_component(path.beta) / path.eta_scale, MAX_SURVIVAL);
    // The event has been counted already.
    if (sampler_roulette(path.smp, path.depth - 1u) >= survival) {
        return false;
    }
    path.beta *= 1.0 / survival;
    return true;
}

// What a vertex leaves to be done.
struct Scattered {
    // The path goes on.
    bool alive;
    // It waits at a shadow catcher.
    bool waits;
    // Its shadow rays, if it has any.
    bool has_far;
    bool has_near;
    PendingLight far;
    PendingLight near;
};

// A candidate as a shadow ray. `media` and `wavelength` are those on the far side of the surface.
PendingLight path_pending(Path path, Candidate c, float prob, MediumStack media, float wavelength) {
    if (c.reflects) {
        media = path.media;
        wavelength = path.wavelength;
    }
    return PendingLight(c.line, path.beta * c.unshadowed, c.mis_weight, prob, c.solids_pass, media, wavelength);
}

// Next-event estimation, then the next direction.
Scattered path_scatter(inout Path path, Interaction it, Surface surface, vec3 wo) {
    vec3 wo_local = frame_to_local(surface.frame, wo);
    // Sample one light of each group.
    Candidate far;
    Candidate near;
    far.present = false;
    near.present = false;
    far.unshadowed = vec3(0.0);
    near.unshadowed = vec3(0.0);
    if (LIGHT_SAMPLING && path.rough <= push.view.rough_bounces && bsdf_has_smooth_lobes(surface.bsdf)) {
        // One call for both groups: each is compiled in full.
        for (uint group = FIRST_GROUP; group < END_GROUP; ++group) {
            bool second = HAS_BOTH_GROUPS && group == GROUP_NEAR;
            vec2 point = second ? sampler_second_light_point(path.smp, path.depth) : sampler_light_point(path.smp, path.depth);
            Candidate c = path_candidate(path, it, surface, wo_local, group, point);
            if (group == GROUP_NEAR) {
                near = c;
            } else {
                far = c;
            }
        }
    }
    // Both cannot be faint, so one number serves.
    float both = average(far.unshadowed) + average(near.unshadowed);
    float prob_far = HAS_BOTH_GROUPS ? path_prob_asked(far.unshadowed, both) : 1.0;
    float prob_near = HAS_BOTH_GROUPS ? path_prob_asked(near.unshadowed, both) : 1.0;
    float u = HAS_BOTH_GROUPS ? sampler_light_roulette(path.smp, path.depth) : 0.0;
    MediumStack beyond = path.media;
    float wavelength = path.wavelength;
    if (surface.is_solid) {
        medium_stack_cross(beyond, surface.beyond, it.material, it.front);
        if (HAS_DISPERSION && wavelength == 0.0 && surface.takes != TAKES_NONE) {
            wavelength = surface.wavelength.nm;
        }
    }
    Scattered result;
    result.has_far = HAS_FAR_LIGHTS && far.present && (prob_far >= 1.0 || u < prob_far);
    result.has_near = HAS_NEAR_LIGHTS && near.present && (prob_near >= 1.0 || u < prob_near);
    result.far = path_pending(path, far, prob_far, beyond, wavelength);
    result.near = path_pending(path, near, prob_near, beyond, wavelength);
    // Sample the BSDF.
    float lobe = bsdf_has_one_lobe(surface.bsdf) ? 0.0 : sampler_lobe(path.smp, path.depth);
    BsdfSample s;
    bool scatters =
        bsdf_sample(surface.bsdf, wo_local, lobe, sampler_direction(path.smp, path.depth), TRANSPORT_RADIANCE, s);
    result.alive = false;
    result.waits = false;
    if (!scatters || (!lobe_is_delta(s.lobe) && path.rough > push.view.rough_bounces)) {
        return result;
    }
    vec3 wi = normalize(frame_to_world(surface.frame, s.wi));
    // Interpolated normals: directions on the wrong side of the triangle carry nothing.
    if ((dot(wi, surface.ng) > 0.0) == lobe_is_transmission(s.lobe)) {
        return result;
    }
    path_step(path, it, surface, s, wi);
    // Play roulette.
    result.alive = !is_black(path.beta) && path_survives(path);
    if (result.alive && !(is_finite(wi) && is_finite(path.beta))) {
        // No ray can be traced with it; the film counts the sample as one that is not finite.
        path.radiance = vec3(uintBitsToFloat(0x7fc00000u));
        result.alive = false;
    }
    return result;
}

#endif
