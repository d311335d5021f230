// How a path begins. Twin: Path::begin_inside and Path::take of cpu/src/path.rs.
#ifndef PATH_BEGIN_GLSL
#define PATH_BEGIN_GLSL

#include "path/index.glsl"
#include "path/state.glsl"

// From here on the path carries one wavelength.
void path_take(inout Path path, Wavelength wavelength) {
    path.beta *= wavelength.weight;
    path.wavelength = wavelength.nm;
}

// Takes a wavelength at once where the camera stands in a medium that disperses.
void path_begin_inside(inout Path path) {
    path.media = push.view.media;
    bool disperses = false;
    for (uint i = 0u; HAS_DISPERSION && i < 4u; ++i) {
        uint material = push.view.media.material[i];
        disperses = disperses || (material != VACUUM && (MATERIAL(material).flags & FLAG_DISPERSION) != 0u);
    }
    if (HAS_DISPERSION && disperses) {
        Wavelength wavelength = wavelength_sample(sampler_wavelength(path.smp));
        path_take(path, wavelength);
        for (uint i = 0u; i < 4u; ++i) {
            uint material = path.media.material[i];
            path.media.ior[i] = material == VACUUM ? 1.0 : index_at(material, wavelength.nm);
        }
    }
}

Path path_new(Ray ray, Sampler smp) {
    Path path;
    path.smp = smp;
    path.ray = ray;
    path.radiance = vec3(0.0);
    path.beta = vec3(1.0);
    path.eta_scale = 1.0;
    path.media = medium_stack_empty();
    path.wavelength = 0.0;
    path.arrival_p = ray.origin;
    path.arrival_pdf = -1.0;
    path.through_solid = false;
    path.seen_by_camera = true;
    path.straight = true;
    path.caught = 0u;
    path.travelled = 0.0;
    path.alpha = 1.0;
    path.depth = 0u;
    path.rough = 0u;
    path.has_hit = false;
    path.asked = 0u;
    return path;
}

#endif
