//! Structs that shaders and Rust share lie in memory alike: every member of every struct in the SPIR-V of the path tracer and of the passes after it stands where Rust
//! puts the field of that name.

use lumbre_scene::compiled::geometry::{InstanceRecord, TransformKey, Vertex};
use lumbre_scene::compiled::lights::{
    EnvironmentRecord, LightRecord, PunctualRecord, SunRecord, TriangleLightRecord,
};
use lumbre_scene::compiled::material::{LobesRecord, MaterialRecord, TextureUse};
use lumbre_shaders::camera::CameraRecord;
use lumbre_shaders::hybrid::{FrameHeads, FramePush, FrameTable};
use lumbre_shaders::layout::{GeometryRecord, MeshTable, SceneTable, TextureTable};
use lumbre_shaders::medium::MediumStackRecord;
use lumbre_shaders::post::PostPush;
use lumbre_shaders::replay::{CollectPush, ReplayHit, ReplayRay};
use lumbre_shaders::tables::Tables;
use lumbre_shaders::view::{Push, QueueHead, QueueHeads, ViewTable};
use rspirv::dr::{Module, Operand};
use rspirv::spirv::{Decoration, Op};
use std::collections::BTreeMap;
use std::mem::offset_of;

/// Members of a struct by name, with their offsets.
type Members = BTreeMap<String, u32>;

/// A struct of Rust: its name in shaders and its fields; the pattern names all, so that none is forgotten.
macro_rules! fields {
    ($shader:literal, $rust:ident { $($field:ident),* $(,)? }) => {{
        #[expect(dead_code, reason = "it is there to be compiled")]
        fn all_are_named(x: &$rust) {
            let $rust { $($field: _),* } = x;
        }
        let members: Members =
            [$((stringify!($field).to_owned(), offset_of!($rust, $field) as u32)),*].into_iter().collect();
        ($shader, members)
    }};
}

#[rustfmt::skip]
fn rust() -> Vec<(&'static str, Members)> {
    vec![
        fields!("SceneTable", SceneTable { geometries, meshes, instances, transforms, materials, lobes, textures, emissive_ranks,
            lights, near_light_cdf, far_light_cdf, triangle_lights, punctual_lights, environment_pixels, environment_row_cdf,
            environment_cell_cdf, near_lights, far_lights, sun, environment }),
        fields!("GeometryRecord", GeometryRecord { triangle_ids, instance, mesh }),
        fields!("MeshTable", MeshTable { triangles, triangle_materials, positions, normals, vertices, first_emissive_rank, attributes }),
        fields!("TextureTable", TextureTable { texels, width, height, wrap_s, wrap_t, nearest, unused }),
        fields!("Vertex", Vertex { tangent, uv, color }),
        fields!("InstanceRecord", InstanceRecord { mesh, first_transform, transform_count, first_light, mask, node }),
        fields!("TransformKey", TransformKey { object_to_world, world_to_object, handedness, scale, time }),
        fields!("LightRecord", LightRecord { kind, index }),
        fields!("TriangleLightRecord", TriangleLightRecord { p0, e1, e2, radiance, instance, triangle, side, textured }),
        fields!("PunctualRecord", PunctualRecord { intensity, position, axis, cos_inner, cos_outer }),
        fields!("SunRecord", SunRecord { direction, one_minus_cos, radiance, light }),
        fields!("EnvironmentRecord", EnvironmentRecord { width, height, rotation, light }),
        fields!("TextureUse", TextureUse { texture, uv_set, transform }),
        fields!("MaterialRecord", MaterialRecord { base_color, alpha, emission, alpha_cutoff, specular_color, specular, absorption, ior,
            metallic, roughness, transmission, normal_scale, flags, lobes, base_color_texture, metallic_roughness_texture,
            normal_texture, emissive_texture, specular_texture, specular_color_texture, transmission_texture }),
        fields!("LobesRecord", LobesRecord { coat, coat_roughness, coat_normal_scale, sheen_roughness, sheen_color, anisotropy,
            anisotropy_direction, iridescence, iridescence_ior, iridescence_thickness_nm, dispersion, diffuse_roughness,
            diffuse_transmission_color, diffuse_transmission, phong_specular, phong_exponent, coat_texture, coat_roughness_texture,
            coat_normal_texture, sheen_color_texture, sheen_roughness_texture, anisotropy_texture, iridescence_texture,
            iridescence_thickness_texture, diffuse_transmission_texture, diffuse_transmission_color_texture,
            phong_specular_texture }),
        fields!("CameraRecord", CameraRecord { origin, right, up, forward, projection, half_height, aspect, lens_radius, focus_distance }),
        fields!("MediumStack", MediumStackRecord { material, ior }),
        fields!("QueueHead", QueueHead { count, one_row, one_layer, unused }),
        fields!("QueueHeads", QueueHeads { at, groups, path_rays, shadow_rays }),
        fields!("ViewTable", ViewTable { film, non_finite, state, queues, heads, picture, origin, size, capacity, seed, frame, max_depth, roulette, clamp_to,
            filter_kind, object_colors, rough_bounces, camera, media }),
        fields!("PostPush", PostPush { film, blocks, state, display, size, block_side, block_count, exposure, factor, ease, tone, vignette,
            center, half_diagonal, aberrates, shrinks, transparent }),
        fields!("Push", Push { tables, scene, view, first_pixel, size, first_sample, sample_count, parity, group }),
        fields!("Tables", Tables { albedo_deficit, albedo_schlick_excess, albedo_deficit_average, albedo_schlick_average,
            sheen_directional, sheen_average, aniso_deficit, aniso_schlick_residual, aniso_deficit_average, aniso_schlick_average,
            wavelength_response, wavelength_cdf, filter_distance, srgb_decode }),
    ]
}

