// Triangles that are there as a whole, drawn as numbers.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "hybrid/vertex.glsl"

layout(location = 0) flat out uvec2 id;

void main() {
    DrawnVertex v = drawn_vertex(gl_InstanceIndex, gl_VertexIndex);
    id = uvec2(gl_InstanceIndex, v.primitive);
    gl_Position = drawn_position(v);
}
