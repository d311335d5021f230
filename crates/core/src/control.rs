//! What a backend tells its caller while it works, and how it is stopped.

/// What has been done since a backend was asked to render.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Camera samples taken.
    pub samples: u64,
    /// Rays traced.
    pub rays: u64,
}

/// Says, before each tile, whether to go on, and hears what has been done after it. Called from any thread.
pub trait Control: Sync {
    /// True to leave out the tiles that have not begun.
    fn cancelled(&self) -> bool {
        false
    }
    /// A tile is done.
    fn progress(&self, _so_far: Progress) {}
}

impl Control for () {}
