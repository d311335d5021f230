// Rays against the scene. Twin: cpu/src/tracer.rs; back faces that camera rays do not see are culled by the structure, which holds
// for each instance whether it culls.
#extension GL_EXT_ray_tracing : require
#ifndef PATH_TRACER_GLSL
#define PATH_TRACER_GLSL

#include "path/coverage.glsl"
#include "path/interaction.glsl"
#include "variants.glsl"

layout(set = 0, binding = 0) uniform accelerationStructureEXT tlas;
layout(location = 0) rayPayloadEXT HitPayload hit_payload;
layout(location = 1) rayPayloadEXT ShadowPayload shadow_payload;

// Shadow rays traced so far.
uint shadow_rays = 0u;

// The closest surface that a path's ray finds, in `hit_payload`; camera rays do not find the back faces of single-sided opaque materials.
void tracer_trace(Ray ray, uint key, bool camera) {
    hit_payload.geometry = key;
    uint flags = camera && !SHADE_BACK_FACES ? gl_RayFlagsCullBackFacingTrianglesEXT : gl_RayFlagsNoneEXT;
    traceRayEXT(tlas, flags, 0xff, RAY_RADIANCE, 0, RAY_RADIANCE, ray.origin, ray.t_min, ray.dir, ray.t_max, 0);
}

// The closest surface that a ray finds; false: none.
bool tracer_closest_hit(Ray ray, uint key, out Hit hit) {
    tracer_trace(ray, key, false);
    if (hit_payload.geometry == NONE) {
        return false;
    }
    hit = hit_of(hit_payload.geometry, hit_payload.primitive, hit_payload.b, hit_payload.t);
    return true;
}

// Whether something stops the light along a ray, and whether it meets what lets light through: bits of ShadowPayload.state.
uint tracer_shadow(Ray ray, uint key, bool solids_pass) {
    shadow_rays += 1u;
    shadow_payload.key = key;
    shadow_payload.state = SHADOW_BLOCKED | (solids_pass ? SHADOW_SOLIDS_PASS : 0u);
    uint flags = gl_RayFlagsTerminateOnFirstHitEXT | gl_RayFlagsSkipClosestHitShaderEXT;
    traceRayEXT(tlas, flags, 0xff, RAY_SHADOW, 0, RAY_SHADOW, ray.origin, ray.t_min, ray.dir, ray.t_max, 1);
    return shadow_payload.state;
}

#endif
