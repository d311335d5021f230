// Materials at a point: textures looked up, the shading frame built, the BSDF made. Twin: cpu/src/surface.rs.
#ifndef PATH_SURFACE_GLSL
#define PATH_SURFACE_GLSL

#include "path/index.glsl"
#include "path/interaction.glsl"
#include "scene/texture.glsl"
#include "bsdf/layered.glsl"
#include "frame.glsl"
#include "medium.glsl"
#include "wavelength.glsl"
#include "sampler.glsl"

// Everything the integrator asks of a surface.
struct Surface {
    // Shading frame, its normal on the side the ray came from.
    Frame frame;
    // Geometric normal on the side the ray came from.
    vec3 ng;
    Bsdf bsdf;
    Rgb base_color;
    // The medium on the far side, for a solid.
    bool is_solid;
    Medium beyond;
    // The wavelength that a path without one takes here: on arrival, or only when it crosses.
    uint takes;
    Wavelength wavelength;
};

// Values of Surface.takes.
const uint TAKES_NONE = 0u;
const uint TAKES_CROSSING = 1u;
const uint TAKES_ON_ARRIVAL = 2u;

// What a path carries, for solids that disperse.
struct Hue {
    // One of HUE_….
    uint kind;
    // HUE_ONE: the wavelength, nm.
    float nm;
    // HUE_ALL: the number that draws the wavelength it takes when it must.
    Sampler smp;
};

const uint HUE_ALL = 0u;
const uint HUE_ONE = 1u;
const uint HUE_STRAIGHT = 2u;

// Base colour: factor × texture × vertex colour.
Rgb surface_base_color(Interaction it) {
    vec3 t = TEXTURE(MATERIAL(it.material).base_color_texture, it, SRGB).rgb;
    return clamp(MATERIAL(it.material).base_color * t * it.color.rgb, 0.0, 1.0);
}

// Radiance emitted towards the side `front`.
Spectrum surface_emission(Interaction it) {
    uint flags = MATERIAL(it.material).flags;
    if ((flags & FLAG_EMISSIVE) == 0u || !(it.front || (flags & FLAG_DOUBLE_SIDED) != 0u)) {
        return vec3(0.0);
    }
    return MATERIAL(it.material).emission * TEXTURE(MATERIAL(it.material).emissive_texture, it, SRGB).rgb;
}

// The two sides of a solid's boundary.
struct Boundary {
    // Index beyond over index here.
    float eta;
    // That of the d line, where it shares out the light.
    bool has_eta_fresnel;
    float eta_fresnel;
    Medium beyond;
    uint takes;
    Wavelength wavelength;
};

Boundary boundary_plain(Interaction it, MediumStack media, float ior) {
    Medium inside = Medium(ior, it.material);
    Medium here;
    Boundary b;
    medium_stack_sides(media, inside, it.front, here, b.beyond);
    b.eta = b.beyond.ior / here.ior;
    b.has_eta_fresnel = false;
    b.eta_fresnel = b.eta;
    b.takes = TAKES_NONE;
    b.wavelength = Wavelength(0.0, vec3(1.0));
    return b;
}

// Media that a path is in have the index of its wavelength already: without one it is in none that disperses, or does not know.
Boundary boundary_new(Interaction it, MediumStack media, Hue hue) {
    float ior = MATERIAL(it.material).ior;
    if (!HAS_DISPERSION || (MATERIAL(it.material).flags & FLAG_DISPERSION) == 0u || hue.kind == HUE_STRAIGHT) {
        return boundary_plain(it, media, ior);
    }
    if (hue.kind == HUE_ONE) {
        return boundary_plain(it, media, index_at(it.material, hue.nm));
    }
    Wavelength wavelength = wavelength_sample(sampler_wavelength(hue.smp));
    Boundary b = boundary_plain(it, media, index_at(it.material, wavelength.nm));
    float eta_d = ior / medium_stack_current(media).ior;
    // Into a thinner medium total reflection depends on the wavelength, so what is reflected does too.
    bool on_arrival = !it.front || min(b.eta, eta_d) < 1.0;
    b.takes = on_arrival ? TAKES_ON_ARRIVAL : TAKES_CROSSING;
    b.wavelength = wavelength;
    b.has_eta_fresnel = !on_arrival;
    b.eta_fresnel = eta_d;
    return b;
}

// Smallest cosine between the shading normal and the viewer.
const float MIN_COS_VIEW = 1e-3;

