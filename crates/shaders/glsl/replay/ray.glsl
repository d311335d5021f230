// Rays in a list, and what they hit. Twin: shaders/src/replay.rs.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#ifndef REPLAY_RAY_GLSL
#define REPLAY_RAY_GLSL

// Values of ReplayRay.kind.
const uint KIND_PATH = 0u;
const uint KIND_CAMERA = 1u;
const uint KIND_SHADOW = 2u;
// A shadow ray that solids let pass straight.
const uint KIND_SHADOW_STRAIGHT = 3u;
// No ray: a place of a list that is left out.
const uint KIND_NONE = 4u;

struct ReplayRay {
    vec3 origin;
    float t_min;
    vec3 dir;
    float t_max;
    uint kind;
    // Which surfaces it finds that are there only in part: path/coverage.glsl.
    uint key;
};

// t is negative where nothing was hit, and 0 for a shadow ray that something stops; instance and triangle are those of the scene.
struct ReplayHit {
    float t;
    uint instance;
    uint triangle;
    vec2 b;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ReplayRays {
    ReplayRay at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ReplayHits {
    ReplayHit at[];
};

#endif
