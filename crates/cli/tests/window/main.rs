//! `lumbre view` as people have it: a real window on a real display (Xvfb, a display without a screen), moved by a mouse and a keyboard
//! (xdotool), with a picture of the display after each step. The pictures lie in `target/tmp/window`, for people to look at.
//!
//! Both programs and OpenGL in software are needed; where they are missing, the tests say so, or fail with `LUMBRE_REQUIRE_WINDOW=1`.
#![cfg(feature = "viewer")]

mod display;
mod hand;
mod tour;
