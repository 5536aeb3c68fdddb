#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use hammerbeam_motion::{Law, exact::ExactSettings, law::PowerSpring};

use super::*;
use crate::{OrbitSettings, eigenvalues::eigenvalues, solve::correct, test_oscillator::oscillator};

/// `x'' + 0.1 x' + x - x^3/10 = 1e-6 cos(2 pi f t)`: on the hill at `x = sqrt(10)` motions part like `exp(l
/// t)`, `l^2 + 0.1 l - 2 = 0`.
fn on_the_hill(frequency_hz: f64, segments: usize) -> Result<[f64; 2], OrbitError> {
    let (system, _) = oscillator(0.1, 1e-6, Law::Power(PowerSpring::cubic(-0.1).unwrap()));
    let hill = vec![10.0_f64.sqrt(), 0.0];
    let scale = StateScale::new(&[1.0], 1.0, hill[0]);
    let integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    let mut problem = ShootingProblem::new(integrator, (1, segments), scale, 1.0);
    let mut point = problem.point(&vec![hill; segments], frequency_hz);
    correct(&mut problem, &mut point, &OrbitSettings::default())?;
    Ok(eigenvalues(2, problem.monodromy())?[0])
}

/// The orbit stays within 1e-6 m of the top, so its larger multiplier is `exp(l/f)` to some 1e-12.
#[test]
fn multipliers_of_1e4_to_1e12_are_those_of_the_hill() {
    let growth = -0.05 + (0.0025_f64 + 2.0).sqrt();
    for segments in [4, 16, 64] {
        for power in [4, 6, 8, 10, 12] {
            let expected = 10.0_f64.powi(power);
            let [found, _] = on_the_hill(growth / expected.ln(), segments).unwrap();
            assert!((found / expected - 1.0).abs() < 1e-8, "{found:e} with {segments} segments");
        }
    }
}
