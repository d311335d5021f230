// Indices of refraction. Twin: index_at of cpu/src/surface.rs.
#ifndef PATH_INDEX_GLSL
#define PATH_INDEX_GLSL

#include "path/push.glsl"
#include "wavelength.glsl"
#include "variants.glsl"

// The index of refraction of a solid at a wavelength.
float index_at(uint material, float nm) {
    float ior = MATERIAL(material).ior;
    if (!HAS_DISPERSION || (MATERIAL(material).flags & FLAG_DISPERSION) == 0u) {
        return ior;
    }
    return dispersed_index(ior, push.scene.lobes.at[MATERIAL(material).lobes].dispersion, nm);
}

#endif
