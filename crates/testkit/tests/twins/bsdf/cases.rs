//! What both sides are asked: surfaces, directions and random numbers.

use super::super::columns::Numbers;
use bytemuck::{Pod, Zeroable};
use lumbre_core::bsdf::{
    BsdfParams, CoatParams, DiffuseSampling, FilmParams, GlossParams, SheenParams, TransportMode,
};
use lumbre_core::math::{ONE_MINUS_EPSILON, Vec3};
use lumbre_core::{Spectrum, bsdf::Bsdf};
use lumbre_testkit::bsdf_rows::{self, Row};

/// One question.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    /// Which family of surfaces it belongs to.
    pub(super) family: &'static str,
    pub(super) params: BsdfParams,
    pub(super) wo: Vec3,
    pub(super) wi: Vec3,
    pub(super) u_lobe: f32,
    pub(super) u: [f32; 2],
    pub(super) mode: TransportMode,
}

/// `Input` of the kernel.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Input {
    base_color: Spectrum,
    metallic: f32,
    roughness: f32,
    ior: f32,
    specular: f32,
    specular_color: Spectrum,
    transmission: f32,
    thin: u32,
    eta: f32,
    inside: u32,
    has_eta_fresnel: u32,
    eta_fresnel: f32,
    diffuse_sampling: u32,
    diffuse_roughness: f32,
    diffuse_transmission: f32,
    diffuse_transmission_color: Spectrum,
    anisotropy: f32,
    has_film: u32,
    film: [f32; 3],
    has_gloss: u32,
    gloss_specular: Spectrum,
    gloss_exponent: f32,
    gloss_fresnel: u32,
    has_sheen: u32,
    sheen_color: Spectrum,
    sheen_roughness: f32,
    has_coat: u32,
    coat_factor: f32,
    coat_roughness: f32,
    coat_normal: [f32; 3],
    wo: [f32; 3],
    wi: [f32; 3],
    u_lobe: f32,
    u: [f32; 2],
    mode: u32,
}

impl Case {
    pub(super) fn input(&self) -> Input {
        let p = &self.params;
        let film = p.film.unwrap_or(FilmParams { factor: 0.0, ior: 1.0, thickness_nm: 0.0 });
        let gloss =
            p.gloss.unwrap_or(GlossParams { specular: Spectrum::BLACK, exponent: 0.0, fresnel: false });
        let sheen = p.sheen.unwrap_or(SheenParams { color: Spectrum::BLACK, roughness: 1.0 });
        let coat = p.coat.unwrap_or(CoatParams { factor: 0.0, roughness: 0.0, normal: Vec3::Z });
        Input {
            base_color: p.base_color,
            metallic: p.metallic,
            roughness: p.roughness,
            ior: p.ior,
            specular: p.specular,
            specular_color: p.specular_color,
            transmission: p.transmission,
            thin: p.thin.into(),
            eta: p.eta,
            inside: p.inside.into(),
            has_eta_fresnel: p.eta_fresnel.is_some().into(),
            eta_fresnel: p.eta_fresnel.unwrap_or(0.0),
            diffuse_sampling: (p.diffuse_sampling == DiffuseSampling::Uniform).into(),
            diffuse_roughness: p.diffuse_roughness,
            diffuse_transmission: p.diffuse_transmission,
            diffuse_transmission_color: p.diffuse_transmission_color,
            anisotropy: p.anisotropy,
            has_film: p.film.is_some().into(),
            film: [film.factor, film.ior, film.thickness_nm],
            has_gloss: p.gloss.is_some().into(),
            gloss_specular: gloss.specular,
            gloss_exponent: gloss.exponent,
            gloss_fresnel: gloss.fresnel.into(),
            has_sheen: p.sheen.is_some().into(),
            sheen_color: sheen.color,
            sheen_roughness: sheen.roughness,
            has_coat: p.coat.is_some().into(),
            coat_factor: coat.factor,
            coat_roughness: coat.roughness,
            coat_normal: coat.normal.to_array(),
            wo: self.wo.to_array(),
            wi: self.wi.to_array(),
            u_lobe: self.u_lobe,
            u: self.u,
            mode: (self.mode == TransportMode::Importance).into(),
        }
    }
}

