//! `bsdf/` against `lumbre_core::bsdf`: value, density, direction drawn and all else that a surface is asked, for every model.
//!
//! How near both sides must be is a matter of each question. A lobe of width α magnifies the rounding of its half vector by 1/α, a film
//! that of its path; no bound for all of them would be tight. So Rust's side is asked again with each number of the question moved by a few
//! roundings (quotients and roots of GPUs are off by up to three), and its answer may differ from the other side's by twice what all of that
//! changes, a ten thousandth, and three millionths: of the unit vectors and colours that all this is about, and of values and densities, which are 0.3
//! and 0.2 for light spread evenly (tables are read to a hundred thousandth of their columns, so that lost light is known to 1e-7 and no better).

mod cases;
mod features;
mod planted;

use super::{evaluate, kernel};
use bytemuck::{Pod, Zeroable};
use cases::{Case, cases};
use lumbre_core::bsdf::{Bsdf, BsdfParams, CoatParams, FilmParams, Lobe, SheenParams};
use lumbre_core::math::Vec3;
use std::sync::OnceLock;

/// `Output` of the kernel.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    f: [f32; 3],
    pdf: f32,
    found: u32,
    wi: [f32; 3],
    weight: [f32; 3],
    sample_pdf: f32,
    lobe: u32,
    eta_scale: f32,
    albedo: [f32; 3],
    thin_transmittance: [f32; 3],
    straight_transmittance: [f32; 3],
    has_smooth_lobes: u32,
    has_one_lobe: u32,
}

fn lobe_number(lobe: Lobe) -> u32 {
    match lobe {
        Lobe::DiffuseReflection => 0,
        Lobe::DiffuseTransmission => 1,
        Lobe::GlossyReflection => 2,
        Lobe::SpecularReflection => 3,
        Lobe::GlossyTransmission => 4,
        Lobe::SpecularTransmission => 5,
        Lobe::ThinTransmission => 6,
    }
}

/// Mirrors and straight passages: their weight is given, and no density.
fn is_delta(lobe: u32) -> bool {
    matches!(lobe, 3 | 5 | 6)
}

fn twin(c: &Case) -> Output {
    let bsdf = Bsdf::new(&c.params);
    let (f, pdf) = bsdf.eval_pdf(c.wo, c.wi, c.mode);
    let mut o = Output {
        f: f.to_array(),
        pdf,
        albedo: bsdf.albedo().to_array(),
        thin_transmittance: bsdf.thin_transmittance(c.wo).to_array(),
        straight_transmittance: bsdf.straight_transmittance(c.wo).to_array(),
        has_smooth_lobes: bsdf.has_smooth_lobes().into(),
        has_one_lobe: bsdf.has_one_lobe().into(),
        ..Output::zeroed()
    };
    if let Some(s) = bsdf.sample(c.wo, c.u_lobe, c.u, c.mode) {
        o.found = 1;
        o.wi = s.wi.to_array();
        o.weight = s.weight.to_array();
        o.sample_pdf = s.pdf;
        o.lobe = lobe_number(s.lobe);
        o.eta_scale = s.eta_scale;
    }
    o
}

/// What is compared.
fn numbers(o: &Output) -> [(&'static str, f32); 23] {
    let [f, w, a] = [o.f, o.weight, o.albedo];
    let [d, t, s] = [o.wi, o.thin_transmittance, o.straight_transmittance];
    [
        ("f", f[0]),
        ("f", f[1]),
        ("f", f[2]),
        ("pdf", o.pdf),
        ("wi", d[0]),
        ("wi", d[1]),
        ("wi", d[2]),
        ("weight", w[0]),
        ("weight", w[1]),
        ("weight", w[2]),
        ("sample pdf", o.sample_pdf),
        ("eta scale", o.eta_scale),
        ("albedo", a[0]),
        ("albedo", a[1]),
        ("albedo", a[2]),
        ("thin transmittance", t[0]),
        ("thin transmittance", t[1]),
        ("thin transmittance", t[2]),
        ("straight transmittance", s[0]),
        ("straight transmittance", s[1]),
        ("straight transmittance", s[2]),
        ("has smooth lobes", o.has_smooth_lobes as f32),
        ("has one lobe", o.has_one_lobe as f32),
    ]
}

/// What counts as nothing.
const ABSOLUTE: f32 = 3e-6;

/// A few roundings.
const STEP: f32 = 4.0 * f32::EPSILON;

/// Where `numbers` has the weight of a sample, and its density behind.
const FIRST_WEIGHT: usize = 7;

/// The same question with one number moved by a few roundings.
fn nudged(c: &Case) -> Vec<Case> {
    let more = |x: f32| x * (1.0 + STEP);
    let along = |w: Vec3, axis: Vec3| (w + axis * STEP).normalize();
    let mut all = Vec::new();
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        all.push(Case { wo: along(c.wo, axis), ..*c });
        all.push(Case { wi: along(c.wi, axis), ..*c });
    }
    // The small cosine of a grazing direction, by its own size.
    all.push(Case { wo: Vec3::new(c.wo.x, c.wo.y, more(c.wo.z)), ..*c });
    all.push(Case { wi: Vec3::new(c.wi.x, c.wi.y, more(c.wi.z)), ..*c });
    all.push(Case { u_lobe: c.u_lobe + STEP, ..*c });
    all.push(Case { u: [c.u[0] + STEP, c.u[1]], ..*c });
    all.push(Case { u: [c.u[0], c.u[1] + STEP], ..*c });
    let mut params = |change: &dyn Fn(&mut BsdfParams)| {
        let mut params = c.params;
        change(&mut params);
        all.push(Case { params, ..*c });
    };
    params(&|p| p.roughness = more(p.roughness));
    params(&|p| {
        p.eta = more(p.eta);
        p.eta_fresnel = p.eta_fresnel.map(more);
        p.ior = more(p.ior);
    });
    if let Some(film) = c.params.film {
        params(&|p| p.film = Some(FilmParams { thickness_nm: more(film.thickness_nm), ..film }));
        params(&|p| p.film = Some(FilmParams { ior: more(film.ior), ..film }));
    }
    if let Some(coat) = c.params.coat {
        params(&|p| p.coat = Some(CoatParams { roughness: more(coat.roughness), ..coat }));
    }
    if let Some(sheen) = c.params.sheen {
        params(&|p| p.sheen = Some(SheenParams { roughness: more(sheen.roughness), ..sheen }));
    }
    all
}

