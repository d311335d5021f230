//! Makes the reference pictures of our own scenes: `cargo run --example bless -p lumbre-testkit [NAME...]`. Look at what changed
//! before you keep it: from then on, tests hold the renderer to it.
#![forbid(unsafe_code)]

use lumbre_testkit::references::{ALL, SEED};
use lumbre_testkit::z_test::{Picture, compare};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let names: Vec<String> = std::env::args().skip(1).collect();
    if let Some(unknown) = names.iter().find(|n| ALL.iter().all(|r| r.name != **n)) {
        return Err(format!("there is no reference {unknown:?}").into());
    }
    for reference in ALL.iter().filter(|r| names.is_empty() || names.iter().any(|n| n == r.name)) {
        let before = reference.read();
        let film = reference.open(SEED).film(reference.size, 0..reference.spp);
        let picture = Picture::of_film(&film);
        reference.bless(&film)?;
        let (mean, error) = picture.overall();
        println!("{}: mean {mean:.6} ± {error:.6}", reference.path().display());
        match before {
            Ok(old) => println!("  against the one before: {:?}", compare(&picture, &old.picture, 1)),
            Err(why) => println!("  there was none before: {why}"),
        }
    }
    Ok(())
}
