//! The solids around a point, from what rays to infinity cross.

use super::material::{MaterialRecord, flag};
use glam::Vec3;
use lumbre_core::medium::{Medium, MediumStack};

/// A surface of a solid that a ray crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Crossing {
    /// Its material.
    pub material: u32,
    /// The ray comes from its front side: it enters.
    pub front: bool,
}

/// The solids around a point: those that rays to infinity leave without having entered them, in every one of a few directions,
/// so that a pane which is open but claims to be solid does not count. `crossings` gives the surfaces of solids in a unit
/// direction, nearest first.
pub fn surroundings(
    materials: &[MaterialRecord],
    mut crossings: impl FnMut(Vec3) -> Vec<Crossing>,
) -> MediumStack {
    let mut stack = MediumStack::default();
    if !materials.iter().any(|m| m.has(flag::SOLID)) {
        return stack;
    }
    // Not along an axis, so that they do not graze the walls of common models.
    let directions =
        [(0.267, 0.875, 0.404), (-0.611, -0.733, 0.298), (0.349, -0.211, -0.913), (-0.728, 0.405, -0.553)];
    let mut around = directions.map(|d| left_behind(&crossings(Vec3::from(d).normalize()))).into_iter();
    let mut enclosing = around.next().unwrap_or_default();
    for others in around {
        enclosing.retain(|m| others.contains(m));
    }
    for id in enclosing.into_iter().rev() {
        let material = &materials[id as usize];
        stack.enter(Medium { ior: material.ior, absorption: material.absorption, material: id });
    }
    stack
}

/// Materials of the solids that a ray leaves without having entered them, innermost first.
fn left_behind(crossings: &[Crossing]) -> Vec<u32> {
    let (mut entered, mut left) = (Vec::new(), Vec::new());
    for c in crossings {
        if c.front {
            entered.push(c.material);
        } else if let Some(i) = entered.iter().rposition(|&e| e == c.material) {
            entered.remove(i);
        } else {
            left.push(c.material);
        }
    }
    left
}
