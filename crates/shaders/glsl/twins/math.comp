// Twin test of math.glsl: testkit/tests/twins/math.rs.
#version 460
#extension GL_GOOGLE_include_directive : require

struct Input {
    // An angle, and for `atan2` a coordinate.
    float x;
    float y;
    // In [-1, 1].
    float cosine;
    // Positive.
    float positive;
};
struct Output {
    float sine;
    float cosine;
    float tangent;
    float arc_cosine;
    float arc_tangent;
    float exp_;
    float exp2_;
    float ln_;
    float power;
};

#include "twins/kernel.glsl"
#include "math.glsl"

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    Input it = push.inputs.at[i];
    Output o;
    sin_cos(it.x, o.sine, o.cosine);
    o.tangent = tan(it.x);
    o.arc_cosine = acos(it.cosine);
    o.arc_tangent = atan2(it.y, it.x);
    o.exp_ = exp(it.x);
    o.exp2_ = exp2(it.x);
    o.ln_ = ln(it.positive);
    o.power = pow_(it.positive, it.y);
    push.outputs.at[i] = o;
}
