// What each path's ray has met: sky or surface; light from there, the shadow rays that it asks for, and where it goes on.
// Twin: the loop of cpu/src/path.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#define IMAGES

layout(local_size_x = 64) in;

#include "path/push.glsl"
#include "label.glsl"
#include "path/path.glsl"

// Members of the three lists that this group adds to, and where in them the group's part begins.
shared uint members[3];
shared uint begins[3];

// The planes of the first hit.
void store_planes(uint id, inout Path path, Interaction it, Surface surface) {
    path.has_hit = true;
    Quads state = push.view.state;
    uint n = push.view.capacity;
    Rgb albedo = push.view.object_colors != 0u ? label(it.instance) : bsdf_albedo(surface.bsdf);
    state.at[STATE_ALBEDO * n + id] = floatBitsToUint(vec4(albedo, path.travelled + it.t));
    state.at[STATE_NORMAL * n + id] = floatBitsToUint(vec4(surface.frame.n, 0.0));
    state.at[STATE_POSITION * n + id] = floatBitsToUint(vec4(it.p, 0.0));
}

// One step of a path.
Scattered step_path(uint id, inout Path path) {
    Scattered result;
    result.alive = false;
    result.waits = false;
    result.has_far = false;
    result.has_near = false;
    Hit hit;
    if (!hit_load(id, hit)) {
        path_add_sky(path);
        return result;
    }
    Interaction it = interaction_new(path.ray, hit);
    // Absorb on the way to it.
    path.beta *= medium_transmittance(medium_stack_current(path.media), it.t);
    // A catcher shows the camera what lies behind it; rays are traced for that.
    if (path_meets_catcher(path, it)) {
        // Here and not there: storing the path drops the distance of the hit.
        path.travelled += it.t;
        queue_add(QUEUE_CATCHERS, id);
        result.waits = true;
        return result;
    }
    // Build the surface.
    vec3 wo = -path.ray.dir;
    Surface surface = surface_new(it, wo, path.media, path_hue(path));
    if (HAS_DISPERSION && surface.takes == TAKES_ON_ARRIVAL) {
        path_take(path, surface.wavelength);
    }
    if (path.depth == 0u) {
        store_planes(id, path, it, surface);
    }
    // Add what it emits.
    if (path_add_emission(path, it, surface.base_color) || path.depth >= push.view.max_depth) {
        return result;
    }
    uint depth = path.depth;
    result = path_scatter(path, it, surface, wo);
    if (result.has_far) {
        pending_store(GROUP_FAR, id, result.far, depth);
    }
    if (result.has_near) {
        pending_store(GROUP_NEAR, id, result.near, depth);
    }
    return result;
}

void main() {
    uint lane = gl_LocalInvocationID.x;
    if (lane < 3u) {
        members[lane] = 0u;
    }
    barrier();
    uint id = queue_get(QUEUE_PATHS + push.parity, gl_GlobalInvocationID.x);
    bvec3 joins = bvec3(false);
    if (id != NONE) {
        Path path = path_load(id);
        Scattered result = step_path(id, path);
        path.asked |= (result.has_far ? asked_bit(push.parity, GROUP_FAR) : 0u)
            | (result.has_near ? asked_bit(push.parity, GROUP_NEAR) : 0u);
        if (result.alive || result.waits) {
            path_store(id, path);
        } else {
            path_store_end(id, path);
        }
        joins = bvec3(result.alive, result.has_far, result.has_near);
    }
    // Join the lists: the group reserves its places at once.
    uvec3 places = uvec3(0u);
    for (uint i = 0u; i < 3u; ++i) {
        if (joins[i]) {
            places[i] = atomicAdd(members[i], 1u);
        }
    }
    barrier();
    uint lists[3] = uint[3](QUEUE_PATHS + 1u - push.parity, queue_shadow(push.parity, GROUP_FAR), queue_shadow(push.parity, GROUP_NEAR));
    QueueHeads heads = push.view.heads;
    if (lane < 3u && members[lane] > 0u) {
        begins[lane] = atomicAdd(heads.at[lists[lane]].count, members[lane]);
    }
    barrier();
    Queues queues = push.view.queues;
    for (uint i = 0u; i < 3u; ++i) {
        if (joins[i]) {
            queues.at[lists[i] * push.view.capacity + begins[i] + places[i]] = id;
        }
    }
}
