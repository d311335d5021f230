//! A small scene with something of everything, and edits of it: what a person does in an interactive program, and what a program may do
//! wrong. For tests of what is brought up to date after an edit.

use crate::measure::grey;
use crate::shapes::{cuboid, icosphere, quad, rectangle, smooth_icosphere};
use glam::{Mat4, Vec3};
use lumbre_core::hash::{hash_combine, to_unit};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Camera, Rgb};
use lumbre_scene::{
    AlphaMode, Anisotropy, Background, Clearcoat, Environment, EnvironmentMap, Filter, Image, ImageId, Light,
    LightId, LightKind, Material, MaterialId, Mesh, MeshId, Node, NodeId, Phong, Primitive, Scene, Sheen,
    Sun, Texture, TextureId, TextureRef, Volume, Wrap,
};
use std::sync::Arc;

/// Materials of [`rich`] by name.
pub mod material {
    /// A textured floor with a normal map.
    pub const FLOOR: usize = 0;
    /// A box of metal.
    pub const METAL: usize = 1;
    /// A ball of glass, placed twice.
    pub const GLASS: usize = 2;
    /// A lamp with a picture.
    pub const LAMP: usize = 3;
    /// A sheet with holes.
    pub const SHEET: usize = 4;
    /// A plain ball without texture coordinates.
    pub const PLAIN: usize = 5;
    /// A varnished part of a mesh of two materials.
    pub const COATED: usize = 6;
}

/// Nodes of [`rich`] by name.
pub mod node {
    /// Moves what follows: box, first glass ball and point light.
    pub const GROUP: usize = 0;
    /// The box.
    pub const METAL: usize = 1;
    /// The first glass ball.
    pub const GLASS: usize = 2;
    /// The point light.
    pub const POINT: usize = 3;
    /// The second glass ball.
    pub const OTHER_GLASS: usize = 5;
    /// The lamp.
    pub const LAMP: usize = 6;
    /// The plain ball.
    pub const PLAIN: usize = 8;
    /// The directional light.
    pub const DIRECTIONAL: usize = 11;
}

fn image(seed: u32, width: u32, height: u32) -> Image {
    let texel = |i: u32| (hash_combine(seed, i) | 0x0040_4040).to_le_bytes();
    let rgba8 = (0..width * height).flat_map(texel).collect();
    Image { name: format!("noise {seed}"), width, height, rgba8 }
}

/// An uneven sky.
pub fn map(seed: u32) -> Background {
    let texel = |i: u32| {
        let u = to_unit(hash_combine(seed, i));
        Rgb::new(0.2 + u, 0.5, 0.9 - 0.4 * u)
    };
    Background::Map(EnvironmentMap { width: 8, height: 4, pixels: (0..32).map(texel).collect() })
}

fn materials() -> Vec<Material> {
    let picture = |t: u32| Some(TextureRef::from(TextureId(t)));
    let clearcoat = Clearcoat {
        factor: 0.8,
        texture: None,
        roughness: 0.1,
        roughness_texture: None,
        normal_texture: None,
        normal_scale: 1.0,
    };
    let volume =
        Volume { thickness: 1.0, attenuation_color: Rgb::new(0.9, 0.6, 0.5), attenuation_distance: 0.8 };
    let floor = Material {
        base_color_texture: picture(0),
        normal_texture: picture(1),
        ..Material::diffuse(grey(0.9))
    };
    let lamp = Material { emissive_texture: picture(1), ..Material::emitter(Rgb::new(9.0, 7.0, 5.0), true) };
    let sheet = Material {
        base_color_texture: picture(2),
        alpha_mode: AlphaMode::Mask { cutoff: 0.5 },
        double_sided: true,
        ..Material::default()
    };
    let coated = Material { clearcoat: Some(clearcoat), roughness: 0.6, ..Material::default() };
    vec![
        floor,
        Material::metal(Rgb::new(0.9, 0.7, 0.4), 0.3),
        Material { volume: Some(volume), ..Material::glass(1.5, 0.0) },
        lamp,
        sheet,
        Material { roughness: 0.4, base_color: Rgb::new(0.3, 0.5, 0.7), ..Material::default() },
        coated,
    ]
}

