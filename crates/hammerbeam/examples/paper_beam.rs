//! The beam with an elastic stop of van de Vorst and others: its eigenfrequencies, and the harmonic and
//! subharmonic motions that it has at 36.2 Hz.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

use hammerbeam::{Error, Quiet, Study, check::check};

const BEAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/beam-with-stop.toml");

pub fn main() -> Result<(), Error> {
    let study = Study::read(BEAM)?;
    let found = check(&study, &mut Quiet)?;
    println!("{}: eigenfrequencies {:.2?} Hz", found.study.title, found.eigenfrequencies_hz);
    for period_multiple in [1, 2] {
        for orbit in study.orbits(36.2, period_multiple)? {
            let maxima = &orbit.maxima;
            println!(
                "period {period_multiple}, {}: {:.4} mm, {:.1} m/s^2, {:.2} N",
                orbit.stability().word(),
                1e3 * maxima.displacement,
                maxima.acceleration,
                maxima.contact_force
            );
        }
    }
    Ok(())
}
