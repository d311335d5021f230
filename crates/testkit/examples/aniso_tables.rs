//! Writes one of the albedo tables of anisotropic microfacets, `deficit` or `schlick`, to standard output:
//! `cargo run -p lumbre-testkit --example aniso_tables deficit > crates/core/src/bsdf/aniso_albedo_deficit.rs && cargo fmt`.

fn main() {
    let which = std::env::args().nth(1).unwrap_or_default();
    let [deficit, schlick] = lumbre_testkit::aniso_tables::Tables::new().data_files();
    match which.as_str() {
        "deficit" => print!("{deficit}"),
        "schlick" => print!("{schlick}"),
        _ => {
            eprintln!("usage: aniso_tables deficit|schlick");
            std::process::exit(2);
        }
    }
}
