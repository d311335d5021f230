//! A scene with the light that the flags ask for.

use crate::console;
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

/// Loads a scene and lights it.
pub(crate) fn load(path: &Path, loading: &LoadingArgs, light: &LightArgs) -> Result<Lit, Failure> {
    let load = loading.options();
    let mut loaded = lumbre::load_scene(path, &load)?;
    loaded.warnings.iter().for_each(console::warning);
    set_environment(light, &load.limits, &mut loaded.scene.environment)?;
    let sky_added = mind_the_light(light, &mut loaded.scene);
    Ok(Lit { scene: loaded.scene, sky_added })
}

/// Gives a scene without any light a gradient sky, unless the flags say what light there is; says what may surprise. Returns
/// whether the sky was added.
fn mind_the_light(args: &LightArgs, scene: &mut Scene) -> bool {
    let kinds = lumbre::light_kinds(scene);
    let asked = args.sky.is_some() || args.env.is_some() || args.sun.is_some();
    if kinds.any() {
        if kinds.only_emissive() && !asked {
            console::note("light: emissive surfaces only; --sky gradient adds a sky");
        }
        return false;
    }
    if !asked {
        scene.environment.background = Background::Gradient;
        console::note("light: nothing in the scene gives any; gradient sky added (--sky off: none)");
    } else if kinds.unlit {
        console::warning("nothing gives light: only unlit surfaces will be seen");
    } else {
        console::warning("nothing gives light: the picture will be black");
    }
    !asked
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
