//! The window from a program of one's own: `cargo run --release -p lumbre-viewer --example window -- scene.glb`.

use lumbre_viewer::{Options, run};

fn main() {
    let scene = std::env::args_os().nth(1).map(Into::into);
    if let Err(e) = run(Options { scene, ..Options::default() }) {
        eprintln!("{e}");
        std::process::exit(69);
    }
}
