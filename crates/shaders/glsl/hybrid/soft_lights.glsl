// Light of which each frame has a sample: the disc of the sun, lamps that have a size, light from the sky and from other surfaces. What comes of it is
// filtered.
#ifndef HYBRID_SOFT_LIGHTS_GLSL
#define HYBRID_SOFT_LIGHTS_GLSL

#include "hybrid/sharp_lights.glsl"
#include "mis.glsl"

// What the surface makes of a light sample, over its density, and the density with which scattering would have found it.
Spectrum soft_unshadowed(Surface surface, vec3 wo_local, LightSample light, out float pdf_bsdf) {
    pdf_bsdf = 0.0;
    vec3 wi_local = frame_to_local(surface.frame, light.wi);
    bool reflects = dot(light.wi, surface.ng) > 0.0;
    if (reflects != (wi_local.z > 0.0)) {
        return BLACK;
    }
    return bsdf_eval_pdf(surface.bsdf, wo_local, wi_local, TRANSPORT_RADIANCE, pdf_bsdf) * light.radiance / light.pdf;
}

// A point of the sun's disc.
void soft_sun(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    SunDisc sun = scene_sun();
    LightSample light;
    light.light = push.scene.sun.light;
    light.wi = sun_sample(sun, sampler_second_light_point(smp, a.kind.depth));
    light.radiance = sun.radiance;
    light.pdf = uniform_cone_pdf(sun.one_minus_cos);
    light.is_delta = false;
    light.on_surface = false;
    light.distance = INFINITY;
    float pdf_bsdf;
    Spectrum brings = a.beta * soft_unshadowed(surface, frame_to_local(surface.frame, -a.ray.dir), light, pdf_bsdf);
    if (!is_black(brings)) {
        light_add(list, a, it, surface, light, brings, CHANNEL_SOFT);
    }
}

// A point of a lamp. Those without a size have sharp shadows, and nothing is asked where one of them is drawn.
void soft_lamp(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    LightSample light;
    if (!sample_light(GROUP_NEAR, it.p, sampler_light_point(smp, a.kind.depth), smp, a.kind.depth, light) || light.is_delta) {
        return;
    }
    float pdf_bsdf;
    Spectrum brings = a.beta * soft_unshadowed(surface, frame_to_local(surface.frame, -a.ray.dir), light, pdf_bsdf);
    // Gathering rays find lamps, too.
    if (GLOBAL_ILLUMINATION) {
        brings *= power_heuristic(light.pdf, pdf_bsdf);
    }
    if (!is_black(brings)) {
        light_add(list, a, it, surface, light, brings, CHANNEL_SOFT);
    }
}

// Ambient light, where nothing near is in its way.
void soft_ambient(uint list, Arrived a, Interaction it, Surface surface, Spectrum ambient, Sampler smp) {
    vec3 wi = frame_to_world(surface.frame, cosine_hemisphere(sampler_direction(smp, a.kind.depth)));
    if (dot(wi, surface.ng) <= 0.0) {
        return;
    }
    Ray ray = Ray(interaction_leave(it, wi), wi, 0.0, push.frame.occlusion_reach, 0.0);
    shadow_add(list, ray, Asked(a.pixel, a.kind.depth, CHANNEL_SOFT), true, ambient, a.media);
}

// What mirrors and glass show of a surface is gathered for each frame where it is at least this share of what they show.
const float GATHERED_ALWAYS = 0.25;

// A ray that gathers light from the sky and from other surfaces: as a path would go on, along all lobes but the delta ones.
void soft_gather(uint list, Arrived a, Interaction it, Surface surface, Sampler smp) {
    float asked = min(max_component(a.beta) / GATHERED_ALWAYS, 1.0);
    if (asked < 1.0 && sampler_roulette(smp, a.kind.depth) >= asked) {
        return;
    }
    float lobe = sampler_lobe(smp, a.kind.depth);
    BsdfSample s;
    vec3 wo_local = frame_to_local(surface.frame, -a.ray.dir);
    bool scatters =
        bsdf_sample(surface.bsdf, wo_local, lobe, sampler_direction(smp, a.kind.depth), TRANSPORT_RADIANCE, s);
    if (!scatters || lobe_is_delta(s.lobe)) {
        return;
    }
    vec3 wi = normalize(frame_to_world(surface.frame, s.wi));
    bool transmits = lobe_is_transmission(s.lobe);
    Spectrum beta = a.beta * s.weight / asked;
    // Interpolated normals: directions on the wrong side of the triangle carry nothing.
    if ((dot(wi, surface.ng) > 0.0) == transmits || is_black(beta) || !(is_finite(wi) && is_finite(beta))) {
        return;
    }
    MediumStack media = a.media;
    if (surface.is_solid && transmits) {
        medium_stack_cross(media, surface.beyond, it.material, it.front);
    }
    RayKind kind = RayKind(a.kind.depth + 1u, true, s.pdf);
    ray_add(list, ray_new(interaction_leave(it, wi), wi, 0.0), kind, beta, a.pixel, media);
}

#endif
