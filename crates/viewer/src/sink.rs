//! Where the render thread leaves what it made. It never waits for the interface nor the interface for it: a lock is held as long as it
//! takes to put a pointer into a place, and of frames only the newest is kept.

use eframe::egui::{ColorImage, Context};
use lumbre::session::{Event, Frame, FrameSink, FrameStats};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A frame that can be shown.
#[derive(Clone)]
pub struct Shown {
    /// Its pixels; already turned into what the interface takes, on the render thread.
    pub image: Arc<ColorImage>,
    /// How many times something had been wanted when it was begun.
    pub number: u64,
    /// How it was made.
    pub stats: FrameStats,
}

/// What came since the interface looked last.
#[derive(Default)]
pub struct News {
    /// The newest frame, if there is one.
    pub frame: Option<Shown>,
    /// How each frame that came was made, the oldest first: the newest and those that no one saw.
    pub made: Vec<FrameStats>,
    /// What happened, in the order it did.
    pub events: Vec<Event>,
    /// The newest wish of which a frame came.
    newest: u64,
}

/// Statistics of frames that are kept for an interface that does not look: a minimised window.
const KEPT: usize = 1024;

/// The place between the two threads.
#[derive(Default)]
pub struct Sink {
    news: Mutex<News>,
    window: Mutex<Option<Context>>,
}

impl Sink {
    /// Tells whose window is to be woken. Until then frames and events gather.
    pub fn wake(&self, window: &Context) {
        *self.window.lock().unwrap_or_else(PoisonError::into_inner) = Some(window.clone());
    }

    /// Takes what came.
    pub fn take(&self) -> News {
        let mut news = self.news();
        let newest = news.newest;
        std::mem::replace(&mut *news, News { newest, ..News::default() })
    }

    fn news(&self) -> MutexGuard<'_, News> {
        self.news.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Wakes the window.
    pub fn tell(&self) {
        let window = self.window.lock().unwrap_or_else(PoisonError::into_inner).clone();
        if let Some(window) = window {
            window.request_repaint();
        }
    }
}

impl FrameSink for Sink {
    fn frame(&self, frame: Frame) {
        let size = frame.size.map(|n| n as usize);
        let image = Arc::new(ColorImage::from_rgba_unmultiplied(size, &frame.rgba));
        let shown = Shown { image, number: frame.number, stats: frame.stats };
        let mut news = self.news();
        // A picture that was being developed when another layer was asked for.
        if shown.number < news.newest {
            return;
        }
        news.newest = shown.number;
        if news.made.len() == KEPT {
            news.made.clear();
        }
        news.made.push(shown.stats.clone());
        let last = news.frame.replace(shown);
        // What no one saw is freed without the lock.
        drop(news);
        drop(last);
        self.tell();
    }

    fn event(&self, event: Event) {
        self.news().events.push(event);
        self.tell();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(number: u64) -> Frame {
        let stats = FrameStats { spp: number as u32, ..FrameStats::default() };
        Frame { size: [2, 1], rgba: vec![255, 0, 0, 255, 10, 20, 30, 255], number, stats }
    }

    #[test]
    fn the_newest_frame_is_kept_and_all_events() {
        let sink = Sink::default();
        (1..=3).for_each(|n| sink.frame(frame(n)));
        sink.event(Event::Notice("a".into()));
        sink.event(Event::Notice("b".into()));
        let news = sink.take();
        let shown = news.frame.unwrap();
        assert_eq!((shown.number, shown.image.size), (3, [2, 1]));
        assert_eq!(shown.image.pixels[1].to_array(), [10, 20, 30, 255]);
        assert_eq!(news.made.iter().map(|s| s.spp).collect::<Vec<_>>(), [1, 2, 3]);
        assert_eq!(news.events.len(), 2);
        let nothing = sink.take();
        assert!(nothing.frame.is_none() && nothing.events.is_empty() && nothing.made.is_empty());
    }

    #[test]
    fn a_frame_of_an_older_wish_is_not_shown() {
        let sink = Sink::default();
        sink.frame(frame(5));
        sink.take();
        sink.frame(frame(4));
        assert!(sink.take().frame.is_none());
        sink.frame(frame(5));
        assert_eq!(sink.take().frame.unwrap().number, 5);
    }

    #[test]
    fn a_window_that_does_not_look_costs_no_memory() {
        let sink = Sink::default();
        (0..5000).for_each(|n| sink.frame(frame(n)));
        let news = sink.take();
        assert!(news.made.len() <= KEPT);
        assert_eq!(news.frame.unwrap().number, 4999);
    }

    #[test]
    fn the_window_is_woken() {
        let (sink, window) = (Sink::default(), Context::default());
        sink.wake(&window);
        let woken = Arc::new(std::sync::atomic::AtomicUsize::new(0));
        let count = woken.clone();
        window.set_request_repaint_callback(move |_| {
            count.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        });
        sink.frame(frame(1));
        sink.event(Event::Notice("a".into()));
        assert!(woken.load(std::sync::atomic::Ordering::Relaxed) >= 1);
    }
}
