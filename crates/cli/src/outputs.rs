//! Pictures as files or on standard output: what `-o` means, checked before the work, written after it.

use crate::console;
use crate::exit::{Code, Failure};
use crate::memory::EXR_BYTES_PER_PIXEL;
use lumbre::core::Film;
use lumbre::core::color::Exposure;
use lumbre::core::film::state::WORDS;
use lumbre::edits::LookEdits;
use lumbre::fingerprint::Fingerprint;
use lumbre::io::{self, IoError, Picture, STANDARD_OUTPUT};
use lumbre::output::{self, DisplayImage, Look};
use std::fs;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

/// Formats of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Jpeg,
    Hdr,
    Exr,
}

/// What `-o` may be, for messages.
const KNOWN: &str =
    "an output is a .png, .jpg, .hdr or .exr; - is standard output, also as exr:- and the like";

impl Format {
    fn named(name: &str) -> Option<Format> {
        match name.to_ascii_lowercase().as_str() {
            "png" => Some(Format::Png),
            "jpg" | "jpeg" => Some(Format::Jpeg),
            "hdr" => Some(Format::Hdr),
            "exr" => Some(Format::Exr),
            _ => None,
        }
    }

    /// Bytes of memory that a picture takes while it is written, per pixel: its planes, and for an EXR the same once more as the
    /// file's rows.
    fn bytes_per_pixel(self, sums: bool) -> u64 {
        match self {
            Format::Png | Format::Jpeg => 12 + 4,
            Format::Hdr => 2 * 12,
            Format::Exr => EXR_BYTES_PER_PIXEL + if sums { 2 * 4 * WORDS as u64 } else { 0 },
        }
    }

    /// Whether exposure and tone curve shape it.
    fn is_for_display(self) -> bool {
        matches!(self, Format::Png | Format::Jpeg)
    }
}

/// Where a picture goes.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Place {
    File(PathBuf),
    Stdout,
}

/// One `-o`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Target {
    place: Place,
    format: Format,
}

impl Target {
    fn parse(path: &Path) -> Result<Target, Failure> {
        let text = path.to_string_lossy();
        if text == "-" {
            return Ok(Target { place: Place::Stdout, format: Format::Png });
        }
        if let Some(format) = text.strip_suffix(":-").and_then(Format::named) {
            return Ok(Target { place: Place::Stdout, format });
        }
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        let format = Format::named(&extension)
            .ok_or_else(|| Failure::usage(format!("{}: {KNOWN}", io::one_line(&text))))?;
        Ok(Target { place: Place::File(path.into()), format })
    }
}

/// What makes an EXR a part that `lumbre merge` can add.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartOf {
    pub(crate) fingerprint: Fingerprint,
    /// The first of the film's samples.
    pub(crate) first_sample: u32,
}

/// A film, and what there is to say of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Developed<'a> {
    pub(crate) film: &'a Film,
    pub(crate) metadata: &'a [(String, String)],
    /// An EXR carries the exact sums, too.
    pub(crate) part: Option<PartOf>,
}

/// Where pictures go, and what they look like.
#[derive(Debug, Default)]
pub(crate) struct Outputs {
    targets: Vec<Target>,
    look: LookEdits,
    /// Of JPEG.
    quality: u8,
}

impl Outputs {
    /// Checks that each has a format and could be written now, and that none of them is one of the `inputs`.
    pub(crate) fn check(
        paths: &[PathBuf],
        inputs: &[&Path],
        look: LookEdits,
        quality: u8,
    ) -> Result<Self, Failure> {
        let targets: Vec<Target> = paths.iter().map(|p| Target::parse(p)).collect::<Result<_, _>>()?;
        let is_stdout = |t: &&Target| t.place == Place::Stdout;
        match targets.iter().filter(is_stdout).count() {
            0 => {}
            1 if std::io::stdout().is_terminal() => {
                let why = "is a terminal, which shows no pictures: redirect it, as in `> picture.png`";
                return Err(Failure::usage(format!("{STANDARD_OUTPUT} {why}")));
            }
            1 => {}
            _ => return Err(Failure::usage(format!("{STANDARD_OUTPUT} takes one picture only"))),
        }
        for target in &targets {
            let Place::File(path) = &target.place else { continue };
            if inputs.iter().any(|input| same_file(input, path)) {
                let message = format!(
                    "{}: is read and cannot be the output too",
                    io::one_line(&path.to_string_lossy())
                );
                return Err(Failure::usage(message));
            }
            io::check_writable(path)?;
        }
        Ok(Outputs { targets, look, quality })
    }

    /// The same for pictures with alpha, where the format has it, or without.
    pub(crate) fn with_alpha(self, transparent: bool) -> Self {
        Outputs { look: LookEdits { look: Look { transparent, ..self.look.look }, ..self.look }, ..self }
    }

    /// The same for one of a row of pictures: its number stands behind the names of files.
    pub(crate) fn numbered(&self, number: u32) -> Self {
        let targets = self.targets.iter().map(|target| {
            let Place::File(path) = &target.place else { return target.clone() };
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let extension = path.extension().unwrap_or_default().to_string_lossy();
            let name = path.with_file_name(format!("{stem}-{number:04}.{extension}"));
            Target { place: Place::File(name), format: target.format }
        });
        Outputs { targets: targets.collect(), look: self.look, quality: self.quality }
    }

    /// Whether one of them goes to standard output, where nothing else must then appear.
    pub(crate) fn uses_stdout(&self) -> bool {
        self.targets.iter().any(|t| t.place == Place::Stdout)
    }

    /// Whether one of them is a file.
    pub(crate) fn has_file(&self) -> bool {
        self.targets.iter().any(|t| t.place != Place::Stdout)
    }

