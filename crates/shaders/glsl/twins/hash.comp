// Twin test of hash.glsl: testkit/tests/twins/hash.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    uint a;
    uint b;
};
struct Output {
    uint combined;
    float unit;
};

#include "twins/kernel.glsl"
#include "hash.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    uint combined = hash_combine(it.a, it.b);
    push.outputs.at[i] = Output(combined, to_unit(combined));
}
