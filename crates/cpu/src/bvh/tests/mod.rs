//! Tests of the BVH against the plain loop over all triangles, and of what it promises beyond that.

mod brute;
mod build;
mod edge_cases;
mod faults;
mod instances;
mod meshes;
mod watertight;

use super::{Blas, Hit, InstanceDesc, SimdLevel, Tlas};
use glam::{Affine3A, Vec3};
use lumbre_core::Ray;
use lumbre_core::hash::{hash_combine, to_unit};
use meshes::{grid, icosphere, map, needles, soup};
use std::sync::Arc;

/// A stream of random numbers, the same in every run.
struct Random(u32);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        to_unit(hash_combine(0x5eed, self.0))
    }

    /// Uniform in `lo..hi`.
    fn range(&mut self, lo: f32, hi: f32) -> f32 {
        lo + (hi - lo) * self.next()
    }

    fn index(&mut self, n: usize) -> usize {
        ((self.next() * n as f32) as usize).min(n - 1)
    }

    /// Uniform in the cube of half edge `r`.
    fn point(&mut self, r: f32) -> Vec3 {
        Vec3::new(self.range(-r, r), self.range(-r, r), self.range(-r, r))
    }

    /// A point of a triangle of `mesh`.
    fn on(&mut self, (positions, triangles): &Mesh) -> Vec3 {
        let [a, b, c] = triangles[self.index(triangles.len())].map(|i| positions[i as usize]);
        let (u, v) = (self.next(), self.next());
        a + (b - a) * (u * v) + (c - a) * (u * (1.0 - v))
    }

    /// Uniform on the sphere.
    fn direction(&mut self) -> Vec3 {
        loop {
            let p = self.point(1.0);
            if (1e-3..1.0).contains(&p.length_squared()) {
                return p.normalize();
            }
        }
    }
}

type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

fn ray(origin: Vec3, dir: Vec3) -> Ray {
    Ray::new(origin, dir, 0.0)
}

/// The scene of one mesh where it is.
fn scene((positions, triangles): &Mesh) -> Tlas {
    Tlas::build(
        &[InstanceDesc::new(0, Affine3A::IDENTITY)],
        vec![Arc::new(Blas::build(positions, triangles))],
    )
}

/// The same scene at each level the processor has.
fn at_all_levels(tlas: &Tlas) -> Vec<Tlas> {
    let levels = SimdLevel::ALL.into_iter().filter(|l| l.is_supported());
    levels.map(|l| tlas.clone().with_level(l)).collect()
}

fn bits(hit: &Option<Hit>) -> Option<[u32; 5]> {
    hit.map(|h| [h.t.to_bits(), h.instance, h.triangle, h.b1.to_bits(), h.b2.to_bits()])
}

/// How many of the queries of `rays` at any level differ from the loop over all triangles, in any bit.
fn differences(tlas: &Tlas, rays: impl IntoIterator<Item = Ray>) -> usize {
    let levels = at_all_levels(tlas);
    let mut wrong = 0;
    for ray in rays {
        let expected = tlas.closest_hit_brute(&ray, |_| true);
        for level in &levels {
            wrong += usize::from(bits(&level.closest_hit(&ray, |_| true)) != bits(&expected));
            wrong += usize::from(level.any_hit(&ray, |_| true) != expected.is_some());
        }
    }
    wrong
}

/// Asserts that all levels agree with the loop over all triangles, and that at least `hits` rays hit something.
#[track_caller]
fn assert_exact(tlas: &Tlas, rays: Vec<Ray>, hits: usize) {
    let found = rays.iter().filter(|r| tlas.closest_hit_brute(r, |_| true).is_some()).count();
    assert!(found >= hits, "only {found} of {} rays hit: the test shows little", rays.len());
    let count = rays.len();
    assert_eq!(differences(tlas, rays), 0, "of {count} rays");
}
