// A replayed ray of a path that meets nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "replay/push.glsl"
#include "path/hit.glsl"

layout(location = 0) rayPayloadInEXT HitPayload payload;

void main() {
    payload.geometry = NONE;
}
