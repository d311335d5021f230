// What the passes of a hybrid frame share beside path/push.glsl: planes of what the camera sees, rays and shadow rays under way, sums of light.
// Twins of the layout: shaders/src/hybrid.rs.
//
// To be included first: it adds a member to the push constants of the path tracer, so that surfaces, lights and rays are its own.
#ifndef HYBRID_FRAME_GLSL
#define HYBRID_FRAME_GLSL

#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

#include "camera.glsl"

struct ListHead {
    // An indirect launch of one ray each: VkTraceRaysIndirectCommandKHR.
    uint count;
    uint one_row;
    uint one_layer;
    uint unused;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FrameHeads {
    // Rays: one list is read while the other is written.
    ListHead rays[2];
    // Shadow rays, likewise.
    ListHead shadows[2];
    // Those of them that meet what lets light through.
    ListHead glass[2];
    // An indirect dispatch of groups that shade: VkDispatchIndirectCommand.
    uint groups[3];
    // Rays traced in this frame: from surfaces, to lights, and those for which there was no room.
    uint traced_rays;
    uint traced_shadows;
    uint dropped;
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FrameQuads {
    uvec4 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FrameIds {
    uvec2 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer FrameSums {
    uint64_t at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FrameNumbers {
    uint at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer FrameFloats {
    vec4 at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer AmbientSums {
    // Light over albedo, quanta of 2^-24, and the pixels that it is of.
    uint64_t light[3];
    uint64_t pixels;
};

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FrameTable {
    // What the rasteriser saw of each pixel: geometry, primitive; NONE: nothing.
    FrameIds ids;
    // PLANE_QUADS times four words of each pixel.
    FrameQuads planes;
    // Two lists of `ray_capacity` rays: RAY_QUADS times four words each.
    FrameQuads rays;
    // Two lists of `shadow_capacity` shadow rays: SHADOW_QUADS times four words each.
    FrameQuads shadows;
    // Two lists of `shadow_capacity` numbers of shadow rays.
    FrameNumbers glass;
    FrameHeads heads;
    // Light of each pixel, three sums of quanta for each channel.
    FrameSums sums;
    // What gathering rays brought in the mean: sums of this frame and of the one before.
    AmbientSums measured[2];
    // Lights with sharp shadows.
    FrameNumbers sharp_lights;
    // Of each pixel of the frame before: PREVIOUS_QUADS times four words.
    FrameQuads previous_planes;
    // Soft light of each pixel, without albedo, and its variance: two that take turns, and what the next frame goes on from.
    FrameFloats soft[2];
    FrameFloats soft_history;
    // Its moments over frames: those of this frame and of the one before.
    FrameFloats moments[2];
    // The frame before anti-aliasing; then the picture, and that of the frame before.
    FrameFloats drawn;
    FrameFloats shown[2];
    // Transforms as they were in the frame before.
    uint64_t previous_transforms;
    uint sharp_light_count;
    uint ray_capacity;
    uint shadow_capacity;
    // Most rays one after another, the camera's not counted.
    uint depth;
    // Where in their pixels the camera looks, from the centre, pixels; and where it did in the frame before.
    vec2 jitter;
    vec2 previous_jitter;
    // For cameras whose rays are parallel: metres that are drawn.
    float far;
    // Nearest distance that is drawn, metres.
    float near;
    // Radiance that stands for what no ray brings, until it is measured.
    vec3 ambient;
    // Metres beyond which nothing occludes ambient light.
    float occlusion_reach;
    // The camera of the frame before.
    CameraRecord previous;
    // Size of the picture that is shown.
    uvec2 shown_size;
    // Which of two buffers that take turns between frames is this frame's.
    uint turn;
    // There was a frame before; and nothing has changed since.
    uint has_history;
    uint is_still;
    // The ambient light of the settings counts, whatever is measured.
    uint ambient_is_given;
    uint unused;
};

#define HYBRID
#include "path/push.glsl"
#include "path/hit.glsl"
#include "sampler.glsl"
#include "variants.glsl"
#include "bsdf/features.glsl"

// Planes of a pixel.
const uint PLANE_NORMAL = 0u; // shading normal, distance along the camera's ray
const uint PLANE_ALBEDO = 1u; // albedo; roughness and specularity as halves
const uint PLANE_POSITION = 2u; // position; instance, NONE for the sky
const uint PLANE_MOTION = 3u; // from here to where it was, pixels; how far from the camera it was then
const uint PLANE_EMISSION = 4u; // emitted radiance; material
const uint PLANE_SHARES = 5u; // shares mirrored and let through; index of refraction
const uint PLANE_QUADS = 6u;

// Planes that are kept for the next frame: PLANE_NORMAL, PLANE_POSITION.
const uint PREVIOUS_NORMAL = 0u;
const uint PREVIOUS_POSITION = 1u;
const uint PREVIOUS_QUADS = 2u;

// Light that is brought by the rays that it takes (sharp), and light of which each frame has a sample, to be filtered: straight from lamps and sun (soft),
// and from the sky and other surfaces (gathered).
const uint CHANNEL_SHARP = 0u;
const uint CHANNEL_SOFT = 1u;
const uint CHANNEL_GATHERED = 2u;
const uint CHANNELS = 3u;

// What frames have beside sharp shadows, mirrors and glass.
layout(constant_id = 70) const bool SOFT_SHADOWS = false;
layout(constant_id = 71) const bool GLOBAL_ILLUMINATION = false;
layout(constant_id = 72) const bool AMBIENT_OCCLUSION = false;

// Four words of a ray.
const uint RAY_ORIGIN = 0u; // origin; once traced the distance
const uint RAY_DIRECTION = 1u; // direction; RayKind
const uint RAY_BETA = 2u; // throughput; pixel
const uint RAY_HIT = 3u; // once traced geometry, primitive, barycentrics
const uint RAY_MEDIA = 4u; // two, where the scene has solids
const uint RAY_QUADS_PLAIN = 4u;
const uint RAY_QUADS = 6u;

// What a ray is for.
struct RayKind {
    // Scattering events so far.
    uint depth;
    // It gathers light for the soft channel; others show what lies along a delta lobe.
    bool gathers;
    // Density of its direction, sr⁻¹; 0 where light sampling could not have found what it meets.
    float pdf;
};

uint ray_kind_pack(RayKind kind) {
    return kind.depth | (kind.gathers ? 0x100u : 0u) | (packHalf2x16(vec2(0.0, min(kind.pdf, 65504.0))) & 0xffff0000u);
}

RayKind ray_kind_unpack(uint bits) {
    return RayKind(bits & 0xffu, (bits & 0x100u) != 0u, unpackHalf2x16(bits).y);
}

// Four words of a shadow ray.
const uint SHADOW_ORIGIN = 0u; // origin; length
const uint SHADOW_DIRECTION = 1u; // direction; depth, and SHADOW_PASSES
const uint SHADOW_LIGHT = 2u; // what it brings; pixel
const uint SHADOW_MEDIA = 3u; // two, where the scene has solids
const uint SHADOW_QUADS_PLAIN = 3u;
const uint SHADOW_QUADS = 5u;

// Solids let this light through straight.
const uint SHADOW_PASSES = 0x80000000u;
// The channel of its light.
const uint SHADOW_CHANNEL_SHIFT = 8u;
const uint SHADOW_DEPTH = 0xffu;

uint frame_pixels() {
    return push.view.size.x * push.view.size.y;
}

#define PLANE(place, pixel) push.frame.planes.at[(place) * frame_pixels() + (pixel)]

uint ray_at_place(uint list, uint place, uint index) {
    uint quads = HAS_SOLID ? RAY_QUADS : RAY_QUADS_PLAIN;
    return (list * quads + place) * push.frame.ray_capacity + index;
}

#define RAY(list, place, index) push.frame.rays.at[ray_at_place(list, place, index)]

uint shadow_at_place(uint list, uint place, uint index) {
    uint quads = HAS_SOLID ? SHADOW_QUADS : SHADOW_QUADS_PLAIN;
    return (list * quads + place) * push.frame.shadow_capacity + index;
}

#define SHADOW(list, place, index) push.frame.shadows.at[shadow_at_place(list, place, index)]

// The stream of random numbers of a pixel in this frame.
Sampler frame_sampler(uint pixel) {
    uvec2 at = uvec2(pixel % push.view.size.x, pixel / push.view.size.x);
    return sampler_new(push.view.seed, push.view.frame, push.view.origin + at, push.first_sample);
}

// Where the camera looks through a pixel, in the unit square.
vec2 frame_film(vec2 pixel) {
    return (vec2(push.view.origin) + pixel + 0.5 + push.frame.jitter) / vec2(push.view.picture);
}

// Ambient radiance: what gathering rays found in the mean in the frame before, so that light between surfaces bounces on over frames.
vec3 frame_ambient() {
    if (!GLOBAL_ILLUMINATION || push.frame.ambient_is_given != 0u) {
        return push.frame.ambient;
    }
    AmbientSums measured = push.frame.measured[1u - push.frame.turn];
    if (push.frame.has_history == 0u || measured.pixels == 0ul) {
        // The guess is of all light; what has bounced twice is a part of it.
        return 0.25 * push.frame.ambient;
    }
    vec3 sum = vec3(float(measured.light[0]), float(measured.light[1]), float(measured.light[2]));
    return sum * (1.0 / 16777216.0) / float(measured.pixels);
}

#endif