/// The structs of a module that lie in memory.
fn shader(module: &Module) -> BTreeMap<String, Members> {
    let text = |o: &Operand| o.unwrap_literal_string().to_owned();
    let mut names = BTreeMap::new();
    let mut members = BTreeMap::new();
    for i in &module.debug_names {
        let id = i.operands[0].unwrap_id_ref();
        match i.class.opcode {
            Op::Name => drop(names.insert(id, text(&i.operands[1]))),
            Op::MemberName => {
                drop(members.insert((id, i.operands[1].unwrap_literal_bit32()), text(&i.operands[2])));
            }
            _ => {}
        }
    }
    let mut structs: BTreeMap<String, Members> = BTreeMap::new();
    for i in &module.annotations {
        let is_offset = i.class.opcode == Op::MemberDecorate
            && matches!(i.operands[2], Operand::Decoration(Decoration::Offset));
        if is_offset {
            let key = (i.operands[0].unwrap_id_ref(), i.operands[1].unwrap_literal_bit32());
            let offset = i.operands[3].unwrap_literal_bit32();
            structs.entry(names[&key.0].clone()).or_default().insert(members[&key].clone(), offset);
        }
    }
    structs
}

/// What differs.
fn differences(structs: &BTreeMap<String, Members>, rust: &[(&str, Members)]) -> Vec<String> {
    let mut found = Vec::new();
    for (name, fields) in rust {
        match structs.get(*name) {
            None => found.push(format!("no struct {name} in the shader")),
            Some(members) if members != fields => found.push(format!("{name}: {members:?} but {fields:?}")),
            Some(_) => {}
        }
    }
    found
}

fn shaders() -> BTreeMap<String, Members> {
    let load = |spirv| shader(&rspirv::dr::load_bytes(spirv).expect("SPIR-V"));
    let mut structs = load(lumbre_shaders::POST_DEVELOP);
    structs.extend(load(lumbre_shaders::passes::SHADE));
    structs
}

#[test]
fn shared_structs_lie_alike() {
    let found = differences(&shaders(), &rust());
    assert!(found.is_empty(), "{found:#?}");
}

/// What the shader that collects rays is told, and what it writes.
#[test]
fn collected_rays_lie_alike() {
    let structs = shader(&rspirv::dr::load_bytes(lumbre_shaders::replay::COLLECT).expect("SPIR-V"));
    let mut push = rust().into_iter().find(|(name, _)| *name == "Push").unwrap().1;
    push.insert("rays".to_owned(), offset_of!(CollectPush, rays) as u32);
    push.insert("hits".to_owned(), offset_of!(CollectPush, hits) as u32);
    let mut rust = vec![
        ("Push", push),
        fields!("ReplayRay", ReplayRay { origin, t_min, dir, t_max, kind, key }),
        fields!("ReplayHit", ReplayHit { t, instance, triangle, b }),
    ];
    assert_eq!(differences(&structs, &rust), Vec::<String>::new());
    *rust[1].1.get_mut("key").unwrap() += 4;
    assert_eq!(differences(&structs, &rust).len(), 1);
}

