// What the shaders that replay rays are told. Twin: shaders/src/replay.rs.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#ifndef REPLAY_PUSH_GLSL
#define REPLAY_PUSH_GLSL

#include "tables.glsl"
#include "scene/layout.glsl"

// Values of ReplayRay.kind.
const uint KIND_PATH = 0u;
const uint KIND_CAMERA = 1u;
const uint KIND_SHADOW = 2u;

struct ReplayRay {
    vec3 origin;
    float t_min;
    vec3 dir;
    float t_max;
    uint kind;
};

// t is negative where nothing was hit, and 0 for a shadow ray that something stops; instance and triangle are those of the scene.
struct ReplayHit {
    float t;
    uint instance;
    uint triangle;
    vec2 b;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer ReplayRays {
    ReplayRay at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer ReplayHits {
    ReplayHit at[];
};

layout(push_constant, scalar) uniform Push {
    Tables tables;
    SceneTable scene;
    ReplayRays rays;
    ReplayHits hits;
    uint count;
    uint unused;
} push;

#endif
