//! Hybrid frames: what the rasteriser sees against the path tracer's first hits, what rays bring against paths under the same restrictions.

mod motion;
mod planes;
mod soft;
mod whitted;

use lumbre_core::Film;
use lumbre_core::filter::FilterKind;
use lumbre_core::hybrid::{FrameView, HybridSettings};
use lumbre_core::settings::{RenderSettings, View};
use lumbre_vulkan::VulkanBackend;

/// A view whose samples all lie at the centres of pixels, as those of a frame do.
fn centred(view: &View) -> View {
    let settings = RenderSettings { filter: FilterKind::Point, ..view.settings };
    let mut camera = view.camera;
    camera.lens_radius = 0.0;
    View { camera, settings, frame: view.frame }
}

/// A frame as a film of one sample.
fn frame(backend: &VulkanBackend, view: &View, size: [u32; 2], settings: &HybridSettings) -> Film {
    let mut hybrid = backend.hybrid().expect("the device draws hybrid frames");
    let done = hybrid.frame(&FrameView { view, size, settings }).expect("the GPU draws");
    assert_eq!(done.report.dropped, 0, "{done:?}");
    let film = hybrid.film().expect("the device is there").clone();
    assert_eq!(film.non_finite_count(), 0, "{:?}", film.non_finite());
    film
}
