//! The pictures that the materials in use name, decoded on all cores. One that cannot be read is a warning: the material goes
//! without it.

use super::library::{Entry, Libraries};
use super::map::Map;
use super::texels::has_alpha;
use crate::files::read_file;
use crate::image::ldr;
use crate::limits::Room;
use crate::resolver::Resolver;
use crate::warnings::Warnings;
use crate::{Bound, IoError, Limits};
use lumbre_scene::Image;
use rayon::prelude::*;
use std::collections::HashMap;
use std::path::PathBuf;

/// Names of pictures; every one costs looks at the disk.
const MOST_NAMES: usize = 1 << 13;

/// A decoded picture.
pub(super) struct Picture {
    pub(super) image: Image,
    pub(super) has_alpha: bool,
}

/// All of them.
pub(super) struct Pictures {
    pub(super) list: Vec<Picture>,
    /// By library and name; `None`: it could not be read.
    by_name: HashMap<(usize, String), Option<usize>>,
    /// What is left for pictures made from these.
    pub(super) room: Room,
}

/// A file before decoding.
struct Encoded {
    bytes: Vec<u8>,
    /// For messages.
    shown: PathBuf,
}

/// Where a name was first met, and what it led to.
struct Use {
    file: usize,
    name: String,
    place: String,
    /// Index into the encoded files, or why it was not read.
    read: Result<usize, String>,
}

impl Pictures {
    /// Reads what the maps of these materials name.
    pub(super) fn load(
        resolver: &Resolver,
        libraries: &Libraries,
        used: &[&Entry],
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Self {
        let mut gather = Gather {
            resolver,
            limits,
            bytes: limits.room(Bound::BufferBytes),
            decoded: limits.room(Bound::TotalImageBytes),
            encoded: Vec::new(),
            by_path: HashMap::new(),
        };
        let mut uses: HashMap<(usize, String), Use> = HashMap::new();
        let mut order = Vec::new();
        for (entry, map) in used.iter().flat_map(|e| e.mtl.maps().map(move |m| (e, m))) {
            let key = (entry.file, map.name.clone());
            if uses.contains_key(&key) {
                continue;
            }
            let file = &libraries.files[entry.file];
            let place = format!("{}: line {}", file.name, map.line);
            let read = if uses.len() < MOST_NAMES {
                gather.find(map, file, &place, warnings)
            } else {
                Err(format!("more than {MOST_NAMES} pictures"))
            };
            uses.insert(key.clone(), Use { file: key.0, name: key.1.clone(), place, read });
            order.push(key);
        }
        let Gather { encoded, decoded: room, .. } = gather;
        let decoded: Vec<Result<Picture, IoError>> =
            encoded.into_par_iter().map(|e| decode(e, limits)).collect();
        let mut list = Vec::with_capacity(decoded.len());
        let indices: Vec<Result<usize, String>> = decoded
            .into_iter()
            .map(|picture| {
                list.push(picture.map_err(|e| e.to_string())?);
                Ok(list.len() - 1)
            })
            .collect();
        let mut by_name = HashMap::new();
        for key in order {
            let Some(Use { file, name, place, read }) = uses.remove(&key) else { continue };
            let index = read.and_then(|i| indices[i].clone());
            let index =
                index.map_err(|why| warnings.add(place, format!("{why}; the material goes without it")));
            by_name.insert((file, name), index.ok());
        }
        Pictures { list, by_name, room }
    }

    /// The picture of a map of a material of library `file`.
    pub(super) fn get(&self, file: usize, map: &Map) -> Option<usize> {
        // Every map in use was looked for.
        self.by_name.get(&(file, map.name.clone())).copied().flatten()
    }
}

/// Files that were found, each once.
struct Gather<'a> {
    resolver: &'a Resolver<'a>,
    limits: &'a Limits,
    bytes: Room,
    decoded: Room,
    encoded: Vec<Encoded>,
    by_path: HashMap<PathBuf, Result<usize, String>>,
}

impl Gather<'_> {
    fn find(
        &mut self,
        map: &Map,
        file: &super::library::File,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<usize, String> {
        let found = self.resolver.find_name(&map.name, Some(&file.folder))?;
        if let Some(note) = &found.note {
            warnings.add(place, note);
        }
        if let Some(known) = self.by_path.get(&found.real) {
            return known.clone();
        }
        let read = self.read(&found.real, found.shown).map_err(|e| e.to_string());
        self.by_path.insert(found.real, read.clone());
        read
    }

    /// Reads a file and checks what it will take once decoded.
    fn read(&mut self, real: &std::path::Path, shown: PathBuf) -> Result<usize, IoError> {
        let room = self.bytes.min(self.limits.room(Bound::FileBytes));
        let bytes = read_file(real, room).map_err(|e| e.at_path(&shown))?;
        let (width, height) = ldr::dimensions(&bytes, &shown, self.limits)?;
        self.decoded.take(&shown, "", u64::from(width) * u64::from(height) * 4)?;
        self.bytes.take(&shown, "", bytes.len() as u64)?;
        self.encoded.push(Encoded { bytes, shown });
        Ok(self.encoded.len() - 1)
    }
}

fn decode(e: Encoded, limits: &Limits) -> Result<Picture, IoError> {
    let (width, height, rgba8) = ldr::decode_rgba8(&e.bytes, &e.shown, limits)?;
    let name = e.shown.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let image = Image { name, width, height, rgba8 };
    Ok(Picture { has_alpha: has_alpha(&image), image })
}
