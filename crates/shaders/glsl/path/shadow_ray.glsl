// Lines to lights. Twin: cpu/src/shadow.rs (ShadowRay).
#ifndef PATH_SHADOW_RAY_GLSL
#define PATH_SHADOW_RAY_GLSL

#include "path/light_sampling.glsl"

// A straight line to a light.
struct ShadowRay {
    Ray ray;
    // The media in which it begins.
    MediumStack media;
    // The wavelength of the path, nm, if it has taken one (HUE_ONE), or HUE_STRAIGHT.
    Hue hue;
    // Thin walls it may pass before the path would be too long.
    uint wall_budget;
    // Solids let this light through straight.
    bool solids_pass;
};

// The hue of a shadow ray; 0 nm: all wavelengths.
Hue shadow_hue(float nm) {
    return Hue(HAS_DISPERSION && nm > 0.0 ? HUE_ONE : HUE_STRAIGHT, nm, Sampler(0u, 0u));
}

// The line from a surface to a light.
Ray shadow_line(Interaction it, LightSample light) {
    vec3 origin = interaction_leave(it, light.wi);
    if (!light.on_surface) {
        return Ray(origin, light.wi, 0.0, light.distance, 0.0);
    }
    // Both ends leave their surfaces towards each other, so neither is in the way.
    vec3 to = offset_ray_origin(light.point, light.ng, -light.wi, light.extent) - origin;
    float d = length(to);
    return Ray(origin, d > 0.0 ? to / d : light.wi, 0.0, d, 0.0);
}

// Whether solids let the light through straight.
bool shadow_solids_pass(LightSample light) {
    // The sun can be hit, but only by luck; behind glass its light is left to shadow rays like that of a point.
    bool to_delta_light = light.is_delta || light.light == push.scene.sun.light;
    return TRANSMISSIVE_SHADOWS == SHADOWS_AUTO ? to_delta_light : TRANSMISSIVE_SHADOWS == SHADOWS_STRAIGHT;
}

uint shadow_wall_budget(uint depth) {
    return push.view.max_depth > depth + 1u ? push.view.max_depth - (depth + 1u) : 0u;
}

#endif
