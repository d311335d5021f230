//! What a hybrid frame knows of its pixels, as pictures.

use crate::look::Look;
use lumbre_core::color::{label, srgb_encode_u8};
use lumbre_core::hybrid::PixelPlanes;
use lumbre_core::rgb::Rgb;

/// What of a frame is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Plane {
    /// Shading normals, -1 to 1 from black to full.
    Normal,
    /// Distance: white is the nearest, in the logarithm.
    Depth,
    /// Place in the world: red, green and blue repeat every metre.
    Position,
    /// Directional albedo.
    Albedo,
    /// Perceptual roughness.
    Roughness,
    /// Reflectance of the interface over the diffuse base, times four.
    Specularity,
    /// Share of light that is mirrored along delta lobes.
    Mirrored,
    /// Share of light that is let through along them.
    Through,
    /// Index of refraction: black is 1, white is 2.
    Index,
    /// Emitted radiance.
    Emission,
    /// A colour for each object.
    Object,
    /// A colour for each material.
    Material,
    /// Where points were in the frame before: grey is here, red to the right, green below, full at 16 pixels.
    Motion,
    /// Light that has no noise: emitted, of lights with sharp shadows, seen in mirrors and through glass.
    Sharp,
    /// This frame's sample of light straight from lamps and sun.
    Soft,
    /// This frame's sample of light from the sky and other surfaces.
    Gathered,
    /// Both samples after the filter.
    Filtered,
}

impl Plane {
    /// All of them.
    pub const ALL: [Plane; 17] = [
        Plane::Normal,
        Plane::Depth,
        Plane::Position,
        Plane::Albedo,
        Plane::Roughness,
        Plane::Specularity,
        Plane::Mirrored,
        Plane::Through,
        Plane::Index,
        Plane::Emission,
        Plane::Object,
        Plane::Material,
        Plane::Motion,
        Plane::Sharp,
        Plane::Soft,
        Plane::Gathered,
        Plane::Filtered,
    ];

    /// As files and menus call it.
    pub fn name(self) -> &'static str {
        match self {
            Plane::Normal => "normal",
            Plane::Depth => "depth",
            Plane::Position => "position",
            Plane::Albedo => "albedo",
            Plane::Roughness => "roughness",
            Plane::Specularity => "specularity",
            Plane::Mirrored => "mirrored",
            Plane::Through => "through",
            Plane::Index => "index",
            Plane::Emission => "emission",
            Plane::Object => "object",
            Plane::Material => "material",
            Plane::Motion => "motion",
            Plane::Sharp => "sharp",
            Plane::Soft => "soft",
            Plane::Gathered => "gathered",
            Plane::Filtered => "filtered",
        }
    }

    /// Three bytes a pixel. Light is developed with this look, and this factor in the place of its exposure.
    pub fn picture(self, planes: &[PixelPlanes], look: &Look, factor: f32) -> Vec<u8> {
        if self == Plane::Depth {
            return depth(planes);
        }
        let light = |l: [f32; 3]| {
            let color = look.tone.display(Rgb::new(l[0], l[1], l[2]) * factor);
            color.to_array().map(|v| (v * 255.0 + 0.5) as u8)
        };
        planes.iter().flat_map(|p| self.color(p, &light)).collect()
    }

    fn color(self, p: &PixelPlanes, light: &impl Fn([f32; 3]) -> [u8; 3]) -> [u8; 3] {
        let share = |x: f32| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
        let grey = |x: f32| [share(x); 3];
        let labelled = |id: Option<u32>| id.map_or([0; 3], |id| label(id).to_array().map(srgb_encode_u8));
        match self {
            Plane::Normal if p.instance.is_none() => [0; 3],
            Plane::Normal => p.normal.map(|v| share(0.5 * v + 0.5)),
            Plane::Position if p.instance.is_none() => [0; 3],
            Plane::Position => p.position.map(|v| share(v - v.floor())),
            Plane::Albedo => p.albedo.map(srgb_encode_u8),
            Plane::Roughness => grey(p.roughness),
            Plane::Specularity => grey(4.0 * p.specularity),
            Plane::Mirrored => grey(p.mirrored),
            Plane::Through => grey(p.through),
            Plane::Index => grey(p.index - 1.0),
            Plane::Emission => light(p.emission),
            Plane::Object => labelled(p.instance),
            Plane::Material => labelled(p.material),
            Plane::Motion => {
                let [x, y] = p.motion.map(|v| share(0.5 + v / 32.0));
                [x, y, 128]
            }
            Plane::Sharp => light(p.sharp),
            Plane::Soft => light(p.soft),
            Plane::Gathered => light(p.gathered),
            Plane::Filtered => light(p.filtered),
            Plane::Depth => unreachable!("it needs all pixels"),
        }
    }
}

