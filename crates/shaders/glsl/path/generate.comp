// Begins the paths of a slice: camera rays. Twin: the loop of cpu/src/backend.rs.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require

layout(local_size_x = 64) in;

#include "path/push.glsl"
#include "path/begin.glsl"
#include "filter.glsl"

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= paths_per_sample() * push.sample_count) {
        return;
    }
    uvec2 within = path_pixel(id);
    Queues queues = push.view.queues;
    if (any(greaterThanEqual(within, push.size))) {
        // A block that reaches outside: its place in the list is kept, so that lists need no counting here.
        queues.at[id] = NONE;
        return;
    }
    uvec2 pixel = push.view.origin + push.first_pixel + within;
    Sampler smp = path_sampler(id);
    vec2 offset = filter_sample(push.view.filter_kind, sampler_filter(smp));
    vec2 film = (vec2(pixel) + 0.5 + offset) / vec2(push.view.picture);
    CameraRecord camera = push.view.camera;
    vec2 lens = camera.lens_radius > 0.0 ? sampler_lens(smp) : vec2(0.5);
    Path path = path_new(camera_ray(camera, film, lens, 0.0), smp);
    if (HAS_SOLID) {
        path_begin_inside(path);
    }
    path_store(id, path);
    queues.at[id] = id;
}