/// Meshes 0 to 6 are floor, box, glass ball, lamp, sheet, plain ball, and one of two parts, the second without a material; 7 is empty, and
/// no node places 8.
fn meshes() -> Vec<Mesh> {
    let of = |shape: Primitive, id: usize| Primitive { material: Some(MaterialId(id as u32)), ..shape };
    let corner = Vec3::new(-0.25, 0.0, -0.25);
    let two = vec![
        of(cuboid(corner, corner + Vec3::new(0.5, 0.4, 0.5)), material::COATED),
        quad(Vec3::new(-0.5, 0.45, -0.2), Vec3::Z * 0.4, Vec3::X),
    ];
    let shapes = [
        vec![of(rectangle(Vec3::ZERO, Vec3::Z * 3.0, Vec3::X * 3.0), material::FLOOR)],
        vec![of(cuboid(Vec3::new(-0.4, 0.0, -0.4), Vec3::new(0.4, 0.9, 0.4)), material::METAL)],
        vec![of(smooth_icosphere(Vec3::ZERO, 0.4, 2), material::GLASS)],
        vec![of(rectangle(Vec3::ZERO, Vec3::X * 0.6, Vec3::Z * 0.4), material::LAMP)],
        vec![of(rectangle(Vec3::ZERO, Vec3::X * 0.5, Vec3::Y * 0.5), material::SHEET)],
        vec![of(smooth_icosphere(Vec3::ZERO, 0.35, 2), material::PLAIN)],
        two,
        vec![],
        vec![of(icosphere(Vec3::ZERO, 1.0, 0), material::METAL)],
    ];
    shapes.into_iter().map(|primitives| Mesh { name: String::new(), primitives }).collect()
}

fn nodes() -> Vec<Node> {
    let at = |x, y, z| Mat4::from_translation(Vec3::new(x, y, z));
    let mesh = |id, transform| Node { mesh: Some(MeshId(id)), transform, ..Node::default() };
    let light = |id, transform| Node { light: Some(LightId(id)), transform, ..Node::default() };
    let children = [node::METAL, node::GLASS, node::POINT].map(|id| NodeId(id as u32)).to_vec();
    vec![
        Node { children, transform: at(-0.3, 0.0, 0.2), ..Node::default() },
        mesh(1, at(-0.9, 0.0, -0.4) * Mat4::from_rotation_y(0.4)),
        mesh(2, at(0.2, 0.4, 0.8)),
        light(0, at(-1.2, 1.6, 1.3)),
        mesh(0, Mat4::IDENTITY),
        mesh(2, at(1.3, 0.6, 0.9) * Mat4::from_scale(Vec3::new(1.2, 0.8, -1.0))),
        mesh(3, at(0.2, 2.3, -0.4)),
        mesh(4, at(0.8, 0.5, 1.4) * Mat4::from_rotation_y(0.3)),
        mesh(5, at(0.9, 0.35, -0.4)),
        mesh(6, at(-0.2, 0.0, 1.3)),
        light(1, at(1.5, 2.0, 1.0) * Mat4::from_rotation_x(-1.1)),
        light(2, Mat4::from_rotation_x(-0.8)),
        mesh(7, Mat4::IDENTITY),
    ]
}

/// Every kind of light over glass, metal, holes, varnish, textures, a normal map, shared meshes and a group.
pub fn rich() -> Scene {
    let light = |kind, intensity| Light { name: String::new(), kind, intensity };
    let texture = |image, filter| Texture {
        image: ImageId(image),
        wrap_s: Wrap::Repeat,
        wrap_t: Wrap::MirroredRepeat,
        filter,
    };
    let sun = Sun { elevation: 0.9, azimuth: 0.6, irradiance: Rgb::new(1.5, 1.4, 1.2), angular_radius: 0.05 };
    Scene {
        name: "rich".into(),
        meshes: meshes().into(),
        materials: materials(),
        textures: vec![texture(0, Filter::Linear), texture(1, Filter::Linear), texture(0, Filter::Nearest)],
        images: vec![image(1, 8, 8), image(2, 5, 3)].into(),
        lights: vec![
            light(LightKind::Point, Rgb::new(2.0, 2.0, 3.0)),
            light(LightKind::Spot { inner_angle: 0.2, outer_angle: 0.6 }, Rgb::new(9.0, 8.0, 3.0)),
            light(LightKind::Directional, Rgb::new(0.6, 0.9, 0.7)),
        ],
        nodes: nodes(),
        roots: [0, 4, 5, 6, 7, 8, 9, 10, 11, 12].map(NodeId).to_vec(),
        environment: Environment { background: map(5), rotation: 0.7, strength: 1.0, sun: Some(sun) },
        ..Scene::default()
    }
}

