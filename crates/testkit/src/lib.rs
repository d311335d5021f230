//! Test tools of Lumbre: statistical tests of samplers and models, reference quadratures, scene builders.
#![forbid(unsafe_code)]

pub mod bsdf_rows;
pub mod bsdf_tables;
pub mod chi_square;
pub mod furnace;
pub mod measure;
pub mod shapes;
pub mod square;
