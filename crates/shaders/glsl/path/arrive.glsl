// What a shadow ray brings to its path. Twin: Path::add_light of cpu/src/path.rs.
#ifndef PATH_ARRIVE_GLSL
#define PATH_ARRIVE_GLSL

#include "path/state.glsl"

// Adds the share that arrives of a shadow ray's light. Only one shadow ray of a path is under way at a time.
void path_add_arriving(uint id, PendingLight light, uint depth, Spectrum share, float mis_weight) {
    Spectrum contribution = path_clamped(light.contribution * share * mis_weight, depth + 1u);
    Quads state = push.view.state;
    state.at[STATE_RADIANCE * push.view.capacity + id].xyz += contribution * (1.0 / light.prob);
}

#endif
