// Textures. Twin: scene/src/compiled/texture.rs for alpha, which decides whether a ray finds a surface; for all else, where IMAGES is
// defined, images that the device filters take its place.
#extension GL_EXT_nonuniform_qualifier : require
#ifndef SCENE_TEXTURE_GLSL
#define SCENE_TEXTURE_GLSL

#include "scene/layout.glsl"
#include "variants.glsl"
#include "math.glsl"

#ifdef IMAGES
layout(set = 0, binding = 1) uniform sampler2D textures_srgb[];
layout(set = 0, binding = 2) uniform sampler2D textures_linear[];
#endif

// The texel index for one that lies at most a texel outside the range that texture_reduced leaves.
int texture_wrapped(int i, int n, uint mode) {
    if (mode == WRAP_CLAMP_TO_EDGE) {
        return clamp(i, 0, n - 1);
    }
    int period = mode == WRAP_MIRRORED_REPEAT ? 2 * n : n;
    int m = i < 0 ? i + period : (i >= period ? i - period : i);
    return m < n ? m : 2 * n - 1 - m;
}

// A coordinate within one period of its wrap mode, so that large ones keep their fraction: [0, 1], or [0, 2] mirrored. What is not
// finite becomes 0.
float texture_reduced(float x, uint mode) {
    if (mode == WRAP_CLAMP_TO_EDGE) {
        x = clamp(x, -1.0, 2.0);
    } else if (mode == WRAP_MIRRORED_REPEAT) {
        x = x - 2.0 * floor(0.5 * x);
    } else {
        x = x - floor(x);
    }
    return isnan(x) || isinf(x) ? 0.0 : x;
}

vec2 texture_uv(TextureUse use, vec2 uv0, vec2 uv1) {
    vec3 uv = vec3(use.uv_set == 0u ? uv0 : uv1, 1.0);
    return vec2(dot(use.transform[0], uv), dot(use.transform[1], uv));
}

// Alpha of a texel.
float texture_alpha_texel(TextureTable t, int x, int y) {
    int at = texture_wrapped(y, int(t.height), t.wrap_t) * int(t.width) + texture_wrapped(x, int(t.width), t.wrap_s);
    return float(t.texels.at[at] >> 24) * (1.0 / 255.0);
}

// Alpha of a texture, bilinear between texel centres; v down. Filtered by hand, so that every device finds the same surfaces.
float texture_alpha(TextureUse use, vec2 uv0, vec2 uv1) {
    TextureTable t = push.scene.textures.at[use.texture];
    vec2 uv = texture_uv(use, uv0, uv1);
    float x = texture_reduced(uv.x, t.wrap_s) * float(t.width);
    float y = texture_reduced(uv.y, t.wrap_t) * float(t.height);
    if (t.nearest == 1u) {
        return texture_alpha_texel(t, int(floor(x)), int(floor(y)));
    }
    x -= 0.5;
    y -= 0.5;
    int i = int(floor(x));
    int j = int(floor(y));
    float fx = x - float(i);
    float fy = y - float(j);
    float top = lerp(texture_alpha_texel(t, i, j), texture_alpha_texel(t, i + 1, j), fx);
    float bottom = lerp(texture_alpha_texel(t, i, j + 1), texture_alpha_texel(t, i + 1, j + 1), fx);
    return lerp(top, bottom, fy);
}

#ifdef IMAGES
// The value of a texture, filtered by the device.
vec4 texture_value(TextureUse use, vec2 uv0, vec2 uv1, bool srgb) {
    vec2 uv = texture_uv(use, uv0, uv1);
    // Rays have no footprint: the finest level.
    return srgb ? textureLod(textures_srgb[nonuniformEXT(use.texture)], uv, 0.0)
                : textureLod(textures_linear[nonuniformEXT(use.texture)], uv, 0.0);
}

// The value of a texture that a record in memory names; white where there is none. A macro, so that the record is read only where
// there is one.
#define TEXTURE(use, it, srgb) \
    (HAS_TEXTURES && (use).texture != NONE ? texture_value(use, (it).uv0, (it).uv1, srgb) : vec4(1.0))
const bool SRGB = true;
const bool LINEAR = false;
#endif

#endif
