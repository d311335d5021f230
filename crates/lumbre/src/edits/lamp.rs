//! The table of a light: a node of the scene that holds one, or a light that was added. Place and direction are the world's.

use super::material::{hue, pure};
use super::param::{Access, HUE, HUGE, Param, field, growing, number};
use super::place::parts;
use super::value::{Kind, Value};
use glam::{Mat4, Quat, Vec3};
use lumbre_core::Rgb;
use lumbre_scene::{Light, LightId, LightKind, Node, NodeId, Scene};

/// A light where it stands.
#[derive(Clone, Debug)]
pub(super) struct Lamp {
    on: bool,
    shape: &'static str,
    /// Its intensity is the product of the two.
    color: Rgb,
    intensity: f32,
    position: Vec3,
    direction: Vec3,
    /// Radians.
    inner: f32,
    outer: f32,
    /// What was set.
    relit: bool,
    moved: bool,
    turned: bool,
}

/// Half the opening of a new spot.
const OUTER: f32 = std::f32::consts::FRAC_PI_6;

/// One that is added: a point light of 100 candela at the origin.
impl Default for Lamp {
    fn default() -> Self {
        Lamp {
            on: true,
            shape: "point",
            color: Rgb::WHITE,
            intensity: 100.0,
            position: Vec3::ZERO,
            direction: Vec3::NEG_Y,
            inner: 0.0,
            outer: OUTER,
            relit: true,
            moved: true,
            turned: true,
        }
    }
}

impl Lamp {
    /// The light of a node; `None` if it holds none.
    pub(super) fn of(scene: &Scene, node: NodeId) -> Option<Lamp> {
        let light = scene.lights.get(scene.nodes.get(node.index())?.light?.index())?;
        let (_, to_world) = placed(scene, node);
        let (color, intensity) = hue(light.intensity);
        let (shape, [inner, outer]) = match light.kind {
            LightKind::Point => ("point", [0.0, OUTER]),
            LightKind::Spot { inner_angle, outer_angle } => ("spot", [inner_angle, outer_angle]),
            LightKind::Directional => ("directional", [0.0, OUTER]),
        };
        let (position, direction) = (to_world.w_axis.truncate(), axis(to_world));
        let (relit, moved, turned) = (false, false, false);
        Some(Lamp {
            on: true,
            shape,
            color,
            intensity,
            position,
            direction,
            inner,
            outer,
            relit,
            moved,
            turned,
        })
    }

    fn light(&self, name: &str) -> Light {
        let kind = match self.shape {
            "spot" => LightKind::Spot { inner_angle: self.inner.min(self.outer), outer_angle: self.outer },
            "directional" => LightKind::Directional,
            _ => LightKind::Point,
        };
        Light { name: name.into(), kind, intensity: self.color * self.intensity }
    }

    /// Puts it back where it was found. A light that stands elsewhere too changes here alone.
    pub(super) fn put(&self, scene: &mut Scene, node: NodeId) {
        let Some(light) = scene.nodes[node.index()].light else { return };
        if !self.on {
            scene.nodes[node.index()].light = None;
            return;
        }
        if self.relit {
            let changed = self.light(&scene.lights[light.index()].name);
            let shared = scene.nodes.iter().filter(|n| n.light == Some(light)).count() > 1;
            if shared {
                scene.nodes[node.index()].light = Some(LightId(scene.lights.len() as u32));
                scene.lights.push(changed);
            } else {
                scene.lights[light.index()] = changed;
            }
        }
        // Below a node that is scaled to nothing there is no other place.
        let transform = self.transform(scene, node);
        if transform.is_finite() {
            scene.nodes[node.index()].transform = transform;
        }
    }

    /// That of its node, which stands where the light is to be.
    fn transform(&self, scene: &Scene, node: NodeId) -> Mat4 {
        if !(self.moved || self.turned) {
            return scene.nodes[node.index()].transform;
        }
        let (parent, mut world) = placed(scene, node);
        if self.turned {
            let (scale, rotation) = parts(world);
            let turn = Quat::from_rotation_arc(axis(world), unit(self.direction));
            world = Mat4::from_scale_rotation_translation(scale, turn * rotation, world.w_axis.truncate());
        }
        if self.moved {
            world.w_axis = self.position.extend(1.0);
        }
        if parent == Mat4::IDENTITY { world } else { parent.inverse() * world }
    }