/// The rows of `bsdf_rows` by family.
fn families() -> Vec<(&'static str, Vec<Row>)> {
    vec![
        ("metals", bsdf_rows::metals()),
        ("bases", bsdf_rows::bases()),
        ("diffuse", bsdf_rows::diffuse()),
        ("gloss", bsdf_rows::gloss()),
        ("transmissive", bsdf_rows::transmissive()),
        ("mixtures", bsdf_rows::mixtures()),
        ("coats", bsdf_rows::coats()),
        ("tilted coats", bsdf_rows::tilted_coats()),
        ("sheens", bsdf_rows::sheens()),
        ("anisotropic", bsdf_rows::anisotropic()),
        ("films", bsdf_rows::films()),
    ]
}

/// Questions to each row of the tables.
const PER_ROW: u32 = 400;
/// Surfaces with any parameters.
const RANDOM: u32 = 60_000;

/// All questions: each row of the tables, surfaces with random parameters, and surfaces at the ends of what parameters mean.
pub(super) fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    let mut seed = 0;
    let mut ask = |family, params: BsdfParams| {
        seed += 1;
        all.push(case(family, params, &mut Numbers::new(seed)));
    };
    for (family, rows) in families() {
        for row in rows {
            (0..PER_ROW).for_each(|_| ask(family, row.params));
        }
    }
    for params in corners() {
        (0..PER_ROW / 4).for_each(|_| ask("corners", params));
    }
    for i in 0..RANDOM {
        ask("random", random(&mut Numbers::new(0x4000_0000 + i)));
    }
    all
}

/// A question about a surface.
fn case(family: &'static str, params: BsdfParams, n: &mut Numbers) -> Case {
    let wo = match (n.below(8), params.eta < 1.0) {
        (0, true) => at_critical_angle(params.eta, n),
        _ => from_above(n),
    };
    let (u_lobe, u) = (n.unit(), n.pair());
    // Seldom the ends: there they meet choices of a probability that rounding decides.
    let u_lobe = match n.below(256) {
        0 => 0.0,
        1 => ONE_MINUS_EPSILON,
        _ => u_lobe,
    };
    let mode = n.one_of(&[TransportMode::Radiance, TransportMode::Radiance, TransportMode::Importance]);
    let (other_lobe, other) = (n.unit(), n.pair());
    // Where the surface itself sends light, and anywhere; now and then straight at the horizon.
    let drawn = Bsdf::new(&params).sample(wo, other_lobe, other, mode).map(|s| s.wi);
    let anywhere = Vec3::from_array(n.direction());
    let wi = match n.below(8) {
        0 => anywhere,
        1 => from_above(n),
        2 => Vec3::new(0.6, 0.8, 0.0),
        _ => drawn.unwrap_or(anywhere),
    };
    Case { family, params, wo, wi, u_lobe, u, mode }
}

/// A direction about where total reflection begins.
fn at_critical_angle(eta: f32, n: &mut Numbers) -> Vec3 {
    let beside = n.scale(1e-7, 1e-2) * n.one_of(&[-1.0, 1.0]);
    let z = ((1.0 - eta * eta).sqrt() * (1.0 + beside)).min(1.0);
    let phi = n.between(0.0, std::f32::consts::TAU);
    let sin = (1.0 - z * z).sqrt();
    Vec3::new(sin * phi.cos(), sin * phi.sin(), z)
}

/// A direction above the surface: any, grazing down to the least cosine that scatters, or the normal itself.
fn from_above(n: &mut Numbers) -> Vec3 {
    let grazing = n.scale(2e-6, 1.0);
    let z = match n.below(16) {
        0 => return Vec3::Z,
        1..4 => grazing,
        _ => n.unit().max(1e-5),
    };
    let phi = n.between(0.0, std::f32::consts::TAU);
    let sin = (1.0 - z * z).sqrt();
    Vec3::new(sin * phi.cos(), sin * phi.sin(), z)
}

fn color(n: &mut Numbers) -> Spectrum {
    let any = Spectrum::new(n.unit(), n.unit(), n.unit());
    n.one_of(&[any, any, any, any, Spectrum::BLACK, Spectrum::WHITE])
}

/// A share: often 0 or 1.
fn share(n: &mut Numbers) -> f32 {
    let any = n.unit();
    n.one_of(&[0.0, 0.0, any, 1.0])
}

fn roughness(n: &mut Numbers) -> f32 {
    let any = n.unit();
    n.one_of(&[0.0, any, any, any, 0.0317, 1.0])
}

