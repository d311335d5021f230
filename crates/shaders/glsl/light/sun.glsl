// The sun: a disc of constant radiance, infinitely far away. Twin: core/src/light/sun.rs.
#ifndef LIGHT_SUN_GLSL
#define LIGHT_SUN_GLSL

#include "frame.glsl"
#include "rgb.glsl"
#include "warp.glsl"

// A distant disc.
struct SunDisc {
    // Unit direction to its centre.
    vec3 direction;
    // 1 - cos of its angular radius.
    float one_minus_cos;
    // Its radiance.
    Spectrum radiance;
};

// A uniform direction on the disc.
vec3 sun_sample(SunDisc self_, vec2 u) {
    return frame_to_world(frame_from_normal(self_.direction), uniform_cone(u, self_.one_minus_cos));
}

// True on the disc. 1 - cos as |wi - d|²/2, exact for the small angles that count here.
bool sun_contains(SunDisc self_, vec3 wi) {
    vec3 off = wi - self_.direction;
    return 0.5 * dot(off, off) <= self_.one_minus_cos;
}

// Density of sun_sample at `wi`, sr⁻¹; 0 off the disc.
float sun_pdf(SunDisc self_, vec3 wi) {
    return sun_contains(self_, wi) ? uniform_cone_pdf(self_.one_minus_cos) : 0.0;
}

#endif
