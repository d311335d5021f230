//! The physics of Lumbre, pure: vectors and frames, random streams, warps, Fresnel, microfacets, BSDFs, lights, camera,
//! film and filters, colour, multiple importance sampling. No I/O, no threads, no unsafe code, and nothing that can fail:
//! a wrong value here is a bug and asserts.
#![forbid(unsafe_code)]

pub mod bsdf;
pub mod camera;
pub mod color;
pub mod control;
pub mod distribution;
pub mod film;
pub mod filter;
pub mod frame;
pub mod fresnel;
pub mod hash;
pub mod hybrid;
pub mod light;
pub mod math;
pub mod measure;
pub mod medium;
pub mod microfacet;
pub mod mis;
pub mod ray;
pub mod rgb;
pub mod sampler;
pub mod settings;
pub mod tone;
pub mod warp;
pub mod wavelength;

pub use camera::Camera;
pub use film::Film;
pub use frame::Frame;
pub use ray::Ray;
pub use rgb::{Rgb, Spectrum};
