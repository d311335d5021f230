// Geometry and primitive that a pixel shows.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(location = 0) flat in uvec2 id;
layout(location = 0) out uvec2 shown;

void main() {
    shown = id;
}
