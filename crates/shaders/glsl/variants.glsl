// What a pipeline is specialised for: settings of the render, and what its scene has. What is switched off costs nothing.
// Twin: vulkan/src/path/variant.rs, which sets them. Ids 10 to 29 belong to bsdf/features.glsl, 30 to 49 to the random stream, camera and filter.
#ifndef VARIANTS_GLSL
#define VARIANTS_GLSL

// Settings.
layout(constant_id = 0) const bool LIGHT_SAMPLING = true;
layout(constant_id = 1) const uint TRANSMISSIVE_SHADOWS = 0u;
layout(constant_id = 2) const bool SHADE_BACK_FACES = false;
layout(constant_id = 3) const bool TRANSPARENT_BACKGROUND = false;
layout(constant_id = 4) const bool CLAMPED = true;

// The scene.
layout(constant_id = 50) const bool HAS_NEAR_LIGHTS = true;
layout(constant_id = 51) const bool HAS_FAR_LIGHTS = true;
layout(constant_id = 52) const bool HAS_TRIANGLE_LIGHTS = true;
layout(constant_id = 53) const bool HAS_PUNCTUAL_LIGHTS = true;
layout(constant_id = 54) const bool HAS_SUN = true;
layout(constant_id = 55) const bool HAS_ENVIRONMENT = true;
layout(constant_id = 56) const bool HAS_TEXTURES = true;
layout(constant_id = 57) const bool HAS_NORMAL_MAPS = true;
layout(constant_id = 58) const bool HAS_CATCHERS = true;
layout(constant_id = 59) const bool HAS_DISPERSION = true;
layout(constant_id = 60) const bool HAS_TRANSMISSION = true;
layout(constant_id = 61) const bool HAS_LOBES = true;
layout(constant_id = 62) const bool HAS_UNLIT = true;
layout(constant_id = 63) const bool HAS_COVERED = true;

// Values of TRANSMISSIVE_SHADOWS.
const uint SHADOWS_AUTO = 0u;
const uint SHADOWS_PHYSICAL = 1u;
const uint SHADOWS_STRAIGHT = 2u;

#endif
