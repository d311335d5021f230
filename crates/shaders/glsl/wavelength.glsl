// One wavelength of light, for paths that meet a medium which disperses. Twin: core/src/wavelength.rs, which says how and why.
#ifndef WAVELENGTH_GLSL
#define WAVELENGTH_GLSL

#include "math.glsl"
#include "rgb.glsl"

// First node of the table and the distance between nodes, nm; how many there are.
const float WAVELENGTH_FIRST = 390.0;
const float WAVELENGTH_STEP = 5.0;
const uint WAVELENGTH_NODES = 63u;

// A wavelength and the colour it carries.
struct Wavelength {
    // Length in vacuum, nm.
    float nm;
    // Factor on the throughput of a path that takes it; 1 on average.
    Spectrum weight;
};

// The wavelength of a number in [0, 1).
Wavelength wavelength_sample(float u) {
    // The last node whose integral is not above u.
    uint node = 0u;
    for (uint step_ = 32u; step_ > 0u; step_ >>= 1) {
        uint next = node + step_;
        if (next <= WAVELENGTH_NODES - 2u && push.tables.wavelength_cdf[next] <= u) {
            node = next;
        }
    }
    Spectrum a = push.tables.wavelength_response[node];
    Spectrum b = push.tables.wavelength_response[node + 1u];
    float pa = average(a);
    float pb = average(b);
    // Invert the integral of a linear density over the cell, written so that nothing cancels.
    float low = push.tables.wavelength_cdf[node];
    float part = clamp((u - low) / (push.tables.wavelength_cdf[node + 1u] - low), 0.0, 1.0);
    float x = min(part * (pa + pb) / (pa + safe_sqrt(sqr(pa) + part * (pb - pa) * (pb + pa))), 1.0);
    Spectrum response = a + (b - a) * x;
    return Wavelength(
        WAVELENGTH_FIRST + WAVELENGTH_STEP * (float(node) + x),
        response * (1.0 / average(response))
    );
}

// Index of refraction at `nm` of a medium with index `ior` at the d line, by Cauchy's law through the Abbe number 20 / `dispersion`,
// as KHR_materials_dispersion writes it. At least 1.
float dispersed_index(float ior, float dispersion, float nm) {
    return max(ior + (ior - 1.0) * (dispersion / 20.0) * (523655.0 / (nm * nm) - 1.5168), 1.0);
}

#endif
