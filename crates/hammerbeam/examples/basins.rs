//! Basins of attraction of a hardening Duffing oscillator where two motions are stable, as a picture of
//! letters.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

use hammerbeam::{
    Error, Study,
    basins::{BasinAxis, BasinsRequest},
};

const DUFFING: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/duffing.toml");

pub fn main() -> Result<(), Error> {
    let study = Study::read(DUFFING)?;
    let axis = |coordinate: &str, reach: f64| BasinAxis {
        coordinate: coordinate.to_owned(),
        low: -reach,
        high: reach,
    };
    let request = BasinsRequest {
        frequency_hz: 0.25,
        x: axis("q1", 2.0),
        y: axis("v1", 3.0),
        grid: 16,
        effort: Default::default(),
    };
    let found = study.basins(&request)?;
    for row in found.cells.chunks(16).rev() {
        println!("{}", row.iter().map(|cell| ['.', 'a', 'b', 'c'][*cell as usize % 4]).collect::<String>());
    }
    for attractor in &found.attractors {
        let kind = attractor.kind;
        println!("{}: {kind}, {:.0} % of the cells", attractor.attractor, 100.0 * attractor.fraction);
    }
    Ok(())
}
