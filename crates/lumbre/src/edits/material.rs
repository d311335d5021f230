//! The table of a material: all its numbers, colours and flags. Textures stay as they are and multiply what is set here.

use super::param::{Access, FRACTION, HUE, HUGE, Param, REFLECTANCE, field, growing, number, or};
use super::value::{Kind, Value};
use lumbre_core::Rgb;
use lumbre_scene::{
    AlphaMode, Anisotropy, Clearcoat, DiffuseTransmission, Iridescence, Material, Phong, Sheen, Volume,
};

/// A material, with what its fields do not keep apart.
#[derive(Clone, Debug)]
pub(super) struct Painted {
    pub(super) material: Material,
    /// `emission` is the product of the two.
    glow: Rgb,
    glow_strength: f32,
    /// Kept while another mode has none.
    cutoff: f32,
}

impl From<Material> for Painted {
    fn from(material: Material) -> Self {
        let (glow, glow_strength) = hue(material.emission);
        let cutoff = if let AlphaMode::Mask { cutoff } = material.alpha_mode { cutoff } else { 0.5 };
        Painted { material, glow, glow_strength, cutoff }
    }
}

/// Light as a colour whose largest band is 1, and its strength. Black light is white of no strength.
pub(super) fn hue(light: Rgb) -> (Rgb, f32) {
    let strength = light.max_component();
    if strength > 0.0 { (pure(light), strength) } else { (Rgb::WHITE, 0.0) }
}

/// A colour brought to where its largest band is 1, so that colour and strength of a light are set apart.
pub(super) fn pure(color: Rgb) -> Rgb {
    let most = color.max_component();
    // Divided each, since a product with the inverse would not give 1.
    if most > 0.0 { color.map(|v| v / most) } else { Rgb::BLACK }
}

impl Painted {
    fn set_glow(&mut self, glow: Rgb, strength: f32) {
        (self.glow, self.glow_strength) = (pure(glow), strength);
        self.material.emission = self.glow * strength;
    }

    fn is_mask(&self) -> bool {
        matches!(self.material.alpha_mode, AlphaMode::Mask { .. })
    }

    fn set_alpha_mode(&mut self, mode: &str) {
        self.material.alpha_mode = match mode {
            "mask" => AlphaMode::Mask { cutoff: self.cutoff },
            "blend" => AlphaMode::Blend,
            _ => AlphaMode::Opaque,
        };
    }

    fn set_cutoff(&mut self, cutoff: f32) {
        self.cutoff = cutoff;
        if self.is_mask() {
            self.material.alpha_mode = AlphaMode::Mask { cutoff };
        }
    }

    /// Light goes through it.
    fn lets_through(&self) -> bool {
        self.material.transmission > 0.0 || self.material.diffuse_transmission.is_some_and(|d| d.factor > 0.0)
    }

    fn is_solid(&self) -> bool {
        self.lets_through() && self.material.volume.is_some_and(|v| v.thickness > 0.0)
    }
}

// What the extensions say of what is not said (and a volume of no thickness, which is none).
const VOLUME: Volume =
    Volume { thickness: 0.0, attenuation_color: Rgb::WHITE, attenuation_distance: f32::INFINITY };
const CLEARCOAT: Clearcoat = Clearcoat {
    factor: 0.0,
    texture: None,
    roughness: 0.0,
    roughness_texture: None,
    normal_texture: None,
    normal_scale: 1.0,
};
const SHEEN: Sheen =
    Sheen { color: Rgb::BLACK, color_texture: None, roughness: 0.0, roughness_texture: None };
const ANISOTROPY: Anisotropy = Anisotropy { strength: 0.0, rotation: 0.0, texture: None };
const IRIDESCENCE: Iridescence = Iridescence {
    factor: 0.0,
    texture: None,
    ior: 1.3,
    thickness_min_nm: 100.0,
    thickness_max_nm: 400.0,
    thickness_texture: None,
};
const DIFFUSE_TRANSMISSION: DiffuseTransmission =
    DiffuseTransmission { factor: 0.0, texture: None, color: Rgb::WHITE, color_texture: None };
/// A plain gloss for a material that gets one by hand.
const PHONG: Phong =
    Phong { specular: Rgb::splat(0.04), specular_texture: None, exponent: 32.0, fresnel: false };

/// Access to a field of a part that a material may lack; setting it adds the part.
macro_rules! part {
    (number $part:ident $default:ident $field:ident) => {
        Access {
            get: |p| Value::Number(p.material.$part.unwrap_or($default).$field),
            set: |p, v| p.material.$part.get_or_insert($default).$field = v.number(),
        }
    };
    (color $part:ident $default:ident $field:ident) => {
        Access {
            get: |p| Value::Color(p.material.$part.unwrap_or($default).$field),
            set: |p, v| p.material.$part.get_or_insert($default).$field = v.color(),
        }
    };
    (degrees $part:ident $default:ident $field:ident) => {
        Access {
            get: |p| Value::Number(p.material.$part.unwrap_or($default).$field.to_degrees()),
            set: |p, v| p.material.$part.get_or_insert($default).$field = v.number().to_radians(),
        }
    };
}

