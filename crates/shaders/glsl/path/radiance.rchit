// The closest surface of a path's ray: says which, and leaves the rest to other passes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_ray_tracing : require

#include "path/push.glsl"
#include "path/hit.glsl"

layout(location = 0) rayPayloadInEXT HitPayload payload;
hitAttributeEXT vec2 barycentrics;

void main() {
    payload.geometry = gl_InstanceCustomIndexEXT + gl_GeometryIndexEXT;
    payload.primitive = gl_PrimitiveID;
    payload.b = barycentrics;
    payload.t = gl_HitTEXT;
}
