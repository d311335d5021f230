//! The interactive window.
#![forbid(unsafe_code)]

pub mod app;
pub mod command;
pub mod dialog;
pub mod document;
pub mod folder;
pub mod gizmo;
pub mod history;
pub mod input;
pub mod log;
pub mod meter;
pub mod navigation;
pub mod open;
pub mod panels;
pub mod picks;
pub mod picture;
pub mod places;
pub mod recent;
pub mod sink;
pub mod state;
pub mod theme;
pub mod watch;
mod window;

pub use window::{Options, ViewError, run};
