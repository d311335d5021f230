//! What a parameter holds, and what it may hold.

use super::json::{Json, Node, number_text, quoted};
use glam::Vec3;
use lumbre_core::Rgb;
use std::fmt;

/// What a parameter holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number, in the unit of its parameter.
    Number(f32),
    /// A whole number.
    Whole(u32),
    /// A linear colour.
    Color(Rgb),
    /// A point, a direction, three angles or three factors.
    Vector(Vec3),
    /// Yes or no.
    Flag(bool),
    /// One of the parameter's words.
    Word(&'static str),
    /// Focal length over diameter of the lens.
    FNumber(f32),
    /// The name of a camera or of a file.
    Text(String),
}

/// What a parameter may hold, and with what it is well chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// [`Value::Number`], or one of `words`.
    Number {
        /// Least and most that is taken.
        range: [f32; 2],
        /// Ends of a slider: where values that make sense lie.
        slider: [f32; 2],
        /// The slider grows by factors.
        log: bool,
        /// Short, such as `m` or `°`; may be empty.
        unit: &'static str,
        /// What may stand in place of a number; mostly none.
        words: &'static [&'static str],
    },
    /// [`Value::Whole`], or one of `words`.
    Whole {
        /// Least and most that is taken.
        range: [u32; 2],
        /// Ends of a slider.
        slider: [u32; 2],
        /// What may stand in place of a number; mostly none.
        words: &'static [&'static str],
    },
    /// [`Value::Color`]: no band is negative.
    Color {
        /// Most of a band: 1 for what reflects, more for light.
        most: f32,
    },
    /// [`Value::Vector`].
    Vector {
        /// Short; may be empty.
        unit: &'static str,
        /// Least and most of a component that is taken.
        range: [f32; 2],
    },
    /// [`Value::Flag`].
    Flag,
    /// [`Value::Word`].
    Choice(&'static [&'static str]),
    /// How far the lens is open: [`Value::FNumber`], [`Value::Number`] for its diameter in metres, or the word `off`.
    Aperture,
    /// [`Value::Text`]: name or number of one of the file's cameras.
    Camera,
    /// [`Value::Text`]: a file.
    File,
}

/// What may stand in place of an aperture.
const CLOSED: &[&str] = &["off"];
/// Least and most of a diameter in metres, and of an f-number.
const DIAMETERS: [f32; 2] = [1e-6, 1e3];
const F_NUMBERS: [f32; 2] = [1e-3, 1e6];

impl Kind {
    /// The words that may stand there.
    pub fn words(&self) -> &'static [&'static str] {
        match self {
            Kind::Number { words, .. } | Kind::Whole { words, .. } | Kind::Choice(words) => words,
            Kind::Aperture => CLOSED,
            _ => &[],
        }
    }

    /// Whether this can stand there, or why not: one line.
    ///
    /// # Errors
    /// If it is of another kind, out of range, not finite, or none of the words.
    pub fn check(&self, value: &Value) -> Result<(), String> {
        let sound = match (self, value) {
            (Kind::Number { range, .. }, Value::Number(v)) => within(range, v),
            (Kind::Whole { range, .. }, Value::Whole(v)) => within(range, v),
            (Kind::Color { most }, Value::Color(c)) => c.to_array().iter().all(|v| within(&[0.0, *most], v)),
            (Kind::Vector { range, .. }, Value::Vector(v)) => v.to_array().iter().all(|v| within(range, v)),
            (Kind::Aperture, Value::Number(v)) => within(&DIAMETERS, v),
            (Kind::Aperture, Value::FNumber(v)) => within(&F_NUMBERS, v),
            (_, Value::Word(word)) => self.words().contains(word),
            (Kind::Flag, Value::Flag(_)) => true,
            (Kind::Camera | Kind::File, Value::Text(text)) => !text.is_empty(),
            _ => false,
        };
        if sound { Ok(()) } else { Err(format!("expected {}, not {value}", self.expected())) }
    }

    /// What is taken, in words.
    fn expected(&self) -> String {
        let words: Vec<String> = self.words().iter().map(|w| format!("{w:?}")).collect();
        let or = if words.is_empty() { String::new() } else { format!(" or {}", words.join(", ")) };
        let between = |a: &dyn fmt::Display, b: &dyn fmt::Display, unit: &str| {
            format!("from {a} to {b}{}{unit}", gap(unit))
        };
        match self {
            Kind::Number { range: [a, b], unit, .. } => {
                format!("a number {}{or}", between(&number_text(*a), &number_text(*b), unit))
            }
            Kind::Whole { range: [a, b], .. } => format!("a whole number {}{or}", between(a, b, "")),
            Kind::Color { most } => {
                format!("a colour [r, g, b], each {}", between(&0, &number_text(*most), ""))
            }
            Kind::Vector { unit, range: [a, b] } => {
                format!("[x, y, z], each {}", between(&number_text(*a), &number_text(*b), unit))
            }
            Kind::Flag => "true or false".into(),
            Kind::Choice(_) => format!("one of {}", words.join(", ")),
            Kind::Aperture => "\"f/2.8\" or the like, the diameter of the lens in metres, or \"off\"".into(),
            Kind::Camera => "the name of a camera, or its number as text".into(),
            Kind::File => "the path of a file".into(),
        }
    }

    /// The value that stands in a file.
    pub(super) fn read(&self, json: &Json<'_>) -> Result<Value, String> {
        let value = self.guess(json).ok_or_else(|| format!("expected {}", self.expected()))?;
        self.check(&value).map(|()| value)
    }

    /// The value, if what stands there has the right form.
    fn guess(&self, json: &Json<'_>) -> Option<Value> {
        Some(match (self, &json.node) {
            (Kind::Number { .. } | Kind::Aperture, Node::Number(_)) => Value::Number(json.number()?),
            (Kind::Whole { .. }, Node::Number(text)) => Value::Whole(text.parse().ok()?),
            (Kind::Color { .. }, Node::List(_)) => Value::Color(Rgb::from_array(json.numbers()?)),
            (Kind::Vector { .. }, Node::List(_)) => Value::Vector(Vec3::from_array(json.numbers()?)),
            (Kind::Flag, Node::Flag(flag)) => Value::Flag(*flag),
            (Kind::Camera | Kind::File, Node::Text(text)) => Value::Text(text.to_string()),
            (Kind::Aperture, Node::Text(text)) if text.starts_with("f/") => {
                Value::FNumber(text[2..].parse().ok()?)
            }
            (_, Node::Text(text)) => Value::Word(self.words().iter().find(|word| *word == text)?),
            _ => return None,
        })
    }
}

