// Homogeneous absorption and the small stack of media that a path is inside of. Twin: core/src/medium.rs.
//
// A path carries its stack through every ray, so it holds only what cannot be looked up: which solids, and their indices, which
// depend on the path's wavelength. What a solid absorbs is asked for where it is needed: who includes this file defines
// `medium_absorption`.
#ifndef MEDIUM_GLSL
#define MEDIUM_GLSL

#include "math.glsl"
#include "rgb.glsl"

// The material of empty space.
const uint VACUUM = 0xffffffffu;

// Absorption coefficient of the inside of a solid, 1/m. Never asked of VACUUM.
Spectrum medium_absorption(uint material);

// The inside of a transmissive solid, or empty space.
struct Medium {
    // Index of refraction.
    float ior;
    // Identity: the material that bounds it.
    uint material;
};

Medium medium_vacuum() {
    return Medium(1.0, VACUUM);
}

// Beer-Lambert transmittance over `distance` metres.
Spectrum medium_transmittance(Medium self_, float distance_) {
    if (self_.material == VACUUM) {
        return WHITE;
    }
    Spectrum a = medium_absorption(self_.material);
    if (is_black(a)) {
        return WHITE;
    }
    // A ray that leaves the scene inside an absorbing medium: 0 times infinity must not become NaN.
    return Spectrum(
        a.r == 0.0 ? 1.0 : exp(-a.r * distance_),
        a.g == 0.0 ? 1.0 : exp(-a.g * distance_),
        a.b == 0.0 ? 1.0 : exp(-a.b * distance_)
    );
}

// The media around a point: the innermost first, VACUUM from where there is none (the Rust twin holds them the other way round).
// Twin of its layout: shaders/src/medium.rs.
struct MediumStack {
    uvec4 material;
    vec4 ior;
};

MediumStack medium_stack_empty() {
    return MediumStack(uvec4(VACUUM), vec4(1.0));
}

// The innermost medium.
Medium medium_stack_current(MediumStack self_) {
    return Medium(self_.ior.x, self_.material.x);
}

// The media on both sides of the boundary of the solid `inside`, met on its front or its back: where the path is, and where it would be
// beyond. Both are read from the stack, so that indices of refraction telescope along a path also where solids overlap.
void medium_stack_sides(MediumStack self_, Medium inside, bool front, out Medium here, out Medium beyond) {
    here = medium_stack_current(self_);
    if (front) {
        beyond = inside;
    } else if (self_.material.x == inside.material) {
        here = inside;
        beyond = Medium(self_.ior.y, self_.material.y);
    } else if (any(equal(self_.material.yzw, uvec3(inside.material)))) {
        // Another medium lies further in, on both sides.
        beyond = here;
    } else {
        // The path began inside without knowing.
        beyond = here;
        here = inside;
    }
}

// Enters a solid; without effect where the stack is full.
void medium_stack_enter(inout MediumStack self_, Medium medium) {
    if (self_.material.w == VACUUM) {
        self_.material = uvec4(medium.material, self_.material.xyz);
        self_.ior = vec4(medium.ior, self_.ior.xyz);
    }
}

// Leaves the innermost solid of this material, if the path is inside one.
void medium_stack_leave(inout MediumStack self_, uint material) {
    bvec4 found = equal(self_.material, uvec4(material));
    // Those outside of it come one place further in.
    bool x = found.x;
    bool y = x || found.y;
    bool z = y || found.z;
    bool w = z || found.w;
    bvec4 moves = bvec4(x, y, z, w);
    self_.material = mix(self_.material, uvec4(self_.material.yzw, VACUUM), moves);
    self_.ior = mix(self_.ior, vec4(self_.ior.yzw, 1.0), moves);
}

// Crosses the boundary of the solid of `material`: from its front side into `beyond`, or out of it.
void medium_stack_cross(inout MediumStack self_, Medium beyond, uint material, bool front) {
    if (front) {
        medium_stack_enter(self_, beyond);
    } else {
        medium_stack_leave(self_, material);
    }
}

#endif
