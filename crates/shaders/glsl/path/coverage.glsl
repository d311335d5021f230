// Stochastic coverage: whether a ray finds a surface that is there only in part.
// Twins: cpu/src/tracer.rs (CoverageKey), cpu/src/surface.rs (base_color, coverage).
#ifndef PATH_COVERAGE_GLSL
#define PATH_COVERAGE_GLSL

#include "path/hit.glsl"
#include "scene/texture.glsl"

// Key of the path's ray that leaves vertex `vertex` (0: the camera).
uint coverage_key_path(uint stream, uint vertex) {
    return hash_combine(stream, 2u * vertex);
}

// Key of the shadow ray from vertex `vertex`.
uint coverage_key_shadow(uint stream, uint vertex) {
    return hash_combine(stream, 2u * vertex + 1u);
}

// Key of the shadow ray from the shadow catcher seen from vertex `vertex` after `passed` others.
uint coverage_key_catcher(uint stream, uint vertex, uint passed) {
    return hash_combine(hash_combine(stream, 2u * vertex + 1u), passed + 1u);
}

// Alpha: factor × texture × vertex colour.
float surface_alpha(uint material, HitAttributes at) {
    float texel = 1.0;
    if (HAS_TEXTURES && MATERIAL(material).base_color_texture.texture != NONE) {
        texel = texture_alpha(MATERIAL(material).base_color_texture, at.uv0, at.uv1);
    }
    return clamp(MATERIAL(material).alpha * texel * at.color.a, 0.0, 1.0);
}

// Probability that the surface is there, by its alpha mode.
float surface_coverage(uint material, HitAttributes at) {
    float alpha = surface_alpha(material, at);
    if ((MATERIAL(material).flags & FLAG_ALPHA_MASK) != 0u) {
        return alpha >= MATERIAL(material).alpha_cutoff ? 1.0 : 0.0;
    }
    return alpha;
}

// True when the ray of `key` finds the surface there.
bool covered_at(uint instance, uint triangle, uint material, HitAttributes at, uint key) {
    return to_unit(hash_combine(hash_combine(key, instance), triangle)) < surface_coverage(material, at);
}

bool covered(Hit hit, uint material, uint key) {
    if (!HAS_COVERED || (MATERIAL(material).flags & (FLAG_ALPHA_MASK | FLAG_ALPHA_BLEND)) == 0u) {
        return true;
    }
    return covered_at(hit.instance, hit.triangle, material, hit_attributes(hit), key);
}

#endif
