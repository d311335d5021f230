// Textures. Twin: scene/src/compiled/texture.rs. All that is not alpha is read from images, where IMAGES is defined.
#extension GL_EXT_nonuniform_qualifier : require
#extension GL_EXT_samplerless_texture_functions : require
#ifndef SCENE_TEXTURE_GLSL
#define SCENE_TEXTURE_GLSL

#include "scene/layout.glsl"
#include "variants.glsl"
#include "math.glsl"

#ifdef IMAGES
layout(set = 0, binding = 1) uniform texture2D textures[];
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

// The four texels around a place, and how far it is from the first two of them.
struct Footprint {
    ivec2 low;
    ivec2 high;
    vec2 weight;
};

// Where a texture is read: bilinear between texel centres, v down.
Footprint texture_footprint(TextureTable t, vec2 uv) {
    ivec2 size = ivec2(t.width, t.height);
    vec2 at = vec2(texture_reduced(uv.x, t.wrap_s), texture_reduced(uv.y, t.wrap_t)) * vec2(size);
    at -= t.nearest == 1u ? 0.0 : 0.5;
    ivec2 low = ivec2(floor(at));
    Footprint f;
    f.weight = t.nearest == 1u ? vec2(0.0) : at - vec2(low);
    f.low = ivec2(texture_wrapped(low.x, size.x, t.wrap_s), texture_wrapped(low.y, size.y, t.wrap_t));
    f.high = ivec2(texture_wrapped(low.x + 1, size.x, t.wrap_s), texture_wrapped(low.y + 1, size.y, t.wrap_t));
    return f;
}

// Alpha of a texel.
float texture_alpha_texel(TextureTable t, ivec2 at) {
    return float(t.texels.at[at.y * int(t.width) + at.x] >> 24) * (1.0 / 255.0);
}

// Alpha of a texture, from texels in memory: it decides whether a ray finds a surface, so that every device must find the same.
float texture_alpha(TextureUse use, vec2 uv0, vec2 uv1) {
    TextureTable t = push.scene.textures.at[use.texture];
    Footprint f = texture_footprint(t, texture_uv(use, uv0, uv1));
    float top = lerp(texture_alpha_texel(t, f.low), texture_alpha_texel(t, ivec2(f.high.x, f.low.y)), f.weight.x);
    float bottom = lerp(texture_alpha_texel(t, ivec2(f.low.x, f.high.y)), texture_alpha_texel(t, f.high), f.weight.x);
    return lerp(top, bottom, f.weight.y);
}

#ifdef IMAGES
// A texel. Devices decode the sRGB curve with errors that tell their pictures apart (2e-3 on Mesa's CPU driver; on an H100 a quarter of all
// paths in a textured room differed): a table does it.
vec4 texture_texel(uint id, ivec2 at, bool srgb) {
    vec4 v = texelFetch(textures[nonuniformEXT(id)], at, 0);
    if (!srgb) {
        return v;
    }
    uvec3 code = uvec3(v.rgb * 255.0 + 0.5);
    return vec4(push.tables.srgb_decode[code.r], push.tables.srgb_decode[code.g], push.tables.srgb_decode[code.b], v.a);
}

// The value of a texture. Texels come from an image, which lies in memory as rays want it; the weights are ours, since devices
// filter with 8 bits of them, which would tell the devices' pictures apart.
vec4 texture_value(TextureUse use, vec2 uv0, vec2 uv1, bool srgb) {
    Footprint f = texture_footprint(push.scene.textures.at[use.texture], texture_uv(use, uv0, uv1));
    vec4 top = mix(texture_texel(use.texture, f.low, srgb), texture_texel(use.texture, ivec2(f.high.x, f.low.y), srgb), f.weight.x);
    vec4 bottom = mix(texture_texel(use.texture, ivec2(f.low.x, f.high.y), srgb), texture_texel(use.texture, f.high, srgb), f.weight.x);
    return mix(top, bottom, f.weight.y);
}

// The value of a texture that a record in memory names; white where there is none. A macro, so that the record is read only where
// there is one.
#define TEXTURE(use, it, srgb) \
    (HAS_TEXTURES && (use).texture != NONE ? texture_value(use, (it).uv0, (it).uv1, srgb) : vec4(1.0))
const bool SRGB = true;
const bool LINEAR = false;
#endif

#endif
