// What a gathering ray finds: light that the surface there sends back, of one light drawn by what each would bring.
#ifndef HYBRID_GATHERED_GLSL
#define HYBRID_GATHERED_GLSL

#include "bsdf/branches.glsl"
#include "hybrid/soft_lights.glsl"

// The sky; the sun is asked for by shadow rays.
Spectrum gathered_sky(Arrived a) {
    Spectrum beta = a.beta * medium_transmittance(medium_stack_current(a.media), INFINITY);
    return HAS_ENVIRONMENT ? beta * environment_radiance(scene_environment(), a.ray.dir) : BLACK;
}

// Weight of a lamp that the ray met, against light sampling.
float gathered_weight(Arrived a, Interaction it) {
    if (!SOFT_SHADOWS || a.kind.pdf <= 0.0) {
        return 1.0;
    }
    uint first_light = push.scene.instances.at[it.instance].first_light;
    uint first_rank = push.scene.meshes.at[it.mesh].first_emissive_rank;
    if (first_light == NONE || first_rank == NONE) {
        return 1.0;
    }
    uint rank = push.scene.emissive_ranks.at[first_rank + it.triangle];
    if (rank == NONE) {
        return 1.0;
    }
    return power_heuristic(a.kind.pdf, pdf_triangle(first_light + rank, a.ray.dir, it.t * it.t));
}

// One light, drawn of a light of each group by what they bring.
void gathered_light(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    vec3 wo_local = frame_to_local(surface.frame, -a.ray.dir);
    LightSample chosen;
    Spectrum brings = BLACK;
    float sum = 0.0;
    float u = sampler_light_roulette(smp, a.kind.depth);
    for (uint group = FIRST_GROUP; group < END_GROUP; ++group) {
        bool second = HAS_BOTH_GROUPS && group == GROUP_NEAR;
        vec2 point = second ? sampler_second_light_point(smp, a.kind.depth) : sampler_light_point(smp, a.kind.depth);
        LightSample light;
        if (!sample_light(group, it.p, point, smp, a.kind.depth, light)) {
            continue;
        }
        float pdf_bsdf;
        Spectrum unshadowed = soft_unshadowed(surface, wo_local, light, pdf_bsdf);
        float weight = average(unshadowed);
        if (weight <= 0.0) {
            continue;
        }
        sum += weight;
        // A reservoir of one.
        float prob = weight / sum;
        if (u < prob) {
            chosen = light;
            brings = unshadowed / weight;
            u /= prob;
        } else {
            u = (u - prob) / (1.0 - prob);
        }
    }
    brings *= a.beta * sum;
    if (!is_black(brings)) {
        light_add(list, a, it, surface, chosen, brings, CHANNEL_GATHERED);
    }
}

// Goes on along one of the delta lobes.
void gathered_branch(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    Branches b = bsdf_branches(surface.bsdf, frame_to_local(surface.frame, -a.ray.dir), TRANSPORT_RADIANCE);
    float mirrored = average(b.mirrored.weight + b.varnish.weight);
    float sum = mirrored + average(b.through.weight);
    if (sum <= 0.0) {
        return;
    }
    bool through = sampler_lobe(smp, a.kind.depth) * sum >= mirrored;
    Branch branch = through ? b.through : average(b.varnish.weight) > average(b.mirrored.weight) ? b.varnish : b.mirrored;
    float prob = (through ? sum - mirrored : mirrored) / sum;
    vec3 wi = normalize(frame_to_world(surface.frame, branch.wi));
    Spectrum beta = a.beta * branch.weight / prob;
    if ((dot(wi, surface.ng) > 0.0) == through || !(is_finite(wi) && is_finite(beta))) {
        return;
    }
    MediumStack media = a.media;
    if (through && b.refracted) {
        medium_stack_cross(media, surface.beyond, it.material, it.front);
    }
    ray_add(list, ray_new(interaction_leave(it, wi), wi, 0.0), RayKind(a.kind.depth + 1u, true, 0.0), beta, a.pixel, media);
}

// The surface: what it emits; asks for a shadow ray, and a ray where it is smooth.
Spectrum gathered_surface(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    uint flags = MATERIAL(it.material).flags;
    if (HAS_UNLIT && (flags & FLAG_UNLIT) != 0u) {
        return BLACK;
    }
    Spectrum light = a.beta * surface_emission(it);
    if (!is_black(light)) {
        light *= gathered_weight(a, it);
    }
    if (a.kind.depth >= push.frame.depth) {
        return light;
    }
    if (bsdf_has_smooth_lobes(surface.bsdf)) {
        gathered_light(list, a, it, surface, smp);
        light += a.beta * frame_ambient() * bsdf_smooth_albedo(surface.bsdf);
    }
    gathered_branch(list, a, it, surface, smp);
    return light;
}

#endif
