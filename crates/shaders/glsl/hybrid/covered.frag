// Geometry and primitive that a pixel shows, where the surface is there.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "hybrid/frame.glsl"
#include "path/coverage.glsl"

layout(location = 0) flat in uvec2 id;
layout(location = 1) flat in uvec3 surface;
layout(location = 2) in vec4 uv;
layout(location = 3) in vec4 color;
layout(location = 0) out uvec2 shown;

void main() {
    uvec2 at = uvec2(gl_FragCoord.xy);
    uint key = coverage_key_path(sampler_coverage_key(frame_sampler(at.y * push.view.size.x + at.x)), 0u);
    if (!covered_at(surface.x, surface.y, surface.z, HitAttributes(uv.xy, uv.zw, color), key)) {
        discard;
    }
    shown = id;
}
