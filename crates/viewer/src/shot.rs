//! The camera of the edits: found as `lumbre render` finds it, and written down as it moves.

use crate::document::Document;
use crate::navigation::{Pose, overview};
use glam::Vec3;
use lumbre::camera::{DEFAULT_FOV, camera_names};
use lumbre::core::Camera;
use lumbre::core::camera::Projection;
use lumbre::edits::{Changes, Edits, Item, Value};
use lumbre::scene::{CompiledScene, Scene};
use std::cell::RefCell;
use std::sync::{Arc, LazyLock};

/// A scene without anything: a camera of the file needs no more.
static EMPTY: LazyLock<CompiledScene> =
    LazyLock::new(|| lumbre::compile(&Scene::default()).expect("an empty scene can be compiled").scene);

/// The camera that was found last, and for what: finding one looks through the whole scene, and panels ask for it many times a frame.
#[derive(Default)]
pub(crate) struct Found(RefCell<Option<FoundFor>>);

/// A camera, and the scene, the changes and the aspect that it was found for.
type FoundFor = (Arc<Scene>, Changes, f32, Camera);

impl Found {
    pub(crate) fn get(&self, document: &Document, aspect: f32) -> Camera {
        let mut last = self.0.borrow_mut();
        if let Some((scene, changes, of, camera)) = &*last
            && Arc::ptr_eq(scene, &document.scene)
            && (changes, of) == (&document.edits.camera, &aspect)
        {
            return *camera;
        }
        let scene = &document.scene;
        let changes = &document.edits.camera;
        let camera = camera_of(scene, changes, aspect)
            // A camera of that name is not there, as where the file has changed.
            .or_else(|| camera_of(scene, &Changes::default(), aspect))
            .unwrap_or_else(|| overview(document.places.all(), DEFAULT_FOV, aspect).camera);
        *last = Some((scene.clone(), changes.clone(), aspect, camera));
        camera
    }
}

/// The camera of these changes, exactly as `lumbre render` finds it; `None` where the whole scene has to be brought into view.
fn camera_of(scene: &Scene, changes: &Changes, aspect: f32) -> Option<Camera> {
    let options = changes.camera_options();
    let placed = options.look_from.is_some() && options.look_at.is_some();
    if !placed && camera_names(scene).is_empty() {
        return None;
    }
    lumbre::find_camera(scene, &EMPTY, &options, aspect).ok().map(|found| found.camera)
}

/// Width over height; 16:9 before there is a picture.
pub(crate) fn aspect_of(size: [u32; 2]) -> f32 {
    if size.contains(&0) { 16.0 / 9.0 } else { size[0] as f32 / size[1] as f32 }
}

/// Writes where the camera stands and what it looks at; upright cameras need no more.
pub(crate) fn write_pose(edits: &mut Edits, base: &Scene, pose: &Pose) {
    let camera = &pose.camera;
    let mut set = |name, v: Vec3| edits.set(base, Item::Camera, name, Value::Vector(v));
    let upright = camera.right.y.abs() < 1e-4 && camera.up.y > 0.0;
    // Values that are no numbers are refused, and the camera stays.
    let done = set("eye", camera.origin).and_then(|()| set("target", pose.pivot()));
    let done = done.and_then(|()| match upright {
        true => edits.unset(base, Item::Camera, "up"),
        false => edits.set(base, Item::Camera, "up", Value::Vector(camera.up)),
    });
    debug_assert!(done.is_ok() || !camera.origin.is_finite(), "{done:?}");
}

/// Writes how much of the scene the camera takes in; what is out of range is refused, and it stays.
pub(crate) fn write_extent(edits: &mut Edits, base: &Scene, projection: Projection) {
    let (name, value) = match projection {
        Projection::Perspective { tan_half_fov_y } => ("fov", (2.0 * tan_half_fov_y.atan()).to_degrees()),
        Projection::Orthographic { half_height } => ("height", 2.0 * half_height),
    };
    let _ = edits.set(base, Item::Camera, name, Value::Number(value));
}
