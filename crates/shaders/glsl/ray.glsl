// Rays, and how their origins leave a surface. Twin: core/src/ray.rs.
#ifndef RAY_GLSL
#define RAY_GLSL

#include "math.glsl"

#define INFINITY uintBitsToFloat(0x7f800000u)

// A ray segment in world space.
struct Ray {
    // Metres.
    vec3 origin;
    // Unit.
    vec3 dir;
    // Nearest and farthest distance that count.
    float t_min;
    float t_max;
    // Moment in the shutter interval, 0 to 1.
    float time;
};

// A ray without an end.
Ray ray_new(vec3 origin, vec3 dir, float time) {
    return Ray(origin, dir, 0.0, INFINITY, time);
}

// The point at distance `t`.
vec3 ray_at(Ray self_, float t) {
    return self_.origin + self_.dir * t;
}

// One coordinate a few units in the last place along `n`. Wächter and Binder 2019.
float offset_coordinate(float p, float n) {
    const float ORIGIN = 1.0 / 32.0;
    const float FLOAT_SCALE = 1.0 / 65536.0;
    const float INT_SCALE = 256.0;
    if (abs(p) < ORIGIN) {
        return p + FLOAT_SCALE * n;
    }
    int i = int(INT_SCALE * n);
    return intBitsToFloat(floatBitsToInt(p) + (p < 0.0 ? -i : i));
}

// Moves `p` off its surface to the side that `towards` points to: by a few units in the last place of `p`, so that the step fits
// every scale, and by a millionth of the triangle's size. `ng` is the geometric normal, `extent` the largest distance from `p` to a
// vertex of its triangle (along an axis is near enough), metres.
//
// Wächter and Binder 2019, "A Fast and Robust Method for Avoiding Self-Intersection"; the share of the extent is ours, for triangles
// much larger than their distance.
vec3 offset_ray_origin(vec3 p, vec3 ng, vec3 towards, float extent) {
    const float EXTENT_SCALE = 1.0 / 1048576.0;
    vec3 n = dot(ng, towards) < 0.0 ? -ng : ng;
    p = p + n * (extent * EXTENT_SCALE);
    return vec3(offset_coordinate(p.x, n.x), offset_coordinate(p.y, n.y), offset_coordinate(p.z, n.z));
}

#endif
