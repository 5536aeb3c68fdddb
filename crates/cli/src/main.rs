//! The `hammerbeam` command.
fn main() {}
