// A replayed shadow ray that nothing stops.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "replay/push.glsl"
#include "path/hit.glsl"

layout(location = 1) rayPayloadInEXT ShadowPayload payload;

void main() {
    payload.state &= ~SHADOW_BLOCKED;
}
