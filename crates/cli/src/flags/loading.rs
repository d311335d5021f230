//! Flags on how a scene is read: shared by the commands that open one.

use super::values::{bytes, count, file_name};
use crate::exit::Failure;
use clap::Args;
use lumbre::LoadOptions;
use lumbre::edits::Edits;
use lumbre::io::{Bound, Limits, SceneChoice};
use std::path::PathBuf;

/// How to read the scene.
#[derive(Args, Debug)]
#[command(next_help_heading = "Scene")]
pub(crate) struct LoadingArgs {
    /// Which of the file's scenes: its name, or its number from 0. [default: the one that the file names, else the first]
    #[arg(long = "scene", value_name = "NAME|INDEX", value_parser = which_scene)]
    pub(crate) which_scene: Option<SceneChoice>,

    /// Which of the file's sets of materials, by name. [default: the materials that stand without one]
    #[arg(long, value_name = "NAME")]
    pub(crate) variant: Option<String>,

    /// What was changed of the scene, as `lumbre view` writes it (docs/edits.md says what can stand there): camera, lights,
    /// materials, places of things, settings, look. Flags that are given stand above it.
    #[arg(long, value_name = "FILE")]
    pub(crate) edits: Option<PathBuf>,

    /// What it holds.
    #[arg(skip)]
    pub(crate) edited: Edits,

    /// Folder from which textures and other files that the scene names may be read too. May be given several times.
    #[arg(long, value_name = "DIR")]
    pub(crate) asset_dir: Vec<PathBuf>,

    // Last, since its heading holds for all that follows.
    #[command(flatten)]
    pub(crate) limits: LimitArgs,
}

impl LoadingArgs {
    /// Reads the edits, if a file of them is named.
    pub(crate) fn read_edits(&mut self) -> Result<(), Failure> {
        if let Some(path) = &self.edits {
            self.edited = Edits::read(path)?;
        }
        Ok(())
    }

    /// The same in the library's terms.
    pub(crate) fn options(&self) -> LoadOptions {
        let (scene, variant) = (self.which_scene.clone().unwrap_or_default(), self.variant.clone());
        LoadOptions { limits: self.limits.limits(), asset_dirs: self.asset_dir.clone(), scene, variant }
    }

    /// Names and values of the flags that choose what is seen, for the metadata of a file.
    pub(crate) fn described(&self) -> Vec<(&'static str, String)> {
        let scene = self.which_scene.as_ref().and_then(|s| match s {
            SceneChoice::Default => None,
            SceneChoice::Index(i) => Some(i.to_string()),
            SceneChoice::Name(name) => Some(name.clone()),
        });
        let edits = self.edits.as_deref().map(file_name);
        let all = [("whichScene", scene), ("variant", self.variant.clone()), ("edits", edits)];
        all.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
    }
}

fn which_scene(text: &str) -> Result<SceneChoice, String> {
    match text {
        "" => Err("expected a name or a number".into()),
        _ => Ok(text.parse().map_or_else(|_| SceneChoice::Name(text.into()), SceneChoice::Index)),
    }
}

/// Limits on what a file may ask for, each named as in the library. A size is a number of bytes, or one with K, M, G or T
/// (also KiB, …), powers of 1024.
#[derive(Args, Debug)]
#[command(next_help_heading = "Limits on what a file may ask for")]
pub(crate) struct LimitArgs {
    /// Bytes of one file, such as 4GiB. [default: 8GiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_file_bytes: Option<u64>,

    /// Bytes of a scene's JSON. [default: 256MiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_json_bytes: Option<u64>,

    /// Objects in a scene's JSON, of all kinds together. [default: 4194304]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_json_objects: Option<u64>,

    /// Lists and objects of a scene's JSON inside one another, up to 127. [default: 64]
    #[arg(long, value_name = "N", hide_short_help = true, allow_negative_numbers = true)]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=Limits::JSON_DEPTH_BOUND))]
    pub(crate) max_json_depth: Option<u64>,