/// How an answer of the other side compares.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    Near,
    /// The path takes another turn: another lobe, or none.
    Forked,
    /// This number is further away than it may be.
    Far(&'static str),
}

fn verdict(c: &Case, gpu: &Output) -> Verdict {
    let rust = twin(c);
    if (rust.found, rust.lobe) != (gpu.found, gpu.lobe) && (rust.found | gpu.found) != 0 {
        return Verdict::Forked;
    }
    let (a, b) = (numbers(&rust), numbers(gpu));
    let far = |spread: &[f32; 23]| {
        let drawn = |name| matches!(name, "wi" | "weight" | "sample pdf" | "eta scale");
        let far = a.iter().zip(&b).zip(spread).find(|((a, b), spread)| {
            let allowed = 1e-4 * a.1.abs().max(b.1.abs()) + ABSOLUTE + 2.0 * **spread;
            // What is no number is far from everything.
            let near = (a.1 - b.1).abs() <= allowed || a.1 == b.1;
            (rust.found == 1 || !drawn(a.0)) && !near
        });
        far.map(|((a, _), _)| a.0)
    };
    // Most are near without asking again.
    if far(&[0.0; 23]).is_none() {
        return Verdict::Near;
    }
    let mut spread = [0.0f32; 23];
    for other in nudged(c) {
        for ((sum, a), b) in spread.iter_mut().zip(&a).zip(numbers(&twin(&other))) {
            *sum += (a.1 - b.1).abs();
        }
    }
    // What a weight is divided by is known no better: a density to a millionth, the probability of a choice of which the other one leaves
    // hardly anything to a few roundings of 1.
    if rust.found == 1 {
        let known = if is_delta(rust.lobe) { STEP } else { ABSOLUTE };
        (0..3).for_each(|k| spread[FIRST_WEIGHT + k] += known / rust.sample_pdf * rust.weight[k]);
        spread[FIRST_WEIGHT + 3] += known;
    }
    // The direction drawn is rounded once more before it is weighed.
    if rust.found == 1 && rust.sample_pdf > 0.0 && !is_delta(rust.lobe) {
        let (bsdf, wi) = (Bsdf::new(&c.params), Vec3::from_array(rust.wi));
        let weigh = |wi: Vec3| {
            let (f, pdf) = bsdf.eval_pdf(c.wo, wi, c.mode);
            let [r, g, b] = (f / pdf).to_array();
            [r, g, b, pdf]
        };
        let at = weigh(wi);
        let turned = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| (wi + axis * STEP).normalize());
        for other in turned.into_iter().chain([wi * (1.0 + STEP)]) {
            let beside = weigh(other);
            (0..4).for_each(|k| spread[FIRST_WEIGHT + k] += (beside[k] - at[k]).abs());
        }
    }
    far(&spread).map_or(Verdict::Near, Verdict::Far)
}

/// The questions and the device's answers; `None` without a device.
fn answers() -> Option<&'static [(Case, Output)]> {
    static ANSWERS: OnceLock<Option<Vec<(Case, Output)>>> = OnceLock::new();
    let ask = || {
        let cases = cases();
        let inputs: Vec<_> = cases.iter().map(Case::input).collect();
        let gpu: Vec<Output> = evaluate(kernel!("bsdf"), &lumbre_shaders::tables::tables(), &inputs)?;
        Some(cases.into_iter().zip(gpu).collect())
    };
    ANSWERS.get_or_init(ask).as_deref()
}

#[test]
fn both_sides_say_the_same() {
    let Some(answers) = answers() else { return };
    let (mut forked, mut far) = (0, 0);
    for (i, (case, gpu)) in answers.iter().enumerate() {
        match verdict(case, gpu) {
            Verdict::Near => {}
            Verdict::Forked => {
                forked += 1;
                println!("forked {i}: {case:?}\n  here  {:?}\n  there {gpu:?}", twin(case));
            }
            Verdict::Far(number) => {
                far += 1;
                println!("{number} of {i}: {case:?}\n  here  {:?}\n  there {gpu:?}", twin(case));
            }
        }
    }
    println!("of {}: {forked} forked, {far} far", answers.len());
    assert!(far == 0 && forked <= answers.len() / 10_000, "of {}: {forked} forked, {far} far", answers.len());
}
