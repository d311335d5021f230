//! Flags on light from far away, in the place of what the scene brings: `--sky` of its sky, `--sun` of its sun, `--env` of both.

use super::values::{Sky, SunFlag, file_name, finite, not_negative, sky, sun};
use clap::Args;
use std::path::PathBuf;

/// Light from far away.
#[derive(Args, Debug)]
#[command(next_help_heading = "Light")]
pub(crate) struct LightArgs {
    /// What fills the sky: one radiance (R,G,B linear in nits, or #rrggbb sRGB), a plain `gradient` with a mean near 1, or
    /// nothing. [default: what the scene has; the gradient if nothing in it gives light]
    #[arg(long, value_name = "R,G,B|#rrggbb|gradient|off", value_parser = sky, conflicts_with = "env")]
    #[arg(allow_hyphen_values = true)]
    pub(crate) sky: Option<Sky>,

    /// A sun: elevation above the horizon and azimuth from -z towards +x, degrees. STRENGTH is the illuminance on a surface that
    /// faces it, in lux on the scale of the scene's lights; 15 by default, which makes a clear day with the gradient sky
    /// (a real clear noon is 100000 lux under a sky of some 5000 nits). Its light is slightly warm.
    #[arg(long, value_name = "ELEV,AZIM[,STRENGTH]", value_parser = sun, allow_hyphen_values = true)]
    pub(crate) sun: Option<SunFlag>,

    /// A latitude-longitude picture of radiance around the scene: .hdr or .exr. Its centre lies at -z.
    #[arg(long, value_name = "FILE")]
    pub(crate) env: Option<PathBuf>,

    /// Turns that picture to the right as seen from inside, degrees.
    #[arg(long, value_name = "DEG", requires = "env", value_parser = finite, allow_hyphen_values = true)]
    #[arg(default_value = "0")]
    pub(crate) env_rotate: f32,

    /// Factor on its radiance.
    #[arg(long, value_name = "X", requires = "env", value_parser = not_negative, allow_hyphen_values = true)]
    #[arg(default_value = "1")]
    pub(crate) env_strength: f32,
}

impl LightArgs {
    /// Names and values of the flags that were given, for the metadata of a file.
    pub(crate) fn described(&self) -> Vec<(&'static str, String)> {
        let with_env = |value: f32| self.env.as_ref().map(|_| value.to_string());
        let all = [
            ("sky", self.sky.map(|s| s.to_string())),
            ("sun", self.sun.map(|s| s.to_string())),
            ("env", self.env.as_deref().map(file_name)),
            ("envRotate", with_env(self.env_rotate)),
            ("envStrength", with_env(self.env_strength)),
        ];
        all.into_iter().filter_map(|(name, value)| Some((name, value?))).collect()
    }
}
