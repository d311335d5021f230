// Spot light: the square of a linear ramp in the cosine. Twin: core/src/light/spot.rs.
#ifndef LIGHT_SPOT_GLSL
#define LIGHT_SPOT_GLSL

#include "light/point.glsl"

// A cone of light.
struct Cone {
    // Unit axis, the way the light travels.
    vec3 axis;
    // Cosine of the angle at which the falloff begins.
    float cos_inner;
    // Cosine of the angle at which it ends.
    float cos_outer;
};

// Share of the intensity at a cosine from the axis, 0 to 1.
float cone_falloff(Cone self_, float cos_angle) {
    float ramp = (cos_angle - self_.cos_outer) / max(self_.cos_inner - self_.cos_outer, 0.001);
    ramp = clamp(ramp, 0.0, 1.0);
    return ramp * ramp;
}

// Irradiance at `p`; false outside the cone.
bool spot_sample(vec3 position, Spectrum intensity, Cone cone, vec3 p, out DeltaSample s) {
    if (!point_sample(position, intensity, p, s)) {
        return false;
    }
    float falloff = cone_falloff(cone, -dot(s.wi, cone.axis));
    s.irradiance *= falloff;
    return falloff > 0.0;
}

#endif