    /// Bytes of all buffers of a scene; also of all its encoded images. [default: 16GiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_buffer_bytes: Option<u64>,

    /// Columns or rows of an image. [default: 32768]
    #[arg(long, value_name = "N", hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_image_side: Option<u32>,

    /// Bytes of one image once decoded. [default: 4GiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_image_bytes: Option<u64>,

    /// Bytes of all images of a scene once decoded. [default: 16GiB]
    #[arg(long, value_name = "SIZE", value_parser = bytes, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_total_image_bytes: Option<u64>,

    /// Triangles, each mesh counted once. [default: 500000000]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_triangles: Option<u64>,

    /// Vertices, each mesh counted once. [default: 500000000]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_vertices: Option<u64>,

    /// Elements of a glTF accessor that has no data of its own. [default: 1048576]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_zero_filled: Option<u64>,

    /// Meshes that the nodes place in the world. [default: 16777216]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_instances: Option<u64>,

    /// Nodes beneath one another. [default: 1048576]
    #[arg(long, value_name = "N", value_parser = count, hide_short_help = true, allow_negative_numbers = true)]
    pub(crate) max_node_depth: Option<u64>,
}

impl LimitArgs {
    /// The same in the library's terms.
    pub(crate) fn limits(&self) -> Limits {
        let default = Limits::default();
        Limits {
            max_file_bytes: self.max_file_bytes.unwrap_or(default.max_file_bytes),
            max_json_bytes: self.max_json_bytes.unwrap_or(default.max_json_bytes),
            max_json_objects: self.max_json_objects.unwrap_or(default.max_json_objects),
            max_json_depth: self.max_json_depth.unwrap_or(default.max_json_depth),
            max_buffer_bytes: self.max_buffer_bytes.unwrap_or(default.max_buffer_bytes),
            max_image_side: self.max_image_side.unwrap_or(default.max_image_side),
            max_image_bytes: self.max_image_bytes.unwrap_or(default.max_image_bytes),
            max_total_image_bytes: self.max_total_image_bytes.unwrap_or(default.max_total_image_bytes),
            max_triangles: self.max_triangles.unwrap_or(default.max_triangles),
            max_vertices: self.max_vertices.unwrap_or(default.max_vertices),
            max_zero_filled: self.max_zero_filled.unwrap_or(default.max_zero_filled),
            max_instances: self.max_instances.unwrap_or(default.max_instances),
            max_node_depth: self.max_node_depth.unwrap_or(default.max_node_depth),
        }
    }
}

/// The flag that widens a limit.
pub(crate) fn flag_of(bound: Bound) -> String {
    format!("--{}", bound.field().replace('_', "-"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::{CommandFactory, Parser};

    #[derive(Debug, Parser)]
    struct Only {
        #[command(flatten)]
        loading: LoadingArgs,
    }

    #[test]
    fn every_limit_has_its_flag_which_sets_it_and_says_its_default() {
        let command = Only::command();
        for bound in Bound::ALL {
            let flag = flag_of(bound);
            let args = Only::try_parse_from(["x", &flag, "99"]).unwrap();
            let limits = args.loading.options().limits;
            assert_eq!(limits.of(bound), 99, "{flag}");
            let others = Bound::ALL.into_iter().filter(|b| *b != bound);
            others.for_each(|b| assert_eq!(limits.of(b), Limits::default().of(b), "{flag} changes {b:?}"));
            let arg = command.get_arguments().find(|a| a.get_long() == flag.strip_prefix("--")).unwrap();
            let help = arg.get_help().unwrap().to_string();
            let (_, said) = help.trim_end_matches(']').split_once("[default: ").unwrap();
            assert_eq!(bytes(said), Ok(Limits::default().of(bound)), "{flag}");
        }
        assert_eq!(Only::try_parse_from(["x"]).unwrap().loading.options(), LoadOptions::default());
    }
}
