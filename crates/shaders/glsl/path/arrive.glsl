// What a shadow ray brings to its path. Twin: Path::add_light of cpu/src/path.rs.
#ifndef PATH_ARRIVE_GLSL
#define PATH_ARRIVE_GLSL

#include "path/state.glsl"

// Leaves the share that arrives of a shadow ray's light for the path's next step, or for the film.
void path_add_arriving(uint id, PendingLight light, uint depth, Spectrum share, float mis_weight) {
    Spectrum contribution = path_clamped(light.contribution * share * mis_weight, depth + 1u);
    pending_arrived(push.group, id, contribution * (1.0 / light.prob));
}

#endif