    /// Whether one of them can carry exact sums.
    pub(crate) fn has_exr(&self) -> bool {
        self.targets.iter().any(|t| t.format == Format::Exr)
    }

    /// Bytes of memory that the most demanding of them takes while it is written, per pixel. What goes to standard output is whole
    /// in memory first.
    pub(crate) fn bytes_per_pixel(&self, sums: bool) -> u64 {
        let need = |t: &Target| {
            let bytes = t.format.bytes_per_pixel(sums);
            if t.place == Place::Stdout { 2 * bytes } else { bytes }
        };
        self.targets.iter().map(need).max().unwrap_or(0)
    }

    /// Writes the files with what there is so far; standard output takes the finished picture only.
    pub(crate) fn save(&self, developed: &Developed<'_>) -> Result<(), Failure> {
        self.write_where(developed, |target| target.place != Place::Stdout, |_| ())
    }

    /// Writes all of them, and says so. One that fails does not keep the others from being written.
    pub(crate) fn write(&self, developed: &Developed<'_>) -> Result<(), Failure> {
        let by_itself = !matches!(self.look.look.exposure, Exposure::Ev(_));
        if by_itself && self.targets.iter().any(|t| t.format.is_for_display()) {
            let ev = self.look.exposure_factor(developed.film).log2();
            console::note(format_args!("exposure: {ev:+.2} EV"));
        }
        let note = |target: &Target| match &target.place {
            Place::File(path) => console::note(format_args!("wrote {}", path.display())),
            Place::Stdout => console::note(format_args!("wrote {STANDARD_OUTPUT}")),
        };
        self.write_where(developed, |_| true, note)
    }

    fn write_where(
        &self,
        developed: &Developed<'_>,
        wanted: impl Fn(&Target) -> bool,
        wrote: impl Fn(&Target),
    ) -> Result<(), Failure> {
        let targets: Vec<&Target> = self.targets.iter().filter(|t| wanted(t)).collect();
        // One development for all formats that want the same.
        let image =
            |alpha: bool| {
                let look = Look { transparent: self.look.look.transparent && alpha, ..self.look.look };
                let same = |t: &&Target| (t.format == Format::Png) == alpha && t.format.is_for_display();
                targets.iter().copied().any(|t| same(&t)).then(|| {
                    output::develop_at(developed.film, &look, self.look.exposure_factor(developed.film))
                })
            };
        let (png, jpeg) = (image(true), image(false));
        let mut failures = Vec::new();
        for target in targets {
            let shown = if target.format == Format::Png { &png } else { &jpeg };
            match self.write_one(target, developed, shown.as_ref()) {
                Ok(()) => wrote(target),
                Err(e) => failures.push(e.to_string()),
            }
        }
        match failures.pop() {
            None => Ok(()),
            Some(last) => {
                failures.iter().for_each(console::error);
                Err(Failure::new(Code::CannotWrite, last))
            }
        }
    }

    fn write_one(
        &self,
        target: &Target,
        developed: &Developed<'_>,
        shown: Option<&DisplayImage>,
    ) -> Result<(), IoError> {
        let linear;
        let picture = match (target.format, shown) {
            (Format::Png, Some(image)) => Picture::Png(image),
            (Format::Jpeg, Some(image)) => Picture::Jpeg(image, self.quality),
            (Format::Exr, _) => Picture::Exr(self.exr(developed)),
            _ => {
                linear = output::to_linear(developed.film);
                Picture::Hdr(&linear)
            }
        };
        match &target.place {
            Place::File(path) => picture.write(path),
            Place::Stdout => picture.write_to_stdout(),
        }
    }

    fn exr(&self, developed: &Developed<'_>) -> io::ExrImage {
        let Developed { film, metadata, part } = *developed;
        let mut image = output::to_exr(film, self.look.look.transparent, metadata.to_vec());
        if let Some(PartOf { fingerprint, first_sample }) = part
            && lumbre::merge::add_sums(&mut image, film, fingerprint, first_sample).is_none()
        {
            console::warning(
                "the picture carries no exact sums: some pixels have more samples than others, as happens when a \
                 render is interrupted",
            );
        }
        image
    }
}

/// Whether both exist and are one.
fn same_file(a: &Path, b: &Path) -> bool {
    fs::canonicalize(a).ok().zip(fs::canonicalize(b).ok()).is_some_and(|(a, b)| a == b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_says_the_format() {
        let format = |text: &str| Target::parse(Path::new(text)).unwrap().format;
        assert_eq!(format("a/b.PNG"), Format::Png);
        assert_eq!(format("b.tmp.exr"), Format::Exr);
        assert_eq!(
            (format("a.jpg"), format("a.JPEG"), format("a.hdr")),
            (Format::Jpeg, Format::Jpeg, Format::Hdr)
        );
        for wrong in ["png", "a.bmp", "a.", "a", "", ".png", ":-", "bmp:-"] {
            let e = Target::parse(Path::new(wrong)).unwrap_err();
            assert_eq!(e.code, Code::Usage, "{wrong}");
            assert!(e.message.ends_with(KNOWN), "{wrong}");
        }
    }

    #[test]
    fn a_dash_is_standard_output() {
        let of = |text: &str| Target::parse(Path::new(text)).unwrap();
        assert_eq!(of("-"), Target { place: Place::Stdout, format: Format::Png });
        assert_eq!(of("exr:-"), Target { place: Place::Stdout, format: Format::Exr });
        assert_eq!(of("a-.png").place, Place::File("a-.png".into()));
        assert_eq!(of("-.jpg").place, Place::File("-.jpg".into()));
    }
}
