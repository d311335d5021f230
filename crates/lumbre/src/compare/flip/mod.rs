//! FLIP: how different two pictures look to someone who flips between them.
//!
//! LDR-FLIP after Andersson et al. 2020, "FLIP: A Difference Evaluator for Alternating Images"; HDR-FLIP after Andersson
//! et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images". Checked against the authors' program
//! (`flip-evaluator` 1.7); see `tests.rs`.

mod colour;
mod exposure;
mod filter;
#[cfg(test)]
mod tests;

pub use exposure::Exposures;

use super::{CompareError, ImageView, NonFinite, check_pair, magma};
use filter::{Kernels, Plane};
use lumbre_core::Rgb;
use rayon::prelude::*;

/// What an observer sees at 0.7 m from a screen 0.7 m and 3840 pixels wide: 67.02 pixels per degree, the paper's default.
pub const PIXELS_PER_DEGREE: f32 = 3840.0 * std::f32::consts::PI / 180.0;

/// A map of perceived errors.
#[derive(Clone, Debug, PartialEq)]
pub struct FlipMap {
    /// Pixels per row.
    pub width: usize,
    /// Number of rows.
    pub height: usize,
    /// One error per pixel in [0, 1], row 0 on top. A pixel that is not finite in either picture has error 1; for its
    /// neighbours it counts as black in both.
    pub errors: Vec<f32>,
    /// Mean of `errors`.
    pub mean: f64,
    /// The pixels that are not finite.
    pub nonfinite: NonFinite,
    /// The exposures HDR-FLIP looked at; `None` for LDR-FLIP.
    pub exposures: Option<Exposures>,
}

impl FlipMap {
    /// The map as an sRGB picture in magma colours, black for no error to pale yellow for 1, row 0 on top.
    pub fn picture(&self) -> Vec<[u8; 3]> {
        self.errors.iter().map(|e| magma(*e)).collect()
    }
}

/// LDR-FLIP of two pictures as a screen shows them: linear values clamped to [0, 1].
///
/// `pixels_per_degree` is the viewing distance, usually `PIXELS_PER_DEGREE`.
///
/// # Errors
/// When the sizes differ, no pixel is finite in both, or `pixels_per_degree` is not in [1, 1000].
pub fn flip_ldr(
    reference: ImageView,
    test: ImageView,
    pixels_per_degree: f32,
) -> Result<FlipMap, CompareError> {
    let pair = Pair::new(reference, test, pixels_per_degree)?;
    let errors = pair.errors(&|c| c.map(|v| v.clamp(0.0, 1.0)));
    Ok(pair.finish(errors, None))
}

/// HDR-FLIP: per pixel the largest LDR-FLIP over a series of exposures, each through the ACES tone curve. The series is
/// chosen from the reference: see `Exposures::of`.
///
/// # Errors
/// When the sizes differ, no pixel is finite in both, or `pixels_per_degree` is not in [1, 1000].
pub fn flip_hdr(
    reference: ImageView,
    test: ImageView,
    pixels_per_degree: f32,
) -> Result<FlipMap, CompareError> {
    let pair = Pair::new(reference, test, pixels_per_degree)?;
    let exposures = Exposures::of(&pair.reference);
    let mut errors = vec![0.0_f32; pair.reference.len()];
    for stops in exposures.stops() {
        let at_exposure = pair.errors(&exposure::tone_curve(stops));
        errors.par_iter_mut().zip(at_exposure).for_each(|(e, new)| *e = e.max(new));
    }
    Ok(pair.finish(errors, Some(exposures)))
}

/// Two pictures of one size without non-finite pixels.
struct Pair {
    width: usize,
    reference: Vec<Rgb>,
    test: Vec<Rgb>,
    /// Indices of pixels blackened in both.
    blackened: Vec<usize>,
    nonfinite: NonFinite,
    kernels: Kernels,
}

impl Pair {
    fn new(reference: ImageView, test: ImageView, ppd: f32) -> Result<Self, CompareError> {
        let nonfinite = check_pair(reference, test)?;
        // Beyond these bounds the kernels would be empty or larger than any picture.
        if !(1.0..=1000.0).contains(&ppd) {
            return Err(CompareError::PixelsPerDegree(ppd.to_string()));
        }
        let mut pair = Pair {
            width: reference.width(),
            reference: reference.pixels().to_vec(),
            test: test.pixels().to_vec(),
            blackened: Vec::new(),
            nonfinite,
            kernels: Kernels::new(f64::from(ppd)),
        };
        for i in 0..pair.reference.len() {
            if !pair.reference[i].is_finite() || !pair.test[i].is_finite() {
                pair.reference[i] = Rgb::BLACK;
                pair.test[i] = Rgb::BLACK;
                pair.blackened.push(i);
            }
        }
        Ok(pair)
    }

