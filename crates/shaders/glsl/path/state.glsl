// Paths under way, as they lie in memory between passes: four words of all paths after one another, then the next four. A path keeps its
// place from the camera to the film; lists say which paths go where.
#ifndef PATH_STATE_GLSL
#define PATH_STATE_GLSL

#include "path/push.glsl"
#include "path/hit.glsl"
#include "ray.glsl"
#include "sampler.glsl"
#include "bsdf/features.glsl"
#include "variants.glsl"

// A path under way.
struct Path {
    Sampler smp;
    Ray ray;
    Spectrum radiance;
    // Throughput.
    Spectrum beta;
    // Radiance scaling by refraction that is part of `beta`.
    float eta_scale;
    MediumStack media;
    // The wavelength that it has taken, nm; 0: none yet.
    float wavelength;
    // The last vertex that scattered (thin walls passed straight do not count).
    vec3 arrival_p;
    // Density of the direction there, sr⁻¹; negative where light sampling could not have found the light (camera, delta lobes).
    float arrival_pdf;
    // Since a vertex with a density, the path has done nothing but refract through smooth solids.
    bool through_solid;
    // So far it has only met delta lobes: what it finds is seen, not lit by.
    bool seen_by_camera;
    // So far it is a straight line from the camera.
    bool straight;
    // Shadow catchers that it has passed.
    uint caught;
    // Length of the rays up to the last of these, metres.
    float travelled;
    // How much the background is covered.
    float alpha;
    // Scattering events so far.
    uint depth;
    // Of them those at lobes that are not delta lobes.
    uint rough;
    // It has met a surface, whose planes are kept.
    bool has_hit;
    // Shadow rays whose light has not been added yet: bits ASKED_….
    uint asked;
};

// A shadow ray that waits to be traced, with what it will bring.
struct PendingLight {
    Ray ray;
    // Throughput times what the surface makes of the light, over its density.
    Spectrum contribution;
    // Weight against scattering, unless it comes straight through a solid.
    float mis_weight;
    // Probability with which it was asked for.
    float prob;
    // Solids let it through straight.
    bool solids_pass;
    // The media in which it begins, and the wavelength of its light, nm; 0: all.
    MediumStack media;
    float wavelength;
};

// Places of the numbers.
const uint STATE_RAY = 0u;
const uint STATE_DIRECTION = 1u;
const uint STATE_BETA = 2u;
const uint STATE_ARRIVAL = 3u;
const uint STATE_RADIANCE = 4u;
const uint STATE_HIT = 5u;
const uint STATE_BITS = 6u;
const uint STATE_ALBEDO = 7u;
const uint STATE_NORMAL = 8u;
const uint STATE_POSITION = 9u;
const uint STATE_SHADOW = 10u; // four for each group of lights, for either parity
const uint STATE_MEDIA = 26u; // two
const uint STATE_SHADOW_MEDIA = 28u; // two for each group of lights, for either parity
const uint STATE_QUADS_PLAIN = 26u;
const uint STATE_QUADS = 36u;

// Whether the last vertex counts beside its density: only triangles have one that depends on it.
const bool KEEPS_ARRIVAL = LIGHT_SAMPLING && HAS_TRIANGLE_LIGHTS;
// Whether a shadow ray has more to keep than three times four words.
const bool PENDING_HAS_MORE = (HAS_NEAR_LIGHTS && HAS_FAR_LIGHTS) || HAS_DISPERSION;

// Shadow rays of a path lie apart by the parity of the step that asked for them: those of one step may still be under way through glass
// while the next asks for others. What they bring is added two steps later, or with the film.
uint pending_slot(uint parity, uint group) {
    return 2u * parity + group;
}

uint asked_bit(uint parity, uint group) {
    return 1u << pending_slot(parity, group);
}

// Four words of a path: as they are, and as floats.
#define STATE_WORDS(place, id) push.view.state.at[(place) * push.view.capacity + (id)]
#define STATE(place, id) uintBitsToFloat(STATE_WORDS(place, id))

// Pixels are taken in blocks of 8 x 4, so that neighbours in a list are neighbours in the picture.
const uvec2 BLOCK = uvec2(8u, 4u);

uvec2 path_blocks() {
    return (push.size + BLOCK - 1u) / BLOCK;
}

// Paths of one sample of the slice; those of blocks that reach outside stand still.
uint paths_per_sample() {
    uvec2 blocks = path_blocks();
    return blocks.x * blocks.y * BLOCK.x * BLOCK.y;
}

