//! The interactive window.
#![forbid(unsafe_code)]

pub mod gizmo;
pub mod history;
pub mod input;
pub mod navigation;
pub mod open;
pub mod places;
pub mod recent;
pub mod sink;
