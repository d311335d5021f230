// What lights have in common. Twin: core/src/light/mod.rs.
#ifndef LIGHT_MOD_GLSL
#define LIGHT_MOD_GLSL

#include "ray.glsl"
#include "rgb.glsl"

// Light that arrives at a point from a light that no ray can hit.
struct DeltaSample {
    // Unit direction towards the light.
    vec3 wi;
    // Distance to it, metres; infinite for directional light.
    float distance;
    // Irradiance on a surface that faces it, without occlusion.
    Spectrum irradiance;
};

#endif
