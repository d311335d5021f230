// Tables of numbers that functions look up: one buffer, filled by `lumbre_shaders::tables` from those of lumbre-core. Shaders name its
// address `push.tables`; declare push constants before including what uses it (see twins/kernel.glsl).
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#ifndef TABLES_GLSL
#define TABLES_GLSL

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Tables {
    // Points of every value of each byte of a reversed index: core/src/sampler/sobol.rs.
    uint sobol[4][256][4];
};

#endif