/// The view of [`rich`].
pub fn view(aspect: f32) -> View {
    let camera = Camera::look_at(Vec3::new(0.4, 1.7, 4.4), Vec3::new(0.0, 0.6, 0.0), Vec3::Y, 0.8, aspect);
    View { camera, settings: RenderSettings::default(), frame: 0 }
}

/// An edit by name.
pub type Edit = (&'static str, fn(&mut Scene));

/// Edits that an interactive program offers, each of which changes the picture of [`rich`].
pub const EDITS: &[Edit] = &[
    ("a colour", |s| s.materials[material::METAL].base_color = Rgb::new(0.2, 0.8, 0.4)),
    ("a floor without its normal map", |s| s.materials[material::FLOOR].normal_texture = None),
    ("a metal with holes", |s| {
        let m = &mut s.materials[material::METAL];
        m.alpha_mode = AlphaMode::Mask { cutoff: 0.6 };
        m.base_color_texture = Some(TextureId(1).into());
    }),
    ("a sheet without holes", |s| s.materials[material::SHEET].alpha_mode = AlphaMode::Opaque),
    ("half a ball", |s| {
        let m = &mut s.materials[material::PLAIN];
        (m.alpha_mode, m.alpha) = (AlphaMode::Blend, 0.5);
    }),
    ("a box that glows", |s| s.materials[material::METAL].emission = Rgb::new(0.5, 2.0, 1.0)),
    ("a lamp that is off", |s| s.materials[material::LAMP].emission = Rgb::BLACK),
    ("a brighter lamp", |s| s.materials[material::LAMP].emission = grey(20.0)),
    ("glass to plaster", |s| s.materials[material::GLASS] = Material::diffuse(grey(0.7))),
    ("plastic to glass", |s| s.materials[material::PLAIN] = Material::glass(1.4, 0.1)),
    ("no varnish", |s| s.materials[material::COATED].clearcoat = None),
    ("varnish with a hole", |s| {
        let m = &mut s.materials[material::COATED];
        (m.alpha_mode, m.base_color_texture) = (AlphaMode::Mask { cutoff: 0.6 }, Some(TextureId(1).into()));
    }),
    ("varnish on both sides", |s| {
        let m = &mut s.materials[material::COATED];
        (m.double_sided, m.base_color) = (true, grey(0.3));
    }),
    ("cloth", |s| {
        let color = Rgb::new(0.9, 0.3, 0.2);
        let sheen = Sheen { color, color_texture: None, roughness: 0.4, roughness_texture: None };
        s.materials[material::PLAIN].sheen = Some(sheen);
    }),
    ("brushed metal", |s| {
        s.materials[material::METAL].anisotropy =
            Some(Anisotropy { strength: 0.8, rotation: 0.3, texture: None });
    }),
    ("a shadow catcher", |s| s.materials[material::FLOOR].shadow_catcher = true),
    ("the strength of a lamp", |s| s.lights[0].intensity = grey(7.0)),
    ("a lamp that gives nothing", |s| s.lights[0].intensity = Rgb::BLACK),
    ("a spot to a point", |s| s.lights[1].kind = LightKind::Point),
    ("one more light", |s| {
        s.lights.push(Light { name: String::new(), kind: LightKind::Point, intensity: grey(5.0) });
        let (light, transform) = (Some(LightId(3)), Mat4::from_translation(Vec3::new(1.0, 1.0, 2.0)));
        s.add_root(Node { light, transform, ..Node::default() });
    }),
    ("a light less", |s| s.nodes[node::DIRECTIONAL].light = None),
    ("a box moved", |s| s.nodes[node::METAL].transform *= Mat4::from_translation(Vec3::new(0.3, 0.1, 0.5))),
    ("a group moved", |s| s.nodes[node::GROUP].transform = Mat4::from_translation(Vec3::new(0.4, 0.0, 0.0))),
    ("a ball mirrored", |s| {
        s.nodes[node::OTHER_GLASS].transform *= Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0))
    }),
    ("a lamp moved", |s| s.nodes[node::LAMP].transform *= Mat4::from_translation(Vec3::new(0.8, -0.6, 0.4))),
    ("a ball pressed flat", |s| s.nodes[node::PLAIN].transform *= Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0))),
    ("a hidden box", |s| s.nodes[node::METAL].visible = false),
    ("a hidden group", |s| s.nodes[node::GROUP].visible = false),
    ("a hidden lamp", |s| s.nodes[node::LAMP].visible = false),
    ("a hidden light", |s| s.nodes[node::DIRECTIONAL].visible = false),
    ("a box copied", |s| {
        let transform = Mat4::from_translation(Vec3::new(1.5, 0.0, -1.0));
        s.add_root(Node { mesh: Some(MeshId(1)), transform, ..Node::default() });
    }),
    ("a weaker sky", |s| s.environment.strength = 0.3),
    ("a turned sky", |s| s.environment.rotation = 2.0),
    ("another sky", |s| s.environment.background = map(9)),
    ("no sky", |s| s.environment.background = Background::Black),
    ("no sun", |s| s.environment.sun = None),
    ("a sharp texture", |s| s.textures[0].filter = Filter::Nearest),
];

