//! The examples of the crate: each is short, and runs.
#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "tests and examples")]

#[path = "../examples/basins.rs"]
mod basins;
#[path = "../examples/book_figures/main.rs"]
#[expect(dead_code, reason = "its `main` writes into the book; the test compares with what is there")]
mod book_figures;
#[path = "../examples/branch_by_hand.rs"]
mod branch_by_hand;
mod committed_figures;
#[path = "../examples/custom_sweep.rs"]
mod custom_sweep;
#[path = "../examples/lumped_rattle.rs"]
mod lumped_rattle;
#[path = "../examples/paper_beam.rs"]
mod paper_beam;
mod readme;

use std::{fs, path::Path};

#[test]
fn the_examples_run() {
    lumped_rattle::main().unwrap();
    paper_beam::main().unwrap();
    branch_by_hand::main().unwrap();
    custom_sweep::main().unwrap();
    basins::main().unwrap();
}

#[test]
fn no_example_is_longer_than_forty_lines() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    // The folder beside them draws the figures of the book.
    let files: Vec<_> = files.filter(|path| path.is_file()).collect();
    assert_eq!(files.len(), 5);
    for file in files {
        let lines = fs::read_to_string(&file).unwrap().lines().count();
        assert!(lines < 40, "{}: {lines} lines", file.display());
    }
}
