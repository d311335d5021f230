//! What shows that pictures are right: samplers against their densities, pictures against references, the same bits on every
//! way, the rate of convergence, and estimators that must agree. One program, since linking it takes longer than running it.

mod background;
mod bits;
mod catcher;
mod convergence;
mod dispersion;
mod error_estimate;
mod lens_and_filter;
mod lights;
mod references;
mod sheets;
mod transport;
mod two_formats;
