//! The window's contents, driven as a person would: by mouse, keys and the names of widgets, with a stand-in for the render thread that
//! writes down what it is told.

mod camera;
mod editing;
mod files;
mod kit;
mod panels;
mod render;
