//! Two backends, one picture: the same samples drawn by both, compared path by path.
//!
//! Both take the same random numbers, so that nearly all paths are the same but for rounding. A few fork: where rounding decides a comparison, they
//! go on as different paths of the same distribution. So the share of pixels that agree is high, and what forks must average out.

use lumbre_core::Film;
use lumbre_core::film::PixelSums;

/// Relative difference from which two samples of a path count as forked.
const FORKED: f32 = 1e-3;
/// Radiance below this share of the picture's mean counts as that share, so that the dark does not ask for more digits than anyone sees.
const DARK: f32 = 0.01;
/// Rounding may pull all pixels the same way: this share of the mean counts as part of the standard error.
const ROUNDING: f64 = 1e-5;

/// How two renders of the same samples differ.
#[derive(Clone, Copy, Debug, Default)]
pub struct Paired {
    /// Pixels.
    pub pixels: usize,
    /// Pixels whose means agree within 1e-3 relative.
    pub close: usize,
    /// Paths.
    pub paths: usize,
    /// Paths that differ by more than that.
    pub forks: usize,
    /// Difference of the image means over the mean of the first.
    pub bias: f64,
    /// The same over its standard error, estimated from the spread over pixels, and rounding.
    pub z: f64,
    /// Image mean of the first.
    pub mean: f64,
    /// Paths whose first hits differ, by plane.
    pub planes: Planes,
}

/// Paths whose first hits differ: the plane's value, or whether there is a hit at all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Planes {
    /// Albedo, by [`Bounds::color`].
    pub albedo: usize,
    /// Normal, by [`Bounds::color`].
    pub normal: usize,
    /// Position, by 1e-4 of the distance and [`Bounds::position`].
    pub position: usize,
    /// Distance, by 1e-4 of itself.
    pub depth: usize,
    /// Share of the background that is hidden, by 1e-3.
    pub alpha: usize,
}

/// What the paired test demands.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// Least share of pixels that agree within 1e-3.
    pub close: f64,
    /// Largest relative difference of the image means.
    pub bias: f64,
    /// Largest |z| of it.
    pub z: f64,
    /// Largest difference of albedos and of normals of first hits.
    pub color: f32,
    /// Largest difference of positions beyond 1e-4 of the distance, metres.
    pub position: f32,
    /// Largest share of paths that may differ in a plane: those that pass an edge at a rounding's distance.
    pub planes: f64,
}

impl Bounds {
    /// For scenes without textures.
    pub const PLAIN: Bounds =
        Bounds { close: 0.99, bias: 1e-3, z: 4.5, color: 1e-3, position: 0.0, planes: 5e-3 };
    /// For scenes with textures: their texels are read at coordinates that differ in the last digits, and normal maps pass that on.
    pub const TEXTURED: Bounds = Bounds { close: 0.95, color: 1e-2, ..Bounds::PLAIN };

    /// For scenes of this radius in metres, some of whose triangles are as large: hit points come from barycentrics, which have 24 bits
    /// however near the triangle is.
    pub fn with_triangles_of(self, radius: f32) -> Bounds {
        Bounds { position: 3e-7 * radius, ..self }
    }
}

impl Paired {
    /// Compares films that hold one sample of each pixel each: `pairs` in the order of their samples.
    ///
    /// # Panics
    /// If the films are not of the same size.
    pub fn new(pairs: &[(Film, Film)], bounds: &Bounds) -> Self {
        let Some((first, _)) = pairs.first() else { return Paired::default() };
        let pixels = first.pixels().len();
        let mut sums = vec![[[0.0f32; 3]; 2]; pixels];
        let mean =
            |f: &Film| f.radiance().iter().map(|c| f64::from(c.average())).sum::<f64>() / pixels as f64;
        let overall = pairs.iter().map(|(a, _)| mean(a)).sum::<f64>() / pairs.len() as f64;
        let floor = DARK * overall as f32;
        let mut forks = 0;
        let mut planes = Planes::default();
        for (a, b) in pairs {
            assert_eq!((a.width(), a.height()), (b.width(), b.height()), "films of different sizes");
            a.pixels().iter().zip(b.pixels()).for_each(|(p, q)| planes.add(p, q, bounds));
            for (i, (p, q)) in a.radiance().iter().zip(b.radiance()).enumerate() {
                let (p, q) = (p.to_array(), q.to_array());
                forks += usize::from(!close(p, q, floor));
                for band in 0..3 {
                    sums[i][0][band] += p[band];
                    sums[i][1][band] += q[band];
                }
            }
        }
        let floor = floor * pairs.len() as f32;
        let agree = sums.iter().filter(|[p, q]| close(*p, *q, floor)).count();
        let (bias, z) = difference(&sums, overall * pairs.len() as f64);
        Paired { pixels, close: agree, paths: pixels * pairs.len(), forks, bias, z, mean: overall, planes }
    }

