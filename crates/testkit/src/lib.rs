//! Test tools of Lumbre: statistical tests of samplers and models, reference quadratures, scene builders.
#![forbid(unsafe_code)]

pub mod aniso_tables;
pub mod bsdf_rows;
pub mod bsdf_tables;
pub mod calibration;
pub mod changing;
pub mod chi_square;
pub mod convergence;
pub mod furnace;
pub mod fuzzing;
mod gpu;
pub mod inexact;
pub mod measure;
pub mod npy;
pub mod paired;
pub mod plot;
pub mod ready;
pub mod references;
pub mod shapes;
pub mod sheen_tables;
pub mod square;
pub mod z_test;

pub use gpu::{TestGpu, gpu, own_gpu};
