// Twin test of medium.glsl: testkit/tests/twins/medium.rs. A stack goes through a list of steps; its state is looked at after each.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "medium.glsl"

const uint STEPS = 12u;

struct Step {
    // 0: enter, 1: leave, 2: cross from the front, 3: cross from the back.
    uint kind;
    uint material;
    float ior;
    // What is asked of the stack afterwards.
    uint asked;
    uint front;
    float distance;
};
struct State {
    Medium current;
    Medium here;
    Medium beyond;
    vec3 transmittance;
};
struct Input {
    MediumStack start;
    Step steps[STEPS];
};
struct Output {
    State states[STEPS];
};

#include "twins/kernel.glsl"

// Material 3k absorbs nothing, others absorb some bands.
Spectrum medium_absorption(uint material) {
    float a = float(material % 3u);
    return Spectrum(0.0, 0.5 * a, a * a);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) {
        return;
    }
    MediumStack stack = push.inputs.at[i].start;
    for (uint k = 0u; k < STEPS; ++k) {
        Step s = push.inputs.at[i].steps[k];
        Medium medium = Medium(s.ior, s.material);
        if (s.kind == 0u) {
            medium_stack_enter(stack, medium);
        } else if (s.kind == 1u) {
            medium_stack_leave(stack, s.material);
        } else {
            medium_stack_cross(stack, medium, s.material, s.kind == 2u);
        }
        State state;
        state.current = medium_stack_current(stack);
        Medium asked = Medium(s.ior, s.asked);
        medium_stack_sides(stack, asked, s.front == 1u, state.here, state.beyond);
        state.transmittance = medium_transmittance(state.current, s.distance);
        push.outputs.at[i].states[k] = state;
    }
}
