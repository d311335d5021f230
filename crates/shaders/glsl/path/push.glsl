// What every shader of the path tracer is told. Twins of the layout: shaders/src/layout.rs (SceneTable), shaders/src/view.rs.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#ifndef PATH_PUSH_GLSL
#define PATH_PUSH_GLSL

#include "tables.glsl"
#include "scene/layout.glsl"
#include "camera.glsl"
#include "film.glsl"
#include "medium.glsl"

// Numbers of rays are spread over this many counters of each kind, so that threads do not wait for each other.
const uint RAY_COUNTERS = 4096u;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Counters {
    uint at[];
};

// The view, and where its film lies.
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ViewTable {
    // Sums of the film's pixels, row by row.
    FilmPixels film;
    // Samples that were not finite.
    NonFiniteList non_finite;
    // RAY_COUNTERS numbers of rays of paths, then as many of shadow rays.
    Counters rays;
    // Size of the picture, and the film's part of it, pixels.
    uvec2 picture;
    uvec2 origin;
    uvec2 size;
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
    CameraRecord camera;
    // The media around the camera.
    MediumStack media;
    uint unused;
};

layout(push_constant, scalar) uniform Push {
    Tables tables;
    SceneTable scene;
    ViewTable view;
    // Pixel of the film at launch index 0, 0.
    uvec2 first_pixel;
    // Samples to take of each pixel.
    uint first_sample;
    uint sample_count;
} push;

#define MATERIAL(id) push.scene.materials.at[id]

Spectrum medium_absorption(uint material) {
    return MATERIAL(material).absorption;
}

#endif