/// Even in the logarithm, so that a room before a wide land has shades.
fn depth(planes: &[PixelPlanes]) -> Vec<u8> {
    let seen = planes.iter().map(|p| p.distance).filter(|d| d.is_finite() && *d > 0.0);
    let (near, far) = seen.fold((f32::INFINITY, 0.0f32), |(n, f), d| (n.min(d), f.max(d)));
    let range = (far / near).ln().max(1e-3);
    let shade = |d: f32| {
        let shade = if d.is_finite() { 1.0 - 0.9 * (d.max(near) / near).ln() / range } else { 0.0 };
        [(shade.clamp(0.0, 1.0) * 255.0) as u8; 3]
    };
    planes.iter().flat_map(|p| shade(p.distance)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_core::color::Exposure;

    fn pixel() -> PixelPlanes {
        PixelPlanes {
            normal: [0.0, 1.0, 0.0],
            distance: 2.0,
            albedo: [1.0, 0.0, 0.0],
            roughness: 0.5,
            specularity: 0.04,
            position: [0.25, 1.0, -0.5],
            instance: Some(3),
            material: Some(3),
            motion: [16.0, -16.0],
            emission: [0.0; 3],
            mirrored: 1.0,
            through: 0.0,
            index: 1.5,
            sharp: [1.0; 3],
            soft: [0.0; 3],
            gathered: [0.0; 3],
            filtered: [0.0, 1.0, 0.0],
        }
    }

    #[test]
    fn every_plane_shows_what_it_says() {
        let sky = PixelPlanes { instance: None, material: None, distance: f32::INFINITY, ..pixel() };
        let far = PixelPlanes { distance: 9.0, ..pixel() };
        let look = Look { exposure: Exposure::Ev(0.0), ..Look::default() };
        let of = |plane: Plane| plane.picture(&[pixel(), sky, far], &look, 1.0);
        assert!(Plane::ALL.iter().all(|p| of(*p).len() == 9));
        assert_eq!(of(Plane::Normal)[..6], [128, 255, 128, 0, 0, 0]);
        let depth = of(Plane::Depth);
        assert!(depth[0] == 255 && depth[3] == 0 && depth[6] > 0 && depth[6] < 255, "{depth:?}");
        assert_eq!(of(Plane::Position)[..3], [64, 0, 128]);
        assert_eq!(of(Plane::Albedo)[..3], [255, 0, 0]);
        assert_eq!(of(Plane::Motion)[..3], [255, 0, 128]);
        assert_eq!([of(Plane::Mirrored)[0], of(Plane::Through)[0], of(Plane::Index)[0]], [255, 0, 128]);
        assert_eq!(of(Plane::Object)[..3], of(Plane::Material)[..3]);
        assert!(of(Plane::Sharp)[0] > 200 && of(Plane::Soft)[0] == 0);
        assert_eq!(of(Plane::Filtered)[0], 0);
        let mut names: Vec<&str> = Plane::ALL.map(Plane::name).into();
        names.dedup();
        assert_eq!(names.len(), Plane::ALL.len());
    }
}
