// The closest hit of a replayed ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "replay/push.glsl"
#include "path/hit.glsl"

layout(location = 0) rayPayloadInEXT HitPayload payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    payload.geometry = gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT;
    payload.primitive = gl_PrimitiveID;
    payload.b = barycentrics;
    payload.t = gl_HitTEXT;
}
