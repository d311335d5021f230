// Lists of rays: invocations of a subgroup reserve their places together.
#ifndef HYBRID_LISTS_GLSL
#define HYBRID_LISTS_GLSL

#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

#include "hybrid/frame.glsl"
#include "ray.glsl"
#include "medium.glsl"

// The first of `wanted` places of a list; heads may say more than there is room for, passes in between set that right (hybrid/advance.comp).
#define RESERVE(head, wanted, first)                                  \
    {                                                                 \
        uint before_ = subgroupExclusiveAdd(wanted);                  \
        uint all_ = subgroupAdd(wanted);                              \
        uint begin_ = 0u;                                             \
        if (subgroupElect()) {                                        \
            begin_ = atomicAdd(heads.head.count, all_);               \
        }                                                             \
        first = subgroupBroadcastFirst(begin_) + before_;             \
    }

// Adds a ray to a list.
void ray_add(uint list, Ray ray, RayKind kind, Spectrum beta, uint pixel, MediumStack media) {
    FrameHeads heads = push.frame.heads;
    uint at;
    RESERVE(rays[list], 1u, at)
    if (at >= push.frame.ray_capacity) {
        return;
    }
    FrameQuads rays = push.frame.rays;
    rays.at[ray_at_place(list, RAY_ORIGIN, at)] = uvec4(floatBitsToUint(ray.origin), 0u);
    rays.at[ray_at_place(list, RAY_DIRECTION, at)] = uvec4(floatBitsToUint(ray.dir), ray_kind_pack(kind));
    rays.at[ray_at_place(list, RAY_BETA, at)] = uvec4(floatBitsToUint(beta), pixel);
    if (HAS_SOLID) {
        rays.at[ray_at_place(list, RAY_MEDIA, at)] = media.material;
        rays.at[ray_at_place(list, RAY_MEDIA + 1u, at)] = floatBitsToUint(media.ior);
    }
}

// A shadow ray: who asks for it, and for which channel.
struct Asked {
    uint pixel;
    // Scattering events before the surface that asks.
    uint depth;
    uint channel;
};

// Adds a shadow ray to a list.
void shadow_add(uint list, Ray ray, Asked asked, bool solids_pass, Spectrum light, MediumStack media) {
    FrameHeads heads = push.frame.heads;
    uint at;
    RESERVE(shadows[list], 1u, at)
    if (at >= push.frame.shadow_capacity) {
        return;
    }
    FrameQuads shadows = push.frame.shadows;
    uint bits = asked.depth | (solids_pass ? SHADOW_PASSES : 0u) | (asked.channel << SHADOW_CHANNEL_SHIFT);
    shadows.at[shadow_at_place(list, SHADOW_ORIGIN, at)] = floatBitsToUint(vec4(ray.origin, ray.t_max));
    shadows.at[shadow_at_place(list, SHADOW_DIRECTION, at)] = uvec4(floatBitsToUint(ray.dir), bits);
    shadows.at[shadow_at_place(list, SHADOW_LIGHT, at)] = uvec4(floatBitsToUint(light), asked.pixel);
    if (HAS_SOLID) {
        shadows.at[shadow_at_place(list, SHADOW_MEDIA, at)] = media.material;
        shadows.at[shadow_at_place(list, SHADOW_MEDIA + 1u, at)] = floatBitsToUint(media.ior);
    }
}

#endif
