//! The tables of light from far away: the sun, and the sky.

use super::EditsError;
use super::material::pure;
use super::param::{Access, HUE, HUGE, Param, field, growing, number};
use super::value::{Kind, Value};
use lumbre_core::Rgb;
use lumbre_scene::{Background, Environment, EnvironmentMap, Sun};

/// A sun, or what it would be.
#[derive(Clone, Debug)]
pub(super) struct Sunlight {
    on: bool,
    sun: Sun,
    color: Rgb,
}

impl From<Option<Sun>> for Sunlight {
    fn from(sun: Option<Sun>) -> Self {
        let on = sun.is_some();
        let sun = sun.unwrap_or_else(|| Sun::daylight(45.0, 135.0, Sun::STRENGTH));
        let most = sun.irradiance.max_component();
        let color = if on && most > 0.0 { sun.irradiance / most } else { Sun::COLOR };
        Sunlight { on, sun, color }
    }
}

impl Sunlight {
    pub(super) fn sun(self) -> Option<Sun> {
        self.on.then_some(self.sun)
    }

    /// Sets the illuminance, as [`Sun::daylight`] does it, and with another colour.
    fn shine(&mut self, color: Rgb, strength: f32) {
        self.color = color;
        let luminance = color.luminance();
        self.sun.irradiance = if luminance > 0.0 { color * (strength / luminance) } else { Rgb::BLACK };
    }
}

fn is_on(s: &Sunlight) -> bool {
    s.on
}

type OfSun = Param<Sunlight>;

/// All parameters of the sun.
pub(super) const SUN: &[OfSun] = &[
    OfSun::new("on", "On", Kind::Flag, field!(flag on)),
    OfSun::new(
        "elevation",
        "Elevation",
        number([-90.0, 90.0], [-10.0, 90.0], "°"),
        field!(degrees sun.elevation),
    )
    .when(is_on),
    OfSun::new(
        "azimuth",
        "Azimuth",
        number([-3600.0, 3600.0], [0.0, 360.0], "°"),
        Access {
            get: |s| Value::Number(s.sun.azimuth.to_degrees()),
            // A whole turn is nothing, exactly.
            set: |s, v| s.sun.azimuth = (v.number() % 360.0).to_radians(),
        },
    )
    .when(is_on),
    OfSun::new(
        "strength",
        "Strength",
        growing(HUGE, [0.1, 1e5], "lx"),
        Access {
            get: |s| Value::Number(s.sun.irradiance.luminance()),
            set: |s, v| s.shine(s.color, v.number()),
        },
    )
    .when(is_on),
    OfSun::new(
        "color",
        "Colour",
        HUE,
        Access {
            get: |s| Value::Color(s.color),
            set: |s, v| s.shine(pure(v.color()), s.sun.irradiance.luminance()),
        },
    )
    .when(is_on),
    OfSun::new(
        "diameter",
        "Diameter",
        number([0.0, 90.0], [0.0, 10.0], "°"),
        Access {
            get: |s| Value::Number(2.0 * s.sun.angular_radius.to_degrees()),
            set: |s, v| s.sun.angular_radius = (0.5 * v.number()).to_radians(),
        },
    )
    .when(is_on),
];

/// What fills the sky.
#[derive(Clone, Debug)]
pub(super) struct Heaven {
    kind: &'static str,
    color: Rgb,
    file: Option<String>,
    /// Radians.
    rotation: f32,
    strength: f32,
}

/// The sky that the scene brings as a map.
const MAP: &str = "map";
/// A map in a file that the edits name.
const FILE: &str = "file";

impl From<&Environment> for Heaven {
    fn from(environment: &Environment) -> Self {
        let (kind, color) = match &environment.background {
            Background::Black => ("off", Rgb::WHITE),
            Background::Constant(color) => ("color", *color),
            Background::Gradient => ("gradient", Rgb::WHITE),
            Background::Map(_) => (MAP, Rgb::WHITE),
        };
        let Environment { rotation, strength, .. } = *environment;
        Heaven { kind, color, file: None, rotation, strength }
    }
}

impl Heaven {
    /// The file that is to be read.
    pub(super) fn file(&self) -> Option<&str> {
        self.file.as_deref().filter(|_| self.kind == FILE)
    }

    /// Puts it into the environment that it was made of; `map` is what was read from its file.
    pub(super) fn put(
        self,
        environment: &mut Environment,
        map: Option<&EnvironmentMap>,
    ) -> Result<(), EditsError> {
        let wrong = |key: &str, reason| Err(EditsError::new(key, reason));
        match self.kind {
            "off" => environment.background = Background::Black,
            "color" => environment.background = Background::Constant(self.color),
            "gradient" => environment.background = Background::Gradient,
            FILE => match (&self.file, map) {
                (None, _) => return wrong("kind", "no file is named: `file` is missing"),
                (_, None) => return wrong("file", "the file was not read"),
                (_, Some(map)) => environment.background = Background::Map(map.clone()),
            },
            _ if matches!(environment.background, Background::Map(_)) => {}
            _ => return wrong("kind", "the scene brings no map"),
        }
        (environment.rotation, environment.strength) = (self.rotation, self.strength);
        Ok(())
    }

    fn turns(&self) -> bool {
        self.kind == MAP || self.kind == FILE
    }
}

type OfSky = Param<Heaven>;

/// All parameters of the sky.
pub(super) const SKY: &[OfSky] = &[
    OfSky::new(
        "kind",
        "Sky",
        Kind::Choice(&["off", "color", "gradient", MAP, FILE]),
        Access {
            get: |h| Value::Word(h.kind),
            // Another sky is not turned and not scaled as the last one was.
            set: |h, v| (h.kind, h.rotation, h.strength) = (v.word(), 0.0, 1.0),
        },
    ),
    OfSky::new("color", "Colour", Kind::Color { most: HUGE }, field!(color color))
        .when(|h| h.kind == "color"),
    OfSky::new(
        "file",
        "File",
        Kind::File,
        Access {
            get: |h| Value::Text(h.file.clone().unwrap_or_default()),
            set: |h, v| h.file = v.as_text().map(str::to_owned),
        },
    )
    .when(|h| h.kind == FILE),
    OfSky::new(
        "rotation",
        "Rotation",
        number([-3600.0, 3600.0], [-180.0, 180.0], "°"),
        field!(degrees rotation),
    )
    .when(Heaven::turns),
    OfSky::new("strength", "Strength", growing(HUGE, [0.01, 100.0], "x"), field!(number strength))
        .when(|h| h.kind != "off"),
];
