//! `lumbre compare`: how much a picture differs from a reference, in figures and as a picture.

use crate::console;
use crate::exit::{Code, Failure};
use crate::flags::compare::{CompareArgs, Metric, Threshold};
use lumbre::compare::{
    FlipMap, ImageView, NonFinite, PIXELS_PER_DEGREE, flip_hdr, flip_ldr, psnr, rel_mse, rmse,
};
use lumbre::core::Rgb;
use lumbre::core::color::Exposure;
use lumbre::io::{self, Limits, LinearImage, Range};
use serde_json::json;

/// The figures.
struct Figures {
    rmse: f64,
    rel_mse: f64,
    psnr: f64,
    ldr_flip: FlipMap,
    /// Of two HDR pictures.
    hdr_flip: Option<FlipMap>,
    non_finite: NonFinite,
    /// Exposure at which HDR pictures were shown; `None` if there were none.
    ev: Option<f32>,
}

/// Runs the command.
pub(crate) fn run(args: &CompareArgs) -> Result<Code, Failure> {
    if let Some(path) = &args.output {
        if !path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
            return Err(Failure::usage(format!("{}: the difference picture is a .png", path.display())));
        }
        io::check_writable(path)?;
    }
    let read = |path| io::read_picture(path, args.layer.as_deref(), &Limits::default());
    let (reference, test) = (read(&args.reference)?, read(&args.test)?);
    if args.fail_above.iter().any(|t| t.metric == Metric::HdrFlip) && !(both_hdr(&reference, &test)) {
        return Err(Failure::usage("hdr-flip is only there for two HDR pictures"));
    }
    let figures = measure(reference, test, args.exposure)?;
    warn_of_non_finite(figures.non_finite);
    console::result(if args.json { as_json(&figures) } else { as_text(&figures) })?;
    if let Some(path) = &args.output {
        let map = figures.hdr_flip.as_ref().unwrap_or(&figures.ldr_flip);
        io::write_png(path, map.width as u32, map.height as u32, map.picture().as_flattened())?;
        console::note(format_args!("wrote {}", path.display()));
    }
    Ok(verdict(&figures, &args.fail_above))
}

type Picture = (LinearImage, Range);

fn both_hdr(a: &Picture, b: &Picture) -> bool {
    a.1 == Range::Scene && b.1 == Range::Scene
}

fn view(image: &LinearImage) -> Result<ImageView<'_>, Failure> {
    Ok(ImageView::new(image.width as usize, image.height as usize, &image.pixels)?)
}

fn measure(reference: Picture, test: Picture, exposure: Exposure) -> Result<Figures, Failure> {
    let hdr = both_hdr(&reference, &test);
    // What a screen shows: HDR pictures at one exposure, that of the reference if it is HDR; the others as they are.
    let exposed = [&reference, &test].into_iter().find(|p| p.1 == Range::Scene);
    let factor = exposed.map(|p| exposure.factor(&p.0.pixels, p.0.width as usize));
    let shown = |(image, range): &Picture| match factor {
        Some(factor) if *range == Range::Scene => exposed_image(image, factor, !hdr),
        _ => image.clone(),
    };
    let (shown_reference, shown_test) = (shown(&reference), shown(&test));
    let screen = (view(&shown_reference)?, view(&shown_test)?);
    let linear = if hdr { (view(&reference.0)?, view(&test.0)?) } else { screen };
    let root = rmse(linear.0, linear.1)?;
    Ok(Figures {
        rmse: root.value,
        rel_mse: rel_mse(linear.0, linear.1)?.value,
        psnr: psnr(screen.0, screen.1)?.value,
        ldr_flip: flip_ldr(screen.0, screen.1, PIXELS_PER_DEGREE)?,
        hdr_flip: if hdr { Some(flip_hdr(linear.0, linear.1, PIXELS_PER_DEGREE)?) } else { None },
        non_finite: root.nonfinite,
        ev: factor.map(f32::log2),
    })
}

/// The picture times a factor; beside one that is already as a screen shows it, what is too bright is clipped as a file would.
fn exposed_image(image: &LinearImage, factor: f32, clip: bool) -> LinearImage {
    let one = |p: &Rgb| {
        let p = *p * factor;
        if clip && p.is_finite() { p.map(|v| v.clamp(0.0, 1.0)) } else { p }
    };
    LinearImage { pixels: image.pixels.iter().map(one).collect(), ..*image }
}

fn warn_of_non_finite(n: NonFinite) {
    if n.either > 0 {
        console::warning(format_args!(
            "{} pixels of the reference and {} of the other picture are not finite and are left out",
            n.reference, n.test
        ));
    }
}

fn as_text(f: &Figures) -> String {
    let mut lines = vec![
        format!("rmse      {:.6}", f.rmse),
        format!("relmse    {:.6}", f.rel_mse),
        format!("psnr      {:.3} dB", f.psnr),
        format!("ldr-flip  {:.6}", f.ldr_flip.mean),
    ];
    lines.extend(f.hdr_flip.as_ref().map(|m| format!("hdr-flip  {:.6}", m.mean)));
    lines.extend(f.ev.map(|ev| format!("exposure  {ev:+.2} EV")));
    lines.join("\n")
}

fn as_json(f: &Figures) -> String {
    json!({
        "rmse": f.rmse,
        "relmse": f.rel_mse,
        "psnr": f.psnr.is_finite().then_some(f.psnr),
        "ldr_flip": f.ldr_flip.mean,
        "hdr_flip": f.hdr_flip.as_ref().map(|m| m.mean),
        "exposure_ev": f.ev,
        "non_finite_reference": f.non_finite.reference,
        "non_finite_test": f.non_finite.test,
        "width": f.ldr_flip.width,
        "height": f.ldr_flip.height,
    })
    .to_string()
}

/// Whether all bounds hold; says which do not. Pixels that are no numbers cannot hide from a bound by being left out.
fn verdict(f: &Figures, bounds: &[Threshold]) -> Code {
    let implied = Threshold { metric: Metric::NonFinite, value: 0.0 };
    let given = bounds.iter().any(|t| t.metric == Metric::NonFinite);
    let implied = (!bounds.is_empty() && !given).then_some(implied);
    let mut code = Code::Done;
    for bound in bounds.iter().chain(&implied) {
        let value = match bound.metric {
            Metric::Rmse => f.rmse,
            Metric::RelMse => f.rel_mse,
            Metric::LdrFlip => f.ldr_flip.mean,
            Metric::HdrFlip => f.hdr_flip.as_ref().map_or(f64::NAN, |m| m.mean),
            Metric::NonFinite => (f.non_finite.either - f.non_finite.reference) as f64,
        };
        // A figure that is no number is above any bound.
        if value.is_nan() || value > bound.value {
            console::error(format_args!("{} is {value}, above {}", bound.metric.name(), bound.value));
            code = Code::Different;
        }
    }
    code
}