/// Of a number that may be infinite, which a word says.
macro_rules! unlimited {
    ($part:ident $default:ident $field:ident $word:literal) => {
        Access {
            get: |p| match p.material.$part.unwrap_or($default).$field {
                v if v.is_infinite() => Value::Word($word),
                v => Value::Number(v),
            },
            set: |p, v| {
                p.material.$part.get_or_insert($default).$field = v.as_number().unwrap_or(f32::INFINITY);
            },
        }
    };
}

const NM: Kind = number([0.0, 1e5], [0.0, 1200.0], "nm");
const NORMAL_SCALE: Kind = number([-1e3, 1e3], [0.0, 2.0], "");
const TURN: Kind = number([-360.0, 360.0], [-180.0, 180.0], "°");

type One = Param<Painted>;

/// All parameters of a material.
pub(super) const MATERIAL: &[One] = &[
    One::new("baseColor", "Base colour", REFLECTANCE, field!(color material.base_color)),
    One::new("metallic", "Metallic", FRACTION, field!(number material.metallic)),
    One::new("roughness", "Roughness", FRACTION, field!(number material.roughness)),
    One::new("diffuseRoughness", "Diffuse roughness", FRACTION, field!(number material.diffuse_roughness)),
    One::new("normalScale", "Normal map", NORMAL_SCALE, field!(number material.normal_scale))
        .when(|p| p.material.normal_texture.is_some()),
    One::new("doubleSided", "Two-sided", Kind::Flag, field!(flag material.double_sided)),
    One::new("unlit", "Unlit", Kind::Flag, field!(flag material.unlit)),
    One::new("shadowCatcher", "Shadow catcher", Kind::Flag, field!(flag material.shadow_catcher)),
    One::new(
        "emissionColor",
        "Colour",
        HUE,
        Access { get: |p| Value::Color(p.glow), set: |p, v| p.set_glow(v.color(), p.glow_strength) },
    )
    .of("Emission")
    .when(|p| p.glow_strength > 0.0),
    One::new(
        "emissionStrength",
        "Strength",
        growing(HUGE, [0.01, 1e5], "nit"),
        Access { get: |p| Value::Number(p.glow_strength), set: |p, v| p.set_glow(p.glow, v.number()) },
    )
    .of("Emission"),
    One::new("alpha", "Alpha", FRACTION, field!(number material.alpha))
        .of("Coverage")
        .when(|p| p.material.alpha_mode != AlphaMode::Opaque),
    One::new(
        "alphaMode",
        "Mode",
        Kind::Choice(&["opaque", "mask", "blend"]),
        Access {
            get: |p| {
                Value::Word(match p.material.alpha_mode {
                    AlphaMode::Opaque => "opaque",
                    AlphaMode::Mask { .. } => "mask",
                    AlphaMode::Blend => "blend",
                })
            },
            set: |p, v| p.set_alpha_mode(v.word()),
        },
    )
    .of("Coverage"),
    One::new(
        "alphaCutoff",
        "Cutoff",
        FRACTION,
        Access { get: |p| Value::Number(p.cutoff), set: |p, v| p.set_cutoff(v.number()) },
    )
    .of("Coverage")
    .when(Painted::is_mask),
    One::new("ior", "Index of refraction", number([1.0, 1e4], [1.0, 2.5], ""), field!(number material.ior))
        .of("Specular"),
    One::new("specular", "Specular", FRACTION, field!(number material.specular)).of("Specular"),
    One::new("specularColor", "Colour", Kind::Color { most: 1e3 }, field!(color material.specular_color))
        .of("Specular"),
    One::new("transmission", "Transmission", FRACTION, field!(number material.transmission)).of("Glass"),
    One::new(
        "thickness",
        "Thickness (0: thin wall)",
        growing(HUGE, [1e-3, 10.0], "m"),
        part!(number volume VOLUME thickness),
    )
    .of("Glass")
    .when(Painted::lets_through),
    One::new(
        "attenuationColor",
        "Colour of the inside",
        REFLECTANCE,
        part!(color volume VOLUME attenuation_color),
    )
    .of("Glass")
    .when(Painted::is_solid),
    One::new(
        "attenuationDistance",
        "After",
        or(growing(HUGE, [1e-3, 100.0], "m"), &["unlimited"]),
        unlimited!(volume VOLUME attenuation_distance "unlimited"),
    )
    .of("Glass")
    .when(Painted::is_solid),
    One::new(
        "dispersion",
        "Dispersion",
        number([0.0, 1e3], [0.0, 1.0], ""),
        field!(number material.dispersion),
    )
    .of("Glass")
    .when(Painted::is_solid),
    One::new(
        "diffuseTransmission",
        "Diffuse transmission",
        FRACTION,
        part!(number diffuse_transmission DIFFUSE_TRANSMISSION factor),
    )
    .of("Diffuse transmission"),
    One::new(
        "diffuseTransmissionColor",
        "Colour",
        REFLECTANCE,
        part!(color diffuse_transmission DIFFUSE_TRANSMISSION color),
    )
    .of("Diffuse transmission")
    .when(|p| p.material.diffuse_transmission.is_some_and(|d| d.factor > 0.0)),
    One::new("clearcoat", "Clearcoat", FRACTION, part!(number clearcoat CLEARCOAT factor)).of("Clearcoat"),
    One::new("clearcoatRoughness", "Roughness", FRACTION, part!(number clearcoat CLEARCOAT roughness))
        .of("Clearcoat")
        .when(has_coat),
    One::new(
        "clearcoatNormalScale",
        "Normal map",
        NORMAL_SCALE,
        part!(number clearcoat CLEARCOAT normal_scale),
    )
    .of("Clearcoat")
    .when(|p| has_coat(p) && p.material.clearcoat.is_some_and(|c| c.normal_texture.is_some())),
    One::new("sheenColor", "Colour", REFLECTANCE, part!(color sheen SHEEN color)).of("Sheen"),
    One::new("sheenRoughness", "Roughness", FRACTION, part!(number sheen SHEEN roughness))
        .of("Sheen")
        .when(|p| p.material.sheen.is_some_and(|s| !s.color.is_black())),
    One::new("anisotropy", "Anisotropy", FRACTION, part!(number anisotropy ANISOTROPY strength))
        .of("Anisotropy"),
    One::new("anisotropyRotation", "Rotation", TURN, part!(degrees anisotropy ANISOTROPY rotation))
        .of("Anisotropy")
        .when(|p| p.material.anisotropy.is_some_and(|a| a.strength > 0.0)),
    One::new("iridescence", "Iridescence", FRACTION, part!(number iridescence IRIDESCENCE factor))
        .of("Iridescence"),
    One::new(
        "iridescenceIor",
        "Index of the film",
        number([1.0, 10.0], [1.0, 3.0], ""),
        part!(number iridescence IRIDESCENCE ior),
    )
    .of("Iridescence")
    .when(has_film),
    One::new(
        "iridescenceThicknessMin",
        "Least thickness",
        NM,
        part!(number iridescence IRIDESCENCE thickness_min_nm),
    )
    .of("Iridescence")
    .when(|p| p.material.iridescence.is_some_and(|i| i.factor > 0.0 && i.thickness_texture.is_some())),
    One::new("iridescenceThickness", "Thickness", NM, part!(number iridescence IRIDESCENCE thickness_max_nm))
        .of("Iridescence")
        .when(has_film),
    One::new(
        "phong",
        "Gloss of MTL",
        Kind::Flag,
        Access {
            get: |p| Value::Flag(p.material.phong.is_some()),
            set: |p, v| p.material.phong = v.flag().then_some(p.material.phong.unwrap_or(PHONG)),
        },
    )
    .of("Gloss of MTL"),
    One::new("phongColor", "Colour", REFLECTANCE, phong_color()).of("Gloss of MTL").when(has_phong),
    One::new("phongExponent", "Exponent", or(growing(HUGE, [1.0, 1e4], ""), &["mirror"]), phong_exponent())
        .of("Gloss of MTL")
        .when(has_phong),
    One::new("phongFresnel", "Fresnel", Kind::Flag, phong_fresnel()).of("Gloss of MTL").when(has_phong),
];

