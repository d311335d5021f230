//! Environment light: a latitude-longitude map, sampled in proportion to its radiance.
//!
//! Rows are bands of the sphere, and a point of a cell is drawn uniformly in solid angle, not in (u, v): so the density is
//! constant over a cell, a map of one texel is sampled uniformly, and no pole needs care.

use crate::distribution::{sample_cdf, write_cdf};
use crate::math::{PI, Vec3, atan2, lerp, safe_sqrt, sin_cos};
use crate::rgb::{Rgb, Spectrum};

/// A map with the tables that sample it. Its centre lies at -z, row 0 at +y, +x a quarter of the width right of the centre.
#[derive(Clone, Copy, Debug)]
pub struct EnvironmentLight<'a> {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Turns the map about +y: its content moves by this angle towards +x, radians.
    pub rotation: f32,
    /// Radiance, row by row.
    pub pixels: &'a [Rgb],
    /// Distribution over rows: `height + 1` values from 0 to 1.
    pub row_cdf: &'a [f32],
    /// Distribution within each row: `height` times `width + 1` values.
    pub cell_cdf: &'a [f32],
}

/// Fills the tables for a map. Returns (row_cdf, cell_cdf, mean radiance over the sphere).
pub fn build_distribution(width: u32, height: u32, pixels: &[Rgb]) -> (Vec<f32>, Vec<f32>, Spectrum) {
    let (w, h) = (width as usize, height as usize);
    let mut cell_cdf = Vec::with_capacity(h * (w + 1));
    let mut rows = Vec::with_capacity(h);
    let mut mean = [0.0f64; 3];
    for y in 0..h {
        let share = 0.5 * f64::from(cos_band(y as u32, height).0 - cos_band(y as u32, height).1);
        let cells: Vec<f32> = (0..w).map(|x| cell_mean(w, h, pixels, x, y).average()).collect();
        for x in 0..w {
            let c = cell_mean(w, h, pixels, x, y);
            for (m, v) in mean.iter_mut().zip(c.to_array()) {
                *m += share * f64::from(v) / w as f64;
            }
        }
        rows.push((share * write_cdf(&cells, &mut cell_cdf)) as f32);
    }
    let mut row_cdf = Vec::with_capacity(h + 1);
    write_cdf(&rows, &mut row_cdf);
    (row_cdf, cell_cdf, Rgb::from_array(mean.map(|m| m as f32)))
}

/// Mean over a cell of the bilinear interpolation: weights 1/8, 3/4, 1/8 along each axis.
fn cell_mean(w: usize, h: usize, pixels: &[Rgb], x: usize, y: usize) -> Rgb {
    const WEIGHTS: [f32; 3] = [0.125, 0.75, 0.125];
    let mut sum = Rgb::BLACK;
    for (j, wy) in WEIGHTS.iter().enumerate() {
        let yy = (y + j).saturating_sub(1).min(h - 1);
        for (i, wx) in WEIGHTS.iter().enumerate() {
            sum += pixels[yy * w + (x + w + i - 1) % w] * (wx * wy);
        }
    }
    sum
}

/// Cosines of the polar angle at the top and the bottom of a row.
#[inline]
fn cos_band(row: u32, height: u32) -> (f32, f32) {
    let cos = |r: u32| {
        if 2 * r == height { 0.0 } else { sin_cos(PI * (r as f32 / height as f32)).1 }
    };
    (cos(row), cos(row + 1))
}

