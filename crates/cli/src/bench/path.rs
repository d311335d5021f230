//! The first thesis's table: frames per second of the path tracer at each size and depth, one sample a frame.

use super::sweep::{HD, Sweep};
use super::table::Table;
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;

/// Scattering events.
const DEPTHS: [u32; 4] = [4, 6, 8, 10];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    Sweep::of(args).or_sizes(args, &[HD, [1920, 1080]]).or_depths(args, DEPTHS).frames(args)
}
