//! A mass between two wells, `x'' + c x' - x + x^3 = F cos(w t)`: a linear term that pushes away from the
//! middle.
//!
//! Small motions about a well at `x = 1` are those of `u'' + c u' + 2 u = F cos(w t)`, so the amplitude is `F
//! / |2 - w^2 + i c w|`; what both wells do is each other's mirror image. About the middle they are those of
//! `u'' + c u' - u = F cos(w t)`, a saddle with the multipliers `exp((-c/2 +- sqrt(c^2/4 + 1)) T)`.

use std::f64::consts::TAU;

use hammerbeam_verification::results::Results;

const DAMPING: f64 = 0.25;
const FORCE: f64 = 1e-4;

/// The spring, as a law of its own and as a formula.
const LAWS: [&str; 2] = [
    "law = \"cubic\"\nstiffness_n_m = -1.0\nstiffness_n_m3 = 1.0",
    "law = \"formula\"\nformula = \"k*(x^3 - x)\"\nconstants = { k = 1.0 }",
];

fn study(law: &str) -> String {
    format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "mass", mass_kg = 1.0 }}]
damper = [{{ between = ["mass", "ground"], damping_n_s_m = {DAMPING} }}]
[excitation]
kind = "force"
at = "mass"
amplitude_n = {FORCE:e}
frequency_hz = [0.14, 0.16]
[[stop]]
name = "wells"
at = "mass"
{law}
[search]
frequencies = 1
starts = 8
trials = 40
[continuation]
max_step_hz = 0.002
"#
    )
}

#[test]
fn both_wells_and_the_saddle_between_them_are_as_small_motions_have_it() {
    LAWS.iter().for_each(|law| check_wells(law));
}

fn check_wells(law: &str) {
    let folder = tempfile::tempdir().unwrap();
    let results = Results::of_run(&study(law), folder.path(), 2).unwrap();
    let frequency = 0.15;
    let (w, period) = (TAU * frequency, 1.0 / frequency);
    let amplitude = FORCE / (2.0 - w * w).hypot(DAMPING * w);
    let mut found = [0; 3];
    for (_, orbit) in results.crossings(frequency, 1).unwrap() {
        let x = orbit.nodes[0][0];
        let root = (DAMPING * DAMPING / 4.0 + 1.0).sqrt();
        if x.abs() < 0.5 {
            found[1] += 1;
            assert!(!orbit.stable());
            for (multiplier, sign) in orbit.floquet_multipliers.iter().zip([1.0, -1.0]) {
                let exact = ((-DAMPING / 2.0 + sign * root) * period).exp();
                assert!(
                    (multiplier[0] / exact - 1.0).abs() < 1e-6 && multiplier[1] == 0.0,
                    "{multiplier:?} {exact}"
                );
            }
        } else {
            found[if x > 0.0 { 2 } else { 0 }] += 1;
            assert!(orbit.stable());
            // What is left out is of the order of the square of the force. The product of the multipliers is
            // exact.
            let largest = orbit.maxima.displacement;
            assert!((largest - 1.0 - amplitude).abs() < 20.0 * FORCE * FORCE, "{largest}");
            let modulus = (-DAMPING * period / 2.0).exp();
            for multiplier in &orbit.floquet_multipliers {
                assert!((multiplier[0].hypot(multiplier[1]) / modulus - 1.0).abs() < 1e-9, "{multiplier:?}");
            }
        }
    }
    assert_eq!(found, [1, 1, 1], "left, middle, right, {law}");
}
