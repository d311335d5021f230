//! Normals for faces without, by smoothing group: at each vertex the mean of the normals of the group's triangles around it, each
//! weighed by its angle there (Thürmer and Wüthrich 1998), so that how a face is cut into triangles does not matter. Faces in
//! no group stay flat.

use super::faces::{Corner, NONE, Triangles};
use super::parts::Segment;
use glam::Vec3;
use lumbre_core::math::acos;
use std::collections::HashMap;

/// Gives normals to the triangles that have none and lie in a smoothing group. They are added to `normals`.
pub(super) fn smooth(
    positions: &[Vec3],
    normals: &mut Vec<Vec3>,
    triangles: &mut [Triangles],
    segments: &[Segment],
) {
    let mut table = Table { first: normals.len(), ..Table::default() };
    for segment in segments.iter().filter(|s| s.smoothing != 0) {
        let corners = &mut triangles[segment.piece].corners[segment.range.clone()];
        for triangle in corners.iter_mut().filter(|t| t[0][2] == NONE) {
            table.add(positions, triangle, segment.smoothing);
        }
    }
    normals
        .extend(table.sums.into_iter().zip(table.any).map(|(sum, any)| sum.try_normalize().unwrap_or(any)));
}

/// Normals in the making.
#[derive(Default)]
struct Table {
    /// Index of the first.
    first: usize,
    /// For each vertex the first group it was met in and its normal; 0: none yet. Made when it is needed.
    slots: Vec<(u32, u32)>,
    /// By (vertex, group), for vertices in more than one.
    others: HashMap<(u32, u32), u32>,
    sums: Vec<Vec3>,
    /// The normal of one triangle, for where the sum has no direction.
    any: Vec<Vec3>,
}

impl Table {
    fn add(&mut self, positions: &[Vec3], triangle: &mut [Corner; 3], group: u32) {
        self.slots.resize(positions.len(), (0, 0));
        let p = triangle.map(|c| positions[c[0] as usize]);
        let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
        for k in 0..3 {
            let id = self.id(triangle[k][0], group);
            let to = |other: usize| (p[(k + other) % 3] - p[k]).normalize_or_zero();
            let angle = acos(to(1).dot(to(2)).clamp(-1.0, 1.0));
            self.sums[id as usize] += normal * angle;
            if self.any[id as usize] == Vec3::ZERO {
                self.any[id as usize] = normal;
            }
            triangle[k][2] = self.first as u32 + id;
        }
    }

    fn id(&mut self, vertex: u32, group: u32) -> u32 {
        let fresh = self.sums.len() as u32;
        let slot = &mut self.slots[vertex as usize];
        let id = match slot.0 {
            0 => {
                *slot = (group, fresh);
                fresh
            }
            known if known == group => slot.1,
            _ => *self.others.entry((vertex, group)).or_insert(fresh),
        };
        if id == fresh {
            self.sums.push(Vec3::ZERO);
            self.any.push(Vec3::ZERO);
        }
        id
    }
}
