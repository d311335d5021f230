// Triangles that are there only in part.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "hybrid/vertex.glsl"

layout(location = 0) flat out uvec2 id;
layout(location = 1) flat out uvec3 surface;
layout(location = 2) out vec4 uv;
layout(location = 3) out vec4 color;

void main() {
    DrawnVertex v = drawn_vertex(gl_InstanceIndex, gl_VertexIndex);
    MeshTable mesh = push.scene.meshes.at[v.geometry.mesh];
    id = uvec2(gl_InstanceIndex, v.primitive);
    surface = uvec3(v.geometry.instance, v.triangle, mesh.triangle_materials.at[v.triangle]);
    uv = vec4(0.0);
    color = vec4(1.0);
    if ((mesh.attributes & ATTRIBUTE_UV) != 0u) {
        uv = vec4(mesh.vertices.at[v.vertex].uv[0], mesh.vertices.at[v.vertex].uv[1]);
    }
    if ((mesh.attributes & ATTRIBUTE_COLOR) != 0u) {
        color = mesh.vertices.at[v.vertex].color;
    }
    gl_Position = drawn_position(v);
}