    /// The error of each pixel once `to_screen` has brought both pictures to linear values in [0, 1].
    fn errors(&self, to_screen: &(impl Fn(Rgb) -> Rgb + Sync)) -> Vec<f32> {
        let reference = Appearance::of(&self.reference, self.width, to_screen, &self.kernels);
        let test = Appearance::of(&self.test, self.width, to_screen, &self.kernels);
        let largest = largest_colour_difference();
        (0..self.reference.len())
            .into_par_iter()
            .map(|i| {
                let colour = colour_error(colour::hyab(reference.lab[i], test.lab[i]), largest);
                let edge = (reference.edges[i] - test.edges[i]).abs();
                let point = (reference.points[i] - test.points[i]).abs();
                // Section 4.2.2, qf = 0.5; the detectors answer with at most sqrt(2).
                let feature = (edge.max(point) / std::f32::consts::SQRT_2).sqrt();
                colour.powf(1.0 - feature)
            })
            .collect()
    }

    fn finish(self, mut errors: Vec<f32>, exposures: Option<Exposures>) -> FlipMap {
        for i in &self.blackened {
            errors[*i] = 1.0;
        }
        let mean = errors.iter().map(|e| f64::from(*e)).sum::<f64>() / errors.len() as f64;
        let (width, height) = (self.width, errors.len() / self.width);
        FlipMap { width, height, errors, mean, nonfinite: self.nonfinite, exposures }
    }
}

/// What FLIP knows of one picture.
struct Appearance {
    /// Hunt-adjusted L*a*b* after the eye's blur.
    lab: Vec<[f32; 3]>,
    /// Strength of the edge at each pixel.
    edges: Vec<f32>,
    /// Strength of the point or line at each pixel.
    points: Vec<f32>,
}

impl Appearance {
    fn of(pixels: &[Rgb], width: usize, to_screen: &(impl Fn(Rgb) -> Rgb + Sync), k: &Kernels) -> Self {
        let opponent: Vec<[f32; 3]> =
            pixels.par_iter().map(|p| colour::rgb_to_ycxcz(to_screen(*p).to_array())).collect();
        let channel = |c: usize| Plane { width, data: opponent.par_iter().map(|p| p[c]).collect() };

        // Colour: blur each opponent channel as the eye does, clamp to the screen's gamut, go to L*a*b*.
        let y = channel(0);
        let blurred_y = y.filtered(&k.achromatic, &k.achromatic).data;
        let cx = channel(1).filtered(&k.red_green, &k.red_green).data;
        let cz = channel(2);
        let [(share_1, g1), (share_2, g2)] = &k.blue_yellow;
        let (cz_1, cz_2) = (cz.filtered(g1, g1).data, cz.filtered(g2, g2).data);
        let lab = (0..pixels.len())
            .into_par_iter()
            .map(|i| {
                let seen = [blurred_y[i], cx[i], share_1 * cz_1[i] + share_2 * cz_2[i]];
                colour::rgb_to_hunt_lab(colour::ycxcz_to_rgb(seen).map(|v| v.clamp(0.0, 1.0)))
            })
            .collect();

        // Features: edges and points of the luminance, not blurred.
        let luminance =
            Plane { width, data: y.data.par_iter().map(|y| colour::unit_luminance(*y)).collect() };
        let strength = |detector: &filter::Kernel| {
            let along_x = luminance.filtered(detector, &k.smooth).data;
            let along_y = luminance.filtered(&k.smooth, detector).data;
            along_x.par_iter().zip(&along_y).map(|(x, y)| (x * x + y * y).sqrt()).collect()
        };
        Appearance { lab, edges: strength(&k.edge), points: strength(&k.point) }
    }
}

/// Exponent of colour differences (section 4.1.3).
const QC: f32 = 0.7;

/// The largest HyAB difference on the screen, green to blue, after the exponent.
fn largest_colour_difference() -> f32 {
    let green = colour::rgb_to_hunt_lab([0.0, 1.0, 0.0]);
    let blue = colour::rgb_to_hunt_lab([0.0, 0.0, 1.0]);
    colour::hyab(green, blue).powf(QC)
}

/// A HyAB difference on the scale [0, 1]: those below 40 % of the largest fill [0, 0.95], the rest is pressed into what
/// remains (section 4.1.3, pc and pt).
fn colour_error(hyab: f32, largest: f32) -> f32 {
    const PT: f32 = 0.95;
    let knee = 0.4 * largest;
    let d = hyab.powf(QC);
    if d < knee { d * PT / knee } else { PT + (d - knee) / (largest - knee) * (1.0 - PT) }
}
