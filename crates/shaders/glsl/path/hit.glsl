// What rays bring back: payloads, and the records behind a hit.
// Twin: cpu/src/bvh (Hit) and cpu/src/interaction.rs (HitAttributes, Records).
#ifndef PATH_HIT_GLSL
#define PATH_HIT_GLSL

#include "scene/layout.glsl"
#include "hash.glsl"

// The payload of a path's ray. Going out, `geometry` holds the coverage key.
struct HitPayload {
    // Index into push.scene.geometries, or NONE for a miss.
    uint geometry;
    uint primitive;
    // Barycentric coordinates of the second and third vertex.
    vec2 b;
    // Distance along the ray.
    float t;
};

// The payload of a shadow ray.
struct ShadowPayload {
    uint key;
    // Bits SHADOW_….
    uint state;
};

// Going out: solids let this light through straight.
const uint SHADOW_SOLIDS_PASS = 1u;
// Something stops the light; the miss shader takes it away.
const uint SHADOW_BLOCKED = 2u;
// The ray meets something that lets light through.
const uint SHADOW_MEETS_TRANSMISSIVE = 4u;

// A hit in terms of the scene.
struct Hit {
    float t;
    uint instance;
    uint mesh;
    uint triangle;
    vec2 b;
};

Hit hit_of(uint geometry, uint primitive, vec2 b, float t) {
    GeometryRecord record = push.scene.geometries.at[geometry];
    uint triangle = uint64_t(record.triangle_ids) == 0ul ? primitive : record.triangle_ids.at[primitive];
    return Hit(t, record.instance, record.mesh, triangle, b);
}

// Material of a hit triangle.
uint material_of(Hit hit) {
    return push.scene.meshes.at[hit.mesh].triangle_materials.at[hit.triangle];
}


vec3 hit_weights(Hit hit) {
    return vec3(1.0 - hit.b.x - hit.b.y, hit.b.x, hit.b.y);
}

// What coverage needs to know of a hit.
struct HitAttributes {
    vec2 uv0;
    vec2 uv1;
    vec4 color;
};

HitAttributes hit_attributes(Hit hit) {
    MeshTable mesh = push.scene.meshes.at[hit.mesh];
    HitAttributes at = HitAttributes(vec2(0.0), vec2(0.0), vec4(1.0));
    vec3 w = hit_weights(hit);
    if ((mesh.attributes & (ATTRIBUTE_UV | ATTRIBUTE_COLOR)) == 0u) {
        return at;
    }
    uvec3 v = mesh.triangles.at[hit.triangle];
    if ((mesh.attributes & ATTRIBUTE_UV) != 0u) {
        at.uv0 = w.x * mesh.vertices.at[v.x].uv[0] + w.y * mesh.vertices.at[v.y].uv[0] + w.z * mesh.vertices.at[v.z].uv[0];
        at.uv1 = w.x * mesh.vertices.at[v.x].uv[1] + w.y * mesh.vertices.at[v.y].uv[1] + w.z * mesh.vertices.at[v.z].uv[1];
    }
    if ((mesh.attributes & ATTRIBUTE_COLOR) != 0u) {
        at.color = w.x * mesh.vertices.at[v.x].color + w.y * mesh.vertices.at[v.y].color + w.z * mesh.vertices.at[v.z].color;
    }
    return at;
}

#endif