vec3 normalize_or(vec3 v, vec3 fallback) {
    float len = length(v);
    return len > 0.0 && !isinf(len) && !isnan(len) ? v / len : fallback;
}

// The interpolated normal, turned by a normal map if there is one, on the side of the viewer; unit. `ng` lies on the viewer's side.
vec3 surface_mapped_normal(Interaction it, vec3 wo, vec3 ng, TextureUse use, float scale) {
    vec3 ns = it.ns;
    if (HAS_NORMAL_MAPS && use.texture != NONE && dot(it.tangent, it.tangent) > 0.0) {
        Frame base = frame_from_normal_tangent(ns, it.tangent);
        vec3 texel = texture_value(use, it.uv0, it.uv1, LINEAR).rgb * 2.0 - 1.0;
        float x = texel.x * scale;
        float y = texel.y * scale;
        vec3 mapped = base.t * x + base.b * (y * it.bitangent_sign) + base.n * texel.z;
        mapped = normalize_or(mapped, ns);
        // A map that points below the surface is flattened onto it.
        ns = dot(mapped, it.ng) > 0.0 ? mapped : normalize_or(mapped - it.ng * dot(mapped, it.ng), ns);
    }
    ns = it.front ? ns : -ns;
    // Interpolated normals may face away from a viewer who sees the triangle: bend them until they do not.
    float cos = dot(ns, wo);
    return cos < MIN_COS_VIEW ? normalize_or(ns + wo * (MIN_COS_VIEW - cos), ng) : ns;
}

// The material's values with its textures; what depends on the path is left at its default.
BsdfParams surface_bsdf_params(Interaction it, Rgb base_color) {
    BsdfParams params = bsdf_params_default();
    vec2 rough_metal = TEXTURE(MATERIAL(it.material).metallic_roughness_texture, it, LINEAR).gb;
    params.base_color = base_color;
    params.metallic = MATERIAL(it.material).metallic * rough_metal.y;
    params.roughness = MATERIAL(it.material).roughness * rough_metal.x;
    params.ior = MATERIAL(it.material).ior;
    params.specular = MATERIAL(it.material).specular * TEXTURE(MATERIAL(it.material).specular_texture, it, LINEAR).a;
    params.specular_color = MATERIAL(it.material).specular_color * TEXTURE(MATERIAL(it.material).specular_color_texture, it, SRGB).rgb;
    if (HAS_TRANSMISSION) {
        params.transmission = MATERIAL(it.material).transmission * TEXTURE(MATERIAL(it.material).transmission_texture, it, LINEAR).r;
    }
    // Not only where something is clear: diffuse light crosses the boundary of a solid too.
    if (HAS_SOLID) {
        params.thin = (MATERIAL(it.material).flags & FLAG_SOLID) == 0u;
    }
    return params;
}

#include "path/lobes.glsl"

// The surface at `it`, seen from `wo` by light of `hue`, with the path inside `media`.
Surface surface_new(Interaction it, vec3 wo, MediumStack media, Hue hue) {
    Surface s;
    s.base_color = surface_base_color(it);
    BsdfParams params = surface_bsdf_params(it, s.base_color);
    params.diffuse_sampling = HAS_UNIFORM_DIFFUSE ? DIFFUSE_SAMPLING_UNIFORM : DIFFUSE_SAMPLING_COSINE;
    params.eta = 1.0;
    s.is_solid = HAS_SOLID && (MATERIAL(it.material).flags & FLAG_SOLID) != 0u;
    s.takes = TAKES_NONE;
    if (s.is_solid) {
        Boundary b = boundary_new(it, media, hue);
        params.eta = b.eta;
        params.has_eta_fresnel = b.has_eta_fresnel;
        params.eta_fresnel = b.eta_fresnel;
        params.inside = !it.front;
        s.beyond = b.beyond;
        s.takes = b.takes;
        s.wavelength = b.wavelength;
    }
    s.ng = it.front ? it.ng : -it.ng;
    vec3 normal = surface_mapped_normal(it, wo, s.ng, MATERIAL(it.material).normal_texture, MATERIAL(it.material).normal_scale);
    s.frame = frame_from_normal_tangent(normal, it.tangent);
    if (HAS_LOBES) {
        uint lobes = MATERIAL(it.material).lobes;
        if (lobes != NONE) {
            s.frame = lobes_add(lobes, it, wo, s.ng, s.frame, params);
        }
    }
    s.bsdf = bsdf_new(params);
    return s;
}

#endif
