// Orthonormal frames: the local space of a BSDF has the shading normal at +z. Twin: core/src/frame.rs.
#ifndef FRAME_GLSL
#define FRAME_GLSL

#include "math.glsl"

// Three orthonormal axes, right-handed: t x b = n.
struct Frame {
    vec3 t;
    vec3 b;
    vec3 n;
};

// A frame around a unit normal, continuous except across n.z = 0.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3.
Frame frame_from_normal(vec3 n) {
    float sign_ = copysign(1.0, n.z);
    float a = -1.0 / (sign_ + n.z);
    float b = n.x * n.y * a;
    return Frame(
        vec3(1.0 + sign_ * n.x * n.x * a, sign_ * b, -sign_ * n.x),
        vec3(b, sign_ + n.y * n.y * a, -n.y),
        n
    );
}

// A frame around a unit normal whose tangent leans towards `tangent`; falls back to frame_from_normal where `tangent` is zero or
// parallel to `n`.
Frame frame_from_normal_tangent(vec3 n, vec3 tangent) {
    vec3 t = tangent - n * dot(n, tangent);
    float len2 = dot(t, t);
    // So written that NaN falls back too.
    if (!(len2 > 1e-12 * dot(tangent, tangent))) {
        return frame_from_normal(n);
    }
    t = t / sqrt(len2);
    return Frame(t, cross(n, t), n);
}

// World to local.
vec3 frame_to_local(Frame self_, vec3 v) {
    return vec3(dot(v, self_.t), dot(v, self_.b), dot(v, self_.n));
}

// Local to world.
vec3 frame_to_world(Frame self_, vec3 v) {
    return self_.t * v.x + self_.b * v.y + self_.n * v.z;
}

#endif
