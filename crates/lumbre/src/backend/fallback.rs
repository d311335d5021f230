//! A backend that goes on with another one where the first fails. Sums are exact and ranges of samples are known, so the picture is
//! then made of the same samples as if nothing had happened.

use super::{AccelReport, Backend, DeviceError, Frames, PassTime, RenderError, Replayed};
use lumbre_core::Film;
use lumbre_core::control::{Control, Progress};
use lumbre_core::settings::View;
use lumbre_scene::{CompiledScene, SceneChanges};
use std::ops::Range;
use std::sync::{PoisonError, RwLock, RwLockReadGuard};

/// Makes the second backend when it is needed.
type Make = Box<dyn FnOnce(CompiledScene) -> Result<Box<dyn Backend>, DeviceError> + Send + Sync>;

/// Two backends for one scene. The second is made when the first has failed, which is then let go.
pub struct Fallback {
    state: RwLock<State>,
}

struct State {
    current: Box<dyn Backend>,
    /// What makes the second, and of which scene. `None`: it is in use, or could not be made.
    next: Option<(CompiledScene, Make)>,
}

impl Fallback {
    /// Renders on `first`, and on what `make` makes of the scene once that has failed.
    pub fn new(
        first: Box<dyn Backend>,
        scene: CompiledScene,
        make: impl FnOnce(CompiledScene) -> Result<Box<dyn Backend>, DeviceError> + Send + Sync + 'static,
    ) -> Self {
        Fallback { state: RwLock::new(State { current: first, next: Some((scene, Box::new(make))) }) }
    }

    fn state(&self) -> RwLockReadGuard<'_, State> {
        self.state.read().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Backend for Fallback {
    fn device(&self) -> String {
        self.state().current.device()
    }

    fn memory(&self) -> u64 {
        self.state().current.memory()
    }

    fn render(
        &self,
        view: &View,
        samples: Range<u32>,
        film: &mut Film,
        control: &dyn Control,
    ) -> Result<Progress, RenderError> {
        self.state().current.render(view, samples, film, control)
    }

    fn update(&mut self, scene: CompiledScene, changes: SceneChanges) -> Result<(), RenderError> {
        let state = self.state.get_mut().unwrap_or_else(PoisonError::into_inner);
        if let Some((kept, _)) = &mut state.next {
            *kept = scene.clone();
        }
        state.current.update(scene, changes)
    }

    fn warm_up(&self, view: &View) -> Result<(), RenderError> {
        self.state().current.warm_up(view)
    }

    fn recover(&self, error: RenderError) -> Result<String, RenderError> {
        let mut state = self.state.write().unwrap_or_else(PoisonError::into_inner);
        let Some((scene, make)) = state.next.take() else { return state.current.recover(error) };
        match make(scene) {
            Ok(second) => {
                state.current = second;
                Ok(format!("{error}; going on with the {}", state.current.device()))
            }
            Err(e) => {
                Err(RenderError { reason: format!("{}; nor can the CPU go on: {e}", error.reason), ..error })
            }
        }
    }

    fn pass_times(&self) -> Vec<PassTime> {
        self.state().current.pass_times()
    }

    fn complaints(&self) -> Option<Vec<String>> {
        self.state().current.complaints()
    }

    fn accel(&self) -> Option<AccelReport> {
        self.state().current.accel()
    }

    fn frames(&self, view: &View, size: [u32; 2], spp: u32, count: u32) -> Result<Frames, RenderError> {
        self.state().current.frames(view, size, spp, count)
    }

    fn replayed(&self, view: &View, size: [u32; 2], runs: u32) -> Result<Option<Replayed>, RenderError> {
        self.state().current.replayed(view, size, runs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::Watch;
    use crate::{Device, Ended, SoFar, Targets, prepare, prepare_cpu, render};
    use lumbre_core::settings::RenderSettings;
    use lumbre_core::{Camera, Rgb};
    use lumbre_scene::{Background, Scene, compile};
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicU32, Ordering};

    /// Ranges that were asked for.
    type Asked = std::sync::Arc<Mutex<Vec<Range<u32>>>>;

    /// The CPU under another name, which fails after some passes and remembers what it was asked for.
    struct Flaky {
        inner: Box<dyn Backend>,
        left: AtomicU32,
        asked: Asked,
        /// Its scene can be edited.
        edits: bool,
    }

    fn flaky(passes: u32) -> (Box<Flaky>, Asked) {
        let asked = Asked::default();
        let inner = prepare(scene(), Device::Cpu).unwrap();
        let flaky = Flaky { inner, left: AtomicU32::new(passes), asked: Asked::clone(&asked), edits: true };
        (Box::new(flaky), asked)
    }

    fn lost() -> RenderError {
        RenderError { device: "Flaky 1".into(), reason: "the device is lost".into() }
    }

    impl Backend for Flaky {
        fn device(&self) -> String {
            "Flaky 1".into()
        }
        fn memory(&self) -> u64 {
            7
        }
        fn render(
            &self,
            view: &View,
            samples: Range<u32>,
            film: &mut Film,
            control: &dyn Control,
        ) -> Result<Progress, RenderError> {
            let passes = self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1));
            passes.map_err(|_| lost())?;
            self.asked.lock().unwrap().push(samples.clone());
            self.inner.render(view, samples, film, control)
        }
        fn update(&mut self, scene: CompiledScene, changes: SceneChanges) -> Result<(), RenderError> {
            if self.edits { self.inner.update(scene, changes) } else { Err(lost()) }
        }
    }

