// Shadow catchers: surfaces that show the camera what lies behind them, darkened by the shadows that fall on them.
// Twin: cpu/src/catcher.rs, which says how and why; the candidates are drawn anew where the Rust twin keeps them, to hold few
// registers.
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

// The candidates that the bands choose, each with the share of `u` that is left on the way to it.
struct Choices {
    uvec3 chosen;
    vec3 left;
};

// Takes a candidate into account: a band chooses in proportion to its contributions, where `bands` says that it has light; a band
// without any follows the brightest.
void catcher_choose(inout Choices choices, uint part, Spectrum contribution, bvec3 bands) {
    vec3 weight = mix(vec3(max_component(contribution)), contribution, bands);
    bvec3 open = greaterThanEqual(choices.left, vec3(0.0));
    for (uint band = 0u; band < 3u; ++band) {
        if (open[band] && weight[band] > 0.0) {
            choices.chosen[band] = part;
            choices.left[band] -= weight[band];
        }
    }
}

// The share of direct light that arrives at a catcher, on the side of the camera.
Spectrum catcher_share(Catcher catcher, Sampler smp, MediumStack media, Hue hue) {
    // What all candidates contribute in each band, and the sum of their brightest bands.
    Spectrum total = vec3(0.0);
    float brightest = 0.0;
    Choices choices;
    choices.chosen = uvec3(0u);
    Spectrum arrives[3];
    uint key = coverage_key_catcher(sampler_coverage_key(smp), catcher.depth, catcher.passed);
    // Three rounds with one call: each call is compiled in full. The sums; the choice; the shadow rays of the chosen.
    for (uint round_ = 0u; round_ < 3u; ++round_) {
        for (uint i = 0u; i < (round_ == 2u ? 3u : CANDIDATES); ++i) {
            if (round_ == 2u && i > 0u && choices.chosen[i] == choices.chosen[i - 1u]) {
                arrives[i] = arrives[i - 1u];
                continue;
            }
            uint part = round_ == 2u ? choices.chosen[i] : i;
            LightSample light;
            Spectrum c;
            bool gives = catcher_candidate(catcher, smp, part, light, c);
            if (round_ == 2u) {
                arrives[i] = vec3(0.0);
            }
            if (!gives) {
                continue;
            }
            if (round_ == 0u) {
                total += c;
                brightest += max_component(c);
            } else if (round_ == 1u) {
                catcher_choose(choices, part, c, greaterThan(total, vec3(0.0)));
            } else {
                ShadowRay shadow = ShadowRay(
                    shadow_line(catcher.it, light), media, hue, shadow_wall_budget(catcher.depth), shadow_solids_pass(light));
                bool through_solid;
                arrives[i] = shadow_transmittance(shadow, key, through_solid);
            }
        }
        if (round_ == 0u) {
            if (is_black(total)) {
                // No light that could be in shadow.
                return vec3(1.0);
            }
            float u = sampler_lobe(sampler_split(smp, 2u * catcher.passed + 1u, 1u, 0u), 0u);
            choices.left = u * mix(vec3(brightest), total, greaterThan(total, vec3(0.0)));
        }
    }
    return vec3(arrives[0].r, arrives[1].g, arrives[2].b);
}

#endif
