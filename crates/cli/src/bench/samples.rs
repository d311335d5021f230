//! The second thesis's first plot: time of a frame over the samples of each pixel in it.

use super::sweep::Sweep;
use super::table::Table;
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    Sweep::of(args).or_samples(args, 1..=20).frames(args)
}
