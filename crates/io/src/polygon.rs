//! Polygons to triangles: convex ones as fans, others by cutting ears (Meisters 1975).

use glam::Vec3;

/// Steps of the search for ears that a corner may cost on average. Real polygons stay far below; without it a crafted one could
/// take hours.
const STEPS_PER_CORNER: usize = 512;

/// The warning where it returns false.
pub(crate) const CROSSING: &str = "a face that crosses itself is cut into triangles as well as it can be";

/// Triangulates a polygon of at least four corners, which need not lie quite in a plane, and keeps its winding. Indices of
/// its corners, three to a triangle, are added to `out`: always two triangles less than corners. False when no ear could be
/// found at the end (a polygon that crosses itself): the rest is then a fan.
pub(crate) fn triangulate(points: &[Vec3], out: &mut Vec<[u32; 3]>) -> bool {
    if let [a, b, c, d] = *points {
        // The diagonal that keeps both halves on the same side.
        let fold = (b - a).cross(c - a).dot((c - a).cross(d - a));
        out.extend(if fold >= 0.0 { [[0, 1, 2], [0, 2, 3]] } else { [[1, 2, 3], [1, 3, 0]] });
        return true;
    }
    let flat = project(points);
    let n = points.len() as u32;
    if is_convex(&flat) {
        out.extend((1..n - 1).map(|i| [0, i, i + 1]));
        return true;
    }
    Ears::new(&flat).cut(out)
}

/// A corner in the plane; with f64, so that the sides of points are told rightly.
type Point = [f64; 2];

/// The polygon in the plane of the two axes that see most of it, counter-clockwise.
fn project(points: &[Vec3]) -> Vec<Point> {
    let origin = points[0].to_array().map(f64::from);
    let at = |i: usize| {
        let p = points[i % points.len()].to_array().map(f64::from);
        [0, 1, 2].map(|k| p[k] - origin[k])
    };
    // Newell's normal (Sutherland et al. 1974): the sum of the areas beneath the edges.
    let mut normal = [0.0; 3];
    for i in 0..points.len() {
        let (a, b) = (at(i), at(i + 1));
        for (k, n) in normal.iter_mut().enumerate() {
            let (u, v) = ((k + 1) % 3, (k + 2) % 3);
            *n += a[u] * b[v] - a[v] * b[u];
        }
    }
    let axis = (0..3).fold(0, |best, k| if normal[k].abs() > normal[best].abs() { k } else { best });
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    (0..points.len()).map(at).map(|p| [p[u], p[v] * normal[axis].signum()]).collect()
}

