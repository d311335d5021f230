//! Sessions on the CPU: what is sent after what was wanted.

use super::*;
use crate::{Device, Look, Targets, output, render};
use glam::{Mat4, Vec3};
use lumbre_core::color::Exposure;
use lumbre_core::settings::{RenderSettings, View};
use lumbre_core::{Film, Rgb};
use lumbre_scene::{
    Background, Light, LightId, LightKind, Material, MaterialId, Mesh, MeshId, Node, NodeId, Primitive,
    Scene, compile,
};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

/// Passes everything on.
struct Pipe(Mutex<Sender<Sent>>);

enum Sent {
    Frame(Frame),
    Event(Event),
}

impl FrameSink for Pipe {
    fn frame(&self, frame: Frame) {
        let _ = self.0.lock().unwrap().send(Sent::Frame(frame));
    }
    fn event(&self, event: Event) {
        let _ = self.0.lock().unwrap().send(Sent::Event(event));
    }
}

/// A session, and what came out of it so far.
struct Watched {
    session: Session,
    sent: Receiver<Sent>,
    events: Vec<Event>,
}

impl Watched {
    fn start(wanted: Wanted) -> Self {
        let (to, sent) = channel();
        let session = Session::start(wanted, GpuOptions::default(), Arc::new(Pipe(Mutex::new(to))));
        Watched { session, sent, events: Vec::new() }
    }

    fn next(&mut self) -> Sent {
        self.sent.recv_timeout(Duration::from_secs(60)).expect("a frame or an event within a minute")
    }

    /// The next frame that fits; events on the way are kept.
    fn frame(&mut self, fits: impl Fn(&Frame) -> bool) -> Frame {
        loop {
            match self.next() {
                Sent::Frame(frame) if fits(&frame) => return frame,
                Sent::Frame(_) => {}
                Sent::Event(e) => self.events.push(e),
            }
        }
    }

    fn event(&mut self, fits: impl Fn(&Event) -> bool) -> Event {
        loop {
            if let Some(at) = self.events.iter().position(&fits) {
                return self.events.remove(at);
            }
            if let Sent::Event(e) = self.next() {
                self.events.push(e);
            }
        }
    }

    fn no_more_frames(&mut self) {
        while let Ok(sent) = self.sent.recv_timeout(Duration::from_millis(300)) {
            assert!(matches!(sent, Sent::Event(_)), "a frame although it rests");
        }
    }
}

/// A square of 2 m before a white sky.
fn scene() -> Scene {
    let corner = |x, y| Vec3::new(x, y, 0.0);
    let positions = vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let mut scene = Scene { name: "square".into(), ..Scene::default() };
    let material = scene.add_material(Material::diffuse(Rgb::new(0.8, 0.3, 0.1)));
    let part = Primitive {
        positions,
        indices: vec![0, 1, 2, 0, 2, 3],
        material: Some(material),
        ..Primitive::default()
    };
    let mesh = scene.add_mesh(Mesh { name: String::new(), primitives: vec![part] });
    scene.add_root(Node { transform: Mat4::from_rotation_x(0.3), mesh: Some(mesh), ..Node::default() });
    scene.environment.background = Background::Constant(Rgb::WHITE);
    scene
}

