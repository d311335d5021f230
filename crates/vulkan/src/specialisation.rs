//! Specialisation constants: what a shader is told when its pipeline is made.

use ash::vk;

/// Values of specialisation constants, four bytes each.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Specialisation {
    entries: Vec<(u32, u32)>,
}

/// The same as Vulkan wants it.
pub(crate) struct Table {
    map: Vec<vk::SpecializationMapEntry>,
    data: Vec<u8>,
}

impl Specialisation {
    /// None: every constant keeps its default.
    pub fn new() -> Self {
        Self::default()
    }

    /// With a `uint` or `int`.
    pub fn uint(mut self, id: u32, value: u32) -> Self {
        self.entries.push((id, value));
        self
    }

    /// With a `bool`.
    pub fn bool(self, id: u32, value: bool) -> Self {
        self.uint(id, value.into())
    }

    /// With a `float`.
    pub fn float(self, id: u32, value: f32) -> Self {
        self.uint(id, value.to_bits())
    }

    /// Whether it has the same constants, and every value is the same or, where `optional` says so of the constant, that of a feature that
    /// is there without being asked for.
    pub(crate) fn covers(&self, asked: &Specialisation, optional: impl Fn(u32) -> bool) -> bool {
        let serves = |((id, has), (asked_id, asks)): (&(u32, u32), &(u32, u32))| {
            id == asked_id && (has == asks || (*has == 1 && *asks == 0 && optional(*id)))
        };
        self.entries.len() == asked.entries.len() && self.entries.iter().zip(&asked.entries).all(serves)
    }

    pub(crate) fn table(&self) -> Table {
        let entry = |(i, (id, _)): (usize, &(u32, u32))| {
            vk::SpecializationMapEntry::default().constant_id(*id).offset(4 * i as u32).size(4)
        };
        Table {
            map: self.entries.iter().enumerate().map(entry).collect(),
            data: self.entries.iter().flat_map(|e| e.1.to_ne_bytes()).collect(),
        }
    }
}

impl Table {
    pub(crate) fn info(&self) -> vk::SpecializationInfo<'_> {
        vk::SpecializationInfo::default().map_entries(&self.map).data(&self.data)
    }
}
