//! What decides a picture besides the number of its samples, as 128 bits: parts with the same fingerprint are of one render
//! and may be added. XXH3 (of xxHash 0.8): fast and stable, but no protection against somebody who wants two renders to agree.

use lumbre_core::film::Crop;
use lumbre_core::settings::View;
use lumbre_scene::CompiledScene;
use std::fmt;
use std::str::FromStr;
use twox_hash::xxhash3_128::Hasher;

/// 128 bits of everything that decides a picture besides its samples: the scene as it is compiled, camera, settings, size, part
/// and version of the program. The same on all machines of one byte order.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct Fingerprint(u128);

impl Fingerprint {
    /// Of the rendering of a part of a picture of this size.
    pub fn new(scene: SceneHash, view: &View, picture: [u32; 2], crop: Crop) -> Self {
        let View { camera, settings, frame } = view;
        let mut hasher = Sections::default();
        hasher.add("version", env!("CARGO_PKG_VERSION").as_bytes());
        hasher.add("scene", &scene.0.to_le_bytes());
        // Floats print as the shortest text that reads as the same float.
        hasher.add("camera", format!("{camera:?}").as_bytes());
        hasher.add("settings", format!("{settings:?}").as_bytes());
        hasher.add("frame", &frame.to_le_bytes());
        hasher.add("picture", format!("{picture:?} {crop:?}").as_bytes());
        Fingerprint(hasher.finish())
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl fmt::Debug for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// A text is no fingerprint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a fingerprint is 32 digits to base 16")]
pub struct NoFingerprint;

impl FromStr for Fingerprint {
    type Err = NoFingerprint;

    fn from_str(text: &str) -> Result<Self, NoFingerprint> {
        let digits = text.len() == 32 && text.bytes().all(|b| b.is_ascii_hexdigit());
        let number = u128::from_str_radix(text, 16).ok().filter(|_| digits);
        number.map(Fingerprint).ok_or(NoFingerprint)
    }
}

/// The part of a [`Fingerprint`] that is the scene's; taken while the scene is at hand, before a backend gets it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneHash(u128);

impl SceneHash {
    /// Of all arrays of a scene, texels too.
    pub fn new(scene: &CompiledScene) -> Self {
        let mut hasher = Sections::default();
        scene.sections().into_iter().for_each(|(name, bytes)| hasher.add(name, bytes));
        SceneHash(hasher.finish())
    }
}

/// Bytes under names, with their lengths, so that nothing can slip from one section into the next.
#[derive(Default)]
struct Sections(Hasher);

impl Sections {
    fn add(&mut self, name: &str, bytes: &[u8]) {
        for part in [name.as_bytes(), bytes] {
            self.0.write(&(part.len() as u64).to_le_bytes());
            self.0.write(part);
        }
    }
    fn finish(&self) -> u128 {
        self.0.finish_128()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use lumbre_core::Camera;
    use lumbre_core::settings::RenderSettings;
    use lumbre_scene::{Scene, compile};
    use std::sync::Arc;

    #[test]
    fn text_and_back() {
        let print = Fingerprint(0x0123 << 100);
        assert_eq!(print.to_string().len(), 32);
        assert_eq!(print.to_string().parse(), Ok(print));
        for wrong in ["", "+0000000000000000000000000000000", "g0000000000000000000000000000000", "00"] {
            assert_eq!(wrong.parse::<Fingerprint>(), Err(NoFingerprint));
        }
    }

    #[test]
    fn whatever_decides_the_picture_decides_the_fingerprint() {
        let scene = compile(&Scene::default()).unwrap().scene;
        let camera = Camera::look_at(Vec3::ZERO, Vec3::Z, Vec3::Y, 1.0, 1.0);
        let view = View { camera, settings: RenderSettings::default(), frame: 0 };
        let crop = Crop { origin: [0, 0], size: [8, 6] };
        let of = |s: &CompiledScene, v: &View, size, crop| Fingerprint::new(SceneHash::new(s), v, size, crop);
        let base = of(&scene, &view, [8, 6], crop);
        assert_eq!(of(&scene.clone(), &view.clone(), [8, 6], crop), base);
        let mut lit = scene.clone();
        Arc::make_mut(&mut lit.environment_pixels)[0].g += 1e-6;
        let mut longer = scene.clone();
        longer.texels = longer.texels.iter().copied().chain([0]).collect();
        let mut seeded = view.clone();
        seeded.settings.seed = 1;
        let mut moved = view.clone();
        moved.camera.origin.x = f32::from_bits(1);
        let mut later = view.clone();
        later.frame = 1;
        let part = Crop { origin: [1, 0], size: [7, 6] };
        let all = [
            base,
            of(&lit, &view, [8, 6], crop),
            of(&longer, &view, [8, 6], crop),
            of(&scene, &seeded, [8, 6], crop),
            of(&scene, &moved, [8, 6], crop),
            of(&scene, &later, [8, 6], crop),
            of(&scene, &view, [8, 6], part),
            of(&scene, &view, [9, 6], crop),
        ];
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a != b), "{i}");
        }
    }

    /// What a file from another machine or an older build of this version says must mean the same here.
    #[test]
    fn the_hash_is_xxh3_of_named_sections() {
        let mut sections = Sections::default();
        sections.add("ab", b"cde");
        let flat = b"\x02\0\0\0\0\0\0\0ab\x03\0\0\0\0\0\0\0cde";
        assert_eq!(sections.finish(), Hasher::oneshot(flat));
        // The published value for no bytes (xxHash's own tests).
        assert_eq!(Hasher::oneshot(b""), 0x99aa_06d3_0147_98d8_6001_c324_468d_497f);
    }
}
