//! Writes the albedo tables of the microfacet models to standard output:
//! `cargo run --release -p lumbre-testkit --example bsdf_tables > crates/core/src/bsdf/albedo_data.rs && cargo fmt`.

fn main() {
    print!("{}", lumbre_testkit::bsdf_tables::data_file());
}
