//! An error of a hundredth in any one parameter, handed to one side only, is found, in every family of surfaces that reads the parameter.

use super::cases::Case;
use super::{Verdict, answers, verdict};
use lumbre_core::Spectrum;
use lumbre_core::bsdf::BsdfParams;
use lumbre_core::math::Vec3;

/// A hundredth less: parameters are often at the upper end of their range, and more would be clamped.
const LESS: f32 = 0.99;

type Plant = fn(&mut BsdfParams);

/// Every parameter, and the families in which it must be found.
const PLANTS: [(&str, Plant, &[&str]); 22] = [
    (
        "base_color",
        |p| p.base_color *= LESS,
        &["metals", "bases", "diffuse", "transmissive", "mixtures", "anisotropic"],
    ),
    (
        "base_color, a band",
        |p| p.base_color.g *= LESS,
        &["metals", "bases", "diffuse", "gloss", "transmissive"],
    ),
    ("metallic", |p| p.metallic *= LESS, &["mixtures", "sheens", "anisotropic", "films"]),
    (
        "roughness",
        |p| p.roughness *= LESS,
        &["metals", "bases", "diffuse", "transmissive", "mixtures", "anisotropic"],
    ),
    ("ior", |p| p.ior *= LESS, &["bases", "diffuse", "transmissive", "mixtures", "coats", "films"]),
    ("specular", |p| p.specular *= LESS, &["bases", "diffuse", "mixtures", "coats", "anisotropic", "films"]),
    ("specular_color", |p| p.specular_color *= LESS, &["bases", "diffuse", "mixtures", "films"]),
    (
        "transmission",
        |p| p.transmission *= LESS,
        &["transmissive", "mixtures", "coats", "anisotropic", "films"],
    ),
    ("eta", |p| p.eta *= LESS, &["transmissive", "mixtures", "diffuse", "coats", "anisotropic", "films"]),
    ("eta_fresnel", |p| p.eta_fresnel = p.eta_fresnel.map(|e| e * LESS), &["random"]),
    ("diffuse_roughness", |p| p.diffuse_roughness *= LESS, &["diffuse", "gloss", "mixtures"]),
    ("diffuse_transmission", |p| p.diffuse_transmission *= LESS, &["diffuse", "gloss", "mixtures"]),
    (
        "diffuse_transmission_color",
        |p| p.diffuse_transmission_color *= LESS,
        &["diffuse", "gloss", "mixtures"],
    ),
    ("anisotropy", |p| p.anisotropy *= LESS, &["anisotropic", "random"]),
    ("film", |p| each(&mut p.film, |f| f.factor *= LESS), &["films"]),
    ("film ior", |p| each(&mut p.film, |f| f.ior *= LESS), &["films"]),
    ("film thickness", |p| each(&mut p.film, |f| f.thickness_nm *= LESS), &["films"]),
    ("gloss", |p| each(&mut p.gloss, |g| g.specular *= LESS), &["gloss"]),
    ("gloss exponent", |p| each(&mut p.gloss, |g| g.exponent *= LESS), &["gloss"]),
    ("sheen", |p| each(&mut p.sheen, |s| s.color *= LESS), &["sheens"]),
    ("sheen roughness", |p| each(&mut p.sheen, |s| s.roughness *= LESS), &["sheens"]),
    ("coat", |p| each(&mut p.coat, |c| c.factor *= LESS), &["coats", "tilted coats", "sheens"]),
];

/// The same for what is no factor.
const OTHER_PLANTS: [(&str, Plant, &[&str]); 7] = [
    ("coat roughness", |p| each(&mut p.coat, |c| c.roughness *= LESS), &["coats", "tilted coats", "sheens"]),
    (
        "coat normal",
        |p| each(&mut p.coat, |c| c.normal = (c.normal + Vec3::X * 0.01).normalize()),
        &["coats", "tilted coats"],
    ),
    ("thin", |p| p.thin = !p.thin, &["transmissive", "mixtures"]),
    ("inside", |p| p.inside = !p.inside, &["coats", "sheens"]),
    (
        "diffuse_sampling",
        |p| p.diffuse_sampling = lumbre_core::bsdf::DiffuseSampling::Uniform,
        &["bases", "diffuse", "gloss"],
    ),
    ("gloss fresnel", |p| each(&mut p.gloss, |g| g.fresnel = !g.fresnel), &["gloss"]),
    ("film of another kind", |p| p.film = None, &["films"]),
];

fn each<T>(part: &mut Option<T>, change: impl Fn(&mut T)) {
    part.iter_mut().for_each(change);
}

/// Questions looked at in a family; a hundredth of them must be found wrong.
const ASKED: usize = 1500;

#[test]
fn a_wrong_parameter_is_found() {
    let Some(answers) = answers() else { return };
    let mut missed = Vec::new();
    for (name, plant, families) in PLANTS.iter().chain(&OTHER_PLANTS) {
        for family in *families {
            let of_family: Vec<_> = answers.iter().filter(|(c, _)| c.family == *family).collect();
            let step = of_family.len().div_ceil(ASKED);
            let asked = of_family.iter().step_by(step);
            let wrong = asked.clone().filter(|(case, gpu)| {
                let mut params = case.params;
                plant(&mut params);
                verdict(&Case { params, ..*case }, gpu) != Verdict::Near
            });
            let (wrong, asked) = (wrong.count(), asked.count());
            println!("{name} in {family}: {wrong} of {asked}");
            if wrong * 100 < asked {
                missed.push(format!("{name} in {family}: {wrong} of {asked}"));
            }
        }
    }
    assert!(missed.is_empty(), "not found:\n{}", missed.join("\n"));
}

/// An answer of white where there was none is found too: the comparison looks at every number.
#[test]
fn a_wrong_answer_is_found() {
    let Some(answers) = answers() else { return };
    let drawn = answers.iter().find(|(c, o)| c.family == "films" && o.found == 1 && o.lobe == 2);
    let (case, gpu) = drawn.expect("a film with facets");
    assert_eq!(verdict(case, gpu), Verdict::Near);
    let white = Spectrum::WHITE.to_array();
    for wrong in [
        super::Output { albedo: white, ..*gpu },
        super::Output { thin_transmittance: white, ..*gpu },
        super::Output { straight_transmittance: white, ..*gpu },
        super::Output { has_smooth_lobes: 1 - gpu.has_smooth_lobes, ..*gpu },
        super::Output { has_one_lobe: 1 - gpu.has_one_lobe, ..*gpu },
        super::Output { f: white, ..*gpu },
        super::Output { pdf: f32::NAN, ..*gpu },
        super::Output { found: 1 - gpu.found, ..*gpu },
        super::Output { lobe: gpu.lobe + 1, ..*gpu },
        super::Output { weight: white.map(|w| 2.0 * w), ..*gpu },
        super::Output { sample_pdf: 1.01 * gpu.sample_pdf, ..*gpu },
        super::Output { wi: [gpu.wi[1], gpu.wi[0], gpu.wi[2]], ..*gpu },
        super::Output { eta_scale: 0.99, ..*gpu },
    ] {
        assert_ne!(verdict(case, &wrong), Verdict::Near, "{wrong:?}");
    }
}
