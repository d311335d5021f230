// Directional light: parallel rays. Twin: core/src/light/directional.rs.
#ifndef LIGHT_DIRECTIONAL_GLSL
#define LIGHT_DIRECTIONAL_GLSL

#include "light/mod.glsl"

// The same everywhere: `irradiance` in lux on a surface that faces it, travelling along the unit vector `travel`.
DeltaSample directional_sample(vec3 travel, Spectrum irradiance) {
    return DeltaSample(-travel, INFINITY, irradiance);
}

#endif
