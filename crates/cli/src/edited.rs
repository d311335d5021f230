//! A scene with what `--edits` changes of it.

use crate::console;
use crate::exit::Failure;
use crate::flags::light::LightArgs;
use crate::flags::loading::LoadingArgs;
use crate::flags::values::file_name;
use lumbre::edits::{Edits, EditsError, Item};
use lumbre::scene::{EnvironmentMap, Scene};
use std::path::Path;

/// The scene of a file as the edits make it, and a word on what in them does not show. `light`: flags that stand above them.
pub(crate) fn apply(
    loading: &LoadingArgs,
    path: &Path,
    scene: Scene,
    light: Option<&LightArgs>,
) -> Result<Scene, Failure> {
    let Some(file) = &loading.edits else { return Ok(scene) };
    let wrong = |e: EditsError| Failure::from(e.in_file(file));
    let edits = beneath(&loading.edited, &scene, light).map_err(wrong)?;
    let (made_for, name) = (&edits.scene, file_name(path));
    if !made_for.is_empty() && *made_for != name {
        console::note(format_args!("{}: made for {made_for}, not for {name}", file.display()));
    }
    let map = match edits.sky_file() {
        Some(sky) => Some(environment(&sky, loading)?),
        None => None,
    };
    let edited = edits.apply_with(&scene, map.as_ref()).map_err(wrong)?;
    for line in edits.idle(&scene).map_err(wrong)? {
        console::warning(format_args!("{}: {line}", file.display()));
    }
    Ok(edited)
}

/// The edits without what flags replace: a sky that is not wanted need not be there.
fn beneath(edits: &Edits, scene: &Scene, light: Option<&LightArgs>) -> Result<Edits, EditsError> {
    let mut edits = edits.clone();
    if light.is_some_and(|l| l.sky.is_some() || l.env.is_some()) {
        edits.reset(scene, Item::Sky)?;
    }
    if light.is_some_and(|l| l.sun.is_some() || l.env.is_some()) {
        edits.reset(scene, Item::Sun)?;
    }
    Ok(edits)
}

fn environment(path: &Path, loading: &LoadingArgs) -> Result<EnvironmentMap, Failure> {
    let loaded = lumbre::io::read_environment(path, &loading.options().limits)?;
    for warning in &loaded.warnings {
        console::warning(format_args!("{}: {warning}", path.display()));
    }
    Ok(loaded.map)
}
