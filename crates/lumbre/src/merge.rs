//! Parts of one render, made anywhere, added up to the bits of one run. A part is an EXR that carries, beside the picture,
//! the exact sums of its film ([`add_sums`]) and what it is a part of.
//!
//! The sums are channels of whole numbers in the one part of the file, as layers `sums.…`: a second part of the EXR would hide
//! them better, but makes a file that programs of single parts do not open at all, and Blender, Nuke and tev show both the same
//! way. Each kind of sum is a layer of its own, for no layer may have more than 23 channels (`lumbre_io`, `exr.rs`).

use crate::fingerprint::Fingerprint;
use lumbre_core::film::state::{FilmState, WORDS, word_names};
use lumbre_core::film::{Crop, Film, NonFinite, PixelSums};
use lumbre_io::{ExrImage, IoError, Limits, one_line, read_exr};
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The layers of the sums begin so.
const SUMS: &str = "sums.";
/// Attributes that say what a part is a part of.
const FINGERPRINT: &str = "lumbre.part.fingerprint";
const SAMPLES: &str = "lumbre.part.samples";
const NON_FINITE: &str = "lumbre.part.nonFinite";

/// Some samples of a render.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What it is a part of.
    pub fingerprint: Fingerprint,
    /// Samples that every pixel has.
    pub samples: Range<u32>,
    /// Their sums.
    pub film: Film,
    /// Other attributes of its file.
    pub metadata: Vec<(String, String)>,
}

/// Parts that cannot be added.
#[derive(Debug, thiserror::Error)]
pub enum MergeError {
    /// A file cannot be read.
    #[error(transparent)]
    Io(#[from] IoError),
    /// A picture without sums.
    #[error("{}: carries no exact sums", show(path))]
    NoSums {
        /// The file.
        path: PathBuf,
    },
    /// A file whose sums make no sense.
    #[error("{}: its sums are damaged: {why}", show(path))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        why: String,
    },
    /// Two parts are of different renders.
    #[error("{}: is not of the same render as {}{}", show(path), show(first), difference(found))]
    Foreign {
        /// The file.
        path: PathBuf,
        /// The first part.
        first: PathBuf,
        /// An attribute in which they differ and its values there and here, if there is one.
        found: Option<[String; 3]>,
    },
    /// Two parts have samples in common.
    #[error("{} ({}) and {} ({}) have samples in common", show(&a.0), Samples(&a.1), show(&b.0), Samples(&b.1))]
    Overlap {
        /// One of them.
        a: (PathBuf, Range<u32>),
        /// The other.
        b: (PathBuf, Range<u32>),
    },
    /// Samples between two parts are missing.
    #[error("{} between {} ({}) and {} ({})", missing(&(before.1.end..after.1.start)),
        show(&before.0), Samples(&before.1), show(&after.0), Samples(&after.1))]
    Gap {
        /// The last part before them.
        before: (PathBuf, Range<u32>),
        /// The first part after them.
        after: (PathBuf, Range<u32>),
    },
    /// There is nothing to add.
    #[error("there are no parts")]
    Empty,
}

fn show(path: &Path) -> String {
    one_line(&path.to_string_lossy())
}

fn missing(samples: &Range<u32>) -> String {
    format!("{} {} missing", Samples(samples), if samples.len() == 1 { "is" } else { "are" })
}

fn difference(found: &Option<[String; 3]>) -> String {
    let short = |text: &str| one_line(text).chars().take(80).collect::<String>();
    match found {
        Some([name, first, here]) => {
            format!(": {} is {:?} there and {:?} here", short(name), short(first), short(here))
        }
        None => ": scene, camera or settings differ".into(),
    }
}

/// Samples as people count them: the last one included.
pub struct Samples<'a>(pub &'a Range<u32>);

impl fmt::Display for Samples<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0.len() {
            0 => f.write_str("no samples"),
            1 => write!(f, "sample {}", self.0.start),
            _ => write!(f, "samples {} to {}", self.0.start, self.0.end - 1),
        }
    }
}

