//! The files of a render: checked before it, written after it.

use crate::exit::{Code, Failure};
use crate::flags::render::RenderArgs;
use crate::flags::values::{Sky, file_name};
use crate::{console, memory};
use lumbre::core::Film;
use lumbre::core::color::Exposure;
use lumbre::{io, output};
use std::fs;
use std::path::{Path, PathBuf};

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

/// Files to be written, of known formats.
#[derive(Debug, Default)]
pub(super) struct Outputs(Vec<(PathBuf, Format)>);

impl Outputs {
    /// Nothing is written.
    pub(super) fn none() -> Self {
        Self::default()
    }

    /// Checks that each file has a format and could be written now.
    pub(super) fn check(args: &RenderArgs) -> Result<Self, Failure> {
        let mut outputs = Vec::new();
        for path in &args.output.output {
            let format = format_of(path)?;
            let inputs = [Some(&args.scene), args.light.env.as_ref()];
            if inputs.into_iter().flatten().any(|input| same_file(input, path)) {
                let message = format!("{}: is read and cannot be the output too", path.display());
                return Err(Failure::usage(message));
            }
            io::check_writable(path)?;
            outputs.push((path.clone(), format));
        }
        Ok(Outputs(outputs))
    }

    /// Bytes of memory that the most demanding format takes while it is written, per pixel.
    pub(super) fn bytes_per_pixel(&self) -> u64 {
        let need = |f: &Format| match f {
            Format::Png => memory::PNG_BYTES_PER_PIXEL,
            Format::Exr => memory::EXR_BYTES_PER_PIXEL,
        };
        self.0.iter().map(|(_, f)| need(f)).max().unwrap_or(0)
    }

    /// Writes all of them. One that fails does not keep the others from being written.
    pub(super) fn write(
        &self,
        film: &Film,
        exposure: Exposure,
        metadata: &[(String, String)],
    ) -> Result<(), Failure> {
        let mut failures = Vec::new();
        for (path, format) in &self.0 {
            let written = match format {
                Format::Png => write_png(path, film, exposure),
                Format::Exr => io::write_exr(path, output::to_exr(film, false, metadata.to_vec())),
            };
            match written {
                Ok(()) => console::note(format_args!("wrote {}", path.display())),
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
}

fn format_of(path: &Path) -> Result<Format, Failure> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
    match extension.as_deref() {
        Some("png") => Ok(Format::Png),
        Some("exr") => Ok(Format::Exr),
        _ => Err(Failure::usage(format!("{}: the output is a .png or .exr", path.display()))),
    }
}

/// Whether both exist and are one.
fn same_file(a: &Path, b: &Path) -> bool {
    fs::canonicalize(a).ok().zip(fs::canonicalize(b).ok()).is_some_and(|(a, b)| a == b)
}

fn write_png(path: &Path, film: &Film, exposure: Exposure) -> Result<(), io::IoError> {
    if !matches!(exposure, Exposure::Ev(_)) {
        let ev = exposure.factor(&film.radiance(), film.width() as usize).log2();
        console::note(format_args!("exposure: {ev:+.2} EV"));
    }
    io::write_png(path, film.width(), film.height(), &output::to_srgb8(film, exposure))
}

/// What made the picture. Nothing that differs from run to run, so that the same command writes the same bytes. Flags on camera
/// and light that were not given are left out: the scene decided. `sky_added`: that it had no light and got the gradient.
/// `interrupted` is the number of samples after which the render stopped too early.
pub(super) fn metadata(
    args: &RenderArgs,
    sky_added: bool,
    interrupted: Option<u64>,
) -> Vec<(String, String)> {
    let mut all = vec![("version", env!("CARGO_PKG_VERSION").into()), ("scene", file_name(&args.scene))];
    all.extend(args.sampling.described());
    all.extend(args.loading.described());
    all.extend(args.camera.described());
    all.extend(args.light.described());
    if sky_added {
        all.push(("sky", Sky::Gradient.to_string()));
    }
    if let Some(samples) = interrupted {
        all.push(("interrupted", format!("after {samples} camera samples")));
    }
    all.into_iter().map(|(name, value)| (format!("lumbre.{name}"), value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_says_the_format() {
        assert_eq!(format_of(Path::new("a/b.PNG")).unwrap(), Format::Png);
        assert_eq!(format_of(Path::new("b.tmp.exr")).unwrap(), Format::Exr);
        for wrong in ["png", "a.jpg", "a.", "a", ""] {
            assert_eq!(format_of(Path::new(wrong)).unwrap_err().code, Code::Usage, "{wrong}");
        }
    }
}
