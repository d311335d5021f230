// Cameras: from a place in the picture to a ray. Twins: core/src/camera.rs; of the layout shaders/src/camera.rs.
#ifndef CAMERA_GLSL
#define CAMERA_GLSL

#include "ray.glsl"
#include "warp.glsl"

// Values of CameraRecord.projection.
const uint PROJECTION_PERSPECTIVE = 0u;
const uint PROJECTION_ORTHOGRAPHIC = 1u;

// A camera with a thin lens (telecentric where rays are parallel), in world space.
struct CameraRecord {
    // Eye, metres.
    vec3 origin;
    // To the right of the picture, to its top and into the scene, unit.
    vec3 right;
    vec3 up;
    vec3 forward;
    // One of PROJECTION_...
    uint projection;
    // Half the height of the picture: at distance 1 where rays pass the eye, metres where they are parallel.
    float half_height;
    // Width over height of the picture.
    float aspect;
    // Radius of the lens, metres; 0 is a pinhole.
    float lens_radius;
    // Distance along `forward` that is sharp, metres.
    float focus_distance;
};

// Offset from the lens's centre, world space, uniform over its area.
vec3 camera_lens_point(CameraRecord self_, vec2 lens) {
    vec2 d = concentric_disk(lens);
    return (self_.right * d.x + self_.up * d.y) * self_.lens_radius;
}

// The ray through `film` (x to the right, y down, the picture is the unit square) for a point `lens` of the unit square, mapped to the
// lens with uniform density.
Ray camera_ray(CameraRecord self_, vec2 film, vec2 lens, float time) {
    float x = (2.0 * film.x - 1.0) * self_.half_height * self_.aspect;
    float y = (1.0 - 2.0 * film.y) * self_.half_height;
    // `through` has unit depth.
    vec3 start = self_.origin;
    vec3 through = self_.forward;
    if (self_.projection == PROJECTION_PERSPECTIVE) {
        through = self_.forward + self_.right * x + self_.up * y;
    } else {
        start = self_.origin + self_.right * x + self_.up * y;
    }
    if (self_.lens_radius <= 0.0) {
        return ray_new(start, normalize(through), time);
    }
    vec3 offset = camera_lens_point(self_, lens);
    return ray_new(start + offset, normalize(through - offset / self_.focus_distance), time);
}

#endif