// The pixel of a path within the slice; it may lie outside.
uvec2 path_pixel(uint id) {
    uint place = id % paths_per_sample();
    uint block = place / (BLOCK.x * BLOCK.y);
    uint within = place % (BLOCK.x * BLOCK.y);
    uint columns = path_blocks().x;
    return uvec2(block % columns, block / columns) * BLOCK + uvec2(within % BLOCK.x, within / BLOCK.x);
}

uint path_sample(uint id) {
    return push.first_sample + id / paths_per_sample();
}

Sampler path_sampler(uint id) {
    uvec2 pixel = push.view.origin + push.first_pixel + path_pixel(id);
    return sampler_new(push.view.seed, push.view.frame, pixel, path_sample(id));
}

// The path at `index` of a list; NONE beyond its end: launches may be larger than lists.
uint queue_get(uint queue, uint index) {
    if (index >= push.view.heads.at[queue].count) {
        return NONE;
    }
    return push.view.queues.at[queue * push.view.capacity + index];
}

// Adds a path to a list, where few do.
void queue_add(uint queue, uint id) {
    QueueHeads heads = push.view.heads;
    Queues queues = push.view.queues;
    uint place = atomicAdd(heads.at[queue].count, 1u);
    queues.at[queue * push.view.capacity + place] = id;
}

void media_store(uint place, uint id, MediumStack media) {
    Quads state = push.view.state;
    state.at[place * push.view.capacity + id] = media.material;
    state.at[(place + 1u) * push.view.capacity + id] = floatBitsToUint(media.ior);
}

MediumStack media_load(uint place, uint id) {
    return MediumStack(STATE_WORDS(place, id), STATE(place + 1u, id));
}

// Light that scattered this many times on its way to the camera, within the bound that the settings set.
Spectrum path_clamped(Spectrum contribution, uint scattered) {
    if (!CLAMPED || scattered <= 1u) {
        return contribution;
    }
    float largest = max_component(contribution);
    float most = push.view.clamp_to;
    return largest > most ? contribution * (most / largest) : contribution;
}

// What the film will want to know of a path.
void path_store_end(uint id, Path path) {
    Quads state = push.view.state;
    uint n = push.view.capacity;
    uint bits = (path.through_solid ? 1u : 0u) | (path.seen_by_camera ? 2u : 0u) | (path.straight ? 4u : 0u)
        | (path.caught << 3) | (path.asked << 10) | (path.has_hit ? 1u << 14 : 0u) | (path.depth << 15);
    state.at[STATE_RADIANCE * n + id] = floatBitsToUint(vec4(path.radiance, path.alpha));
    state.at[STATE_BITS * n + id] = uvec4(bits, floatBitsToUint(vec2(path.wavelength, path.eta_scale)), path.rough);
}

// A path that goes on: all but the hit and the planes of the first one.
void path_store(uint id, Path path) {
    path_store_end(id, path);
    Quads state = push.view.state;
    uint n = push.view.capacity;
    // Until it is traced, the ray has its depth in the place of the distance.
    state.at[STATE_RAY * n + id] = uvec4(floatBitsToUint(path.ray.origin), path.depth);
    state.at[STATE_DIRECTION * n + id] = floatBitsToUint(vec4(path.ray.dir, path.arrival_pdf));
    state.at[STATE_BETA * n + id] = floatBitsToUint(vec4(path.beta, path.travelled));
    if (KEEPS_ARRIVAL) {
        state.at[STATE_ARRIVAL * n + id] = floatBitsToUint(vec4(path.arrival_p, 0.0));
    }
    if (HAS_SOLID) {
        media_store(STATE_MEDIA, id, path.media);
    }
}

// What shadow rays asked for by steps of a parity have brought.
Spectrum pending_brought(uint id, uint asked, uint parity) {
    Spectrum brought = vec3(0.0);
    for (uint group = 0u; group < 2u; ++group) {
        if ((asked & asked_bit(parity, group)) != 0u) {
            brought += STATE(STATE_SHADOW + 4u * pending_slot(parity, group) + 2u, id).xyz;
        }
    }
    return brought;
}

// Shadow rays whose light has not been added yet, and whether there are planes of a first hit.
uint path_load_asked(uint id, out bool has_hit) {
    uint bits = STATE_WORDS(STATE_BITS, id).x;
    has_hit = (bits & (1u << 14)) != 0u;
    return (bits >> 10) & 15u;
}

