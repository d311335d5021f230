//! `lumbre info`: what a scene holds, what it takes, and why its picture might be black.

mod advice;
mod json;
mod text;

use crate::exit::{Code, Failure};
use crate::flags::info::InfoArgs;
use crate::flags::values::Size;
use crate::{console, edited, memory};
use lumbre::core::Film;
use lumbre::io::{Description, ErrorKind, SceneChoice, describe_scene};
use lumbre::{Device, GpuOptions, InfoError, SceneInfo};

/// Runs the command.
pub(crate) fn run(args: &mut InfoArgs) -> Result<Code, Failure> {
    args.loading.read_edits()?;
    let args = &*args;
    Device::Cpu.open(&GpuOptions::default())?;
    let options = args.loading.options();
    let description = describe_scene(&args.scene, &options)?;
    let opened = lumbre::load_scene(&args.scene, &options);
    let warnings = opened.as_ref().map_or(&[][..], |l| &l.warnings);
    warnings.iter().for_each(console::warning);
    let (info, failure) = match opened {
        Ok(loaded) => match lumbre::info(&edited::apply(&args.loading, &args.scene, loaded.scene, None)?) {
            Ok(info) => (Some(info), None),
            Err(e) => (None, Some(e.into())),
        },
        Err(e) if e.kind() == ErrorKind::BadChoice => return Err(e.into()),
        // The head could be read, and may say why the rest could not.
        Err(e) => (None, Some(e.into())),
    };
    let report = Report { args, description, info };
    console::result(if args.json { json::of(&report) } else { text::of(&report) })?;
    failure.map_or(Ok(Code::Done), Err)
}

impl From<InfoError> for Failure {
    fn from(e: InfoError) -> Self {
        match e {
            InfoError::Compile(e) => e.into(),
            InfoError::Device(e) => e.into(),
        }
    }
}

/// All there is to print.
struct Report<'a> {
    args: &'a InfoArgs,
    description: Description,
    /// `None`: the scene could not be read.
    info: Option<SceneInfo>,
}

impl Report<'_> {
    /// The place of the scene that is looked at among those of the file.
    fn shown_scene(&self) -> usize {
        match self.args.loading.options().scene {
            SceneChoice::Default => self.description.default_scene,
            SceneChoice::Index(i) => i,
            SceneChoice::Name(name) => self.description.scenes.iter().position(|n| *n == name).unwrap_or(0),
        }
    }

    /// Bytes of the film of a picture of the size asked for, and of writing the most demanding output.
    fn film_bytes(&self) -> u64 {
        let Size([width, height]) = self.args.size;
        Film::bytes(width, height) + u64::from(width) * u64::from(height) * memory::EXR_BYTES_PER_PIXEL
    }
}
