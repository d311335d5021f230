//! Tables of parameters, and the changes that are kept of them. A table says all there is to know of a parameter in one line; files, panels
//! and undo come from it.

use super::EditsError;
use super::json::{Json, Node, Writer};
use super::value::{Kind, Value};
use std::collections::BTreeMap;

/// One parameter of a `T`.
pub(super) struct Param<T: 'static> {
    /// In files.
    pub(super) name: &'static str,
    /// In panels.
    pub(super) label: &'static str,
    /// Parameters of a group stand together; empty: among the first ones.
    pub(super) group: &'static str,
    pub(super) kind: Kind,
    access: Access<T>,
    /// Whether it shows, as things are.
    applies: fn(&T) -> bool,
}

/// How a parameter is read and written. What is written was checked before.
pub(super) struct Access<T: 'static> {
    pub(super) get: fn(&T) -> Value,
    pub(super) set: fn(&mut T, &Value),
}

/// Access to a field, or to one inside it.
macro_rules! field {
    (number $($field:ident).+) => {
        Access { get: |t| Value::Number(t.$($field).+), set: |t, v| t.$($field).+ = v.number() }
    };
    (color $($field:ident).+) => {
        Access { get: |t| Value::Color(t.$($field).+), set: |t, v| t.$($field).+ = v.color() }
    };
    (vector $($field:ident).+) => {
        Access { get: |t| Value::Vector(t.$($field).+), set: |t, v| t.$($field).+ = v.vector() }
    };
    (flag $($field:ident).+) => {
        Access { get: |t| Value::Flag(t.$($field).+), set: |t, v| t.$($field).+ = v.flag() }
    };
    (word $($field:ident).+) => {
        Access { get: |t| Value::Word(t.$($field).+), set: |t, v| t.$($field).+ = v.word() }
    };
    (degrees $($field:ident).+) => {
        Access {
            get: |t| Value::Number(t.$($field).+.to_degrees()),
            set: |t, v| t.$($field).+ = v.number().to_radians(),
        }
    };
}
pub(super) use field;

impl<T> Param<T> {
    /// One of the first ones, which always applies.
    pub(super) const fn new(name: &'static str, label: &'static str, kind: Kind, access: Access<T>) -> Self {
        Param { name, label, group: "", kind, access, applies: |_| true }
    }

    /// The same in a group.
    pub(super) const fn of(mut self, group: &'static str) -> Self {
        self.group = group;
        self
    }

    /// The same, which shows only then.
    pub(super) const fn when(mut self, applies: fn(&T) -> bool) -> Self {
        self.applies = applies;
        self
    }
}

/// 0 to 1.
pub(super) const FRACTION: Kind = number([0.0, 1.0], [0.0, 1.0], "");
/// What reflects or lets through.
pub(super) const REFLECTANCE: Kind = Kind::Color { most: 1.0 };
/// The colour of a light, whose strength stands beside it: only the ratios of its bands count.
pub(super) const HUE: Kind = Kind::Color { most: 1.0 };
/// Largest of what may have any size: sums and squares of it stay finite.
pub(super) const HUGE: f32 = 1e12;

/// A number whose slider is even.
pub(super) const fn number(range: [f32; 2], slider: [f32; 2], unit: &'static str) -> Kind {
    Kind::Number { range, slider, log: false, unit, words: &[] }
}

/// A number from 0 whose slider grows by factors.
pub(super) const fn growing(most: f32, slider: [f32; 2], unit: &'static str) -> Kind {
    Kind::Number { range: [0.0, most], slider, log: true, unit, words: &[] }
}

/// The same kind, that may be one of these words too.
pub(super) const fn or(kind: Kind, words: &'static [&'static str]) -> Kind {
    match kind {
        Kind::Number { range, slider, log, unit, .. } => Kind::Number { range, slider, log, unit, words },
        Kind::Whole { range, slider, .. } => Kind::Whole { range, slider, words },
        other => other,
    }
}

/// A parameter as a panel shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// In files, and for [`Edits::set`](super::Edits::set).
    pub name: &'static str,
    /// For people.
    pub label: &'static str,
    /// Rows of one group follow one another; empty: the first ones.
    pub group: &'static str,
    /// What it may hold.
    pub kind: Kind,
    /// What it holds, edited or not.
    pub value: Value,
    /// It differs from the file's.
    pub changed: bool,
    /// It shows, as things are: the angle of a spot does not where the light is no spot.
    pub applies: bool,
}

