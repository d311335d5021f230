// The records of CompiledScene and the tables that say where they lie, as shaders read them.
// Twins: scene/src/compiled/{geometry,lights,material,texture}.rs and shaders/src/layout.rs; a test compares every offset.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require
#ifndef SCENE_LAYOUT_GLSL
#define SCENE_LAYOUT_GLSL

// An index that points nowhere.
const uint NONE = 0xffffffffu;

struct Vertex {
    vec4 tangent;
    vec2 uv[2];
    vec4 color;
};

// Bits of MeshTable.attributes.
const uint ATTRIBUTE_NORMAL = 1u;
const uint ATTRIBUTE_TANGENT = 2u;
const uint ATTRIBUTE_UV = 4u;
const uint ATTRIBUTE_COLOR = 8u;

struct InstanceRecord {
    uint mesh;
    uint first_transform;
    uint transform_count;
    uint first_light;
    uint mask;
    uint node;
};

// Rows of 3x4 matrices.
struct TransformKey {
    vec4 object_to_world[3];
    vec4 world_to_object[3];
    float handedness;
    float scale;
    float time;
};

// Kinds of lights.
const uint LIGHT_TRIANGLE = 0u;
const uint LIGHT_POINT = 1u;
const uint LIGHT_SPOT = 2u;
const uint LIGHT_DIRECTIONAL = 3u;
const uint LIGHT_SUN = 4u;
const uint LIGHT_ENVIRONMENT = 5u;

struct LightRecord {
    uint kind;
    uint index;
};

struct TriangleLightRecord {
    vec3 p0;
    vec3 e1;
    vec3 e2;
    vec3 radiance;
    uint instance;
    uint triangle;
    float side;
    uint textured;
};

struct PunctualRecord {
    vec3 intensity;
    vec3 position;
    vec3 axis;
    float cos_inner;
    float cos_outer;
};

struct SunRecord {
    vec3 direction;
    float one_minus_cos;
    vec3 radiance;
    uint light;
};

struct EnvironmentRecord {
    uint width;
    uint height;
    float rotation;
    uint light;
};

// Bits of MaterialRecord.flags.
const uint FLAG_DOUBLE_SIDED = 1u;
const uint FLAG_UNLIT = 2u;
const uint FLAG_ALPHA_MASK = 4u;
const uint FLAG_ALPHA_BLEND = 8u;
const uint FLAG_SOLID = 16u;
const uint FLAG_EMISSIVE = 32u;
const uint FLAG_SHADOW_CATCHER = 64u;
const uint FLAG_PHONG = 128u;
const uint FLAG_PHONG_FRESNEL = 256u;
const uint FLAG_DIFFUSE_TRANSMISSION = 512u;
const uint FLAG_DISPERSION = 1024u;

// How a material uses a texture.
struct TextureUse {
    uint texture;
    uint uv_set;
    vec3 transform[2];
};

struct MaterialRecord {
    vec3 base_color;
    float alpha;
    vec3 emission;
    float alpha_cutoff;
    vec3 specular_color;
    float specular;
    vec3 absorption;
    float ior;
    float metallic;
    float roughness;
    float transmission;
    float normal_scale;
    uint flags;
    uint lobes;
    TextureUse base_color_texture;
    TextureUse metallic_roughness_texture;
    TextureUse normal_texture;
    TextureUse emissive_texture;
    TextureUse specular_texture;
    TextureUse specular_color_texture;
    TextureUse transmission_texture;
};

struct LobesRecord {
    float coat;
    float coat_roughness;
    float coat_normal_scale;
    float sheen_roughness;
    vec3 sheen_color;
    float anisotropy;
    vec2 anisotropy_direction;
    float iridescence;
    float iridescence_ior;
    vec2 iridescence_thickness_nm;
    float dispersion;
    float diffuse_roughness;
    vec3 diffuse_transmission_color;
    float diffuse_transmission;
    vec3 phong_specular;
    float phong_exponent;
    TextureUse coat_texture;
    TextureUse coat_roughness_texture;
    TextureUse coat_normal_texture;
    TextureUse sheen_color_texture;
    TextureUse sheen_roughness_texture;
    TextureUse anisotropy_texture;
    TextureUse iridescence_texture;
    TextureUse iridescence_thickness_texture;
    TextureUse diffuse_transmission_texture;
    TextureUse diffuse_transmission_color_texture;
    TextureUse phong_specular_texture;
};

// Values of TextureTable.wrap_s and wrap_t.
const uint WRAP_REPEAT = 0u;
const uint WRAP_MIRRORED_REPEAT = 1u;
const uint WRAP_CLAMP_TO_EDGE = 2u;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Words {
    uint at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Floats {
    float at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vectors {
    vec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Triangles {
    uvec3 at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vertices {
    Vertex at[];
};

struct GeometryRecord {
    Words triangle_ids;
    uint instance;
    uint mesh;
};

struct MeshTable {
    Triangles triangles;
    Words triangle_materials;
    Vectors positions;
    Vectors normals;
    Vertices vertices;
    uint first_emissive_rank;
    uint attributes;
};

struct TextureTable {
    Words texels;
    uint width;
    uint height;
    uint wrap_s;
    uint wrap_t;
    uint nearest;
    uint unused;
};

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Geometries {
    GeometryRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Meshes {
    MeshTable at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Instances {
    InstanceRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Transforms {
    TransformKey at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Materials {
    MaterialRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer LobesRecords {
    LobesRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Textures {
    TextureTable at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Lights {
    LightRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TriangleLights {
    TriangleLightRecord at[];
};
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PunctualLights {
    PunctualRecord at[];
};

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SceneTable {
    Geometries geometries;
    Meshes meshes;
    Instances instances;
    Transforms transforms;
    Materials materials;
    LobesRecords lobes;
    Textures textures;
    Words emissive_ranks;
    Lights lights;
    Floats near_light_cdf;
    Floats far_light_cdf;
    TriangleLights triangle_lights;
    PunctualLights punctual_lights;
    Vectors environment_pixels;
    Floats environment_row_cdf;
    Floats environment_cell_cdf;
    uint near_lights;
    uint far_lights;
    SunRecord sun;
    EnvironmentRecord environment;
};

// The classes of hits and the kinds of rays: their places in the shader binding table.
const uint RAY_KINDS = 2u;
const uint RAY_RADIANCE = 0u;
const uint RAY_SHADOW = 1u;

#endif
