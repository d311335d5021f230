//! The second thesis's third plot: time of a frame over the size of the picture.

use super::sweep::{HD, Sweep};
use super::table::Table;
use crate::exit::Failure;
use crate::flags::bench::BenchArgs;

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    Sweep::of(args).or_sizes(args, &[HD, [1920, 1080], [2560, 1440]]).frames(args)
}
