// From what the rasteriser saw to the planes of each pixel and its first light; asks for the first rays and shadow rays.
#version 460
#extension GL_GOOGLE_include_directive : require
#define IMAGES

layout(local_size_x = 8, local_size_y = 8) in;

#include "hybrid/show.glsl"
#include "hybrid/sums.glsl"
#include "hybrid/project.glsl"

// The triangle that was seen, where the ray through the pixel meets its plane. The rasteriser rounds vertices to parts of a pixel, so that this may
// lie a little outside; what lies far outside, of triangles seen edge-on, is brought to the edge.
Hit seen_hit(Ray ray, uvec2 id) {
    Hit hit = hit_of(id.x, id.y, vec2(0.0), 0.0);
    MeshTable mesh = push.scene.meshes.at[hit.mesh];
    TransformKey key = push.scene.transforms.at[push.scene.instances.at[hit.instance].first_transform];
    uvec3 v = mesh.triangles.at[hit.triangle];
    vec3 p0 = transform_point(key, mesh.positions.at[v.x]);
    vec3 e1 = transform_point(key, mesh.positions.at[v.y]) - p0;
    vec3 e2 = transform_point(key, mesh.positions.at[v.z]) - p0;
    // Möller and Trumbore 1997.
    vec3 to = ray.origin - p0;
    vec3 q = cross(to, e1);
    vec3 r = cross(ray.dir, e2);
    float inv = 1.0 / dot(e1, r);
    vec2 b = vec2(dot(to, r), dot(ray.dir, q)) * inv;
    float least = min(min(b.x, b.y), 1.0 - b.x - b.y);
    if (!(least > -0.5)) {
        b = any(isnan(b)) ? vec2(1.0 / 3.0) : clamp(b, 0.0, 1.0);
        b /= max(b.x + b.y, 1.0);
    }
    hit.b = b;
    hit.t = dot(p0 + e1 * b.x + e2 * b.y - ray.origin, ray.dir);
    return hit;
}

// From this place of the picture to where the point was in the frame before, pixels.
vec2 motion(vec2 pixel, vec4 before) {
    vec2 place = vec2(0.5) + 0.5 * before.xy / before.w;
    return place * vec2(push.view.picture) - (vec2(push.view.origin) + pixel + 0.5 + push.frame.jitter);
}

// The same of a point of a surface, and its distance from the camera then.
vec3 motion_of_surface(vec2 pixel, Interaction it, Hit hit) {
    MeshTable mesh = push.scene.meshes.at[hit.mesh];
    TransformKey key = Transforms(push.frame.previous_transforms).at[push.scene.instances.at[hit.instance].first_transform];
    uvec3 v = mesh.triangles.at[hit.triangle];
    vec3 w = hit_weights(hit);
    vec3 p = mesh.positions.at[v.x] * w.x + mesh.positions.at[v.y] * w.y + mesh.positions.at[v.z] * w.z;
    vec3 before = transform_point(key, p);
    CameraRecord camera = push.frame.previous;
    float away = camera.projection == PROJECTION_PERSPECTIVE ? length(before - camera.origin) : dot(before - camera.origin, camera.forward);
    return vec3(motion(pixel, project(camera, before, vec2(0.0))), away);
}

// The sky turns with the camera only.
vec2 motion_of_sky(vec2 pixel, Ray ray) {
    CameraRecord before = push.frame.previous;
    if (before.projection != PROJECTION_PERSPECTIVE) {
        return vec2(0.0);
    }
    return motion(pixel, project(before, before.origin + ray.dir, vec2(0.0)));
}

void main() {
    uvec2 at = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(at, push.view.size))) {
        return;
    }
    uint pixel = at.y * push.view.size.x + at.x;
    FrameQuads planes = push.frame.planes;
    uint pixels = frame_pixels();
    CameraRecord camera = push.view.camera;
    camera.lens_radius = 0.0;
    Arrived a;
    a.pixel = pixel;
    a.kind = RayKind(0u, false, 0.0);
    a.ray = camera_ray(camera, frame_film(vec2(at)), vec2(0.5), 0.0);
    a.beta = WHITE;
    a.media = push.view.media;
    uvec2 id = push.frame.ids.at[pixel];
    if (id.x == NONE) {
        sums_begin(pixel, TRANSPARENT_BACKGROUND ? BLACK : show_sky(a));
        vec2 moved = motion_of_sky(vec2(at), a.ray);
        planes.at[PLANE_NORMAL * pixels + pixel] = uvec4(0u, 0u, 0u, floatBitsToUint(INFINITY));
        planes.at[PLANE_ALBEDO * pixels + pixel] = uvec4(0u);
        planes.at[PLANE_POSITION * pixels + pixel] = uvec4(0u, 0u, 0u, NONE);
        planes.at[PLANE_MOTION * pixels + pixel] = floatBitsToUint(vec4(moved, INFINITY, 0.0));
        planes.at[PLANE_EMISSION * pixels + pixel] = uvec4(0u, 0u, 0u, NONE);
        planes.at[PLANE_SHARES * pixels + pixel] = floatBitsToUint(vec4(0.0, 0.0, 1.0, 0.0));
        return;
    }
    Hit hit = seen_hit(a.ray, id);
    Interaction it = interaction_new(a.ray, hit);
    a.beta *= medium_transmittance(medium_stack_current(a.media), it.t);
    Surface surface = surface_new(it, -a.ray.dir, a.media, ONE_INDEX);
    sums_begin(pixel, show_surface(0u, a, it, surface, frame_sampler(pixel)));
    // The planes.
    Branches b = bsdf_branches(surface.bsdf, frame_to_local(surface.frame, -a.ray.dir), TRANSPORT_RADIANCE);
    vec2 shares = vec2(average(b.mirrored.weight + b.varnish.weight), average(b.through.weight));
    Mixture m = surface.bsdf.mixture;
    float roughness = sqrt(sqrt(m.ggx.alpha_x * m.ggx.alpha_y));
    float index = mixture_has_base(m) ? MATERIAL(it.material).ior : m.eta;
    vec3 moved = motion_of_surface(vec2(at), it, hit);
    Spectrum emitted = surface_emission(it);
    planes.at[PLANE_NORMAL * pixels + pixel] = floatBitsToUint(vec4(surface.frame.n, it.t));
    planes.at[PLANE_ALBEDO * pixels + pixel] =
        uvec4(floatBitsToUint(bsdf_albedo(surface.bsdf)), packHalf2x16(vec2(roughness, average(m.base_f0))));
    planes.at[PLANE_POSITION * pixels + pixel] = uvec4(floatBitsToUint(it.p), it.instance);
    planes.at[PLANE_MOTION * pixels + pixel] = floatBitsToUint(vec4(moved, 0.0));
    planes.at[PLANE_EMISSION * pixels + pixel] = uvec4(floatBitsToUint(emitted), it.material);
    planes.at[PLANE_SHARES * pixels + pixel] = floatBitsToUint(vec4(shares, index, 0.0));
}