/// From one point to another.
fn to(a: Point, b: Point) -> Point {
    [b[0] - a[0], b[1] - a[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the area of a triangle, positive when it winds counter-clockwise.
fn area(a: Point, b: Point, c: Point) -> f64 {
    cross(to(a, b), to(a, c))
}

/// Whether it turns left at every corner and goes around once. Once: its edges change between up and down only twice.
fn is_convex(p: &[Point]) -> bool {
    let n = p.len();
    let edge = |i: usize| to(p[i % n], p[(i + 1) % n]);
    let turns_left = (0..n).all(|i| cross(edge(i), edge(i + 1)) >= 0.0);
    let rises: Vec<bool> = (0..n).map(edge).filter(|e| e[1] != 0.0).map(|e| e[1] > 0.0).collect();
    let changes = (0..rises.len()).filter(|&i| rises[i] != rises[(i + 1) % rises.len()]).count();
    turns_left && changes <= 2
}

/// What is left of a polygon, as a ring.
struct Ears<'a> {
    p: &'a [Point],
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Corners at which it does not turn left: only these may lie inside an ear.
    reflex: Vec<u32>,
    /// Where each corner stands in `reflex`; otherwise `u32::MAX`.
    slots: Vec<u32>,
}

impl<'a> Ears<'a> {
    fn new(p: &'a [Point]) -> Self {
        let n = p.len() as u32;
        let mut ears = Ears {
            p,
            next: (1..n).chain([0]).collect(),
            previous: std::iter::once(n - 1).chain(0..n - 1).collect(),
            reflex: Vec::new(),
            slots: vec![u32::MAX; p.len()],
        };
        ears.reflex = (0..n).filter(|&i| !ears.is_left(i)).collect();
        for (slot, &i) in ears.reflex.iter().enumerate() {
            ears.slots[i as usize] = slot as u32;
        }
        ears
    }

    fn corners(&self, i: u32) -> [u32; 3] {
        [self.previous[i as usize], i, self.next[i as usize]]
    }

    fn is_left(&self, i: u32) -> bool {
        let [a, b, c] = self.corners(i).map(|k| self.p[k as usize]);
        area(a, b, c) > 0.0
    }

    /// Whether the triangle at this corner can be cut off.
    fn is_ear(&self, i: u32, steps: &mut usize) -> bool {
        if !self.is_left(i) {
            return false;
        }
        let ids = self.corners(i);
        let [a, b, c] = ids.map(|k| self.p[k as usize]);
        *steps += self.reflex.len();
        !self.reflex.iter().any(|&r| {
            let q = self.p[r as usize];
            // Corners that lie on those of the ear are where a slit leads to a hole.
            let apart = !ids.contains(&r) && q != a && q != b && q != c;
            apart && area(a, b, q) >= 0.0 && area(b, c, q) >= 0.0 && area(c, a, q) >= 0.0
        })
    }

    fn cut(mut self, out: &mut Vec<[u32; 3]>) -> bool {
        let mut left = self.p.len();
        let budget = left * STEPS_PER_CORNER;
        let (mut steps, mut passed) = (0, 0);
        let mut i = 0;
        while left > 3 {
            let [a, b, c] = self.corners(i);
            steps += 1;
            // Corners without area go too, once there is no ear left: they cover nothing.
            let flat =
                passed >= left && area(self.p[a as usize], self.p[b as usize], self.p[c as usize]) == 0.0;
            if flat || self.is_ear(i, &mut steps) {
                out.push([a, b, c]);
                self.remove(i);
                left -= 1;
                passed = 0;
                // Leave out a corner, so that ears are not all cut from one side.
                i = self.next[c as usize];
            } else {
                passed += 1;
                i = c;
            }
            if passed > 2 * left || steps > budget {
                self.fan(i, left, out);
                return false;
            }
        }
        out.push(self.corners(i));
        true
    }

    fn remove(&mut self, i: u32) {
        let [a, _, c] = self.corners(i);
        self.next[a as usize] = c;
        self.previous[c as usize] = a;
        self.drop_reflex(i);
        // Cutting an ear can make its neighbours turn left, never the other way.
        for neighbour in [a, c] {
            if self.is_left(neighbour) {
                self.drop_reflex(neighbour);
            }
        }
    }

    fn drop_reflex(&mut self, i: u32) {
        let slot = std::mem::replace(&mut self.slots[i as usize], u32::MAX);
        if slot != u32::MAX {
            self.reflex.swap_remove(slot as usize);
            if let Some(&moved) = self.reflex.get(slot as usize) {
                self.slots[moved as usize] = slot;
            }
        }
    }

    /// The rest as a fan.
    fn fan(&self, first: u32, left: usize, out: &mut Vec<[u32; 3]>) {
        let mut b = self.next[first as usize];
        for _ in 2..left {
            let c = self.next[b as usize];
            out.push([first, b, c]);
            b = c;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut(points: &[[f32; 2]], lift: impl Fn([f32; 2]) -> Vec3) -> (bool, Vec<[u32; 3]>) {
        let points: Vec<Vec3> = points.iter().map(|&p| lift(p)).collect();
        let mut out = Vec::new();
        let clean = triangulate(&points, &mut out);
        assert_eq!(out.len(), points.len() - 2);
        (clean, out)
    }

    /// The triangles wind like the polygon, and cover as much as it does.
    fn covers(points: &[[f32; 2]]) {
        let p: Vec<Point> = points.iter().map(|p| p.map(f64::from)).collect();
        let whole: f64 = (1..p.len() - 1).map(|i| area(p[0], p[i], p[i + 1])).sum();
        let planes: [fn([f32; 2]) -> Vec3; 4] = [
            |[x, y]| Vec3::new(x, y, 7.0),
            |[x, y]| Vec3::new(-3.0, x, y),
            |[x, y]| Vec3::new(y, 0.0, x),
            |[x, y]| Vec3::new(y, x, 2.0 - x),
        ];
        for lift in planes {
            let (clean, triangles) = cut(points, lift);
            assert!(clean, "{points:?}");
            let areas = triangles.iter().map(|t| {
                let [a, b, c] = t.map(|i| p[i as usize]);
                area(a, b, c)
            });
            let areas: Vec<f64> = areas.collect();
            assert!(areas.iter().all(|&a| a * whole.signum() >= 0.0), "{points:?}: {areas:?}");
            assert!((areas.iter().sum::<f64>() - whole).abs() < 1e-9 * whole.abs(), "{points:?}");
        }
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        covers(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
        // An arrow head, in both windings: one diagonal lies outside.
        covers(&[[0.0, 0.0], [2.0, -1.0], [0.5, 0.0], [2.0, 1.0]]);
        covers(&[[2.0, 1.0], [0.5, 0.0], [2.0, -1.0], [0.0, 0.0]]);
        covers(&[[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [2.0, 1.0], [0.0, 3.0]]);
        // An L, with a corner on a straight edge.
        covers(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]]);
        // A comb.
        let mut comb = vec![[0.0, -1.0], [40.0, -1.0]];
        comb.extend((0..=40).rev().map(|i| [i as f32, if i % 2 == 0 { 0.0 } else { 9.0 }]));
        covers(&comb);
        // A frame whose hole is reached through a slit.
        covers(&[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
        ]);
    }

    #[test]
    fn a_star_is_covered_and_a_pentagram_is_not_a_convex_polygon() {
        let point = |i: usize, r: f32, n: f32| {
            let (s, c) = (std::f32::consts::TAU * i as f32 / n).sin_cos();
            [r * c, r * s]
        };
        let star: Vec<_> = (0..200).map(|i| point(i, if i % 2 == 0 { 1.0 } else { 0.4 }, 200.0)).collect();
        covers(&star);
        let round: Vec<_> = (0..50).map(|i| point(i, 1.0, 50.0)).collect();
        covers(&round);
        // It turns left everywhere, but goes around twice.
        let pentagram: Vec<_> = (0..5).map(|i| point(2 * i % 5, 1.0, 5.0)).collect();
        let flat: Vec<Point> = pentagram.iter().map(|p| p.map(f64::from)).collect();
        assert!(!is_convex(&flat));
        cut(&pentagram, |[x, y]| Vec3::new(x, y, 0.0));
    }

    #[test]
    fn degenerate_and_crafted_polygons_end() {
        for points in [vec![[0.0, 0.0]; 7], vec![[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.5, 0.0]]]
        {
            cut(&points, |[x, y]| Vec3::new(x, y, 0.0));
        }
        // A zigzag that crosses itself thousands of times.
        let mad: Vec<_> =
            (0..20_000u32).map(|i| [(i * 7919 % 10_007) as f32, (i * 104_729 % 9973) as f32]).collect();
        let start = std::time::Instant::now();
        let (clean, _) = cut(&mad, |[x, y]| Vec3::new(x, y, 0.0));
        println!("20,000 crossing corners: {:?}", start.elapsed());
        assert!(!clean);
    }
}