/// What the passes of a hybrid frame are told.
#[test]
#[rustfmt::skip]
fn frames_lie_alike() {
    let structs = shader(&rspirv::dr::load_bytes(lumbre_shaders::hybrid::passes::PLANES).expect("SPIR-V"));
    let mut push = rust().into_iter().find(|(name, _)| *name == "Push").unwrap().1;
    push.insert("frame".to_owned(), offset_of!(FramePush, frame) as u32);
    let mut rust = vec![
        ("Push", push),
        fields!("FrameTable", FrameTable { ids, planes, rays, shadows, glass, heads, sums, measured, sharp_lights, previous_planes, soft, soft_history,
            moments, drawn, shown, previous_transforms, sharp_light_count, ray_capacity, shadow_capacity, depth, jitter, previous_jitter, far,
            near, ambient, occlusion_reach, previous, shown_size, turn, has_history, is_still, ambient_is_given, unused }),
        fields!(
            "FrameHeads",
            FrameHeads { rays, shadows, glass, groups, traced_rays, traced_shadows, dropped }
        ),
    ];
    assert_eq!(differences(&structs, &rust), Vec::<String>::new());
    *rust[1].1.get_mut("near").unwrap() += 4;
    assert_eq!(differences(&structs, &rust).len(), 1);
}

#[test]
fn a_member_that_moved_is_found() {
    for (moved, (name, fields)) in rust().iter().enumerate() {
        for field in fields.keys() {
            let mut disturbed = rust();
            *disturbed[moved].1.get_mut(field).unwrap() += 4;
            assert_eq!(differences(&shaders(), &disturbed).len(), 1, "{name}.{field}");
        }
    }
    assert_eq!(differences(&BTreeMap::new(), &rust()).len(), rust().len());
}

/// Numbers that both sides write down.
#[test]
fn shared_constants_are_the_same() {
    let glsl = |file: &str, name: &str| -> u64 {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("glsl").join(file);
        let text = std::fs::read_to_string(path).unwrap();
        let start = format!("const uint {name} = ");
        let value = text
            .lines()
            .find_map(|l| l.strip_prefix(&start))
            .unwrap_or_else(|| panic!("no {name} in {file}"));
        value.split('u').next().unwrap().parse().unwrap()
    };
    let [plain, solids] = lumbre_shaders::view::STATE_QUADS;
    assert_eq!(glsl("path/state.glsl", "STATE_QUADS_PLAIN"), plain);
    assert_eq!(glsl("path/state.glsl", "STATE_QUADS"), solids);
    assert_eq!(glsl("path/push.glsl", "QUEUES"), lumbre_shaders::view::QUEUES as u64);
    let queue = |name| glsl("path/push.glsl", name);
    use lumbre_shaders::view::queue::{CATCHERS, GLASS, PATHS, SHADOW};
    let lists = [queue("QUEUE_PATHS"), queue("QUEUE_SHADOW"), queue("QUEUE_GLASS"), queue("QUEUE_CATCHERS")];
    assert_eq!(lists, [PATHS, SHADOW, GLASS, CATCHERS].map(u64::from));
    let frame = |name| glsl("hybrid/frame.glsl", name);
    use lumbre_shaders::hybrid::{
        CHANNELS, MOST_SHARP, PLANE_QUADS, PREVIOUS_QUADS, RAY_QUADS, SHADOW_QUADS,
    };
    assert_eq!(frame("CHANNELS"), CHANNELS);
    assert_eq!([frame("PLANE_QUADS"), frame("PREVIOUS_QUADS")], [PLANE_QUADS, PREVIOUS_QUADS]);
    assert_eq!([frame("RAY_QUADS_PLAIN"), frame("RAY_QUADS")], RAY_QUADS);
    assert_eq!([frame("SHADOW_QUADS_PLAIN"), frame("SHADOW_QUADS")], SHADOW_QUADS);
    assert_eq!(glsl("hybrid/sharp_lights.glsl", "MOST_SHARP"), u64::from(MOST_SHARP));
    assert_eq!(glsl("scene/layout.glsl", "RAY_KINDS"), u64::from(lumbre_shaders::layout::RAY_KINDS));
}
