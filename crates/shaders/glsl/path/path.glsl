// The path tracer: radiance along a camera ray, by next-event estimation and scattering, joined by multiple importance sampling.
// Twin: cpu/src/path.rs, with the same named steps. One thing is done in another order, which changes no result: the BSDF is sampled before
// the shadow rays are traced, so that the surface need not be kept while they are under way.
#ifndef PATH_PATH_GLSL
#define PATH_PATH_GLSL

#include "path/catcher.glsl"
#include "film.glsl"
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

// A path under way.
struct Path {
    Sampler smp;
    Ray ray;
    Spectrum radiance;
    // Throughput.
    Spectrum beta;
    // Radiance scaling by refraction that is part of `beta`.
    float eta_scale;
    MediumStack media;
    // The wavelength that it has taken, nm; 0: none yet.
    float wavelength;
    // The last vertex that scattered (thin walls passed straight do not count).
    vec3 arrival_p;
    // Density of the direction there, sr⁻¹; negative where light sampling could not have found the light (camera, delta lobes).
    float arrival_pdf;
    // Since a vertex with a density, the path has done nothing but refract through smooth solids.
    bool through_solid;
    // So far it has only met delta lobes: what it finds is seen, not lit by.
    bool seen_by_camera;
    // So far it is a straight line from the camera.
    bool straight;
    // Shadow catchers that it has passed.
    uint caught;
    // Length of the rays up to the last of these, metres.
    float travelled;
    // How much the background is covered.
    float alpha;
    // Scattering events so far.
    uint depth;
};

Hue path_hue(Path path) {
    if (HAS_DISPERSION && path.wavelength > 0.0) {
        return Hue(HUE_ONE, path.wavelength, path.smp);
    }
    return Hue(HUE_ALL, 0.0, path.smp);
}

// The hue of a shadow ray.
Hue shadow_hue(Path path, float wavelength) {
    return Hue(HAS_DISPERSION && wavelength > 0.0 ? HUE_ONE : HUE_STRAIGHT, wavelength, path.smp);
}

// From here on the path carries one wavelength.
void path_take(inout Path path, Wavelength wavelength) {
    path.beta *= wavelength.weight;
    path.wavelength = wavelength.nm;
}

// Takes a wavelength at once where the camera stands in a medium that disperses.
void path_begin_inside(inout Path path) {
    path.media = push.view.media;
    bool disperses = false;
    for (uint i = 0u; HAS_DISPERSION && i < 4u; ++i) {
        uint material = push.view.media.material[i];
        disperses = disperses || (material != VACUUM && (MATERIAL(material).flags & FLAG_DISPERSION) != 0u);
    }
    if (HAS_DISPERSION && disperses) {
        Wavelength wavelength = wavelength_sample(sampler_wavelength(path.smp));
        path_take(path, wavelength);
        for (uint i = 0u; i < 4u; ++i) {
            uint material = path.media.material[i];
            path.media.ior[i] = material == VACUUM ? 1.0 : index_at(material, wavelength.nm);
        }
    }
}

