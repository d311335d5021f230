// Point light: the same intensity in every direction. Twin: core/src/light/point.rs.
#ifndef LIGHT_POINT_GLSL
#define LIGHT_POINT_GLSL

#include "light/mod.glsl"

// Irradiance `intensity / d²` at `p`; `intensity` in candela. False at the light itself.
bool point_sample(vec3 position, Spectrum intensity, vec3 p, out DeltaSample s) {
    vec3 to = position - p;
    float d2 = dot(to, to);
    if (!(d2 > 0.0 && is_finite(d2))) {
        return false;
    }
    float d = sqrt(d2);
    s = DeltaSample(to / d, d, intensity * (1.0 / d2));
    return true;
}

#endif
