// A vertex of a triangle that the rasteriser draws. Draws have no vertex buffers: the vertices are those that rays meet, read by address. The
// first instance of a draw is the number of its geometry record.
#ifndef HYBRID_VERTEX_GLSL
#define HYBRID_VERTEX_GLSL

#include "hybrid/project.glsl"
#include "path/interaction.glsl"

struct DrawnVertex {
    GeometryRecord geometry;
    uint primitive;
    uint triangle;
    // Place in the arrays of the mesh.
    uint vertex;
};

DrawnVertex drawn_vertex(uint geometry, uint index) {
    DrawnVertex v;
    v.geometry = push.scene.geometries.at[geometry];
    v.primitive = index / 3u;
    bool whole = uint64_t(v.geometry.triangle_ids) == 0ul;
    v.triangle = whole ? v.primitive : v.geometry.triangle_ids.at[v.primitive];
    v.vertex = push.scene.meshes.at[v.geometry.mesh].triangles.at[v.triangle][index % 3u];
    return v;
}

vec4 drawn_position(DrawnVertex v) {
    TransformKey key = push.scene.transforms.at[push.scene.instances.at[v.geometry.instance].first_transform];
    vec3 p = push.scene.meshes.at[v.geometry.mesh].positions.at[v.vertex];
    return project(push.view.camera, transform_point(key, p), push.frame.jitter);
}

#endif
