//! The second thesis's second plot: time of a frame over the depth of paths.

use super::sweep::Sweep;
use super::table::Table;
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;

/// Each up to 10, then coarser: roulette or the scene's light ends most paths before.
const DEPTHS: [u32; 16] = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 15, 20, 25, 30, 40, 50];

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    Sweep::of(args).or_depths(args, DEPTHS).frames(args)
}
