// Between passes: lengths of lists become sizes of launches, no larger than there is room; lists that are to be written begin empty.
#version 460
#extension GL_GOOGLE_include_directive : require

layout(local_size_x = 1) in;

#include "hybrid/frame.glsl"

void main() {
    FrameHeads heads = push.frame.heads;
    uint list = push.parity;
    uint rays = min(heads.rays[list].count, push.frame.ray_capacity);
    uint shadows = min(heads.shadows[list].count, push.frame.shadow_capacity);
    heads.dropped += heads.rays[list].count - rays + heads.shadows[list].count - shadows;
    heads.rays[list].count = rays;
    heads.shadows[list].count = shadows;
    heads.groups[0] = (rays + 63u) / 64u;
    heads.traced_rays += rays;
    heads.traced_shadows += shadows;
    heads.rays[1u - list].count = 0u;
    heads.shadows[1u - list].count = 0u;
    heads.glass[list].count = 0u;
}
