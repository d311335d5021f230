//! The interactive window of `lumbre view`. It renders nothing: a [`lumbre::session::Session`] does, on its own thread, and what there is
//! to see and to change comes from [`lumbre::edits`].
//!
//! # The way of a wish
//!
//! 1. A key, the mouse or a [panel](panels) asks for something: an action of the one [table of keys](input), or another
//!    [`Command`](command::Command). Panels read the state and change nothing.
//! 2. [`State::obey`](state::State) does it: it moves the camera by the pure functions of [`navigation`], or sets a parameter of the
//!    [document's](document) edits.
//! 3. At the end of the step the document [settles](document::Document::settle): a scene is made of the edits where these touch it, and a
//!    step for [undo](history) is noted unless something is still being dragged.
//! 4. [`State::wanted`](state::State::wanted) says all that is to be shown; if that is something else than before, the session is told, and
//!    answers when it can. Frames wait in the [`Sink`](sink::Sink), the newest only.
//!
//! So the interface never waits. Files are [opened](open), [watched](watch) and [listed](folder) on threads of their own, and the
//! [`Meter`](meter::Meter) keeps the longest time that a step took; a [`Report`] has them all.
//!
//! # How it is presented
//!
//! `eframe` with OpenGL (`glow`): a texture of 8 bits a band is all that has to be shown. Mesa draws it in software where there is no GPU.
#![forbid(unsafe_code)]

pub mod app;
pub mod command;
pub mod dialog;
pub mod document;
pub mod folder;
pub mod gizmo;
pub mod history;
pub mod input;
pub mod leaving;
pub mod log;
pub mod meter;
pub mod navigation;
pub mod open;
pub mod panels;
pub mod picks;
pub mod picture;
pub mod places;
pub mod recent;
pub mod report;
mod saving;
mod shot;
pub mod sink;
pub mod state;
pub mod theme;
pub mod watch;
mod window;

pub use report::Report;
pub use window::{Options, ViewError, run};
