// Soft light without the albedo of what the camera sees, so that textures stay sharp while it is filtered; and where two pixels show one surface.
#ifndef HYBRID_FILTER_SOFT_GLSL
#define HYBRID_FILTER_SOFT_GLSL

#include "hybrid/frame.glsl"
#include "hybrid/sums.glsl"

// Smallest albedo that light is divided by.
const float LEAST_ALBEDO = 0.02;

Spectrum plane_albedo(uint pixel) {
    return max(uintBitsToFloat(PLANE(PLANE_ALBEDO, pixel).xyz), LEAST_ALBEDO);
}

// This frame's sample.
Spectrum soft_sample(uint pixel) {
    Spectrum light = (sums_read(CHANNEL_SOFT, pixel) + sums_read(CHANNEL_GATHERED, pixel)) / plane_albedo(pixel);
    return is_finite(light) ? light : BLACK;
}

// What pixels are told apart by.
struct Guide {
    vec3 normal;
    float distance;
    vec3 position;
    // NONE: the sky.
    uint instance;
};

Guide guide_of(uvec4 normal, uvec4 position) {
    return Guide(uintBitsToFloat(normal.xyz), uintBitsToFloat(normal.w), uintBitsToFloat(position.xyz), position.w);
}

Guide guide_at(uint pixel) {
    return guide_of(PLANE(PLANE_NORMAL, pixel), PLANE(PLANE_POSITION, pixel));
}

// How far a point lies off the plane of a surface, over the width of so many pixels there.
float off_plane(Guide here, vec3 p, float pixels) {
    CameraRecord camera = push.view.camera;
    float scale = camera.projection == PROJECTION_PERSPECTIVE ? here.distance : 1.0;
    float width = 2.0 * camera.half_height * scale / float(push.view.picture.y);
    return abs(dot(here.normal, p - here.position)) / max(pixels * width, 1e-30);
}

#endif
