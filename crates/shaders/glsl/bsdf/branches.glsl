// The delta lobes of a surface one by one, each with its whole weight, for those who follow all of them (Whitted 1980, "An Improved
// Illumination Model for Shaded Display") and not one drawn by chance. `bsdf_sample` draws the same directions with the same weights over the
// probabilities of choosing them: a test compares both.
#ifndef BSDF_BRANCHES_GLSL
#define BSDF_BRANCHES_GLSL

#include "bsdf/layered.glsl"

// A direction of a delta lobe.
struct Branch {
    // Local direction, unit.
    vec3 wi;
    // What of the light from there leaves towards the viewer; black where there is no such lobe.
    Spectrum weight;
};

// All of them.
struct Branches {
    // Mirrored about the shading normal, by whatever is smooth.
    Branch mirrored;
    // Mirrored about the normal of the varnish, where it has one of its own.
    Branch varnish;
    // Through the surface.
    Branch through;
    // `through` is bent at the boundary of a solid, not straight through a wall.
    bool refracted;
};

const Branch NO_BRANCH = Branch(vec3(0.0, 0.0, 1.0), BLACK);

// What the base and its interface, or its gloss, mirror.
Spectrum base_mirrored(Mixture self_, float cosine) {
    if (mixture_is_gloss(self_)) {
        Phong gloss = mixture_gloss(self_);
        return phong_is_mirror(gloss) ? phong_reflectance(gloss, cosine) : BLACK;
    }
    Interface over = mixture_interface(self_);
    bool mirrors = !interface_is_none(over) && !ggx_is_rough(over.ggx);
    return mirrors ? interface_reflectance(over, cosine) : BLACK;
}

// The branches at the boundary of a solid, where it is smooth.
void solid_branches(Mixture self_, vec3 wo, uint mode, inout Branches b) {
    Dielectric solid = mixture_solid(self_);
    if (ggx_is_rough(solid.ggx)) {
        return;
    }
    float cosine = min(wo.z, 1.0);
    float cos_t;
    float plain = dielectric_fresnel_refracted(solid, cosine, cos_t);
    float prob;
    Spectrum fresnel = dielectric_filmed(solid, plain, cosine, prob);
    b.mirrored.weight += fresnel * self_.weights.z;
    if (prob < 1.0) {
        float inv = 1.0 / solid.eta;
        b.through.wi = vec3(-wo.x * inv, -wo.y * inv, -cos_t);
        b.through.weight = solid.tint * (WHITE - fresnel) * (dielectric_eta_scale(solid, mode) * self_.weights.z);
        b.refracted = true;
    }
}

Branches mixture_branches(Mixture self_, vec3 wo, uint mode) {
    Branches b = Branches(NO_BRANCH, NO_BRANCH, NO_BRANCH, false);
    b.mirrored.wi = vec3(-wo.x, -wo.y, wo.z);
    if (mixture_has_metal(self_) && !ggx_is_rough(self_.ggx)) {
        b.mirrored.weight += metal_reflectance(self_.base_color, mixture_film(self_, self_.base_color), wo.z) * self_.weights.x;
    }
    if (mixture_has_base(self_)) {
        b.mirrored.weight += base_mirrored(self_, wo.z) * (HAS_MIXTURE ? self_.weights.y : 1.0);
    }
    if (mixture_has_solid(self_)) {
        solid_branches(self_, wo, mode, b);
    }
    if (mixture_has_thin(self_) && !ggx_is_rough(self_.ggx)) {
        Slab slab = thin_slab(self_.eta, mixture_film_of_wall(self_), self_.base_color, min(wo.z, 1.0));
        b.mirrored.weight += slab.reflected * self_.weights.z;
        b.through = Branch(-wo, slab.transmitted * self_.weights.z);
    }
    return b;
}

// All delta lobes towards `wo`.
Branches bsdf_branches(Bsdf self_, vec3 wo, uint mode) {
    if (wo.z < MIN_COS) {
        return Branches(NO_BRANCH, NO_BRANCH, NO_BRANCH, false);
    }
    Branches b = mixture_branches(self_.mixture, wo, mode);
    if (!bsdf_has_layers(self_)) {
        return b;
    }
    LayersView view = layers_at(self_, wo);
    float coat_alone;
    b.mirrored.weight *= layers_passed(self_, view, b.mirrored.wi, coat_alone);
    b.through.weight *= layers_passed(self_, view, b.through.wi, coat_alone);
    if (self_.here && bsdf_has_coat(self_) && !ggx_is_rough(self_.coat.ggx)) {
        float cosine = dot(self_.coat.normal, wo);
        vec3 wi = mirror_about(wo, self_.coat.normal);
        Spectrum weight = Spectrum(self_.coat.factor * coat_reflectance(cosine));
        if (self_.coat.normal.z == 1.0) {
            b.mirrored.weight += weight;
        } else if (cosine > 0.0 && wi.z > 0.0) {
            b.varnish = Branch(wi, weight);
        }
    }
    return b;
}

// Hemispherical albedo of what is no delta lobe, approximately.
Spectrum bsdf_smooth_albedo(Bsdf self_) {
    Mixture m = self_.mixture;
    Spectrum sum = BLACK;
    bool rough = ggx_is_rough(m.ggx);
    if (mixture_has_metal(m) && rough) {
        sum += metal_albedo(m.base_color, mixture_film(m, m.base_color), m.ggx) * m.weights.x;
    }
    if (mixture_has_base(m)) {
        Spectrum base;
        if (mixture_is_gloss(m)) {
            Phong gloss = mixture_gloss(m);
            base = phong_albedo(gloss) - (phong_is_mirror(gloss) ? gloss.specular : BLACK);
        } else {
            DielectricBase all = mixture_base(m);
            base = dielectric_base_albedo(all);
            if (!rough && !dielectric_base_is_bare(all)) {
                base -= interface_albedo(all.over);
            }
        }
        sum += base * (HAS_MIXTURE ? m.weights.y : 1.0);
    }
    if (mixture_has_solid(m) && ggx_is_rough(dielectric_facets(m.eta, m.ggx))) {
        sum += dielectric_albedo(mixture_solid(m)) * m.weights.z;
    }
    if (mixture_has_thin(m) && rough) {
        sum += thin_albedo(m.eta, mixture_film_of_wall(m), m.base_color) * m.weights.z;
    }
    sum = max(sum, BLACK);
    if (bsdf_has_sheen(self_) && self_.here) {
        sum = sheen_albedo(self_.sheen) + sum * sheen_passed(self_.sheen, sheen_average(self_.sheen));
    }
    if (bsdf_has_coat(self_) && self_.here) {
        float coat = coat_albedo(self_.coat);
        sum = sum * (1.0 - coat) + (ggx_is_rough(self_.coat.ggx) ? Spectrum(coat) : BLACK);
    }
    return min(sum, WHITE);
}

#endif