// Light that scattered this many times on its way to the camera, within the bound that the settings set.
Spectrum path_clamped(Spectrum contribution, uint scattered) {
    if (!CLAMPED || scattered <= 1u) {
        return contribution;
    }
    float largest = max_component(contribution);
    float most = push.view.clamp_to;
    return largest > most ? contribution * (most / largest) : contribution;
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

// True when the surface is a shadow catcher seen straight from the camera: the path has then moved on behind it.
bool path_passes_catcher(inout Path path, Interaction it) {
    if (!path.straight || (MATERIAL(it.material).flags & FLAG_SHADOW_CATCHER) == 0u || path.caught == MOST_CATCHERS) {
        return false;
    }
    Catcher catcher = Catcher(it, path.caught, path.depth);
    path.beta *= catcher_share(catcher, path.smp, path.media, shadow_hue(path, path.wavelength));
    path.caught += 1u;
    path.travelled += it.t;
    path.ray = ray_new(interaction_leave(it, path.ray.dir), path.ray.dir, path.ray.time);
    return true;
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

// Adds what arrives of a light sample that is asked for with probability `prob`. `media` and `wavelength` are those on the far side of
// the surface.
void path_add_light(inout Path path, Candidate c, float prob, MediumStack media, float wavelength) {
    if (c.reflects) {
        media = path.media;
        wavelength = path.wavelength;
    }
    ShadowRay shadow =
        ShadowRay(c.line, media, shadow_hue(path, wavelength), shadow_wall_budget(path.depth), c.solids_pass);
    bool through_solid;
    uint key = coverage_key_shadow(sampler_coverage_key(path.smp), path.depth);
    Spectrum transmittance = shadow_transmittance(shadow, key, through_solid);
    // Scattered rays do not find light that comes straight through a solid, or leave it out.
    float mis_weight = through_solid ? 1.0 : c.mis_weight;
    Spectrum contribution = path.beta * c.unshadowed * transmittance * mis_weight;
    path.radiance += path_clamped(contribution, path.depth + 1u) * (1.0 / prob);
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

// Next-event estimation, then the next direction; false when the path ends.
bool path_scatter(inout Path path, Interaction it, Surface surface, vec3 wo) {
    vec3 wo_local = frame_to_local(surface.frame, wo);
    // Sample one light of each group.
    Candidate far;
    Candidate near;
    far.present = false;
    near.present = false;
    far.unshadowed = vec3(0.0);
    near.unshadowed = vec3(0.0);
    if (LIGHT_SAMPLING && bsdf_has_smooth_lobes(surface.bsdf)) {
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
    // Sample the BSDF.
    float lobe = bsdf_has_one_lobe(surface.bsdf) ? 0.0 : sampler_lobe(path.smp, path.depth);
    BsdfSample s;
    bool scatters =
        bsdf_sample(surface.bsdf, wo_local, lobe, sampler_direction(path.smp, path.depth), TRANSPORT_RADIANCE, s);
    vec3 wi = normalize(frame_to_world(surface.frame, s.wi));
    // Trace the shadow rays.
    MediumStack beyond = path.media;
    float wavelength = path.wavelength;
    if (surface.is_solid) {
        medium_stack_cross(beyond, surface.beyond, it.material, it.front);
        if (HAS_DISPERSION && wavelength == 0.0 && surface.takes != TAKES_NONE) {
            wavelength = surface.wavelength.nm;
        }
    }
    float both = average(far.unshadowed) + average(near.unshadowed);
    for (uint group = FIRST_GROUP; group < END_GROUP; ++group) {
        Candidate c = far;
        if (group == GROUP_NEAR) {
            c = near;
        }
        float prob = HAS_BOTH_GROUPS ? path_prob_asked(c.unshadowed, both) : 1.0;
        // Both cannot be faint, so one number serves.
        if (c.present && (prob >= 1.0 || sampler_light_roulette(path.smp, path.depth) < prob)) {
            path_add_light(path, c, prob, beyond, wavelength);
        }
    }
    // Interpolated normals: directions on the wrong side of the triangle carry nothing.
    if (!scatters || (dot(wi, surface.ng) > 0.0) == lobe_is_transmission(s.lobe)) {
        return false;
    }
    path_step(path, it, surface, s, wi);
    // Play roulette.
    return !is_black(path.beta) && path_survives(path);
}

Path path_new(Ray ray, Sampler smp) {
    Path path;
    path.smp = smp;
    path.ray = ray;
    path.radiance = vec3(0.0);
    path.beta = vec3(1.0);
    path.eta_scale = 1.0;
    path.media = medium_stack_empty();
    path.wavelength = 0.0;
    path.arrival_p = ray.origin;
    path.arrival_pdf = -1.0;
    path.through_solid = false;
    path.seen_by_camera = true;
    path.straight = true;
    path.caught = 0u;
    path.travelled = 0.0;
    path.alpha = 1.0;
    path.depth = 0u;
    return path;
}

// Radiance along a camera ray.
FilmSample path_radiance(Ray ray, Sampler smp) {
    Path path = path_new(ray, smp);
    if (HAS_SOLID) {
        path_begin_inside(path);
    }
    FilmSample result;
    result.has_hit = false;
    result.albedo = vec3(0.0);
    result.normal = vec3(0.0);
    result.position = vec3(0.0);
    result.depth = 0.0;
    while (true) {
        // Find the closest surface.
        Hit hit;
        uint key = coverage_key_path(sampler_coverage_key(path.smp), path.depth);
        if (!tracer_closest_hit(path.ray, key, path.depth == 0u, hit)) {
            path_add_sky(path);
            break;
        }
        Interaction it = interaction_new(path.ray, hit);
        // Absorb on the way to it.
        path.beta *= medium_transmittance(medium_stack_current(path.media), it.t);
        // A catcher shows the camera what lies behind it.
        if (HAS_CATCHERS && path_passes_catcher(path, it)) {
            if (is_black(path.beta)) {
                break;
            }
            continue;
        }
        // Build the surface.
        vec3 wo = -path.ray.dir;
        Surface surface = surface_new(it, wo, path.media, path_hue(path));
        if (HAS_DISPERSION && surface.takes == TAKES_ON_ARRIVAL) {
            path_take(path, surface.wavelength);
        }
        if (path.depth == 0u) {
            result.has_hit = true;
            result.albedo = bsdf_albedo(surface.bsdf);
            result.normal = surface.frame.n;
            result.position = it.p;
            result.depth = path.travelled + it.t;
        }
        // Add what it emits.
        if (path_add_emission(path, it, surface.base_color) || path.depth >= push.view.max_depth) {
            break;
        }
        if (!path_scatter(path, it, surface, wo)) {
            break;
        }
    }
    result.radiance = path.radiance;
    result.alpha = path.alpha;
    return result;
}

#endif