fn wanted() -> Wanted {
    let size = [64, 48];
    Wanted {
        scene: Arc::new(scene()),
        camera: Camera::look_at(Vec3::new(0.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y, 0.7, 64.0 / 48.0),
        size,
        settings: RenderSettings::default(),
        samples_per_frame: 3,
        limit: 20,
        paused: false,
        restarts: 0,
        moving: false,
        look: ViewLook {
            look: Look { exposure: Exposure::Ev(0.5), ..Look::default() },
            ..ViewLook::default()
        },
        layer: Layer::Picture,
        device: Device::Cpu,
    }
}

fn rendered(w: &Wanted, spp: u32) -> Film {
    let open = Device::Cpu.open(&GpuOptions::default()).unwrap().editable();
    let backend = open.prepare(compile(&w.scene).unwrap().scene).unwrap().backend;
    let view = View { camera: w.camera, settings: w.settings, frame: 0 };
    let mut film = Film::new(w.size[0], w.size[1]);
    render(&*backend, &view, Targets::spp(spp), &mut film, &()).unwrap();
    film
}

#[test]
fn a_view_that_rests_is_the_picture_that_render_draws() {
    let w = wanted();
    let mut s = Watched::start(w.clone());
    let frame = s.frame(|f| f.stats.done);
    assert_eq!((frame.size, frame.stats.spp, frame.stats.scale), (w.size, 20, 1));
    let film = rendered(&w, 20);
    let want = output::develop(&film, &w.look.look).bytes;
    let rgb: Vec<u8> = frame.rgba.chunks_exact(4).flat_map(|p| p[..3].to_vec()).collect();
    assert!(rgb == want && frame.rgba.iter().skip(3).step_by(4).all(|a| *a == 255));
    s.no_more_frames();
    // What is saved is the same, whatever the format.
    let folder = tempfile::tempdir().unwrap();
    for name in ["a.png", "a.jpg", "a.exr", "a.hdr"] {
        let (path, other) = (folder.path().join(name), folder.path().join(format!("b{name}")));
        s.session.save(path.clone());
        s.event(|e| matches!(e, Event::Saved(p) if *p == path));
        output::save(&film, &w.look.look, &other).unwrap();
        assert!(std::fs::read(path).unwrap() == std::fs::read(other).unwrap(), "{name}");
    }
    s.session.save(folder.path().join("a.bmp"));
    let failed = s.event(|e| matches!(e, Event::Failed(_)));
    assert!(format!("{failed:?}").contains("its ending"), "{failed:?}");
}

#[test]
fn another_camera_begins_anew_and_another_look_does_not() {
    let mut w = wanted();
    let mut s = Watched::start(w.clone());
    let first = s.frame(|f| f.stats.done);
    w.look.look.exposure = Exposure::Ev(-1.0);
    s.session.set(w.clone());
    let darker = s.frame(|_| true);
    assert_eq!((darker.stats.spp, darker.stats.done), (20, true));
    assert!(darker.rgba[0] < first.rgba[0] && (darker.stats.exposure_ev + 1.0).abs() < 1e-5);
    w.camera.origin.z = 5.0;
    let number = s.session.set(w.clone());
    let moved = s.frame(|f| f.number == number);
    assert!(moved.stats.spp < 20);
    s.frame(|f| f.number == number && f.stats.done);
    // More samples are added to those that there are.
    w.limit = 40;
    s.session.set(w.clone());
    assert!(s.frame(|_| true).stats.spp > 20);
    assert_eq!(s.frame(|f| f.stats.done).stats.spp, 40);
    w.restarts = 1;
    s.session.set(w.clone());
    assert!(s.frame(|_| true).stats.spp < 20);
}

#[test]
fn layers_are_shown_without_new_samples() {
    let mut w = wanted();
    let mut s = Watched::start(w.clone());
    s.frame(|f| f.stats.done);
    let film = rendered(&w, 20);
    for l in Layer::ALL.into_iter().filter(|l| !matches!(l, Layer::Picture | Layer::Objects)) {
        w.layer = l;
        let number = s.session.set(w.clone());
        let frame = s.frame(|f| f.number == number);
        assert_eq!(frame.stats.spp, 20);
        assert!(frame.rgba == layers::layer(&film, l), "{l:?}");
    }
}

#[test]
fn while_something_moves_frames_are_rough_and_a_pause_holds() {
    let mut w = Wanted { size: [1600, 1200], moving: true, limit: 100_000, ..wanted() };
    let mut s = Watched::start(w.clone());
    let rough = s.frame(|_| true);
    assert!(rough.stats.scale > 1 && rough.size[0] < 1600, "{:?}", rough.stats.scale);
    // It gets finer once nothing moves, and a pause does not keep it rough.
    (w.moving, w.paused) = (false, true);
    let number = s.session.set(w.clone());
    let still = s.frame(|f| f.number == number && f.stats.done);
    assert_eq!((still.stats.scale, still.size), (1, w.size));
    s.no_more_frames();
    w.paused = false;
    s.session.set(w);
    assert!(s.frame(|_| true).stats.spp > still.stats.spp);
}

#[test]
fn the_good_scene_stays_where_a_broken_one_comes() {
    let good = wanted();
    let mut s = Watched::start(good.clone());
    s.frame(|f| f.stats.done);
    let mut broken = scene();
    broken.add_root(Node { mesh: Some(MeshId(7)), ..Node::default() });
    s.session.set(Wanted { scene: Arc::new(broken), ..good.clone() });
    let failed = s.event(|e| matches!(e, Event::Refused { .. }));
    assert!(format!("{failed:?}").contains("there is no mesh 7"), "{failed:?}");
    // The view goes on with what there was.
    let mut moved = good.clone();
    moved.camera.origin.z = 3.0;
    let number = s.session.set(moved);
    s.frame(|f| f.number == number && f.stats.done);
    // An empty scene is a good one.
    let number = s.session.set(Wanted { scene: Arc::new(Scene::default()), ..good });
    let black = s.frame(|f| f.number == number && f.stats.done);
    assert!(black.rgba.chunks_exact(4).all(|p| p == [0, 0, 0, 255]));
}

#[test]
fn a_scene_that_looks_the_same_is_not_begun_anew() {
    let mut w = wanted();
    let mut scene = (*w.scene).clone();
    let empty = scene.add_root(Node::default());
    w.scene = Arc::new(scene.clone());
    let mut s = Watched::start(w.clone());
    s.frame(|f| f.stats.done);
    scene.nodes[empty.index()].transform = Mat4::from_translation(Vec3::X);
    w.scene = Arc::new(scene.clone());
    s.session.set(w.clone());
    s.no_more_frames();
    // The next edit is seen from there.
    scene.nodes[0].visible = false;
    w.scene = Arc::new(scene);
    let number = s.session.set(w.clone());
    let frame = s.frame(|f| f.stats.done && f.number == number);
    let rgb: Vec<u8> = frame.rgba.chunks_exact(4).flat_map(|p| p[..3].to_vec()).collect();
    assert!(rgb == output::develop(&rendered(&w, 20), &w.look.look).bytes);
}

#[test]
fn a_session_begins_with_the_first_scene_that_is_whole() {
    let mut broken = scene();
    broken.add_root(Node { mesh: Some(MeshId(7)), ..Node::default() });
    let mut s = Watched::start(Wanted { scene: Arc::new(broken), ..wanted() });
    s.event(|e| matches!(e, Event::Refused { .. }));
    s.session.set(wanted());
    s.frame(|f| f.stats.done);
}

#[test]
fn a_device_that_is_not_there_is_told_of_and_the_cpu_draws() {
    let device: Device = "Voodoo 2".parse().unwrap();
    let mut s = Watched::start(Wanted { device, ..wanted() });
    let notice = s.event(|e| matches!(e, Event::Notice(_)));
    assert!(format!("{notice:?}").contains("Voodoo 2"), "{notice:?}");
    assert!(s.frame(|f| f.stats.done).stats.device.starts_with("CPU"));
}

#[test]
fn what_stands_there_is_found() {
    let mut s = Watched::start(wanted());
    s.frame(|_| true);
    s.session.pick([0.5, 0.5]);
    let Event::Picked(Some(found)) = s.event(|e| matches!(e, Event::Picked(_))) else { panic!("nothing") };
    assert_eq!((found.node, found.material), (NodeId(0), Some(MaterialId(0))));
    assert!((found.distance - 4.0).abs() < 1e-4 && found.point.length() < 1e-4, "{found:?}");
    assert!(found.normal.z > 0.9);
    s.session.pick([0.01, 0.5]);
    let Event::Picked(nothing) = s.event(|e| matches!(e, Event::Picked(_))) else { unreachable!() };
    assert_eq!(nothing, None);
    // From behind, where the camera sees nothing of it unless it is told to.
    let (mut behind, mut one_sided) = (wanted(), scene());
    one_sided.materials[0].double_sided = false;
    behind.scene = Arc::new(one_sided);
    behind.camera.origin.z = -4.0;
    (behind.camera.forward, behind.camera.right) = (-behind.camera.forward, -behind.camera.right);
    for shade_back_faces in [false, true] {
        behind.settings.shade_back_faces = shade_back_faces;
        let number = s.session.set(behind.clone());
        s.frame(|f| f.number >= number);
        s.session.pick([0.5, 0.5]);
        let Event::Picked(found) = s.event(|e| matches!(e, Event::Picked(_))) else { unreachable!() };
        assert_eq!(found.is_some(), shade_back_faces);
    }
}

#[test]
fn an_eased_exposure_arrives() {
    let mut w = wanted();
    w.look = ViewLook { eased: true, ..ViewLook::default() };
    let mut s = Watched::start(w.clone());
    let before = s.frame(|f| f.stats.done).stats.exposure_ev;
    w.look.offset_ev = 3.0;
    s.session.set(w);
    let first = s.frame(|_| true).stats.exposure_ev;
    assert!(first < before + 2.9, "{before} {first}");
    s.frame(|f| (f.stats.exposure_ev - before - 3.0).abs() < 0.05);
}

#[test]
fn edits_draw_what_a_scene_made_that_way_draws() {
    let mut w = wanted();
    let mut s = Watched::start(w.clone());
    s.frame(|f| f.stats.done);
    let edits: [fn(&mut Scene); 5] = [
        |scene| scene.materials[0].base_color = Rgb::new(0.1, 0.9, 0.2),
        |scene| scene.nodes[0].transform *= Mat4::from_rotation_y(0.5),
        |scene| {
            scene.lights.push(Light {
                name: String::new(),
                kind: LightKind::Point,
                intensity: Rgb::splat(5.0),
            });
            let transform = Mat4::from_translation(Vec3::new(0.5, 1.0, 1.5));
            scene.add_root(Node { transform, light: Some(LightId(0)), ..Node::default() });
        },
        |scene| scene.environment.background = Background::Constant(Rgb::new(0.1, 0.2, 0.4)),
        |scene| scene.nodes[0].visible = false,
    ];
    for edit in edits {
        let mut scene = Scene::clone(&w.scene);
        edit(&mut scene);
        w.scene = Arc::new(scene);
        let number = s.session.set(w.clone());
        let frame = s.frame(|f| f.number == number && f.stats.done);
        let want = output::develop(&rendered(&w, 20), &w.look.look).bytes;
        let rgb: Vec<u8> = frame.rgba.chunks_exact(4).flat_map(|p| p[..3].to_vec()).collect();
        assert!(rgb == want);
    }
    let prepared = s.events.iter().filter(|e| matches!(e, Event::Prepared { .. })).count();
    assert_eq!(prepared, 1, "the scene is brought to the device once");
}
