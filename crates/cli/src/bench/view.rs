//! How soon a session answers, without a window: from a move of the camera to the frame that shows it, and what edits of a material cost
//! while they come ten times a second. Everything but the display, as `lumbre view` has it.

use super::place::{Eye, Place, scenes};
use super::settings;
use super::sweep::HD;
use super::table::{Cell, Column, Table};
use crate::console;
use crate::exit::{Code, Failure};
use crate::flags::bench::BenchArgs;
use crate::memory;
use lumbre::GpuOptions;
use lumbre::scene::Scene;
use lumbre::session::{Event, Frame, FrameSink, FrameStats, Layer, Session, ViewLook, Wanted};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

const COLUMNS: [Column; 12] = [
    ("scene", "scene"),
    ("camera", "camera"),
    ("size", "size"),
    ("event", "event"),
    ("count", "events"),
    ("median_ms", "ms to its frame"),
    ("most_ms", "at most"),
    ("frames", "frames before it, at most"),
    ("scale", "pixels a side"),
    ("fps", "frames/s"),
    ("gap_ms", "longest gap, ms"),
    ("growth_mib", "MiB more"),
];

/// Moves of the camera that are timed.
const MOVES: usize = 60;
/// Between two of them.
const PAUSE: Duration = Duration::from_millis(150);
/// Edits a second.
const EDITS: u32 = 10;
/// Longest wait for anything.
const PATIENCE: Duration = Duration::from_secs(120);

/// Notes when frames come.
struct Clock(Mutex<Sender<Sent>>);

enum Sent {
    Frame { at: Instant, number: u64, stats: FrameStats },
    Failed(String),
}

impl FrameSink for Clock {
    fn frame(&self, frame: Frame) {
        let sent = Sent::Frame { at: Instant::now(), number: frame.number, stats: frame.stats };
        // Nobody listens any more at the very end.
        let _ = self.0.lock().unwrap_or_else(PoisonError::into_inner).send(sent);
    }

    fn event(&self, event: Event) {
        match event {
            Event::Failed(why) | Event::Refused { reason: why, .. } => {
                let _ = self.0.lock().unwrap_or_else(PoisonError::into_inner).send(Sent::Failed(why));
            }
            Event::Notice(notice) => console::warning(notice),
            Event::Prepared { device, seconds, .. } => {
                console::note(format_args!("device: {device}, ready after {seconds:.2} s"));
            }
            _ => {}
        }
    }
}

/// What came of some events.
#[derive(Default)]
struct Answers {
    ms: Vec<f64>,
    /// Frames of what was wanted before that came in between, at most.
    stale: u64,
    scale: u32,
    frames: u64,
    seconds: f64,
    gap_ms: f64,
    growth: Option<f64>,
    device: String,
}

/// A session under measurement.
struct Watched {
    session: Session,
    sent: Receiver<Sent>,
    wanted: Wanted,
}

impl Watched {
    fn start(wanted: Wanted, options: GpuOptions) -> Self {
        let (to, sent) = channel();
        let session = Session::start(wanted.clone(), options, Arc::new(Clock(Mutex::new(to))));
        Watched { session, sent, wanted }
    }

    /// The next frame: when, which, how it was made.
    fn frame(&self, patience: Duration) -> Result<Option<(Instant, u64, FrameStats)>, Failure> {
        match self.sent.recv_timeout(patience) {
            Ok(Sent::Frame { at, number, stats }) => Ok(Some((at, number, stats))),
            Ok(Sent::Failed(why)) => Err(Failure::new(Code::Unavailable, why)),
            Err(_) => Ok(None),
        }
    }

    /// Sets what is wanted, and waits for the frame that shows it.
    fn answer(&self, answers: &mut Answers) -> Result<(), Failure> {
        let asked = Instant::now();
        let number = self.session.set(self.wanted.clone());
        let mut stale = 0;
        loop {
            let frame = self.frame(PATIENCE)?;
            let Some((at, shows, stats)) = frame else {
                let message = format!("no frame came within {} s", PATIENCE.as_secs());
                return Err(Failure::new(Code::Unavailable, message));
            };
            if at < asked {
                continue;
            }
            answers.frames += 1;
            if shows >= number {
                answers.ms.push(1e3 * (at - asked).as_secs_f64());
                answers.scale = answers.scale.max(stats.scale);
                answers.device = stats.device;
                answers.stale = answers.stale.max(stale);
                return Ok(());
            }
            stale += 1;
        }
    }

    /// Lets frames pass for a while.
    fn watch(&self, until: Instant, last: &mut Instant, answers: &mut Answers) -> Result<(), Failure> {
        while let Some(left) = until.checked_duration_since(Instant::now()) {
            if let Some((at, ..)) = self.frame(left)? {
                answers.frames += 1;
                answers.gap_ms = answers.gap_ms.max(1e3 * (at - *last).as_secs_f64());
                *last = at;
            }
        }
        Ok(())
    }
}