    fn scene() -> CompiledScene {
        let mut scene = Scene::default();
        scene.environment.background = Background::Gradient;
        compile(&scene).unwrap().scene
    }

    fn view() -> View {
        let camera = Camera::look_at(glam::Vec3::ZERO, glam::Vec3::Z, glam::Vec3::Y, 1.0, 1.5);
        View { camera, settings: RenderSettings::default(), frame: 0 }
    }

    /// Remembers what it hears.
    #[derive(Default)]
    struct Heard {
        notices: Mutex<Vec<String>>,
        passes: Mutex<Vec<SoFar>>,
    }
    impl Control for Heard {}
    impl Watch for Heard {
        fn passed(&self, film: &Film, so_far: &SoFar) {
            assert!(film.pixels().iter().all(|p| p.samples() == so_far.spp), "even");
            self.passes.lock().unwrap().push(*so_far);
        }
        fn notice(&self, what: &str) {
            self.notices.lock().unwrap().push(what.into());
        }
    }

    const TARGETS: u32 = 40;

    fn whole() -> Film {
        let mut film = Film::new(9, 6);
        let cpu = prepare(scene(), Device::Cpu).unwrap();
        render(&*cpu, &view(), Targets::spp(TARGETS), &mut film, &()).unwrap();
        assert!(film.pixel(4, 3).radiance() != Rgb::BLACK);
        film
    }

    #[test]
    fn the_picture_is_as_if_nothing_had_happened() {
        for passes in [0, 1, 3, 5] {
            let (first, asked) = flaky(passes);
            let both = Fallback::new(first, scene(), |scene| Ok(Box::new(prepare_cpu(scene)?)));
            assert_eq!((both.device(), both.memory()), ("Flaky 1".into(), 7));
            let (mut film, heard) = (Film::new(9, 6), Heard::default());
            let outcome = render(&both, &view(), Targets::spp(TARGETS), &mut film, &heard).unwrap();
            assert_eq!((outcome.ended, outcome.spp), (Ended::Spp, TARGETS));
            assert_eq!(outcome.progress.samples, 9 * 6 * u64::from(TARGETS), "what failed does not count");
            assert!(film == whole(), "after {passes} passes");
            assert_eq!(asked.lock().unwrap().len(), passes as usize);
            let notices = heard.notices.into_inner().unwrap();
            assert_eq!(notices.len(), 1, "{notices:?}");
            assert!(notices[0].starts_with("Flaky 1: the device is lost; going on with the CPU ("));
            assert!(both.device().starts_with("CPU ("));
            assert!(heard.passes.into_inner().unwrap().windows(2).all(|w| w[0].spp < w[1].spp));
        }
    }

