//! placeholder
use super::aniso_albedo::{AVERAGES, NODES};
pub(super) static SCHLICK_RESIDUAL: [i16; NODES] = [0; NODES];
pub(super) static SCHLICK_AVERAGE: [[f32; AVERAGES[1]]; AVERAGES[0]] = [[1.0; AVERAGES[1]]; AVERAGES[0]];