    /// What is out of bounds, if anything.
    pub fn faults(&self, bounds: &Bounds) -> Vec<String> {
        let share = self.close as f64 / self.pixels.max(1) as f64;
        let mut faults = Vec::new();
        if self.pixels == 0 || share < bounds.close {
            faults.push(format!(
                "{:.2} % of pixels agree, wanted {:.1} %",
                100.0 * share,
                100.0 * bounds.close
            ));
        }
        if self.bias.is_nan() || self.bias.abs() > bounds.bias {
            faults.push(format!("the means differ by {:.4} %", 100.0 * self.bias));
        }
        if self.z.is_nan() || self.z.abs() > bounds.z {
            faults.push(format!("z is {:.1}", self.z));
        }
        if self.mean <= 0.0 {
            faults.push("there is nothing to see".into());
        }
        for (plane, differ) in self.planes.named() {
            if differ as f64 > bounds.planes * self.paths as f64 {
                faults.push(format!("{plane} differs in {differ} of {} paths", self.paths));
            }
        }
        faults
    }
}

impl Planes {
    fn add(&mut self, p: &PixelSums, q: &PixelSums, bounds: &Bounds) {
        let apart = |p: [f32; 3], q: [f32; 3], most: f32| p.iter().zip(q).any(|(p, q)| (p - q).abs() > most);
        let [near, far] = [p.depth(), q.depth()];
        let hits = (near.is_finite(), far.is_finite());
        let most = 1e-4 * near.max(far);
        self.albedo += usize::from(apart(p.albedo().to_array(), q.albedo().to_array(), bounds.color));
        self.normal += usize::from(apart(p.normal(), q.normal(), bounds.color));
        self.position +=
            usize::from(hits.0 != hits.1 || apart(p.position(), q.position(), most + bounds.position));
        self.depth += usize::from(hits.0 != hits.1 || (hits.0 && (near - far).abs() > most));
        self.alpha += usize::from((p.alpha() - q.alpha()).abs() > 1e-3);
    }

    fn named(&self) -> [(&'static str, usize); 5] {
        let Planes { albedo, normal, position, depth, alpha } = *self;
        [("albedo", albedo), ("normal", normal), ("position", position), ("depth", depth), ("alpha", alpha)]
    }
}

impl core::fmt::Display for Paired {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Paired { pixels, close, paths, forks, bias, z, .. } = *self;
        let Planes { albedo, normal, position, depth, alpha } = self.planes;
        let (share, forked) = (close as f64 / pixels as f64, forks as f64 / paths as f64);
        write!(
            f,
            "{:.2} % of {pixels} pixels agree; {forks} of {paths} paths fork ({:.3} %); means differ by {:+.4} % (z {z:+.1}); \
             albedo, normal, position, depth, alpha differ in {albedo}, {normal}, {position}, {depth}, {alpha}",
            100.0 * share,
            100.0 * forked,
            100.0 * bias
        )
    }
}

fn close(p: [f32; 3], q: [f32; 3], floor: f32) -> bool {
    p.iter().zip(q).all(|(&p, q)| (p - q).abs() <= FORKED * p.abs().max(q.abs()).max(floor))
}

