// What every shader of the path tracer is told. Twins of the layout: shaders/src/layout.rs (SceneTable), shaders/src/view.rs.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#ifndef PATH_PUSH_GLSL
#define PATH_PUSH_GLSL

#include "tables.glsl"
#include "scene/layout.glsl"
#include "camera.glsl"
#include "film.glsl"
#include "medium.glsl"

// Words as integers: moved as floats, those that are none could be taken for 0 or for another NaN on the way.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Quads {
    uvec4 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Queues {
    uint at[];
};

// A list of paths: its length, as an indirect launch of rays.
struct QueueHead {
    // An indirect launch of one ray each: VkTraceRaysIndirectCommandKHR.
    uint count;
    uint one_row;
    uint one_layer;
    uint unused;
};

// Lists of paths, by what is to be done with them next.
const uint QUEUE_PATHS = 0u; // and 1: one is read while the other is written
const uint QUEUE_SHADOW = 2u; // to 5: a list for each group of lights, for paths of either list
const uint QUEUE_GLASS = 6u; // to 9: those of them that meet what lets light through
const uint QUEUE_CATCHERS = 10u;
const uint QUEUES = 11u;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer QueueHeads {
    QueueHead at[QUEUES];
    // An indirect dispatch of groups that shade: VkDispatchIndirectCommand.
    uint groups[3];
    // Rays traced since the slice began: of paths, to lights.
    uint path_rays;
    uint shadow_rays;
};

// The view, where its film lies, and the memory in which paths are under way.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ViewTable {
    // Sums of the film's pixels, row by row.
    FilmPixels film;
    // Samples that were not finite.
    NonFiniteList non_finite;
    // State of the paths: path/state.glsl.
    Quads state;
    // QUEUES lists of `capacity` paths each, and their heads.
    Queues queues;
    QueueHeads heads;
    // Size of the picture, and the film's part of it, pixels.
    uvec2 picture;
    uvec2 origin;
    uvec2 size;
    // Paths that there is room for.
    uint capacity;
    uint seed;
    uint frame;
    // Most scattering events on a path.
    uint max_depth;
    // First event after which roulette may end a path; NONE: never.
    uint roulette;
    // Most that light which scattered twice or more may add to a sample at a time.
    float clamp_to;
    // One of FILTER_….
    uint filter_kind;
    // 1: the plane of albedo holds a colour for each object.
    uint object_colors;
    // Most scattering events at lobes that are not delta lobes before the last one.
    uint rough_bounces;
    CameraRecord camera;
    // The media around the camera.
    MediumStack media;
};

layout(push_constant, scalar) uniform Push {
    Tables tables;
    SceneTable scene;
    ViewTable view;
    // The slice: its first pixel in the film, its columns and rows.
    uvec2 first_pixel;
    uvec2 size;
    // Samples of each pixel.
    uint first_sample;
    uint sample_count;
    // Which of the two lists of paths is read.
    uint parity;
    // Which group of lights shadow rays go to.
    uint group;
#ifdef HYBRID
    FrameTable frame;
#endif
#ifdef COLLECTS
    // Where replay/collect.comp writes rays, and what they found.
    ReplayRays rays;
    ReplayHits hits;
#endif
} push;

// The list of shadow rays to a group of lights that steps of a parity have asked for.
uint queue_shadow(uint parity, uint group) {
    return QUEUE_SHADOW + 2u * parity + group;
}

// The list of those of them that go through glass.
uint queue_glass(uint parity, uint group) {
    return QUEUE_GLASS + 2u * parity + group;
}

#define MATERIAL(id) push.scene.materials.at[id]

Spectrum medium_absorption(uint material) {
    return MATERIAL(material).absorption;
}

#endif