Path path_load(uint id) {
    vec4 ray = STATE(STATE_RAY, id);
    vec4 direction = STATE(STATE_DIRECTION, id);
    vec4 beta = STATE(STATE_BETA, id);
    vec4 radiance = STATE(STATE_RADIANCE, id);
    uvec4 more = STATE_WORDS(STATE_BITS, id);
    uint bits = more.x;
    Path path;
    path.smp = path_sampler(id);
    path.ray = ray_new(ray.xyz, direction.xyz, 0.0);
    path.arrival_pdf = direction.w;
    path.beta = beta.xyz;
    path.travelled = beta.w;
    path.arrival_p = KEEPS_ARRIVAL ? STATE(STATE_ARRIVAL, id).xyz : vec3(0.0);
    path.alpha = radiance.w;
    path.wavelength = uintBitsToFloat(more.y);
    path.eta_scale = uintBitsToFloat(more.z);
    path.rough = more.w;
    path.through_solid = (bits & 1u) != 0u;
    path.seen_by_camera = (bits & 2u) != 0u;
    path.straight = (bits & 4u) != 0u;
    path.caught = (bits >> 3) & 127u;
    path.has_hit = (bits & (1u << 14)) != 0u;
    path.depth = bits >> 15;
    path.asked = (bits >> 10) & 15u;
    path.radiance = radiance.xyz + pending_brought(id, path.asked, push.parity);
    path.asked &= ~(asked_bit(push.parity, 0u) | asked_bit(push.parity, 1u));
    path.media = medium_stack_empty();
    if (HAS_SOLID) {
        path.media = media_load(STATE_MEDIA, id);
    }
    return path;
}

// Scattering events of a path whose ray has not been traced yet.
uint path_load_depth(uint id) {
    return STATE_WORDS(STATE_RAY, id).w;
}

// What a path's ray has met; `geometry` is NONE for a miss.
void hit_store(uint id, HitPayload hit) {
    Quads state = push.view.state;
    uint n = push.view.capacity;
    state.at[STATE_HIT * n + id] = uvec4(hit.geometry, hit.primitive, floatBitsToUint(hit.b));
    state.at[STATE_RAY * n + id].w = floatBitsToUint(hit.t);
}

// False for a miss.
bool hit_load(uint id, out Hit hit) {
    uvec4 met = STATE_WORDS(STATE_HIT, id);
    if (met.x == NONE) {
        return false;
    }
    hit = hit_of(met.x, met.y, uintBitsToFloat(met.zw), uintBitsToFloat(STATE_WORDS(STATE_RAY, id).w));
    return true;
}

// `depth` is that of the path before it scattered: verdicts and bounds of shadow rays depend on it.
void pending_store(uint group, uint id, PendingLight light, uint depth) {
    Quads state = push.view.state;
    uint n = push.view.capacity;
    uint slot = pending_slot(push.parity, group);
    uint place = STATE_SHADOW + 4u * slot;
    uint bits = (light.solids_pass ? 1u : 0u) | (depth << 1);
    state.at[place * n + id] = floatBitsToUint(vec4(light.ray.origin, light.ray.t_max));
    state.at[(place + 1u) * n + id] = uvec4(floatBitsToUint(light.ray.dir), bits);
    state.at[(place + 2u) * n + id] = floatBitsToUint(vec4(light.contribution, light.mis_weight));
    if (PENDING_HAS_MORE) {
        state.at[(place + 3u) * n + id] = floatBitsToUint(vec4(light.prob, light.wavelength, 0.0, 0.0));
    }
    if (HAS_SOLID) {
        media_store(STATE_SHADOW_MEDIA + 2u * slot, id, light.media);
    }
}

// What a shadow ray has brought, in the place of what it would bring.
void pending_arrived(uint group, uint id, Spectrum arrived) {
    Quads state = push.view.state;
    state.at[(STATE_SHADOW + 4u * pending_slot(push.parity, group) + 2u) * push.view.capacity + id] = floatBitsToUint(vec4(arrived, 0.0));
}

PendingLight pending_load(uint group, uint id, out uint depth) {
    uint slot = pending_slot(push.parity, group);
    uint place = STATE_SHADOW + 4u * slot;
    vec4 ray = STATE(place, id);
    uvec4 direction = STATE_WORDS(place + 1u, id);
    vec4 contribution = STATE(place + 2u, id);
    vec4 more = PENDING_HAS_MORE ? STATE(place + 3u, id) : vec4(1.0, 0.0, 0.0, 0.0);
    uint bits = direction.w;
    depth = bits >> 1;
    PendingLight light;
    light.ray = Ray(ray.xyz, uintBitsToFloat(direction.xyz), 0.0, ray.w, 0.0);
    light.contribution = contribution.xyz;
    light.mis_weight = contribution.w;
    light.prob = more.x;
    light.wavelength = more.y;
    light.solids_pass = (bits & 1u) != 0u;
    light.media = medium_stack_empty();
    if (HAS_SOLID) {
        light.media = media_load(STATE_SHADOW_MEDIA + 2u * slot, id);
    }
    return light;
}

#endif
