//! What a person wants to see: all of it at once, so that nothing depends on the order in which wishes arrive.

use crate::Device;
use crate::look::Look;
use lumbre_core::Camera;
use lumbre_core::settings::RenderSettings;
use lumbre_scene::Scene;
use std::sync::Arc;

/// All that decides what is shown.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// The scene. One that shares meshes and images with the last is taken for an edited form of it, which costs little.
    pub scene: Arc<Scene>,
    /// From where; its field of view is that of a picture of `size`.
    pub camera: Camera,
    /// Columns and rows of the view, pixels.
    pub size: [u32; 2],
    /// How it is rendered.
    pub settings: RenderSettings,
    /// Samples of each pixel from one frame to the next, at least 1.
    pub samples_per_frame: u32,
    /// Samples of each pixel after which it rests.
    pub limit: u32,
    /// No more samples than it takes to show anything.
    pub paused: bool,
    /// Another number than before: begin anew.
    pub restarts: u32,
    /// Something is being dragged: rough frames, soon.
    pub moving: bool,
    /// How the picture is developed.
    pub look: ViewLook,
    /// What is shown.
    pub layer: Layer,
    /// What draws.
    pub device: Device,
}

impl Wanted {
    /// Whether samples taken for `self` are of no use for `other`. Scenes and devices are another matter.
    pub(super) fn begins_anew(&self, other: &Wanted) -> bool {
        self.camera != other.camera
            || self.size != other.size
            || self.settings != other.settings
            || self.restarts != other.restarts
            || (other.layer == Layer::Objects) != (self.layer == Layer::Objects)
            || (other.moving && !self.moving)
    }

    /// Whether a frame under way is better left for `other`.
    pub(super) fn interrupts(&self, other: &Wanted) -> bool {
        self.begins_anew(other) || !Arc::ptr_eq(&self.scene, &other.scene) || self.device != other.device
    }
}

/// How the picture of a view is developed.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ViewLook {
    /// Lens, exposure, tone curve.
    pub look: Look,
    /// Automatic exposure follows slowly, as an eye does.
    pub eased: bool,
    /// Added to an automatic exposure, EV.
    pub offset_ev: f32,
}

/// What is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Layer {
    /// The picture.
    #[default]
    Picture,
    /// Directional albedo of the first hit.
    Albedo,
    /// Shading normal of the first hit, as colours.
    Normal,
    /// Distance of the first hit: white is near.
    Depth,
    /// Standard error of the mean over the mean: black to yellow, 1 and more.
    Error,
    /// Samples taken, of the most that a pixel has.
    Samples,
    /// A colour for each object.
    Objects,
    /// The picture in grey, pixels with samples that were not finite in red.
    NonFinite,
}

impl Layer {
    /// All, in the order of menus.
    pub const ALL: [Layer; 8] = [
        Layer::Picture,
        Layer::Albedo,
        Layer::Normal,
        Layer::Depth,
        Layer::Error,
        Layer::Samples,
        Layer::Objects,
        Layer::NonFinite,
    ];

    /// Its name in menus.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Picture => "Picture",
            Layer::Albedo => "Albedo",
            Layer::Normal => "Normal",
            Layer::Depth => "Depth",
            Layer::Error => "Error",
            Layer::Samples => "Samples",
            Layer::Objects => "Objects",
            Layer::NonFinite => "Non-finite",
        }
    }
}
