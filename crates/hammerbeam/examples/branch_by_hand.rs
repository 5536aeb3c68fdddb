//! A branch followed by hand: the resonance of a hardening Duffing oscillator, row by row over its two folds.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

use hammerbeam::{Side, Study};

const DUFFING: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/duffing.toml");

pub fn main() -> Result<(), Box<dyn std::error::Error>> {
    let study = Study::read(DUFFING)?;
    let start = study.orbits(0.1, 1)?.swap_remove(0);
    let mut branch = study.follow(&start, Side::Up)?;
    let mut folds = Vec::new();
    for row in &mut branch {
        let row = row?;
        if row.events.fold {
            folds.push(row.solution.frequency_hz);
            println!(
                "fold at {:.6} Hz: {:.4} m",
                row.solution.frequency_hz, row.solution.maxima.displacement
            );
        }
    }
    if let Some(end) = branch.end() {
        println!("{end}");
    }
    // x'' + 0.1 x' + x + x^3 = 0.3 cos(W t): the upper branch falls down at the first fold, to the lower one.
    assert!(folds.len() == 2 && folds[0] > folds[1]);
    Ok(())
}