/// Difference of the means over `mean`, and over its standard error.
fn difference(sums: &[[[f32; 3]; 2]], mean: f64) -> (f64, f64) {
    let n = sums.len() as f64;
    let average = |c: &[f32; 3]| c.iter().map(|v| f64::from(*v)).sum::<f64>() / 3.0;
    let differences: Vec<f64> = sums.iter().map(|[p, q]| average(q) - average(p)).collect();
    let d = differences.iter().sum::<f64>() / n;
    let variance = differences.iter().map(|v| (v - d) * (v - d)).sum::<f64>() / (n - 1.0).max(1.0);
    let error = (variance / n + (ROUNDING * mean).powi(2)).sqrt();
    (if mean > 0.0 { d / mean } else { d }, if error > 0.0 { d / error } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::Rgb;
    use lumbre_core::film::{FilmSample, FirstHit};
    use lumbre_core::hash::unit;

    fn film(value: impl Fn(u32) -> f32) -> Film {
        let mut film = Film::new(32, 32);
        for i in 0..1024 {
            let radiance = Rgb::splat(value(i));
            film.add([i % 32, i / 32], 0, &FilmSample { radiance, ..FilmSample::default() });
        }
        film
    }

    fn faults(value: impl Fn(u32) -> f32) -> usize {
        let pairs: Vec<_> = (0..4).map(|s| (film(|i| unit(i, s)), film(|i| unit(i, s) * value(i)))).collect();
        Paired::new(&pairs, &Bounds::PLAIN).faults(&Bounds::PLAIN).len()
    }

    #[test]
    fn rounding_passes_and_one_per_cent_does_not() {
        assert_eq!(faults(|_| 1.0), 0);
        assert_eq!(faults(|i| 1.0 + 1e-5 * unit(i, 7)), 0);
        assert_eq!(faults(|_| 1.01), 3);
        // A few forked paths that average out.
        assert_eq!(faults(|i| if i % 200 == 0 { 0.5 + unit(i, 9) } else { 1.0 }), 0);
        assert!(faults(|i| if i % 50 == 0 { 0.5 } else { 1.0 }) > 0);
        assert!(
            !Paired::new(&[], &Bounds::PLAIN).faults(&Bounds::PLAIN).is_empty(),
            "nothing compared is no agreement"
        );
        let black = vec![(film(|_| 0.0), film(|_| 0.0))];
        assert!(
            !Paired::new(&black, &Bounds::PLAIN).faults(&Bounds::PLAIN).is_empty(),
            "nor are black pictures"
        );
    }

    /// One film of first hits; `disturb` changes some of them.
    fn hits(disturb: impl Fn(u32, &mut FilmSample)) -> Film {
        let mut film = Film::new(32, 32);
        for i in 0..1024 {
            let hit = FirstHit {
                albedo: Rgb::splat(0.5),
                normal: [0.0, 1.0, 0.0],
                position: [1.0, unit(i, 3), 2.0],
                depth: 3.0,
            };
            let mut sample = FilmSample { radiance: Rgb::WHITE, first_hit: Some(hit), alpha: 1.0 };
            disturb(i, &mut sample);
            film.add([i % 32, i / 32], 0, &sample);
        }
        film
    }

    #[test]
    fn each_plane_is_looked_at() {
        type Disturb = fn(&mut FilmSample, &mut FirstHit);
        let off: [(&str, Disturb); 5] = [
            ("albedo", |_, hit| hit.albedo *= 1.01),
            ("normal", |_, hit| hit.normal[0] += 0.01),
            ("position", |_, hit| hit.position[2] *= 1.01),
            ("depth", |_, hit| hit.depth *= 1.01),
            ("alpha", |sample, _| sample.alpha *= 0.99),
        ];
        for (plane, disturb) in off {
            for (every, found) in [(100, true), (1000, false)] {
                let other = hits(|i, sample| {
                    let mut hit = sample.first_hit.unwrap();
                    if i % every == 0 {
                        disturb(sample, &mut hit);
                    }
                    sample.first_hit = Some(hit);
                });
                let paired = Paired::new(&[(hits(|_, _| ()), other)], &Bounds::PLAIN);
                let faults = paired.faults(&Bounds::PLAIN);
                assert_eq!(faults.len(), usize::from(found), "{plane}: {faults:?}");
                assert!(faults.iter().all(|f| f.starts_with(plane)), "{plane}: {faults:?}");
            }
        }
        let missed = hits(|i, sample| sample.first_hit = sample.first_hit.filter(|_| i % 100 > 0));
        let paired = Paired::new(&[(hits(|_, _| ()), missed)], &Bounds::PLAIN);
        assert_eq!(paired.faults(&Bounds::PLAIN).len(), 4, "a hit on one side only: all but alpha");
    }
}
