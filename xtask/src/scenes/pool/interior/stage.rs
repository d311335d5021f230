//! Puts things of the changing room into the scene: from the room's coordinates into the scene's, with a finish by name.

use super::textures;
use crate::scenes::kit::{Material, Mesh, Placement, Texture};
use crate::scenes::pool::{Pool, surfaces};
use glam::DVec3;
use serde_json::json;

/// What a thing is made of.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Finish {
    Formwork,
    Concrete,
    /// As the other buildings outside, and their roofs.
    Outside,
    Roof,
    Screed,
    Birch,
    Pallet,
    Turquoise,
    White,
    Enamel,
    Paint,
    DoorPaint,
    CabinetPaint,
    Steel,
    Light,
    Glass,
    Wire,
    Mat,
    Rubber,
    RubberBlue,
    FoamBlue,
    FoamRed,
    Canvas,
    Bottle,
    BucketBlue,
    BucketYellow,
    BucketRed,
    TowelWhite,
    TowelTeal,
    TowelCoral,
    Striped,
}

/// The room in the scene.
pub(super) struct Room<'a> {
    pool: &'a mut Pool,
    corner: DVec3,
}

impl<'a> Room<'a> {
    /// The room whose corner (0, 0, 0) stands at `corner`.
    pub(super) fn new(pool: &'a mut Pool, corner: DVec3) -> Self {
        Room { pool, corner }
    }

    /// Adds a mesh that is in the room's coordinates.
    pub(super) fn place(&mut self, name: &str, mesh: &Mesh, finish: Finish) {
        self.put(name, mesh, finish, &[Placement::at(DVec3::ZERO)]);
    }

    /// Adds a mesh at each of several places.
    pub(super) fn put(&mut self, name: &str, mesh: &Mesh, finish: Finish, places: &[Placement]) {
        for t in &mesh.triangles {
            assert!(
                mesh.area_vector(*t).length() > 1e-10,
                "{name}: a triangle without area at {}",
                mesh.positions[t[0] as usize]
            );
        }
        let material = self.material(finish);
        let places: Vec<Placement> =
            places.iter().map(|p| Placement { translation: p.translation + self.corner, ..*p }).collect();
        self.pool.document.scatter(name, mesh, material, &places);
    }

    /// Adds a camera of 16 : 9.
    pub(super) fn camera(&mut self, name: &str, places: [DVec3; 2], yfov_deg: f64) {
        self.pool.document.camera(name, places.map(|p| p + self.corner), yfov_deg, 16.0 / 9.0);
    }

    fn material(&mut self, finish: Finish) -> usize {
        match finish {
            Finish::Formwork => self.pool.material("board-marked concrete, inside", |pool| {
                let color =
                    pool.texture("formwork", textures::FORMWORK, || textures::formwork_color().png_srgb());
                let normal = pool.texture("formwork normals", textures::FORMWORK, || {
                    textures::formwork_height().normal_map(textures::FORMWORK)
                });
                Material::new("board-marked concrete, inside", [1.0, 0.97, 0.92], 0.82)
                    .color_texture(color)
                    .normal_texture(normal, 1.0)
            }),
            Finish::Concrete => self.pool.material("plain concrete, inside", |pool| {
                let color =
                    pool.texture("smooth concrete", [2.4, 2.4], || textures::smooth_concrete().png_srgb());
                Material::new("plain concrete, inside", [1.0, 0.98, 0.94], 0.8).color_texture(color)
            }),
            Finish::Outside => surfaces::board_concrete(self.pool),
            Finish::Roof => surfaces::plain_concrete(self.pool),
            Finish::Screed => self.pool.material("screed", |pool| {
                let color = pool.texture("screed", [2.0, 2.0], || textures::screed().png_srgb());
                let rough =
                    pool.texture("screed roughness", [2.0, 2.0], || textures::screed_roughness().png());
                Material::new("screed", [1.0, 0.97, 0.92], 1.0).color_texture(color).roughness_texture(rough)
            }),
            Finish::Birch => self.wood("birch plywood", [0.70, 0.52, 0.33], 0.5),
            Finish::Pallet => self.wood("pallet wood", [0.50, 0.36, 0.235], 0.85),
            Finish::Glass => self.pool.material("pebbled glass", |pool| {
                let size = [0.16, 0.16];
                let normal = pool.texture("pebbles", size, || textures::pebbles().normal_map(size));
                Material::new("pebbled glass", [0.93, 0.97, 0.95], 0.38)
                    .transmissive(1.52)
                    .normal_texture(normal, 1.0)
                    .double_sided()
            }),
            Finish::Wire => self.pool.material("window wire", |pool| {
                let color = pool.texture("wire", [0.08, 0.08], || textures::wire().png());
                Material::new("window wire", [1.0; 3], 0.5).color_texture(color).mask(0.5).double_sided()
            }),
            Finish::Striped => self.pool.material("striped bath towel", |pool| {
                let color = pool.texture("stripes", [0.6, 0.6], || {
                    textures::stripes(DVec3::new(0.78, 0.76, 0.70), DVec3::new(0.03, 0.16, 0.33)).png()
                });
                let normal = terry(pool);
                Material::new("striped bath towel", [1.0; 3], 0.95)
                    .color_texture(color)
                    .normal_texture(normal, 0.7)
                    .double_sided()
            }),
            Finish::TowelWhite => self.terry_cloth("white towel", [0.76, 0.74, 0.70]),
            Finish::TowelTeal => self.terry_cloth("teal towel", [0.05, 0.33, 0.34]),
            Finish::TowelCoral => self.terry_cloth("coral towel", [0.72, 0.20, 0.10]),
            plain => self.pool.material(plain.plain().0, |_| plain.plain().1),
        }
    }