/// Makes a picture of a film a part: adds the film's exact sums and what they are a part of. The samples of the film begin at
/// `first`; returns their range. `None`, and nothing is added, if pixels have different numbers of them, as in a render that was
/// interrupted, or none.
pub fn add_sums(image: &mut ExrImage, film: &Film, of: Fingerprint, first: u32) -> Option<Range<u32>> {
    let samples = first..first.checked_add(film.even_samples().filter(|n| *n > 0)?)?;
    let mut planes: Vec<(String, Vec<u32>)> =
        word_names().map(|name| (format!("{SUMS}{name}"), Vec::with_capacity(film.pixels().len()))).collect();
    for pixel in film.pixels() {
        for ((_, plane), word) in planes.iter_mut().zip(pixel.to_words()) {
            plane.push(word);
        }
    }
    image.whole.append(&mut planes);
    let named =
        film.non_finite().iter().map(|n| format!(" {},{},{}", n.row_column[0], n.row_column[1], n.sample));
    let non_finite = format!("{}:{}", film.non_finite_count(), named.collect::<String>());
    let attributes = [
        (FINGERPRINT, of.to_string()),
        (SAMPLES, format!("{}..{}", samples.start, samples.end)),
        (NON_FINITE, non_finite),
    ];
    image.metadata.extend(attributes.map(|(name, value)| (name.to_string(), value)));
    Some(samples)
}

/// Reads a part.
///
/// # Errors
/// If the file cannot be read, exceeds the limits, has no sums, or sums that no film can have.
pub fn read_part(path: impl AsRef<Path>, limits: &Limits) -> Result<Part, MergeError> {
    let path = path.as_ref();
    let image = read_exr(path, limits)?;
    let text = |name: &str| image.metadata.iter().find(|(n, _)| n == name).map(|(_, v)| v.as_str());
    let (Some(fingerprint), Some(samples)) = (text(FINGERPRINT), text(SAMPLES)) else {
        return Err(MergeError::NoSums { path: path.into() });
    };
    let damaged = |why: &str| MergeError::Damaged { path: path.into(), why: why.into() };
    let fingerprint =
        fingerprint.parse().map_err(|e: crate::fingerprint::NoFingerprint| damaged(&e.to_string()))?;
    let samples = parse_samples(samples).ok_or_else(|| damaged("their range of samples"))?;
    let non_finite = text(NON_FINITE).and_then(parse_non_finite);
    let (non_finite_count, non_finite) =
        non_finite.ok_or_else(|| damaged("the list of samples that are not finite"))?;
    if non_finite.iter().any(|n| !samples.contains(&n.sample)) {
        return Err(damaged("a sample that is not finite is not in their range"));
    }
    let (picture, crop) = place(&image).ok_or_else(|| damaged("they lie outside of the picture"))?;
    let pixels = pixels(&image).ok_or_else(|| damaged("channels are missing"))?;
    if pixels.iter().any(|p| p.samples() as usize != samples.len()) {
        return Err(damaged("a pixel has another number of samples"));
    }
    let state = FilmState { picture, crop, pixels, non_finite_count, non_finite };
    let film = Film::restore(state).ok_or_else(|| damaged("no film can have them"))?;
    let own = |name: &str| [FINGERPRINT, SAMPLES, NON_FINITE].contains(&name);
    let metadata = image.metadata.into_iter().filter(|(name, _)| !own(name)).collect();
    Ok(Part { fingerprint, samples, film, metadata })
}

/// `8..16`; not empty.
fn parse_samples(text: &str) -> Option<Range<u32>> {
    let (start, end) = text.split_once("..")?;
    let range = start.parse().ok()?..end.parse().ok()?;
    (!range.is_empty()).then_some(range)
}

/// `2: 3,4,0 7,1,5`: how many, and row, column and sample of those that are named.
fn parse_non_finite(text: &str) -> Option<(u64, Vec<NonFinite>)> {
    let (count, named) = text.split_once(':')?;
    let one = |words: &str| {
        let mut numbers = words.split(',').map(|n| n.parse().ok());
        let found = NonFinite { row_column: [numbers.next()??, numbers.next()??], sample: numbers.next()?? };
        numbers.next().is_none().then_some(found)
    };
    Some((count.parse().ok()?, named.split_ascii_whitespace().map(one).collect::<Option<_>>()?))
}