/// The changed ones among the parameters of one thing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Changes(BTreeMap<&'static str, Value>);

impl Changes {
    /// What a parameter was changed to.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.get(name)
    }

    /// Whether nothing is changed.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Names of what is changed.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        self.0.keys().copied()
    }

    /// Takes a change back.
    pub fn remove(&mut self, name: &str) {
        self.0.remove(name);
    }

    /// `base` with these changes, made in the order of the table.
    pub(super) fn on<T>(&self, table: &[Param<T>], mut base: T) -> T {
        for p in table {
            if let Some(value) = self.get(p.name) {
                (p.access.set)(&mut base, value);
            }
        }
        base
    }

    /// Changes a parameter of `base`. What it would be without that is not kept.
    pub(super) fn set<T: Clone>(
        &mut self,
        table: &'static [Param<T>],
        base: &T,
        name: &str,
        value: Value,
    ) -> Result<(), EditsError> {
        let p = find(table, name)?;
        p.kind.check(&value).map_err(|reason| EditsError::new(name, reason))?;
        let mut without = self.clone();
        without.remove(name);
        if (p.access.get)(&without.on(table, base.clone())) == value {
            *self = without;
        } else {
            self.0.insert(p.name, value);
        }
        Ok(())
    }

    /// Changes a parameter of what is not known here.
    pub(super) fn insert<T>(
        &mut self,
        table: &'static [Param<T>],
        name: &str,
        value: Value,
    ) -> Result<(), EditsError> {
        let p = find(table, name)?;
        p.kind.check(&value).map_err(|reason| EditsError::new(name, reason))?;
        self.0.insert(p.name, value);
        Ok(())
    }

    /// The whole table.
    pub(super) fn rows<T>(&self, table: &'static [Param<T>], base: T) -> Vec<Row> {
        let edited = self.on(table, base);
        let row = |p: &Param<T>| {
            let changed = self.get(p.name);
            Row {
                name: p.name,
                label: p.label,
                group: p.group,
                kind: p.kind,
                // As it was said: angles do not come back from radians to the last digit.
                value: changed.cloned().unwrap_or_else(|| (p.access.get)(&edited)),
                changed: changed.is_some(),
                applies: (p.applies)(&edited),
            }
        };
        table.iter().map(row).collect()
    }

    /// Names of changes that do not show.
    pub(super) fn idle<T>(&self, table: &'static [Param<T>], base: T) -> Vec<&'static str> {
        let edited = self.on(table, base);
        let idle = |p: &&Param<T>| self.get(p.name).is_some() && !(p.applies)(&edited);
        table.iter().filter(idle).map(|p| p.name).collect()
    }

    /// An object of a file.
    pub(super) fn read<T>(
        table: &'static [Param<T>],
        json: &Json<'_>,
        place: &str,
    ) -> Result<Changes, EditsError> {
        let mut changes = Changes::default();
        for (key, json) in members(json, place)? {
            let at = |e: EditsError| e.under(place).at_line(json.line);
            let p = find(table, key).map_err(at)?;
            let value = p.kind.read(json).map_err(|reason| at(EditsError::new(key, reason)))?;
            changes.0.insert(p.name, value);
        }
        Ok(changes)
    }

    /// Members of an object of a file, in the order of the table.
    pub(super) fn write<T>(&self, table: &[Param<T>], writer: &mut Writer) {
        for p in table {
            if let Some(value) = self.get(p.name) {
                writer.member(p.name, &value.to_string());
            }
        }
    }
}

fn find<T>(table: &'static [Param<T>], name: &str) -> Result<&'static Param<T>, EditsError> {
    table.iter().find(|p| p.name == name).ok_or_else(|| {
        let known: Vec<&str> = table.iter().map(|p| p.name).collect();
        EditsError::new(name, format!("there is no such key here; there are {}", known.join(", ")))
    })
}

/// The members of what must be an object.
pub(super) fn members<'j, 'a>(
    json: &'j Json<'a>,
    place: &str,
) -> Result<&'j [(std::borrow::Cow<'a, str>, Json<'a>)], EditsError> {
    match &json.node {
        Node::Object(members) => Ok(members),
        _ => Err(EditsError {
            place: place.into(),
            line: Some(json.line),
            reason: "expected an object {…}".into(),
        }),
    }
}