    /// Adds it to a scene.
    pub(super) fn add(&self, scene: &mut Scene, name: &str) {
        if !self.on {
            return;
        }
        let light = Some(LightId(scene.lights.len() as u32));
        scene.lights.push(self.light(name));
        let turn = Quat::from_rotation_arc(Vec3::NEG_Z, unit(self.direction));
        let transform = Mat4::from_rotation_translation(turn, self.position);
        scene.add_root(Node { name: name.into(), transform, light, ..Node::default() });
    }

    fn is_spot(&self) -> bool {
        self.shape == "spot"
    }
}

/// Where a node's light shines.
fn axis(to_world: Mat4) -> Vec3 {
    unit(-to_world.z_axis.truncate())
}

fn unit(v: Vec3) -> Vec3 {
    v.normalize_or(Vec3::NEG_Z)
}

/// Transforms to the world of what is above a node, and of the node itself. One that no root reaches stands by itself.
fn placed(scene: &Scene, node: NodeId) -> (Mat4, Mat4) {
    let own = scene.nodes[node.index()].transform;
    if scene.roots.contains(&node) {
        return (Mat4::IDENTITY, own);
    }
    let world = scene.world_nodes();
    let above = world.iter().find(|(id, _)| scene.nodes[id.index()].children.contains(&node));
    above.map_or((Mat4::IDENTITY, own), |(_, parent)| (*parent, *parent * own))
}

/// Sets a part of what shines.
macro_rules! relit {
    ($lamp:ident, $set:expr) => {{
        $lamp.relit = true;
        $set
    }};
}

const ANGLE: Kind = number([0.0, 90.0], [0.0, 90.0], "°");

type One = Param<Lamp>;

/// All parameters of a light.
pub(super) const LAMP: &[One] = &[
    One::new("on", "On", Kind::Flag, field!(flag on)),
    One::new(
        "kind",
        "Kind",
        Kind::Choice(&["point", "spot", "directional"]),
        Access { get: |l| Value::Word(l.shape), set: |l, v| relit!(l, l.shape = v.word()) },
    )
    .when(|l| l.on),
    One::new(
        "color",
        "Colour",
        HUE,
        Access { get: |l| Value::Color(l.color), set: |l, v| relit!(l, l.color = pure(v.color())) },
    )
    .when(|l| l.on),
    One::new(
        "intensity",
        "Intensity",
        growing(HUGE, [0.01, 1e5], "cd or lx"),
        Access { get: |l| Value::Number(l.intensity), set: |l, v| relit!(l, l.intensity = v.number()) },
    )
    .when(|l| l.on),
    One::new(
        "position",
        "Position",
        Kind::Vector { unit: "m", range: [-HUGE, HUGE] },
        Access { get: |l| Value::Vector(l.position), set: |l, v| (l.position, l.moved) = (v.vector(), true) },
    )
    .when(|l| l.on && l.shape != "directional"),
    One::new(
        "direction",
        "Direction",
        Kind::Vector { unit: "", range: [-HUGE, HUGE] },
        Access {
            get: |l| Value::Vector(l.direction),
            set: |l, v| (l.direction, l.turned) = (v.vector(), true),
        },
    )
    .when(|l| l.on && l.shape != "point"),
    One::new(
        "innerAngle",
        "Inner angle",
        ANGLE,
        Access {
            get: |l| Value::Number(l.inner.to_degrees()),
            set: |l, v| relit!(l, l.inner = v.number().to_radians()),
        },
    )
    .when(|l| l.on && l.is_spot()),
    One::new(
        "outerAngle",
        "Outer angle",
        ANGLE,
        Access {
            get: |l| Value::Number(l.outer.to_degrees()),
            set: |l, v| relit!(l, l.outer = v.number().to_radians()),
        },
    )
    .when(|l| l.on && l.is_spot()),
];