/// The camera is turned about a point before it, some degrees at a time.
fn moves(watched: &mut Watched) -> Result<Answers, Failure> {
    let mut answers = Answers::default();
    let (began, camera) = (Instant::now(), watched.wanted.camera);
    watched.wanted.moving = true;
    let mut last = began;
    for i in 0..MOVES {
        let side = camera.right * (0.02 * camera.focus_distance.max(1.0) * (i % 10 + 1) as f32);
        watched.wanted.camera.origin = camera.origin + side;
        watched.answer(&mut answers)?;
        watched.watch(Instant::now() + PAUSE, &mut last, &mut Answers::default())?;
    }
    (watched.wanted.camera, watched.wanted.moving) = (camera, false);
    answers.seconds = began.elapsed().as_secs_f64();
    Ok(answers)
}

/// A material changes ten times a second, for as long as is asked.
fn edits(watched: &mut Watched, time: Duration) -> Result<Answers, Failure> {
    let mut answers = Answers::default();
    // What the first edit does once does not count.
    watched.wanted.scene = Arc::new(edited(&watched.wanted.scene, 0));
    watched.answer(&mut Answers::default())?;
    let (began, held) = (Instant::now(), memory::held());
    let mut last = began;
    let count = (time.as_secs_f64() * f64::from(EDITS)).ceil() as u32;
    for i in 0..count {
        watched.wanted.scene = Arc::new(edited(&watched.wanted.scene, i + 1));
        watched.answer(&mut answers)?;
        let now = Instant::now();
        answers.gap_ms = answers.gap_ms.max(1e3 * (now - last).as_secs_f64());
        last = now;
        watched.watch(began + (i + 1) * Duration::from_secs(1) / EDITS, &mut last, &mut answers)?;
    }
    answers.seconds = began.elapsed().as_secs_f64();
    answers.growth =
        memory::held().zip(held).map(|(now, before)| (now as f64 - before as f64) / f64::from(1 << 20));
    Ok(answers)
}

/// The scene with another colour and roughness of its first material.
fn edited(scene: &Scene, step: u32) -> Scene {
    let mut scene = scene.clone();
    if let Some(material) = scene.materials.first_mut() {
        let t = (step % 10) as f32 / 10.0;
        material.base_color = lumbre::core::Rgb::new(t, 1.0 - t, 0.5);
        material.roughness = 0.2 + 0.6 * t;
    }
    scene
}

pub(super) fn table(args: &BenchArgs) -> Result<Table, Failure> {
    let sizes = args.sizes.as_ref().map_or(vec![HD], |sizes| sizes.iter().map(|s| s.0).collect());
    let (mut rows, mut device) = (Vec::new(), String::new());
    for path in scenes(args)? {
        let place = Place::open(&path, args)?;
        for eye in place.eyes() {
            for &size in &sizes {
                let (both, drawn_by) = measured(args, &place, &eye, size)?;
                rows.extend(both);
                device = drawn_by;
            }
        }
    }
    Ok(Table { columns: COLUMNS.into(), rows, settings: settings(args, &device) })
}

/// The rows of one view, and what drew it.
fn measured(
    args: &BenchArgs,
    place: &Place,
    eye: &Eye<'_>,
    size: [u32; 2],
) -> Result<([Vec<Cell>; 2], String), Failure> {
    let view = eye.view(size, args.settings())?;
    let wanted = Wanted {
        scene: Arc::new(eye.scene().clone()),
        camera: view.camera,
        size,
        settings: view.settings,
        samples_per_frame: args.samples.as_ref().map_or(1, |s| s[0]),
        limit: u32::MAX,
        paused: false,
        restarts: 0,
        moving: false,
        look: ViewLook::default(),
        layer: Layer::Picture,
        device: args.device.device.clone(),
    };
    let mut watched = Watched::start(wanted, args.device.options());
    // The first frames: pipelines are made, speeds are learnt.
    watched.answer(&mut Answers::default())?;
    watched.watch(Instant::now() + Duration::from_secs(1), &mut Instant::now(), &mut Answers::default())?;
    let moved = moves(&mut watched)?;
    let edited = edits(&mut watched, args.time)?;
    let device = edited.device.clone();
    let row = |event: &str, a: Answers| {
        let mut ms = a.ms;
        ms.sort_by(f64::total_cmp);
        let [width, height] = size;
        vec![
            Cell::Text(place.name.clone()),
            Cell::Text(eye.name.into()),
            Cell::Text(format!("{width}x{height}")),
            Cell::Text(event.into()),
            Cell::Whole(ms.len() as u64),
            Cell::Number(ms[ms.len() / 2]),
            Cell::Number(ms[ms.len() - 1]),
            Cell::Whole(a.stale),
            Cell::Whole(a.scale.into()),
            a.growth.map_or(Cell::None, |_| Cell::Number(a.frames as f64 / a.seconds)),
            a.growth.map_or(Cell::None, |_| Cell::Number(a.gap_ms)),
            a.growth.into(),
        ]
    };
    Ok(([row("camera moved", moved), row("material edited", edited)], device))
}
