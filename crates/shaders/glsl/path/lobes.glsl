// The further lobes of a material at a point: their textures looked up, their frames built. Twin: cpu/src/lobes.rs.
#ifndef PATH_LOBES_GLSL
#define PATH_LOBES_GLSL

#define LOBES(id) push.scene.lobes.at[id]

// Sets the anisotropy and turns the frame so that its x axis lies along it (KHR_materials_anisotropy).
Frame lobes_stretched(uint lobes, Interaction it, Frame frame, inout BsdfParams params) {
    vec2 direction = vec2(1.0, 0.0);
    float strength = 1.0;
    if (HAS_TEXTURES && LOBES(lobes).anisotropy_texture.texture != NONE) {
        vec3 texel = texture_value(LOBES(lobes).anisotropy_texture, it.uv0, it.uv1, LINEAR).rgb;
        direction = vec2(2.0 * texel.r - 1.0, 2.0 * texel.g - 1.0);
        strength = texel.b;
    }
    params.anisotropy = LOBES(lobes).anisotropy * strength;
    // The rotation of the material turns the direction of the texture.
    vec2 cs = LOBES(lobes).anisotropy_direction;
    float x = cs.x * direction.x - cs.y * direction.y;
    float y = cs.y * direction.x + cs.x * direction.y;
    // The bitangent of the mesh lies on the side that its tangents say, seen from the front.
    float side = it.front ? it.bitangent_sign : -it.bitangent_sign;
    return frame_from_normal_tangent(frame.n, frame.t * x + frame.b * (y * side));
}

// Adds what `lobes` says to `params` and returns the shading frame, its x axis along the stretched microfacets.
Frame lobes_add(uint lobes, Interaction it, vec3 wo, vec3 ng, Frame frame, inout BsdfParams params) {
    if (HAS_OREN_NAYAR && LOBES(lobes).diffuse_roughness > 0.0) {
        params.diffuse_roughness =
            LOBES(lobes).diffuse_roughness * TEXTURE(MATERIAL(it.material).metallic_roughness_texture, it, LINEAR).g;
    }
    if (HAS_DIFFUSE_TRANSMISSION && LOBES(lobes).diffuse_transmission > 0.0) {
        params.diffuse_transmission =
            LOBES(lobes).diffuse_transmission * TEXTURE(LOBES(lobes).diffuse_transmission_texture, it, LINEAR).a;
        params.diffuse_transmission_color =
            LOBES(lobes).diffuse_transmission_color * TEXTURE(LOBES(lobes).diffuse_transmission_color_texture, it, SRGB).rgb;
    }
    if (HAS_FILM && LOBES(lobes).iridescence > 0.0) {
        vec2 range = LOBES(lobes).iridescence_thickness_nm;
        params.has_film = true;
        params.film_factor = LOBES(lobes).iridescence * TEXTURE(LOBES(lobes).iridescence_texture, it, LINEAR).r;
        params.film_ior = LOBES(lobes).iridescence_ior;
        params.film_thickness_nm =
            range.x + (range.y - range.x) * TEXTURE(LOBES(lobes).iridescence_thickness_texture, it, LINEAR).g;
    }
    if (HAS_GLOSS && (MATERIAL(it.material).flags & FLAG_PHONG) != 0u) {
        params.has_gloss = true;
        params.gloss_specular = LOBES(lobes).phong_specular * TEXTURE(LOBES(lobes).phong_specular_texture, it, SRGB).rgb;
        params.gloss_exponent = LOBES(lobes).phong_exponent;
        params.gloss_fresnel = (MATERIAL(it.material).flags & FLAG_PHONG_FRESNEL) != 0u;
    }
    if (HAS_SHEEN && !is_black(LOBES(lobes).sheen_color)) {
        params.has_sheen = true;
        params.sheen_color = LOBES(lobes).sheen_color * TEXTURE(LOBES(lobes).sheen_color_texture, it, SRGB).rgb;
        params.sheen_roughness = LOBES(lobes).sheen_roughness * TEXTURE(LOBES(lobes).sheen_roughness_texture, it, LINEAR).a;
    }
    if (HAS_ANISOTROPY && LOBES(lobes).anisotropy > 0.0) {
        frame = lobes_stretched(lobes, it, frame, params);
    }
    if (HAS_COAT && LOBES(lobes).coat > 0.0) {
        vec3 normal = surface_mapped_normal(it, wo, ng, LOBES(lobes).coat_normal_texture, LOBES(lobes).coat_normal_scale);
        params.has_coat = true;
        params.coat_factor = LOBES(lobes).coat * TEXTURE(LOBES(lobes).coat_texture, it, LINEAR).r;
        params.coat_roughness = LOBES(lobes).coat_roughness * TEXTURE(LOBES(lobes).coat_roughness_texture, it, LINEAR).g;
        params.coat_normal = normalize(frame_to_local(frame, normal));
    }
    return frame;
}

#endif
