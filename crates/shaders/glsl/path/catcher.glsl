// Shadow catchers: surfaces that show the camera what lies behind them, darkened by the shadows that fall on them.
// Twin: cpu/src/catcher.rs, which says how and why; the candidates are drawn anew where the Rust twin keeps them, to hold few registers.
#ifndef PATH_CATCHER_GLSL
#define PATH_CATCHER_GLSL

#include "path/shadow.glsl"

const uint CANDIDATES = 16u;

struct Catcher {
    Interaction it;
    // Catchers that this path has passed before.
    uint passed;
    // Scattering events of the path so far.
    uint depth;
};

// A light sample and what it would contribute without shadow; false: nothing.
bool catcher_candidate(Catcher catcher, Sampler smp, uint part, out LightSample light, out Spectrum contribution) {
    uint group = HAS_NEAR_LIGHTS && (!HAS_FAR_LIGHTS || part < CANDIDATES / 2u) ? GROUP_NEAR : GROUP_FAR;
    Sampler numbers = sampler_split(smp, 2u * catcher.passed, CANDIDATES, part);
    if (!sample_light(group, catcher.it.p, sampler_light_point(numbers, 0u), numbers, 0u, light)) {
        return false;
    }
    float side = catcher.it.front ? 1.0 : -1.0;
    float cos = side * dot(catcher.it.ns, light.wi);
    float cos_g = side * dot(catcher.it.ng, light.wi);
    contribution = light.radiance * (cos / light.pdf);
    return cos > 0.0 && cos_g > 0.0;
}

// A band without any light follows the brightest.
float catcher_weight(Spectrum contribution, Spectrum total, uint band) {
    return total[band] > 0.0 ? contribution[band] : max_component(contribution);
}

// Index of the candidate that `u` draws in proportion to its weight in a band.
uint catcher_choose(Catcher catcher, Sampler smp, float u, Spectrum total, uint band) {
    float sum = 0.0;
    for (uint part = 0u; part < CANDIDATES; ++part) {
        LightSample light;
        Spectrum c;
        sum += catcher_candidate(catcher, smp, part, light, c) ? catcher_weight(c, total, band) : 0.0;
    }
    float left = u * sum;
    uint chosen = 0u;
    for (uint part = 0u; part < CANDIDATES; ++part) {
        LightSample light;
        Spectrum c;
        float w = catcher_candidate(catcher, smp, part, light, c) ? catcher_weight(c, total, band) : 0.0;
        if (w > 0.0) {
            chosen = part;
            left -= w;
            if (left < 0.0) {
                break;
            }
        }
    }
    return chosen;
}

Spectrum catcher_arriving(Catcher catcher, Sampler smp, uint part, MediumStack media, Hue hue) {
    LightSample light;
    Spectrum c;
    if (!catcher_candidate(catcher, smp, part, light, c)) {
        return vec3(0.0);
    }
    ShadowRay shadow = ShadowRay(
        shadow_line(catcher.it, light), media, hue, shadow_wall_budget(catcher.depth), shadow_solids_pass(light));
    bool through_solid;
    uint key = coverage_key_catcher(sampler_coverage_key(smp), catcher.depth, catcher.passed);
    return shadow_transmittance(shadow, key, through_solid);
}

// The share of direct light that arrives at a catcher, on the side of the camera.
Spectrum catcher_share(Catcher catcher, Sampler smp, MediumStack media, Hue hue) {
    Spectrum total = vec3(0.0);
    for (uint part = 0u; part < CANDIDATES; ++part) {
        LightSample light;
        Spectrum c;
        total += catcher_candidate(catcher, smp, part, light, c) ? c : vec3(0.0);
    }
    if (is_black(total)) {
        // No light that could be in shadow.
        return vec3(1.0);
    }
    float u = sampler_lobe(sampler_split(smp, 2u * catcher.passed + 1u, 1u, 0u), 0u);
    Spectrum share = vec3(0.0);
    uint last = NONE;
    Spectrum arrives = vec3(0.0);
    for (uint band = 0u; band < 3u; ++band) {
        uint chosen = catcher_choose(catcher, smp, u, total, band);
        if (chosen != last) {
            arrives = catcher_arriving(catcher, smp, chosen, media, hue);
            last = chosen;
        }
        share[band] = arrives[band];
    }
    return share;
}

#endif
