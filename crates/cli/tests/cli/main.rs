//! The command line as its users meet it: the built program is run, and its files, words and exit codes are looked at. Each
//! flag has a test of what it does or of what it refuses.

mod bench;
mod camera;
mod common;
mod compare;
mod devices;
mod edits;
mod generated;
mod gpu;
mod info;
mod interrupt;
mod light;
mod limits;
mod loading;
mod merge;
mod openexr;
mod output;
mod picture;
mod replay;
mod running;
mod sampling;
mod targets;
mod usage;
mod whole_files;
