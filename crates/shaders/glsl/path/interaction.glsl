// Where a ray met a surface, in world space. Twin: cpu/src/interaction.rs.
#ifndef PATH_INTERACTION_GLSL
#define PATH_INTERACTION_GLSL

#include "path/hit.glsl"
#include "ray.glsl"

// A point of a surface.
struct Interaction {
    // The point, from its barycentric coordinates.
    vec3 p;
    // Bound of the distance to the vertices of its triangle, metres.
    float extent;
    // Unit geometric normal on the front side.
    vec3 ng;
    // Unit interpolated normal, on the same side as ng.
    vec3 ns;
    // Interpolated tangent, not normalised; zero if there is none.
    vec3 tangent;
    float bitangent_sign;
    vec2 uv0;
    vec2 uv1;
    vec4 color;
    float t;
    uint instance;
    uint mesh;
    uint triangle;
    uint material;
    // The ray came from the side of ng.
    bool front;
};

vec3 transform_point(TransformKey key, vec3 p) {
    vec4 q = vec4(p, 1.0);
    return vec3(dot(key.object_to_world[0], q), dot(key.object_to_world[1], q), dot(key.object_to_world[2], q));
}

vec3 transform_vector(TransformKey key, vec3 v) {
    return vec3(dot(key.object_to_world[0].xyz, v), dot(key.object_to_world[1].xyz, v), dot(key.object_to_world[2].xyz, v));
}

// By the inverse transpose, so that mirroring keeps the front side.
vec3 transform_normal(TransformKey key, vec3 n) {
    return key.world_to_object[0].xyz * n.x + key.world_to_object[1].xyz * n.y + key.world_to_object[2].xyz * n.z;
}

// To unit length, also where the square of the length leaves the range of floats.
vec3 unit(vec3 n) {
    float len2 = dot(n, n);
    if (len2 > 1e-30 && len2 < 1e30) {
        return n * (1.0 / sqrt(len2));
    }
    vec3 a = abs(n);
    vec3 m = n / max(max(max(a.x, a.y), a.z), 1.17549435e-38);
    float len = length(m);
    return len > 0.0 && !isinf(len) ? m / len : vec3(0.0, 1.0, 0.0);
}

Interaction interaction_new(Ray ray, Hit hit) {
    MeshTable mesh = push.scene.meshes.at[hit.mesh];
    // One key holds for all times; more are for motion, which is not drawn yet.
    TransformKey key = push.scene.transforms.at[push.scene.instances.at[hit.instance].first_transform];
    uvec3 v = mesh.triangles.at[hit.triangle];
    vec3 p0 = mesh.positions.at[v.x];
    vec3 p1 = mesh.positions.at[v.y];
    vec3 p2 = mesh.positions.at[v.z];
    vec3 w = hit_weights(hit);
    vec3 p = p0 * w.x + p1 * w.y + p2 * w.z;
    vec3 far = max(max(abs(p0 - p), abs(p1 - p)), abs(p2 - p));

    Interaction it;
    it.ng = unit(transform_normal(key, cross(p1 - p0, p2 - p0)));
    it.ns = it.ng;
    if ((mesh.attributes & ATTRIBUTE_NORMAL) != 0u) {
        vec3 n = mesh.normals.at[v.x] * w.x + mesh.normals.at[v.y] * w.y + mesh.normals.at[v.z] * w.z;
        if (dot(n, n) > 1e-12) {
            it.ns = unit(transform_normal(key, n));
            // Normals that disagree with the winding would turn the surface inside out.
            it.ns = dot(it.ns, it.ng) < 0.0 ? -it.ns : it.ns;
        }
    }
    it.tangent = vec3(0.0);
    it.bitangent_sign = 1.0;
    if ((mesh.attributes & ATTRIBUTE_TANGENT) != 0u) {
        vec4 t0 = mesh.vertices.at[v.x].tangent;
        vec3 t = t0.xyz * w.x + mesh.vertices.at[v.y].tangent.xyz * w.y + mesh.vertices.at[v.z].tangent.xyz * w.z;
        it.tangent = transform_vector(key, t);
        it.bitangent_sign = t0.w * key.handedness;
    }
    HitAttributes at = hit_attributes(hit);
    it.uv0 = at.uv0;
    it.uv1 = at.uv1;
    it.color = at.color;
    it.p = transform_point(key, p);
    it.extent = max(max(far.x, far.y), far.z) * key.scale;
    it.t = hit.t;
    it.instance = hit.instance;
    it.mesh = hit.mesh;
    it.triangle = hit.triangle;
    it.material = mesh.triangle_materials.at[hit.triangle];
    it.front = dot(it.ng, ray.dir) < 0.0;
    return it;
}

// Origin of a ray that leaves this point in direction wi.
vec3 interaction_leave(Interaction it, vec3 wi) {
    return offset_ray_origin(it.p, it.ng, wi, it.extent);
}

#endif