impl EnvironmentLight<'_> {
    /// Map coordinates of a unit direction: u wraps in [0, 1), v in [0, 1].
    #[inline]
    fn uv(&self, d: Vec3) -> [f32; 2] {
        // At the poles any azimuth will do, but not one that depends on the sign of a zero, which GPUs may lose.
        let azimuth = if d.x == 0.0 && d.z == 0.0 { 0.0 } else { atan2(d.x, -d.z) };
        let u = 0.5 + (azimuth - self.rotation) * (0.5 / PI);
        let v = atan2(safe_sqrt(d.x * d.x + d.z * d.z), d.y) / PI;
        [u - u.floor(), v]
    }

    /// Radiance from direction `d` (unit), bilinear.
    #[inline]
    pub fn radiance(&self, d: Vec3) -> Spectrum {
        if self.pixels.len() == 1 {
            return self.pixels[0];
        }
        let [u, v] = self.uv(d);
        let (w, h) = (self.width as i32, self.height as i32);
        let (x, y) = (u * w as f32 - 0.5, v * h as f32 - 0.5);
        let (x0, y0) = (x.floor(), y.floor());
        let texel = |i: i32, j: i32| self.pixels[(j.clamp(0, h - 1) * w + i.rem_euclid(w)) as usize];
        let (i, j) = (x0 as i32, y0 as i32);
        let top = texel(i, j).lerp(texel(i + 1, j), x - x0);
        let bottom = texel(i, j + 1).lerp(texel(i + 1, j + 1), x - x0);
        top.lerp(bottom, y - y0)
    }

    /// A direction and its density, sr⁻¹; `None` for a black map.
    #[inline]
    pub fn sample(&self, u: [f32; 2]) -> Option<(Vec3, f32)> {
        let row = sample_cdf(self.row_cdf, u[1])?;
        let stride = self.width as usize + 1;
        let cell = sample_cdf(&self.cell_cdf[row.index * stride..(row.index + 1) * stride], u[0])?;
        let (top, bottom) = cos_band(row.index as u32, self.height);
        let y = lerp(top, bottom, row.remainder);
        let phi =
            ((cell.index as f32 + cell.remainder) / self.width as f32 - 0.5) * (2.0 * PI) + self.rotation;
        let (s, c) = sin_cos(phi);
        let r = safe_sqrt(1.0 - y * y);
        let pdf = row.probability * cell.probability * self.width as f32 / (2.0 * PI * (top - bottom));
        Some((Vec3::new(r * s, y, -r * c), pdf))
    }

    /// Density of [`EnvironmentLight::sample`] at `d`, sr⁻¹.
    #[inline]
    pub fn pdf(&self, d: Vec3) -> f32 {
        let [u, v] = self.uv(d);
        let x = ((u * self.width as f32) as usize).min(self.width as usize - 1);
        let y = ((v * self.height as f32) as usize).min(self.height as usize - 1);
        let cells = &self.cell_cdf[y * (self.width as usize + 1)..];
        let (top, bottom) = cos_band(y as u32, self.height);
        let probability = (self.row_cdf[y + 1] - self.row_cdf[y]) * (cells[x + 1] - cells[x]);
        probability * self.width as f32 / (2.0 * PI * (top - bottom))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hash::unit;
    use crate::warp::uniform_sphere;

    fn map(w: u32, h: u32) -> Vec<Rgb> {
        (0..w * h).map(|i| Rgb::new(unit(i, 1), 9.0 * unit(i, 2) * unit(i, 3), unit(i, 4))).collect()
    }

    #[test]
    fn the_centre_is_at_minus_z_and_not_mirrored() {
        let mut pixels = vec![Rgb::BLACK; 8 * 4];
        pixels[8 + 5] = Rgb::WHITE; // right of the centre, above the horizon
        let light = EnvironmentLight {
            width: 8,
            height: 4,
            rotation: 0.0,
            pixels: &pixels,
            row_cdf: &[],
            cell_cdf: &[],
        };
        let bright = |l: &EnvironmentLight, az: f32| {
            l.radiance(crate::light::sun::SunDisc::direction_of(PI / 8.0, az)).g
        };
        assert!((bright(&light, 3.0 * PI / 8.0) - 1.0).abs() < 1e-5);
        assert_eq!(bright(&light, -3.0 * PI / 8.0), 0.0);
        let turned = EnvironmentLight { rotation: PI / 4.0, ..light };
        assert!((bright(&turned, 5.0 * PI / 8.0) - 1.0).abs() < 1e-5, "rotation moves content towards +x");
    }

    #[test]
    fn samples_have_the_density_that_pdf_says_and_it_follows_the_map() {
        let (w, h) = (16, 8);
        let pixels = map(w, h);
        let (row_cdf, cell_cdf, mean) = build_distribution(w, h, &pixels);
        let light = EnvironmentLight {
            width: w,
            height: h,
            rotation: 0.7,
            pixels: &pixels,
            row_cdf: &row_cdf,
            cell_cdf: &cell_cdf,
        };
        let n = 200_000;
        let (mut flux, mut total) = ([0.0f64; 2], 0.0f64);
        for i in 0..n {
            let u = [unit(i, 10), unit(i, 11)];
            let (d, pdf) = light.sample(u).unwrap();
            // A direction on the rim of a cell may round into its neighbour.
            if (light.pdf(d) / pdf - 1.0).abs() > 1e-3 {
                total += 1.0;
            }
            flux[0] += f64::from(light.radiance(d).average() / pdf) / f64::from(n);
            flux[1] += f64::from(light.radiance(uniform_sphere(u)).average() * 4.0 * PI) / f64::from(n);
        }
        assert!(total < 0.001 * f64::from(n), "{total} of {n} disagree");
        let expected = f64::from(mean.average() * 4.0 * PI);
        assert!((flux[0] / expected - 1.0).abs() < 3e-3, "{flux:?} {expected}");
        assert!((flux[1] / expected - 1.0).abs() < 1e-2, "{flux:?} {expected}");
    }

    #[test]
    fn one_texel_is_uniform_and_black_gives_nothing() {
        let (r, c, _) = build_distribution(1, 1, &[Rgb::WHITE]);
        let light = EnvironmentLight {
            width: 1,
            height: 1,
            rotation: 0.0,
            pixels: &[Rgb::WHITE],
            row_cdf: &r,
            cell_cdf: &c,
        };
        for i in 0..100 {
            let (d, pdf) = light.sample([unit(i, 0), unit(i, 1)]).unwrap();
            assert!(
                (d.length() - 1.0).abs() < 1e-5 && (pdf * 4.0 * PI - 1.0).abs() < 1e-5 && light.pdf(d) == pdf
            );
        }
        let (r, c, _) = build_distribution(1, 1, &[Rgb::BLACK]);
        assert!(EnvironmentLight { row_cdf: &r, cell_cdf: &c, ..light }.sample([0.5, 0.5]).is_none());
    }
}
