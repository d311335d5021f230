//! Reference pictures of our own scenes: small EXR files with the mean of many samples and its variance, made by
//! `cargo run --example bless -p lumbre-testkit`.

use crate::ready::{Ready, asset, open};
use crate::z_test::Picture;
use lumbre_core::film::Film;
use lumbre_core::sampler::SamplerKind;
use lumbre_core::settings::{RenderSettings, TransmissiveShadows};
use lumbre_io::{ExrImage, ExrLayer, Limits};
use std::path::{Path, PathBuf};

/// A scene and how its reference is made.
#[derive(Clone, Copy, Debug)]
pub struct Reference {
    /// Name of the reference.
    pub name: &'static str,
    /// File in `assets/scenes`.
    pub scene: &'static str,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Samples per pixel of the reference.
    pub spp: u32,
    /// Shadow rays at glass.
    pub shadows: TransmissiveShadows,
    /// Side of the blocks that tests compare, pixels: larger where rare bright paths make small ones far from normal.
    pub block: usize,
}

const CORNELL: Reference = Reference {
    name: "cornell",
    scene: "cornell.glb",
    size: [64, 48],
    spp: 8192,
    shadows: TransmissiveShadows::Auto,
    block: 8,
};

/// Every reference.
pub const ALL: [Reference; 3] = [
    CORNELL,
    // Without caustics through glass.
    Reference { name: "cornell_straight", shadows: TransmissiveShadows::Straight, ..CORNELL },
    Reference { name: "smooth", scene: "smooth.gltf", size: [48, 48], block: 4, ..CORNELL },
];

/// Seed of the references; tests take others.
pub const SEED: u32 = 0xb1e5;

/// Name of the layer that holds the variance of the mean luminance.
const VARIANCE: &str = "variance";
/// Name of the attribute that holds the samples per pixel.
const SAMPLES: &str = "samples";

/// A reference that was read.
#[derive(Clone, Debug)]
pub struct Blessed {
    /// Mean and its variance.
    pub picture: Picture,
    /// Samples per pixel that it was made of.
    pub spp: u32,
}

impl Reference {
    /// Where it lies.
    pub fn path(&self) -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("references").join(format!("{}.exr", self.name))
    }

    /// The scene, set up as the reference is: default settings but for independent samples,
    /// whose variance is known, and its shadow rays.
    pub fn open(&self, seed: u32) -> Ready {
        let [width, height] = self.size.map(|n| n as f32);
        let mut ready = open(&asset(self.scene), width / height);
        ready.view.settings = RenderSettings {
            sampler: SamplerKind::Independent,
            seed,
            transmissive_shadows: self.shadows,
            ..RenderSettings::default()
        };
        ready
    }

    /// Writes the reference.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn bless(&self, film: &Film) -> Result<(), Box<dyn std::error::Error>> {
        let path = self.path();
        path.parent().map(std::fs::create_dir_all).transpose()?;
        let spp = film.pixels().first().map_or(0, |p| p.samples());
        let variance = film.pixels().iter().map(|p| p.error() * p.error()).collect();
        let image = ExrImage {
            width: film.width(),
            height: film.height(),
            layers: vec![
                ExrLayer::rgb("", film.radiance().into_iter(), false),
                ExrLayer { name: VARIANCE.into(), channels: vec![("Y".into(), variance)] },
            ],
            metadata: vec![
                (SAMPLES.into(), spp.to_string()),
                ("seed".into(), SEED.to_string()),
                ("scene".into(), self.scene.into()),
            ],
            ..ExrImage::default()
        };
        Ok(lumbre_io::write_exr(path, image)?)
    }

    /// Reads the reference.
    ///
    /// # Errors
    /// One line: it is missing, or not what `bless` writes.
    pub fn read(&self) -> Result<Blessed, String> {
        let path = self.path();
        let broken =
            |what: &str| format!("{}: {what}; make it anew with the example `bless`", path.display());
        let image = lumbre_io::read_exr(&path, &Limits::default())
            .map_err(|e| format!("{e}; references are made with the example `bless`"))?;
        if [image.width, image.height] != self.size {
            return Err(broken("has another size"));
        }
        let layer = |name: &str| image.layers.iter().find(|l| l.name == name);
        let channel = |c| layer("").and_then(|l| l.channel(c)).ok_or_else(|| broken("lacks a colour"));
        let (r, g, b) = (channel("R")?, channel("G")?, channel("B")?);
        let luminance = |i: usize| f64::from(lumbre_core::Rgb::new(r[i], g[i], b[i]).luminance());
        let variance =
            layer(VARIANCE).and_then(|l| l.channel("Y")).ok_or_else(|| broken("lacks its variance"))?;
        let spp = image.metadata.iter().find(|(k, _)| k == SAMPLES).and_then(|(_, v)| v.parse().ok());
        let picture = Picture {
            width: image.width as usize,
            height: image.height as usize,
            mean: (0..r.len()).map(luminance).collect(),
            variance: variance.iter().copied().map(f64::from).collect(),
        };
        Ok(Blessed { picture, spp: spp.ok_or_else(|| broken("does not say its samples"))? })
    }
}