    fn wood(&mut self, name: &'static str, color: [f64; 3], roughness: f64) -> usize {
        self.pool.material(name, |pool| {
            let grain = pool.texture("wood grain", [1.2, 0.4], || textures::wood().png_srgb());
            Material::new(name, color, roughness).color_texture(grain)
        })
    }

    fn terry_cloth(&mut self, name: &'static str, color: [f64; 3]) -> usize {
        self.pool.material(name, |pool| {
            let sheen =
                json!({ "sheenColorFactor": color.map(|c| 0.25 + 0.3 * c), "sheenRoughnessFactor": 0.6 });
            Material::new(name, color, 0.95)
                .normal_texture(terry(pool), 0.7)
                .double_sided()
                .extension("KHR_materials_sheen", sheen)
        })
    }
}

fn terry(pool: &mut Pool) -> Texture {
    pool.texture("terry", [0.08, 0.08], || textures::terry().normal_map([0.08, 0.08]))
}

impl Finish {
    /// Name and material of those of one colour.
    fn plain(self) -> (&'static str, Material) {
        let paint = |name: &'static str, color: [f64; 3], roughness: f64| {
            (name, Material::new(name, color, roughness))
        };
        match self {
            Finish::Turquoise => paint("turquoise lacquer", [0.03, 0.42, 0.42], 0.32),
            Finish::White => paint("white lacquer", [0.78, 0.78, 0.76], 0.35),
            Finish::Enamel => paint("white enamel", [0.80, 0.80, 0.78], 0.4),
            Finish::Paint => paint("frame paint", [0.16, 0.19, 0.20], 0.45),
            Finish::DoorPaint => paint("door paint", [0.035, 0.22, 0.26], 0.4),
            Finish::CabinetPaint => paint("cabinet paint", [0.46, 0.50, 0.49], 0.42),
            Finish::Steel => ("brushed steel", Material::metal("brushed steel", [0.62, 0.61, 0.59], 0.38)),
            Finish::Light => {
                let tube = Material::new("lamp cover", [0.0; 3], 1.0).specular(0.0);
                ("lamp cover", tube.emissive([1.0, 0.95, 0.84], 160.0))
            }
            Finish::Mat => paint("green mat", [0.035, 0.22, 0.075], 0.55),
            Finish::Rubber => paint("black rubber", [0.025, 0.025, 0.027], 0.6),
            Finish::RubberBlue => paint("blue rubber", [0.03, 0.10, 0.32], 0.55),
            Finish::FoamBlue => paint("blue foam", [0.04, 0.20, 0.50], 0.8),
            Finish::FoamRed => paint("red foam", [0.60, 0.07, 0.045], 0.75),
            Finish::Canvas => paint("bag canvas", [0.10, 0.12, 0.15], 0.85),
            Finish::Bottle => paint("bottle", [0.75, 0.45, 0.06], 0.3),
            Finish::BucketBlue => paint("blue plastic", [0.02, 0.13, 0.42], 0.35),
            Finish::BucketYellow => paint("yellow plastic", [0.80, 0.52, 0.03], 0.35),
            Finish::BucketRed => paint("red plastic", [0.55, 0.04, 0.025], 0.35),
            _ => unreachable!("a finish with textures"),
        }
    }
}
