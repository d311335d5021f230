//! The `lumbre` command.
fn main() {}
