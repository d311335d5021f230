//! Edits of a scene: what is made again is what a new beginning makes.

mod on_cpu;
mod recompiled;