/// Edits that make arrays grow or change what nobody offers to change: meshes, images, lists of materials.
pub const DEEP_EDITS: &[Edit] = &[
    ("another mesh", |s| Arc::make_mut(&mut s.meshes)[1].primitives[0].positions[0].y -= 0.2),
    ("another image", |s| Arc::make_mut(&mut s.images)[0].rgba8[0] ^= 0x55),
    ("one more material", |s| _ = s.add_material(Material::diffuse(grey(0.4)))),
    ("one more texture", |s| {
        s.textures.push(Texture { image: ImageId(1), wrap_s: Wrap::ClampToEdge, ..s.textures[0] });
        s.materials[material::PLAIN].base_color_texture = Some(TextureId(s.textures.len() as u32 - 1).into());
    }),
    ("another order", |s| s.roots.reverse()),
    ("another mesh at a node", |s| s.nodes[node::METAL].mesh = Some(MeshId(8))),
    ("an empty mesh", |s| s.nodes[node::METAL].mesh = Some(MeshId(7))),
];

/// Numbers for random edits.
#[derive(Clone, Copy, Debug)]
pub struct Random(u32);

impl Random {
    /// A stream.
    pub fn new(seed: u32) -> Self {
        Random(hash_combine(seed, 77))
    }
    /// A number below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        self.0 = hash_combine(self.0, 1);
        ((u64::from(self.0) * n as u64) >> 32) as usize
    }
    /// A number from 0 to 1.
    pub fn unit(&mut self) -> f32 {
        self.0 = hash_combine(self.0, 2);
        to_unit(self.0)
    }
    fn flag(&mut self) -> bool {
        self.below(2) == 0
    }
    /// Often something plain, now and then what must be brought into its domain.
    fn value(&mut self) -> f32 {
        const ODD: [f32; 8] = [0.0, -0.0, 1.0, -1.0, f32::NAN, f32::INFINITY, 1e30, 1e-30];
        if self.below(4) == 0 { ODD[self.below(ODD.len())] } else { self.unit() }
    }
    fn color(&mut self) -> Rgb {
        Rgb::new(self.value(), self.value(), self.value())
    }
    /// A texture that there is, or now and then is not.
    fn texture(&mut self, scene: &Scene) -> Option<TextureRef> {
        let over = usize::from(self.below(40) == 0);
        let texture = TextureId(self.below(scene.textures.len() + over) as u32);
        let uv_set = self.below(2) as u32;
        self.flag().then_some(TextureRef { uv_set, ..TextureRef::from(texture) })
    }
}

/// Changes one thing of a scene, anything; what results may not compile.
pub fn change(scene: &mut Scene, r: &mut Random) {
    match r.below(12) {
        0..=3 => change_material(scene, r),
        4 | 5 => change_node(scene, r),
        6 => change_light(scene, r),
        7 => change_environment(scene, r),
        8 => change_texture(scene, r),
        9 | 10 => EDITS[r.below(EDITS.len())].1(scene),
        _ => DEEP_EDITS[r.below(DEEP_EDITS.len())].1(scene),
    }
}

