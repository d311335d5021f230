//! The SPIR-V of the path tracer: that of `lumbre-shaders`; with the feature `shader-reload` that of a folder, read again when it changes.
//!
//! For those who change shaders: `LUMBRE_SHADERS=crates/shaders/spirv` names the folder, `cargo xtask shaders` writes it, and the next render
//! uses it, in a program that runs on.

use super::variant::Needs;
use crate::{HitShaders, RayShaders};
use lumbre_shaders::{self as shaders, passes};

/// SPIR-V of each stage.
pub(crate) struct Code {
    pub(crate) generate: Stage,
    pub(crate) advance: Stage,
    pub(crate) trace: Stage,
    pub(crate) shade: Stage,
    pub(crate) shadow: Stage,
    pub(crate) glass: Stage,
    pub(crate) catch: Stage,
    pub(crate) gather: Stage,
    radiance_rchit: Stage,
    radiance_rahit: Stage,
    radiance_rmiss: Stage,
    shadow_rahit: Stage,
    shadow_rmiss: Stage,
}

type Stage = std::borrow::Cow<'static, [u8]>;

/// Rays that a pass traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kinds {
    /// Those that look for the closest surface.
    Radiance,
    /// Those that ask whether light arrives.
    Shadow,
    Both,
}

impl Code {
    /// That of `lumbre-shaders`.
    pub(crate) fn embedded() -> Self {
        Code {
            generate: passes::GENERATE.into(),
            advance: passes::ADVANCE.into(),
            trace: passes::TRACE.into(),
            shade: passes::SHADE.into(),
            shadow: passes::SHADOW.into(),
            glass: passes::GLASS.into(),
            catch: passes::CATCH.into(),
            gather: passes::GATHER.into(),
            radiance_rchit: shaders::RADIANCE_RCHIT.into(),
            radiance_rahit: shaders::RADIANCE_RAHIT.into(),
            radiance_rmiss: shaders::RADIANCE_RMISS.into(),
            shadow_rahit: shaders::SHADOW_RAHIT.into(),
            shadow_rmiss: shaders::SHADOW_RMISS.into(),
        }
    }

    /// The shaders of a pass that traces rays of these kinds. Class by class as `HitClass` has them: opaque surfaces ask nothing; transmissive
    /// ones are asked by shadow rays, those that are there only in part by all. What the pass or the scene does not need is not compiled;
    /// its places in the table stay.
    pub(crate) fn rays<'a>(&'a self, raygen: &'a [u8], kinds: Kinds, needs: &Needs) -> RayShaders<'a> {
        let (radiance, shadow) = (kinds != Kinds::Shadow, kinds != Kinds::Radiance);
        let closest = HitShaders { closest: radiance.then_some(&*self.radiance_rchit), any: None };
        let covered =
            HitShaders { any: (radiance && needs.covered).then_some(&*self.radiance_rahit), ..closest };
        let asks = |needed: bool| HitShaders {
            closest: None,
            any: (shadow && needed).then_some(&*self.shadow_rahit),
        };
        // A ray of the other kind is never traced: its miss shader can be any.
        let [radiance_rmiss, shadow_rmiss] = [&*self.radiance_rmiss, &*self.shadow_rmiss];
        RayShaders {
            raygen,
            miss: [
                if radiance { radiance_rmiss } else { shadow_rmiss },
                if shadow { shadow_rmiss } else { radiance_rmiss },
            ],
            hits: [
                [closest, asks(false)],
                [closest, asks(needs.transmission)],
                [covered, asks(needs.covered)],
            ],
        }
    }
}

#[cfg(feature = "shader-reload")]
pub(crate) use reload::Watched;

#[cfg(feature = "shader-reload")]
mod reload {
    use super::Code;
    use std::path::{Path, PathBuf};
    use std::time::SystemTime;

    /// The folder that `LUMBRE_SHADERS` names.
    #[derive(Default)]
    pub(in crate::path) struct Watched {
        /// When the newest of its files was written, as of the last look.
        seen: Option<SystemTime>,
    }

    impl Watched {
        /// The code of the folder where it has changed since the last look; `None` where not, or where it cannot be read (a compiler is
        /// writing it).
        pub(in crate::path) fn changed(&mut self) -> Option<Code> {
            let folder = PathBuf::from(std::env::var_os("LUMBRE_SHADERS")?).join("path");
            let files = std::fs::read_dir(&folder).ok()?;
            let newest = files.filter_map(|f| f.ok()?.metadata().ok()?.modified().ok()).max()?;
            if self.seen == Some(newest) {
                return None;
            }
            let code = read(&folder).ok()?;
            self.seen = Some(newest);
            Some(code)
        }
    }

    fn read(folder: &Path) -> std::io::Result<Code> {
        let stage = |name: &str| std::fs::read(folder.join(format!("{name}.spv"))).map(Into::into);
        Ok(Code {
            generate: stage("generate.comp")?,
            advance: stage("advance.comp")?,
            trace: stage("trace.rgen")?,
            shade: stage("shade.comp")?,
            shadow: stage("shadow.rgen")?,
            glass: stage("glass.rgen")?,
            catch: stage("catch.rgen")?,
            gather: stage("gather.comp")?,
            radiance_rchit: stage("radiance.rchit")?,
            radiance_rahit: stage("radiance.rahit")?,
            radiance_rmiss: stage("radiance.rmiss")?,
            shadow_rahit: stage("shadow.rahit")?,
            shadow_rmiss: stage("shadow.rmiss")?,
        })
    }
}
