// Where the rasteriser draws a point: the inverse of camera_ray for a pinhole, with depth reversed (1 near, 0 far), which spends the digits of
// floats where distances need them.
#ifndef HYBRID_PROJECT_GLSL
#define HYBRID_PROJECT_GLSL

#include "hybrid/frame.glsl"

// In clip space; `jitter` from the centre of the pixel, pixels.
vec4 project(CameraRecord camera, vec3 p, vec2 jitter) {
    vec3 d = p - camera.origin;
    vec3 at = vec3(dot(camera.right, d), dot(camera.up, d), dot(camera.forward, d));
    vec2 scale = vec2(1.0, -1.0) / vec2(camera.half_height * camera.aspect, camera.half_height);
    bool perspective = camera.projection == PROJECTION_PERSPECTIVE;
    float w = perspective ? at.z : 1.0;
    vec2 xy = at.xy * scale - (2.0 * jitter / vec2(push.view.picture)) * w;
    return vec4(xy, perspective ? push.frame.near : 1.0 - at.z / push.frame.far, w);
}

#endif