fn change_material(scene: &mut Scene, r: &mut Random) {
    let texture = r.texture(scene);
    let (id, other) = (r.below(scene.materials.len()), r.below(scene.materials.len()));
    let other = scene.materials[other].clone();
    let m = &mut scene.materials[id];
    match r.below(22) {
        0 => m.base_color = r.color(),
        1 => m.alpha = r.value(),
        2 => m.base_color_texture = texture,
        3 => m.metallic = r.value(),
        4 => m.roughness = r.value(),
        5 => m.normal_texture = texture,
        6 => m.emission = r.color(),
        7 => m.emissive_texture = texture,
        8 => {
            let modes = [AlphaMode::Opaque, AlphaMode::Blend, AlphaMode::Mask { cutoff: r.value() }];
            m.alpha_mode = modes[r.below(3)];
        }
        9 => m.double_sided = r.flag(),
        10 => m.unlit = r.flag(),
        11 => m.ior = r.value(),
        12 => m.specular_color = r.color(),
        13 => m.transmission = r.value(),
        14 => {
            let (thickness, attenuation_color, attenuation_distance) = (r.value(), r.color(), r.value());
            m.volume = r.flag().then_some(Volume { thickness, attenuation_color, attenuation_distance });
        }
        15 => m.dispersion = r.value(),
        16 => {
            let (strength, rotation) = (r.value(), r.value());
            m.anisotropy = r.flag().then_some(Anisotropy { strength, rotation, texture });
        }
        17 => {
            let (color, roughness) = (r.color(), r.value());
            let sheen = Sheen { color, color_texture: texture, roughness, roughness_texture: None };
            m.sheen = r.flag().then_some(sheen);
        }
        18 => {
            let coat = Clearcoat {
                factor: r.value(),
                texture: None,
                roughness: r.value(),
                roughness_texture: None,
                normal_texture: texture,
                normal_scale: 1.0,
            };
            m.clearcoat = r.flag().then_some(coat);
        }
        19 => {
            let (specular, exponent, fresnel) = (r.color(), 100.0 * r.value(), r.flag());
            m.phong = r.flag().then_some(Phong { specular, specular_texture: texture, exponent, fresnel });
        }
        20 => m.shadow_catcher = r.flag(),
        _ => *m = other,
    }
}

fn change_node(scene: &mut Scene, r: &mut Random) {
    let meshes = scene.meshes.len() + usize::from(r.below(40) == 0);
    let (mesh, light) = (MeshId(r.below(meshes) as u32), LightId(r.below(scene.lights.len() + 1) as u32));
    let nodes = scene.nodes.len();
    let id = r.below(nodes);
    let n = &mut scene.nodes[id];
    match r.below(10) {
        0 | 1 => n.transform *= Mat4::from_translation(Vec3::new(r.unit(), r.unit(), r.unit()) - 0.5),
        2 => n.transform *= Mat4::from_scale(Vec3::new(r.unit() - 0.5, 1.0, 1.0)),
        3 => n.transform = Mat4::from_rotation_y(6.0 * r.unit()) * r.value(),
        4 | 5 => n.visible = r.flag(),
        6 => n.mesh = r.flag().then_some(mesh),
        7 => n.light = r.flag().then_some(light),
        8 => n.children.push(NodeId(r.below(nodes) as u32)),
        _ => _ = scene.roots.pop(),
    }
}

fn change_light(scene: &mut Scene, r: &mut Random) {
    let id = r.below(scene.lights.len());
    let light = &mut scene.lights[id];
    if r.flag() {
        light.intensity = r.color();
    } else {
        let spot = LightKind::Spot { inner_angle: r.unit(), outer_angle: 1.0 + r.unit() };
        light.kind = [LightKind::Point, LightKind::Directional, spot][r.below(3)];
    }
}

fn change_environment(scene: &mut Scene, r: &mut Random) {
    let e = &mut scene.environment;
    match r.below(7) {
        0 => e.rotation = r.value(),
        1 => e.strength = r.value(),
        2 => {
            let (elevation, azimuth, irradiance) = (r.unit(), r.unit(), r.color());
            let sun = Sun { elevation, azimuth, irradiance, angular_radius: 0.01 + r.unit() };
            e.sun = r.flag().then_some(sun);
        }
        3 => e.background = Background::Constant(r.color()),
        4 => e.background = [Background::Gradient, Background::Black][r.below(2)].clone(),
        _ => e.background = map(r.below(3) as u32),
    }
}

fn change_texture(scene: &mut Scene, r: &mut Random) {
    let images = scene.images.len() + usize::from(r.below(20) == 0);
    let id = r.below(scene.textures.len());
    let t = &mut scene.textures[id];
    match r.below(3) {
        0 => t.filter = [Filter::Linear, Filter::Nearest][r.below(2)],
        1 => t.wrap_s = [Wrap::Repeat, Wrap::ClampToEdge, Wrap::MirroredRepeat][r.below(3)],
        _ => t.image = ImageId(r.below(images) as u32),
    }
}
