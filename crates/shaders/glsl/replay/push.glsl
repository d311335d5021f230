// What the shaders that replay rays are told. Twin: shaders/src/replay.rs.
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#ifndef REPLAY_PUSH_GLSL
#define REPLAY_PUSH_GLSL

#include "tables.glsl"
#include "scene/layout.glsl"
#include "replay/ray.glsl"

layout(push_constant, scalar) uniform Push {
    Tables tables;
    SceneTable scene;
    ReplayRays rays;
    ReplayHits hits;
    uint count;
    uint unused;
} push;

#define MATERIAL(id) push.scene.materials.at[id]

#endif
