//! A scene with the light that the flags ask for.

use crate::console;
use crate::edited;
use crate::exit::Failure;
use crate::flags::light::LightArgs;
use crate::flags::loading::LoadingArgs;
use crate::flags::values::Sky;
use lumbre::io::Limits;
use lumbre::scene::{Background, Environment, Scene, Sun};
use std::path::Path;

/// A scene that can be compiled.
pub(crate) struct Lit {
    pub(crate) scene: Scene,
    /// It had no light and got the gradient sky.
    pub(crate) sky_added: bool,
}

/// Loads a scene, edits it and lights it.
pub(crate) fn load(path: &Path, loading: &LoadingArgs, light: &LightArgs) -> Result<Lit, Failure> {
    let load = loading.options();
    let loaded = lumbre::load_scene(path, &load)?;
    loaded.warnings.iter().for_each(console::warning);
    let mut scene = loaded.scene;
    let asked = light.sky.is_some() || light.env.is_some() || light.sun.is_some();
    // Before the edits, since that is the scene that they were made on.
    let sky_added = !asked && add_sky(&mut scene);
    let mut scene = edited::apply(loading, path, scene, Some(light))?;
    set_environment(light, &load.limits, &mut scene.environment)?;
    let kinds = lumbre::light_kinds(&scene);
    if !kinds.any() {
        console::warning(match kinds.unlit {
            true => "nothing gives light: only unlit surfaces will be seen",
            false => "nothing gives light: the picture will be black",
        });
    } else if kinds.only_emissive() && !asked && loading.edits.is_none() {
        console::note("light: emissive surfaces only; --sky gradient adds a sky");
    }
    Ok(Lit { scene, sky_added })
}

/// Gives a scene without any light a gradient sky, and says so. Returns whether it was added.
fn add_sky(scene: &mut Scene) -> bool {
    let dark = !lumbre::light_kinds(scene).any();
    if dark {
        scene.environment.background = Background::Gradient;
        console::note("light: nothing in the scene gives any; gradient sky added (--sky off: none)");
    }
    dark
}

/// Puts the light of the flags in the place of the scene's own.
fn set_environment(args: &LightArgs, limits: &Limits, environment: &mut Environment) -> Result<(), Failure> {
    if let Some(sky) = args.sky {
        environment.background = match sky {
            Sky::Color(c) => Background::Constant(c),
            Sky::Gradient => Background::Gradient,
            Sky::Off => Background::Black,
        };
        environment.strength = 1.0;
    }
    if let Some(path) = &args.env {
        let loaded = lumbre::io::read_environment(path, limits)?;
        for warning in &loaded.warnings {
            console::warning(format_args!("{}: {warning}", path.display()));
        }
        environment.background = Background::Map(loaded.map);
        environment.rotation = args.env_rotate.to_radians();
        environment.strength = args.env_strength;
        // A picture of the sky has its own sun.
        environment.sun = None;
    }
    if let Some(flag) = args.sun {
        environment.sun = Some(Sun::daylight(flag.elevation_deg, flag.azimuth_deg, flag.strength));
    }
    Ok(())
}
