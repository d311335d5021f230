//! Writes the tables of the surface models into the sources, from the root of the workspace:
//! `cargo run --release -p lumbre-testkit --example bsdf_tables && cargo fmt`.

use std::fs::write;

fn main() -> std::io::Result<()> {
    write("crates/core/src/bsdf/albedo_data.rs", lumbre_testkit::bsdf_tables::data_file())?;
    write("crates/core/src/bsdf/sheen_data.rs", lumbre_testkit::sheen_tables::data_file())
}