    /// After an edit the second backend draws the edited scene, whether the first took the edit or failed.
    #[test]
    fn the_second_one_draws_the_edited_scene() {
        let mut lit = Scene::default();
        lit.environment.background = Background::Constant(Rgb::new(0.25, 0.5, 1.0));
        let lit = compile(&lit).unwrap().scene;
        let changes = SceneChanges::between(&scene(), &lit);
        let draw = |backend: &dyn Backend| {
            let mut film = Film::new(9, 6);
            render(backend, &view(), Targets::spp(TARGETS), &mut film, &()).unwrap();
            film
        };
        let expected = draw(&*prepare(lit.clone(), Device::Cpu).unwrap());
        assert!(expected != whole());
        for edits in [true, false] {
            let (mut first, asked) = flaky(2);
            first.edits = edits;
            let mut both = Fallback::new(first, scene(), |scene| Ok(Box::new(prepare_cpu(scene)?)));
            let updated = both.update(lit.clone(), changes);
            assert_eq!(updated, if edits { Ok(()) } else { Err(lost()) });
            if let Err(error) = updated {
                both.recover(error).unwrap();
            }
            assert!(draw(&both) == expected, "first takes the edit: {edits}");
            assert_eq!(asked.lock().unwrap().len(), if edits { 2 } else { 0 });
            // The second one takes edits too.
            both.update(scene(), changes).unwrap();
            assert!(draw(&both) == whole());
        }
    }

    /// The test above would see a pass that is left out or made twice.
    #[test]
    fn a_pass_left_out_or_made_twice_is_another_picture() {
        let cpu = prepare(scene(), Device::Cpu).unwrap();
        for ranges in [[0..7, 8..TARGETS], [0..8, 7..TARGETS]] {
            let mut film = Film::new(9, 6);
            for range in ranges {
                cpu.render(&view(), range, &mut film, &()).unwrap();
            }
            assert!(film != whole());
        }
    }

    #[test]
    fn without_another_device_what_there_is_stays_even() {
        let (first, asked) = flaky(3);
        let (mut film, heard) = (Film::new(9, 6), Heard::default());
        let failed = render(&*first, &view(), Targets::spp(TARGETS), &mut film, &heard).unwrap_err();
        assert_eq!((&failed.error, failed.outcome.ended), (&lost(), Ended::Failed));
        assert_eq!(failed.to_string(), "Flaky 1: the device is lost");
        let spp = asked.lock().unwrap().last().unwrap().end;
        assert!(spp >= 3 && failed.outcome.spp == spp, "{failed:?}");
        assert!(film.pixels().iter().all(|p| p.samples() == spp));
        assert_eq!(failed.outcome.progress.samples, 9 * 6 * u64::from(spp));
        assert!(heard.notices.into_inner().unwrap().is_empty());
        // The rest of the samples can come from elsewhere.
        let rest = Targets::spp(TARGETS - spp).from_sample(spp);
        render(&*prepare(scene(), Device::Cpu).unwrap(), &view(), rest, &mut film, &()).unwrap();
        assert!(film == whole());
    }

    #[test]
    fn when_the_second_fails_too_it_ends() {
        let both = Fallback::new(flaky(1).0, scene(), |_| Ok(flaky(1).0));
        let heard = Heard::default();
        let failed = render(&both, &view(), Targets::spp(TARGETS), &mut Film::new(9, 6), &heard).unwrap_err();
        assert_eq!((failed.error, failed.outcome.spp), (lost(), 2));
        assert_eq!(heard.notices.into_inner().unwrap().len(), 1);
        let asked = Device::Cpu;
        let none = DeviceError::Unavailable { asked, reason: "none".into() };
        let neither = Fallback::new(flaky(0).0, scene(), move |_| Err(none));
        let failed = render(&neither, &view(), Targets::spp(TARGETS), &mut Film::new(9, 6), &()).unwrap_err();
        assert!(failed.error.reason.contains("the device is lost; nor can the CPU go on: "), "{failed}");
    }
}
