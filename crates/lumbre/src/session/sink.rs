//! What a session sends to those who show it.

use crate::PassTime;
use glam::Vec3;
use lumbre_scene::{MaterialId, NodeId, Scene};
use std::path::PathBuf;
use std::sync::Arc;

/// Where frames and events go. Called from threads of the session, which wait: an implementation takes what it gets and returns.
pub trait FrameSink: Send + Sync {
    /// A frame to be shown instead of the last.
    fn frame(&self, frame: Frame);
    /// Something happened.
    fn event(&self, event: Event);
}

/// What is to be shown.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Columns and rows; fewer than those of the view where it is rough.
    pub size: [u32; 2],
    /// Red, green, blue, alpha of each pixel, sRGB, not multiplied by alpha; row 0 on top.
    pub rgba: Vec<u8>,
    /// How many times something had been wanted when its samples were begun: it shows the last of these.
    pub number: u64,
    /// How it was made.
    pub stats: FrameStats,
}

/// How a frame was made.
#[derive(Clone, Debug, Default)]
pub struct FrameStats {
    /// What drew it, for people.
    pub device: String,
    /// Samples of each pixel so far.
    pub spp: u32,
    /// Seconds that its samples took.
    pub seconds: f64,
    /// Seconds since the picture was begun anew.
    pub since: f64,
    /// Camera samples of this frame.
    pub samples: u64,
    /// Rays of this frame.
    pub rays: u64,
    /// Passes of a GPU for this frame, by its own clock; empty where it has none.
    pub passes: Vec<PassTime>,
    /// Bytes of acceleration structures and of the film.
    pub memory: u64,
    /// Estimated relative mean squared error, where there are samples enough to say.
    pub error: Option<f64>,
    /// Pixels of the view for one of the frame, along each axis.
    pub scale: u32,
    /// Exposure that it is shown with, EV.
    pub exposure_ev: f32,
    /// Samples so far that were not finite.
    pub non_finite: u64,
    /// No more samples will come until something else is wanted.
    pub done: bool,
}

/// Something that happened, in the order it did.
#[derive(Clone, Debug)]
pub enum Event {
    /// Work has begun that takes a moment, in a few words: compiling a scene, bringing it to a device.
    Preparing(String),
    /// A scene is on a device.
    Prepared {
        /// The device, for people.
        device: String,
        /// Seconds that it took.
        seconds: f64,
        /// The scene, as it was wanted.
        scene: Arc<Scene>,
    },
    /// A scene that was wanted cannot be drawn; the one before stays.
    Refused {
        /// The scene, as it was wanted.
        scene: Arc<Scene>,
        /// Why, in one line.
        reason: String,
    },
    /// Something to tell people, in one line.
    Notice(String),
    /// Something that was wanted could not be done, and all goes on as before.
    Failed(String),
    /// What [`super::Session::pick`] found.
    Picked(Option<Picked>),
    /// A picture was written.
    Saved(PathBuf),
}

/// What stands at a place of the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// The node that places it.
    pub node: NodeId,
    /// Its material; `None`: it has none, and stands in the default one.
    pub material: Option<MaterialId>,
    /// Triangle of its mesh.
    pub triangle: u32,
    /// Where, world space, metres.
    pub point: Vec3,
    /// Geometric unit normal there, world space, towards the camera.
    pub normal: Vec3,
    /// From the camera along its ray, metres.
    pub distance: f32,
}
