// A colour that tells things apart. Twin: `label` of core/src/color.rs.
#ifndef LABEL_GLSL
#define LABEL_GLSL

#include "hash.glsl"
#include "rgb.glsl"

Rgb label(uint number) {
    vec3 u = vec3(0.0);
    for (uint i = 0u; i < 3u; ++i) {
        u[i] = to_unit(hash_combine(hash_u32(number), i));
    }
    return 0.05 + 0.95 * u * u;
}

#endif
