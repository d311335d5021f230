// Specialisation constants that switch off what no surface of a scene has, so that its code and its registers are gone from the compiled shader.
// All on by default; a constant may only be false where its condition holds at no point of any surface. Ids 10 to 29 are for BSDFs.
#ifndef FEATURES_GLSL
#define FEATURES_GLSL

// metallic > 0.
layout(constant_id = 10) const bool HAS_METAL = true;
// An opaque dielectric with an interface over its diffuse base: specular > 0 and no gloss.
layout(constant_id = 11) const bool HAS_BASE = true;
// The gloss of MTL.
layout(constant_id = 12) const bool HAS_GLOSS = true;
// The boundary of a solid, whether it transmits or not.
layout(constant_id = 13) const bool HAS_SOLID = true;
// transmission > 0 at a thin wall.
layout(constant_id = 14) const bool HAS_THIN = true;
// A sheen whose colour is not black.
layout(constant_id = 15) const bool HAS_SHEEN = true;
// A coat of factor > 0.
layout(constant_id = 16) const bool HAS_COAT = true;
// A thin film.
layout(constant_id = 17) const bool HAS_FILM = true;
// anisotropy > 0.
layout(constant_id = 18) const bool HAS_ANISOTROPY = true;
// diffuse_roughness > 0.
layout(constant_id = 19) const bool HAS_OREN_NAYAR = true;
// diffuse_transmission > 0.
layout(constant_id = 20) const bool HAS_DIFFUSE_TRANSMISSION = true;
// Diffuse directions are drawn uniformly (a setting, for comparison).
layout(constant_id = 21) const bool HAS_UNIFORM_DIFFUSE = true;

#endif
