//! Questions about what stands at a place of the picture, and what they were for. One is asked at a time, so that an answer cannot be taken
//! for that of another.

use std::collections::VecDeque;

/// What the answer is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// To pick what is there.
    Select,
    /// To pick it and bring it into view.
    Frame,
    /// To focus on it.
    Focus,
    /// To focus on the centre, which has changed.
    AutoFocus,
    /// To turn about what stands in the centre.
    Pivot,
}

/// The questions.
#[derive(Clone, Debug, Default)]
pub struct Picks {
    waiting: VecDeque<([f32; 2], Why)>,
    /// What was asked; `Some(None)`: something that is of no use any more.
    asked: Option<Option<Why>>,
}

/// More than this wait only where nothing answers.
const MOST: usize = 8;

impl Picks {
    /// Puts a question. Of those about the centre the last one is enough.
    pub fn ask(&mut self, at: [f32; 2], why: Why) {
        if matches!(why, Why::AutoFocus | Why::Pivot) {
            self.waiting.retain(|(_, other)| *other != why);
        }
        if self.waiting.len() < MOST {
            self.waiting.push_back((at, why));
        }
    }

    /// The next question to be asked, if the last one was answered.
    pub fn to_ask(&mut self) -> Option<[f32; 2]> {
        if self.asked.is_some() {
            return None;
        }
        let (at, why) = self.waiting.pop_front()?;
        self.asked = Some(Some(why));
        Some(at)
    }

    /// An answer came: what it is for.
    pub fn answered(&mut self) -> Option<Why> {
        self.asked.take().flatten()
    }

    /// Forgets all: another scene is open. An answer that is under way is still waited for and then has no meaning.
    pub fn clear(&mut self) {
        self.waiting.clear();
        self.asked = self.asked.map(|_| None);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_question_at_a_time() {
        let mut picks = Picks::default();
        picks.ask([0.1, 0.1], Why::Select);
        picks.ask([0.2, 0.2], Why::Frame);
        assert_eq!(picks.to_ask(), Some([0.1, 0.1]));
        assert_eq!(picks.to_ask(), None, "the first has no answer yet");
        assert_eq!(picks.answered(), Some(Why::Select));
        assert_eq!(picks.to_ask(), Some([0.2, 0.2]));
        assert_eq!(picks.answered(), Some(Why::Frame));
        assert_eq!((picks.to_ask(), picks.answered()), (None, None));
    }

    #[test]
    fn automatic_focus_asks_once() {
        let mut picks = Picks::default();
        for i in 0..100 {
            picks.ask([i as f32, 0.5], Why::AutoFocus);
        }
        assert_eq!(picks.to_ask(), Some([99.0, 0.5]));
        picks.answered();
        assert_eq!(picks.to_ask(), None);
    }

    #[test]
    fn an_answer_about_another_scene_means_nothing() {
        let mut picks = Picks::default();
        picks.ask([0.1, 0.1], Why::Select);
        picks.to_ask();
        picks.clear();
        picks.ask([0.2, 0.2], Why::Frame);
        assert_eq!(picks.to_ask(), None, "the answer is still under way");
        assert_eq!(picks.answered(), None);
        assert_eq!(picks.to_ask(), Some([0.2, 0.2]));
        assert_eq!(picks.answered(), Some(Why::Frame));
    }
}
