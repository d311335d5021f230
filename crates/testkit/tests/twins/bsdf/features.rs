//! Shaders compiled without what a family of surfaces does not have (bsdf/features.glsl) say the same about it.

use super::cases::{Case, cases};
use super::{Output, Verdict, verdict};
use crate::{evaluate_with, kernel};
use lumbre_core::bsdf::{BsdfParams, DiffuseSampling};
use lumbre_vulkan::Specialisation;

/// Whether a surface needs a constant.
type Needs = fn(&BsdfParams) -> bool;

/// Each constant of features.glsl, by its id.
const FEATURES: [(u32, Needs); 12] = [
    (10, |p| p.metallic > 0.0),
    (11, |p| p.specular > 0.0 && p.gloss.is_none() && p.metallic < 1.0 && p.transmission < 1.0),
    (12, |p| p.gloss.is_some()),
    (13, |p| !p.thin),
    (14, |p| p.thin && p.transmission > 0.0),
    (15, |p| p.sheen.is_some()),
    (16, |p| p.coat.is_some()),
    (17, |p| p.film.is_some()),
    (18, |p| p.anisotropy > 0.0),
    (19, |p| p.diffuse_roughness > 0.0),
    (20, |p| p.diffuse_transmission > 0.0),
    (21, |p| p.diffuse_sampling == DiffuseSampling::Uniform),
];

/// Constants with only what these surfaces need, but for one of them (by its id) if given.
fn constants(cases: &[Case], without: Option<u32>) -> Specialisation {
    FEATURES.iter().fold(Specialisation::new(), |constants, (id, needs)| {
        constants.bool(*id, without != Some(*id) && cases.iter().any(|c| needs(&c.params)))
    })
}

/// How many answers are far, and how many fork, of a kernel with these constants; `None` without a device.
fn wrong(cases: &[Case], constants: &Specialisation) -> Option<[usize; 2]> {
    let inputs: Vec<_> = cases.iter().map(Case::input).collect();
    let tables = lumbre_shaders::tables::tables();
    let gpu: Vec<Output> = evaluate_with(kernel!("bsdf"), &tables, constants, &inputs)?;
    let mut counts = [0; 2];
    for (case, gpu) in cases.iter().zip(&gpu) {
        match verdict(case, gpu) {
            Verdict::Near => {}
            Verdict::Far(_) => counts[0] += 1,
            Verdict::Forked => counts[1] += 1,
        }
    }
    Some(counts)
}

/// A twentieth of the questions to a family.
fn family(all: &[Case], name: &str) -> Vec<Case> {
    all.iter().filter(|c| c.family == name).step_by(20).copied().collect()
}

#[test]
fn what_a_family_does_not_have_can_be_left_out() {
    let all = cases();
    for name in
        ["metals", "bases", "diffuse", "gloss", "transmissive", "mixtures", "coats", "sheens", "films"]
    {
        let cases = family(&all, name);
        let Some([far, forked]) = wrong(&cases, &constants(&cases, None)) else { return };
        assert!(far == 0 && forked <= 1, "{name}, of {}: {far} far, {forked} forked", cases.len());
    }
    // Plain Lambert, with everything left out.
    let lambert = |c: &Case| FEATURES.iter().all(|(_, needs)| !needs(&c.params));
    let cases: Vec<_> = all.iter().filter(|c| lambert(c)).copied().collect();
    assert!(cases.len() > 100);
    assert_eq!(wrong(&cases, &constants(&cases, None)), Some([0, 0]), "plain Lambert");
}

/// Leaving out what a family has is found.
#[test]
fn what_a_family_has_is_missed() {
    let all = cases();
    let of_family = [
        (10, "metals"),
        (11, "bases"),
        (12, "gloss"),
        (13, "transmissive"),
        (14, "transmissive"),
        (15, "sheens"),
        (16, "coats"),
        (17, "films"),
        (18, "anisotropic"),
        (19, "diffuse"),
        (20, "diffuse"),
        (21, "bases"),
    ];
    for (id, name) in of_family {
        let cases = family(&all, name);
        let Some(wrong) = wrong(&cases, &constants(&cases, Some(id))) else { return };
        let wrong = wrong[0] + wrong[1];
        assert!(wrong * 100 > cases.len(), "constant {id} off in {name}: {wrong} of {}", cases.len());
    }
}
