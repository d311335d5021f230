// The rays that wait in a list of the path tracer, as replay.rgen traces them; once they were traced, what they found.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define COLLECTS

layout(local_size_x = 64) in;

#include "replay/ray.glsl"
#include "path/push.glsl"
#include "path/state.glsl"
#include "path/coverage.glsl"

// Beside the groups of lights: rays of paths before they are traced, and what they found.
const uint COLLECT_PATHS = 2u;
const uint COLLECT_FOUND = 3u;

// A shadow ray, and whether it brought light.
void collect_shadow(uint id, uint place) {
    uint depth;
    PendingLight light = pending_load(push.group, id, depth);
    uint key = coverage_key_shadow(sampler_coverage_key(path_sampler(id)), depth);
    uint kind = light.solids_pass ? KIND_SHADOW_STRAIGHT : KIND_SHADOW;
    push.rays.at[place] = ReplayRay(light.ray.origin, 0.0, light.ray.dir, light.ray.t_max, kind, key);
    push.hits.at[place] = ReplayHit(is_black(light.contribution) ? 0.0 : -1.0, NONE, NONE, vec2(0.0));
}

void collect_path(uint id, uint place) {
    Ray ray = ray_new(STATE(STATE_RAY, id).xyz, STATE(STATE_DIRECTION, id).xyz, 0.0);
    uint depth = path_load_depth(id);
    uint key = coverage_key_path(sampler_coverage_key(path_sampler(id)), depth);
    uint kind = depth == 0u && !SHADE_BACK_FACES ? KIND_CAMERA : KIND_PATH;
    push.rays.at[place] = ReplayRay(ray.origin, ray.t_min, ray.dir, ray.t_max, kind, key);
}

void main() {
    uint place = gl_GlobalInvocationID.x;
    bool shadow = push.group < COLLECT_PATHS;
    uint list = shadow ? queue_shadow(push.parity, push.group) : QUEUE_PATHS + push.parity;
    if (place >= push.view.heads.at[list].count) {
        return;
    }
    uint id = queue_get(list, place);
    if (shadow) {
        collect_shadow(id, place);
    } else if (push.group == COLLECT_PATHS) {
        if (id == NONE) {
            push.rays.at[place].kind = KIND_NONE;
        } else {
            collect_path(id, place);
        }
    } else {
        Hit hit;
        bool found = id != NONE && hit_load(id, hit);
        // The path has gone on: its distance is no more.
        push.hits.at[place] =
            found ? ReplayHit(0.0, hit.instance, hit.triangle, hit.b) : ReplayHit(-1.0, NONE, NONE, vec2(0.0));
    }
}