fn gap(unit: &str) -> &'static str {
    if unit.is_empty() || unit == "°" { "" } else { " " }
}

/// NaN lies within nothing.
fn within<T: PartialOrd>([least, most]: &[T; 2], value: &T) -> bool {
    value >= least && value <= most
}

/// As it stands in a file.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let list = |v: [f32; 3]| format!("[{}]", v.map(number_text).join(", "));
        match self {
            Value::Number(v) => f.write_str(&number_text(*v)),
            Value::Whole(v) => v.fmt(f),
            Value::Color(c) => f.write_str(&list(c.to_array())),
            Value::Vector(v) => f.write_str(&list(v.to_array())),
            Value::Flag(v) => v.fmt(f),
            Value::Word(word) => f.write_str(&quoted(word)),
            Value::FNumber(v) => write!(f, "\"f/{}\"", number_text(*v)),
            Value::Text(text) => f.write_str(&quoted(text)),
        }
    }
}

/// What tables read out of a value that [`Kind::check`] let pass. A word stands for "none".
impl Value {
    pub(super) fn as_number(&self) -> Option<f32> {
        if let Value::Number(v) = self { Some(*v) } else { None }
    }
    pub(super) fn as_whole(&self) -> Option<u32> {
        if let Value::Whole(v) = self { Some(*v) } else { None }
    }
    pub(super) fn as_word(&self) -> Option<&'static str> {
        if let Value::Word(word) = self { Some(word) } else { None }
    }
    pub(super) fn as_text(&self) -> Option<&str> {
        if let Value::Text(text) = self { Some(text) } else { None }
    }
    pub(super) fn as_vector(&self) -> Option<Vec3> {
        if let Value::Vector(v) = self { Some(*v) } else { None }
    }
    pub(super) fn number(&self) -> f32 {
        self.as_number().unwrap_or_else(|| self.foreign())
    }
    pub(super) fn color(&self) -> Rgb {
        if let Value::Color(c) = self { *c } else { self.foreign() }
    }
    pub(super) fn vector(&self) -> Vec3 {
        self.as_vector().unwrap_or_else(|| self.foreign())
    }
    pub(super) fn flag(&self) -> bool {
        if let Value::Flag(v) = self { *v } else { self.foreign() }
    }
    pub(super) fn word(&self) -> &'static str {
        self.as_word().unwrap_or_else(|| self.foreign())
    }
    fn foreign<T>(&self) -> T {
        panic!("{self} stands where its kind was not checked")
    }
}
