//! A gear wheel that rattles: a mass on a spring with a tooth 5 mm away. All its periodic motions at 1.8 Hz,
//! and their Floquet multipliers.

#![allow(clippy::print_stdout, missing_docs, reason = "an example shows what it finds")]

use hammerbeam::{Error, Study};

const RATTLE: &str = r#"
    [structure]
    kind = "lumped"
    mass = [{ name = "wheel", mass_kg = 1.0 }]
    spring = [{ between = ["wheel", "ground"], stiffness_n_m = 100.0 }]
    damper = [{ between = ["wheel", "ground"], damping_n_s_m = 0.4 }]

    [excitation]
    kind = "force"
    at = "wheel"
    amplitude_n = 1.0
    frequency_hz = [1.0, 3.0]

    [[stop]]
    at = "wheel"
    law = "linear"
    stiffness_n_m = 1e4
    gap_m = 0.005
    side = "above"
"#;

pub fn main() -> Result<(), Error> {
    let study = Study::parse("rattle", RATTLE)?;
    for orbit in study.orbits(1.8, 1)? {
        let (stability, maxima) = (orbit.stability().word(), &orbit.maxima);
        println!("{stability}: {:.2} mm, contacts: {}", 1e3 * maxima.displacement, maxima.contacts);
        for [re, im] in &orbit.floquet_multipliers {
            println!("    multiplier {re:.6}{im:+.6}i");
        }
    }
    Ok(())
}
