// What every twin kernel begins with: one invocation evaluates one input. `Input` and `Output` must be defined before.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#ifndef KERNEL_GLSL
#define KERNEL_GLSL

#include "tables.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Inputs {
    Input at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Outputs {
    Output at[];
};

layout(push_constant, scalar) uniform Push {
    Tables tables;
    Inputs inputs;
    Outputs outputs;
    uint count;
} push;

#endif
