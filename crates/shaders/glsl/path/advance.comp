// Between passes over all paths: how many paths there are decides the next launches, and the lists that they write begin empty.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 1) in;

#include "path/push.glsl"

void main() {
    QueueHeads heads = push.view.heads;
    uint paths = heads.at[QUEUE_PATHS + push.parity].count;
    heads.groups[0] = (paths + 63u) / 64u;
    heads.path_rays += paths;
    // The shadow rays of the step before, which are traced beside the paths of this one.
    uint before = 1u - push.parity;
    heads.shadow_rays += heads.at[queue_shadow(before, 0u)].count + heads.at[queue_shadow(before, 1u)].count;
    heads.at[QUEUE_PATHS + before].count = 0u;
    heads.at[queue_shadow(push.parity, 0u)].count = 0u;
    heads.at[queue_shadow(push.parity, 1u)].count = 0u;
    heads.at[queue_glass(push.parity, 0u)].count = 0u;
    heads.at[queue_glass(push.parity, 1u)].count = 0u;
    heads.at[QUEUE_CATCHERS].count = 0u;
}
