// Lights with sharp shadows: point, spot and directional ones, and the sun as if it were a point of the sky, where its shadows are not soft.
#ifndef HYBRID_SHARP_LIGHTS_GLSL
#define HYBRID_SHARP_LIGHTS_GLSL

#include "hybrid/lists.glsl"
#include "path/shadow_ray.glsl"

// A ray that has been traced.
struct Arrived {
    uint pixel;
    RayKind kind;
    Ray ray;
    Spectrum beta;
    MediumStack media;
};

// Asks whether light arrives; `brings` if nothing is in the way.
void light_add(uint list, Arrived a, Interaction it, Surface surface, LightSample light, Spectrum brings, uint channel) {
    MediumStack beyond = a.media;
    if (surface.is_solid && dot(light.wi, surface.ng) < 0.0) {
        medium_stack_cross(beyond, surface.beyond, it.material, it.front);
    }
    bool passes = HAS_TRANSMISSION && shadow_solids_pass(light);
    shadow_add(list, shadow_line(it, light), Asked(a.pixel, a.kind.depth, channel), passes, brings, beyond);
}

// Shadow rays that one surface asks for: of more lights the strongest there have shadows.
const uint MOST_SHARP = 4u;

// The light's sample, as sample_light makes it for lights that cannot be hit.
bool sharp_light(uint id, vec3 p, out LightSample s) {
    LightRecord record = push.scene.lights.at[id];
    s.light = id;
    s.pdf = 1.0;
    s.is_delta = true;
    s.on_surface = false;
    s.distance = INFINITY;
    if (HAS_SUN && record.kind == LIGHT_SUN) {
        SunDisc sun = scene_sun();
        s.wi = sun.direction;
        s.radiance = sun.radiance * (2.0 * PI * sun.one_minus_cos);
        return true;
    }
    return HAS_PUNCTUAL_LIGHTS && sample_punctual(record.kind, record.index, p, s);
}

// What the surface makes of a light if nothing is in the way; black where that is nothing.
Spectrum sharp_unshadowed(Interaction it, Surface surface, vec3 wo_local, uint id, out LightSample light) {
    if (!sharp_light(id, it.p, light)) {
        return BLACK;
    }
    vec3 wi_local = frame_to_local(surface.frame, light.wi);
    bool reflects = dot(light.wi, surface.ng) > 0.0;
    if (reflects != (wi_local.z > 0.0)) {
        return BLACK;
    }
    return bsdf_eval(surface.bsdf, wo_local, wi_local, TRANSPORT_RADIANCE) * light.radiance;
}

// Asks for the shadows of the strongest lights, and returns the light of all others. `no_sun`: the sun is left out.
Spectrum sharp_lights(uint list, Arrived a, Interaction it, Surface surface, bool no_sun) {
    vec3 wo_local = frame_to_local(surface.frame, -a.ray.dir);
    Spectrum others = BLACK;
    Spectrum strongest[MOST_SHARP];
    uint ids[MOST_SHARP];
    for (uint k = 0u; k < MOST_SHARP; ++k) {
        strongest[k] = BLACK;
        ids[k] = NONE;
    }
    LightSample light;
    for (uint i = 0u; i < push.frame.sharp_light_count; ++i) {
        uint id = push.frame.sharp_lights.at[i];
        if (HAS_SUN && no_sun && id == push.scene.sun.light) {
            continue;
        }
        Spectrum brings = a.beta * sharp_unshadowed(it, surface, wo_local, id, light);
        // Each place takes the stronger of two; the weakest of all falls out at the end.
        for (uint k = 0u; k < MOST_SHARP; ++k) {
            if (average(brings) > average(strongest[k])) {
                Spectrum weaker = strongest[k];
                uint weaker_id = ids[k];
                strongest[k] = brings;
                ids[k] = id;
                brings = weaker;
                id = weaker_id;
            }
        }
        others += brings;
    }
    for (uint k = 0u; k < MOST_SHARP; ++k) {
        if (is_black(strongest[k]) || !sharp_light(ids[k], it.p, light)) {
            break;
        }
        light_add(list, a, it, surface, light, strongest[k], CHANNEL_SHARP);
    }
    return others;
}

#endif