fn has_coat(p: &Painted) -> bool {
    p.material.clearcoat.is_some_and(|c| c.factor > 0.0)
}

fn has_film(p: &Painted) -> bool {
    p.material.iridescence.is_some_and(|i| i.factor > 0.0)
}

fn has_phong(p: &Painted) -> bool {
    p.material.phong.is_some()
}

// A gloss takes the place of much else, so that none is added by its parameters alone.
const fn phong_color() -> Access<Painted> {
    Access {
        get: |p| Value::Color(p.material.phong.unwrap_or(PHONG).specular),
        set: |p, v| p.material.phong.iter_mut().for_each(|g| g.specular = v.color()),
    }
}

const fn phong_exponent() -> Access<Painted> {
    Access {
        get: |p| match p.material.phong.unwrap_or(PHONG).exponent {
            e if e.is_infinite() => Value::Word("mirror"),
            e => Value::Number(e),
        },
        set: |p, v| {
            p.material.phong.iter_mut().for_each(|g| g.exponent = v.as_number().unwrap_or(f32::INFINITY));
        },
    }
}

const fn phong_fresnel() -> Access<Painted> {
    Access {
        get: |p| Value::Flag(p.material.phong.unwrap_or(PHONG).fresnel),
        set: |p, v| p.material.phong.iter_mut().for_each(|g| g.fresnel = v.flag()),
    }
}