/// Size of the picture, and the part of it that the file holds.
fn place(image: &ExrImage) -> Option<([u32; 2], Crop)> {
    let size = [image.width, image.height];
    let Some(window) = image.window else { return Some((size, Crop { origin: [0, 0], size })) };
    let [x, y] = window.origin;
    Some((window.picture, Crop { origin: [x.try_into().ok()?, y.try_into().ok()?], size }))
}

/// The sums of all pixels; `None` if a channel is missing.
fn pixels(image: &ExrImage) -> Option<Vec<PixelSums>> {
    let plane = |name: String| {
        let name = format!("{SUMS}{name}");
        image.whole.iter().find(|(n, _)| *n == name).map(|(_, plane)| &plane[..])
    };
    let planes: Vec<&[u32]> = word_names().map(plane).collect::<Option<_>>()?;
    let planes: [&[u32]; WORDS] = planes.try_into().ok()?;
    let count = planes[0].len();
    Some((0..count).map(|i| PixelSums::from_words(&planes.map(|p| p[i]))).collect())
}

/// Adds parts one by one, in any order.
#[derive(Debug, Default)]
pub struct Merge {
    sum: Option<Part>,
    /// Those added, with their samples.
    parts: Vec<(PathBuf, Range<u32>)>,
}

impl Merge {
    /// Adds the part of a file.
    ///
    /// # Errors
    /// If it is of another render than the first one, or has samples that are already there.
    pub fn add(&mut self, path: &Path, part: Part) -> Result<(), MergeError> {
        let place = |p: &Part| (p.film.picture_size(), p.film.crop());
        if let Some(sum) = &mut self.sum {
            let (first, _) = &self.parts[0];
            if part.fingerprint != sum.fingerprint || place(&part) != place(sum) {
                let size = |p: &Part| p.film.picture_size().map(|n| n.to_string()).join("x");
                let sizes = Some(["the size".into(), size(sum), size(&part)]).filter(|[_, a, b]| a != b);
                let found = sizes.or_else(|| differing(&sum.metadata, &part.metadata));
                return Err(MergeError::Foreign { path: path.into(), first: first.clone(), found });
            }
            let meets = |r: &Range<u32>| r.start < part.samples.end && part.samples.start < r.end;
            if let Some(other) = self.parts.iter().find(|(_, r)| meets(r)) {
                return Err(MergeError::Overlap { a: other.clone(), b: (path.into(), part.samples) });
            }
            self.parts.push((path.into(), part.samples.clone()));
            sum.film.merge(&part.film);
            // The first samples say what made the picture.
            if part.samples.start < sum.samples.start {
                sum.metadata = part.metadata;
            }
            sum.samples = sum.samples.start.min(part.samples.start)..sum.samples.end.max(part.samples.end);
        } else {
            self.parts.push((path.into(), part.samples.clone()));
            self.sum = Some(part);
        }
        Ok(())
    }

    /// The sum of all.
    ///
    /// # Errors
    /// If samples between them are missing, or there are none.
    pub fn finish(mut self) -> Result<Part, MergeError> {
        self.parts.sort_by_key(|(_, samples)| samples.start);
        for two in self.parts.windows(2) {
            if two[0].1.end < two[1].1.start {
                return Err(MergeError::Gap { before: two[0].clone(), after: two[1].clone() });
            }
        }
        self.sum.ok_or(MergeError::Empty)
    }
}

/// The first attribute that differs, with its values; what counts samples is left out.
fn differing(a: &[(String, String)], b: &[(String, String)]) -> Option<[String; 3]> {
    let of = |all: &[(String, String)], name: &str| {
        all.iter().find(|(n, _)| n == name).map_or_else(|| "not given".into(), |(_, v)| v.clone())
    };
    let names = a.iter().chain(b).map(|(name, _)| name).filter(|n| *n != "lumbre.spp");
    names.map(|name| [name.clone(), of(a, name), of(b, name)]).find(|[_, a, b]| a != b)
}

/// Reads parts and adds them, one after the other: memory for two films and one file.
///
/// # Errors
/// As [`read_part`], [`Merge::add`] and [`Merge::finish`].
pub fn merge<P: AsRef<Path>>(paths: &[P], limits: &Limits) -> Result<Part, MergeError> {
    let mut merge = Merge::default();
    for path in paths {
        merge.add(path.as_ref(), read_part(path, limits)?)?;
    }
    merge.finish()
}