/// Any parameters.
fn random(n: &mut Numbers) -> BsdfParams {
    let eta = n.between(1.0, 2.5);
    let eta = n.one_of(&[eta, 1.0 / eta, 1.5, 1.0]);
    let dispersion = n.between(0.98, 1.02);
    let film =
        FilmParams { factor: n.unit(), ior: n.between(1.0, 2.5), thickness_nm: n.between(0.0, 1500.0) };
    let gloss =
        GlossParams { specular: color(n) * 0.7, exponent: n.scale(0.1, 3e6), fresnel: n.below(2) == 0 };
    let sheen = SheenParams { color: color(n), roughness: roughness(n) };
    let lean = Vec3::new(n.between(-0.3, 0.3), n.between(-0.3, 0.3), 1.0).normalize();
    let coat = CoatParams { factor: share(n), roughness: roughness(n), normal: n.one_of(&[Vec3::Z, lean]) };
    BsdfParams {
        base_color: color(n),
        metallic: share(n),
        roughness: roughness(n),
        ior: n.between(1.0, 2.5),
        specular: share(n),
        specular_color: color(n) * 1.5,
        transmission: share(n),
        thin: n.below(2) == 0,
        eta,
        inside: eta < 1.0,
        eta_fresnel: (eta > 1.0 && n.below(4) == 0).then_some((eta * dispersion).max(1.0)),
        diffuse_sampling: n.one_of(&[
            DiffuseSampling::Cosine,
            DiffuseSampling::Cosine,
            DiffuseSampling::Uniform,
        ]),
        diffuse_roughness: share(n),
        diffuse_transmission: share(n),
        diffuse_transmission_color: color(n),
        anisotropy: share(n),
        film: (n.below(4) == 0).then_some(film),
        gloss: (n.below(6) == 0).then_some(gloss),
        sheen: (n.below(4) == 0).then_some(sheen),
        coat: (n.below(4) == 0).then_some(coat),
    }
}

/// The ends of parameters: roughness on both sides of where surfaces become smooth, indices beside each other, films that do nothing.
fn corners() -> Vec<BsdfParams> {
    let d = BsdfParams { base_color: Spectrum::new(0.8, 0.45, 0.1), ..BsdfParams::default() };
    let solid = BsdfParams { transmission: 1.0, thin: false, ..d };
    let film = |factor, ior, thickness_nm| Some(FilmParams { factor, ior, thickness_nm });
    let mut all = Vec::new();
    for roughness in [0.031, 0.031_622, 0.031_623, 0.031_63, 0.032, 1.0, 2.0] {
        all.push(BsdfParams { roughness, metallic: 1.0, ..d });
        all.push(BsdfParams { roughness, ..d });
        all.push(BsdfParams { roughness, transmission: 1.0, ..d });
        all.push(BsdfParams {
            roughness,
            coat: Some(CoatParams { factor: 1.0, roughness, normal: Vec3::Z }),
            ..d
        });
        all.push(BsdfParams {
            roughness,
            sheen: Some(SheenParams { color: Spectrum::WHITE, roughness }),
            ..d
        });
        all.push(BsdfParams { roughness, anisotropy: 0.02, metallic: 1.0, ..d });
        for eta in [0.5, 0.999, 1.0, 1.000_1, 1.01, 3.0] {
            all.push(BsdfParams { roughness, eta, ..solid });
        }
    }
    for params in
        [BsdfParams { metallic: 1.0, roughness: 0.3, ..d }, d, BsdfParams { roughness: 0.0, ..solid }]
    {
        for film in [film(1.0, 1.8, 0.0), film(0.0, 1.8, 300.0), film(1.0, 1.0, 300.0), film(1.0, 1.8, 1e9)] {
            all.push(BsdfParams { film, ..params });
        }
        for metallic in [1e-9, 1e-4, 0.999_9, 1.0 - f32::EPSILON] {
            all.push(BsdfParams { metallic, ..params });
        }
    }
    // Black all over: nothing to choose from.
    let black = BsdfParams { base_color: Spectrum::BLACK, specular_color: Spectrum::BLACK, ..d };
    all.extend([black, BsdfParams { transmission: 1.0, ..black }, BsdfParams { metallic: 0.5, ..black }]);
    all
}
