//! The estimated error of a picture is its error, within the factor that is promised, on five scenes and for both random streams.

use lumbre_core::sampler::SamplerKind;
use lumbre_testkit::calibration::{Plan, Row, SMOOTH, SUBJECTS, Subject, measure};

/// What is promised from 64 samples per pixel on.
const FACTOR: f64 = 1.3;
/// Where it is promised: a picture with a larger error is mere noise, one with a smaller is perfect to the eye.
const RANGE: std::ops::Range<f64> = 1e-4..0.5;

fn plan(sampler: SamplerKind, counts: &[u32]) -> Plan {
    Plan { size: [48, 36], sampler, seeds: 5, counts: counts.into(), first_sample: 0 }
}

fn rows(subject: &Subject, plan: &Plan) -> Option<Vec<Row>> {
    // Errors of the pool lie in rarer paths: fewer seeds would measure luck.
    let seeds = if subject.name == "pool" { 16 } else { plan.seeds };
    let rows = measure(subject, &Plan { seeds, ..plan.clone() });
    let name = subject.name;
    match &rows {
        None => println!("skipped: no scene {name} (set LUMBRE_SCENES)"),
        Some(rows) => rows.iter().for_each(|r| {
            let ratio = r.predicted / r.measured;
            println!("{name} {:?} {}: predicted/measured {ratio:.2}", plan.sampler, r.spp);
        }),
    }
    rows
}

fn holds(subject: &Subject, plan: &Plan) {
    let Some(rows) = rows(subject, plan) else { return };
    let (inside, outside): (Vec<Row>, Vec<Row>) = rows.iter().partition(|r| RANGE.contains(&r.measured));
    assert!(outside.len() <= 1, "{}: the picture is outside of what is promised: {outside:?}", subject.name);
    for row in inside {
        let factor = row.factor(row.predicted);
        assert!(factor <= FACTOR, "{}: {row:?} is off by {factor:.2}", subject.name);
    }
}

#[test]
fn sobol_points_are_predicted() {
    for subject in &SUBJECTS {
        holds(subject, &plan(SamplerKind::Sobol, &[64, 256]));
    }
}

#[test]
fn independent_samples_are_predicted() {
    for subject in &SUBJECTS {
        holds(subject, &plan(SamplerKind::Independent, &[64]));
    }
}

#[test]
fn counts_between_powers_of_two_and_ranges_from_anywhere_too() {
    let plan = plan(SamplerKind::Sobol, &[80, 112]);
    holds(&SUBJECTS[0], &plan);
    holds(&SUBJECTS[0], &Plan { first_sample: 1000, ..plan });
}

/// The same measurement finds that the spread of the samples alone predicts too much for Sobol points.
#[test]
fn the_measurement_tells_a_wrong_prediction() {
    let rows = rows(&SMOOTH, &plan(SamplerKind::Sobol, &[16, 64])).expect("our own scene");
    assert!(rows.iter().all(|r| r.factor(r.by_spread) > 3.0), "{rows:?}");
}
