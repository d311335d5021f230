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
    // The shadow rays of the pass before.
    heads.shadow_rays += heads.at[QUEUE_SHADOW].count + heads.at[QUEUE_SHADOW + 1u].count;
    for (uint queue = 0u; queue < QUEUES; ++queue) {
        if (queue != QUEUE_PATHS + push.parity) {
            heads.at[queue].count = 0u;
        }
    }
}
