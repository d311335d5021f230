//! Undo and redo: what a document was, step by step. A drag is one step, however many values it passes.

/// Steps that are kept.
const DEPTH: usize = 200;

/// The states of a document. Asked after each frame of the interface, it notices by itself what changed.
#[derive(Clone, Debug)]
pub struct History<T> {
    past: Vec<T>,
    now: T,
    future: Vec<T>,
}

impl<T: Clone + PartialEq> History<T> {
    /// Of a document that nobody has changed.
    pub fn new(now: T) -> Self {
        History { past: Vec::new(), now, future: Vec::new() }
    }

    /// Takes note of the document as it is; while something is dragged or typed (`busy`) it waits for the end. Returns whether
    /// a step was made.
    pub fn observe(&mut self, document: &T, busy: bool) -> bool {
        if busy || *document == self.now {
            return false;
        }
        if self.past.len() == DEPTH {
            self.past.remove(0);
        }
        self.past.push(std::mem::replace(&mut self.now, document.clone()));
        self.future.clear();
        true
    }

    /// The document before the last step, if there is one.
    pub fn undo(&mut self) -> Option<T> {
        let before = self.past.pop()?;
        self.future.push(std::mem::replace(&mut self.now, before));
        Some(self.now.clone())
    }

    /// The document after the step that was taken back last.
    pub fn redo(&mut self) -> Option<T> {
        let after = self.future.pop()?;
        self.past.push(std::mem::replace(&mut self.now, after));
        Some(self.now.clone())
    }

    /// The document after the last step.
    pub fn now(&self) -> &T {
        &self.now
    }

    /// Whether there is a step to take back.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is one to make again.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_taken_back_and_made_again() {
        let mut history = History::new(0);
        assert_eq!((history.undo(), history.redo()), (None, None));
        for step in 1..=3 {
            assert!(history.observe(&step, false));
            assert!(!history.observe(&step, false), "nothing changed");
        }
        assert_eq!([history.undo(), history.undo()], [Some(2), Some(1)]);
        assert!(!history.observe(&1, false), "an undo is no step");
        assert_eq!(history.redo(), Some(2));
        assert!(history.can_undo() && history.can_redo());
        assert!(history.observe(&7, false));
        assert!(!history.can_redo(), "a new step ends what could be made again");
        assert_eq!(
            [history.undo(), history.undo(), history.undo(), history.undo()],
            [Some(2), Some(1), Some(0), None]
        );
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut history = History::new(0);
        for passed in 1..50 {
            assert!(!history.observe(&passed, true));
        }
        assert!(history.observe(&49, false));
        assert_eq!(history.undo(), Some(0));
        assert!(!history.can_undo());
    }

    #[test]
    fn a_drag_that_ends_where_it_began_is_none() {
        let mut history = History::new(0);
        history.observe(&5, true);
        assert!(!history.observe(&0, false));
        assert!(!history.can_undo());
    }

    #[test]
    fn it_does_not_grow_for_ever() {
        let mut history = History::new(0);
        for step in 1..1000 {
            history.observe(&step, false);
        }
        let back = std::iter::from_fn(|| history.undo()).count();
        assert_eq!(back, DEPTH);
    }
}
