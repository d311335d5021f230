//! The map of light from far away, with its distribution.

use super::{CompileError, Earlier};
use crate::compiled::lights::EnvironmentRecord;
use crate::compiled::{CompiledScene, NONE};
use crate::{Background, Scene};
use lumbre_core::Rgb;
use lumbre_core::light::environment;
use lumbre_core::math::sqr;
use std::borrow::Cow;

/// Brightest texel: sums of a whole map stay finite.
const BRIGHTEST: f32 = 1e30;

/// Compiles map and tables; whether it is a light is left to `lights`.
pub(super) fn compile(
    scene: &Scene,
    earlier: Option<&Earlier<'_>>,
    out: &mut CompiledScene,
) -> Result<(), CompileError> {
    let environment = &scene.environment;
    let record =
        |width, height| EnvironmentRecord { width, height, rotation: environment.rotation, light: NONE };
    if let Some(Earlier { compiled, .. }) = earlier.filter(|e| e.has_map(environment)) {
        out.environment = record(compiled.environment.width, compiled.environment.height);
        out.environment_pixels = compiled.environment_pixels.clone();
        out.environment_row_cdf = compiled.environment_row_cdf.clone();
        out.environment_cell_cdf = compiled.environment_cell_cdf.clone();
        out.environment_mean = compiled.environment_mean;
        return Ok(());
    }
    let (width, height, pixels): (u32, u32, Cow<'_, [Rgb]>) = match &environment.background {
        Background::Black => (1, 1, Cow::Owned(vec![Rgb::BLACK])),
        Background::Constant(c) => (1, 1, Cow::Owned(vec![*c])),
        Background::Gradient => gradient(),
        Background::Map(map) => {
            if map.width == 0 || map.pixels.len() != map.width as usize * map.height as usize {
                let message = format!("{}x{} texels, but {} values", map.width, map.height, map.pixels.len());
                return Err(CompileError::Invalid { place: "environment".into(), message });
            }
            (map.width, map.height, Cow::Borrowed(&map.pixels))
        }
    };
    let strength = environment.strength.max(0.0);
    let texel = |p: &Rgb| (*p * strength).map(|v| if v.is_nan() { 0.0 } else { v.clamp(0.0, BRIGHTEST) });
    let pixels: Vec<Rgb> = pixels.iter().map(texel).collect();
    let (rows, cells, mean) = environment::build_distribution(width, height, &pixels);
    out.environment = record(width, height);
    out.environment_pixels = pixels.into();
    out.environment_row_cdf = rows.into();
    out.environment_cell_cdf = cells.into();
    out.environment_mean = mean;
    Ok(())
}

/// A plain clear sky: a pale horizon, a blue zenith, dull ground; its mean radiance is near 1 so that automatic and unit
/// exposure both suit it. Colours are ours.
fn gradient<'a>() -> (u32, u32, Cow<'a, [Rgb]>) {
    const ROWS: u32 = 256;
    let (zenith, horizon, ground) =
        (Rgb::new(0.54, 1.07, 2.24), Rgb::new(2.04, 2.18, 2.33), Rgb::new(0.62, 0.56, 0.50));
    let row = |y: u32| {
        let elevation = 0.5 - (y as f32 + 0.5) / ROWS as f32; // in half turns, 0.5 at the zenith
        if elevation >= 0.0 {
            zenith.lerp(horizon, sqr(sqr(1.0 - 2.0 * elevation)))
        } else {
            // A soft edge of a few degrees below the horizon.
            horizon.lerp(ground, (-elevation * 40.0).min(1.0))
        }
    };
    (1, ROWS, (0..ROWS).map(row).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_s_mean_is_near_one() {
        let (w, h, pixels) = gradient();
        let mean = environment::build_distribution(w, h, &pixels).2.luminance();
        assert!((mean - 1.0).abs() < 0.02, "{mean}");
    }
}
