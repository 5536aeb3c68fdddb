//! The rigid impact oscillator `x'' + x = cos(w t)`, `x <= s`, `x' -> -e x'` at `x = s`, as the limit of ever
//! stiffer contacts that lose energy.
//!
//! Orbits with one impact of speed V in each period `T = 2 pi/w` are in closed form (Shaw and Holmes, J.
//! Sound Vib. 90 (1983), 129-155, section 3; written out anew here): with `g = 1/(1 - w^2)` and `C =
//! cot(T/2)`
//!
//! `(s + V C (1 + e)/2)^2 + (V (1 - e)/(2 w))^2 = g^2`.
//!
//! Their multipliers have the product `e^2` and the sum `-2 e cos T + (1 + e) (a/V) sin T`, with the
//! acceleration a at the impact (Nordmark, J. Sound Vib. 145 (1991), 279-297, has the `1/V` of grazing orbits
//! in it). The rigid stop itself has it to rounding; where stops of stiffness k take its place, what differs
//! falls with the duration of a contact, like `k^(-2/5)` for a Hertz contact and `k^(-1/2)` for a linear one.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use crate::common::{ObservedSystem, element_at, force_at, response_of, single_mass};
use hammerbeam_motion::{
    Law, Load, System,
    law::{HertzStop, LinearStop, RestitutionModel, RestitutionStop, RigidStop},
};
use hammerbeam_orbit::{BranchWalk, OrbitMaxima, OrbitSettings, PeriodicSolution, Side, find_start};

const FREQUENCY: f64 = 1.8;
const GAP: f64 = 0.1;
const RESTITUTION: f64 = 0.6;

/// Speed of the impact, sum and product of the multipliers, with the coefficient of restitution `e`.
fn rigid(e: f64) -> [f64; 3] {
    let (w, s) = (FREQUENCY, GAP);
    let (period, g) = (TAU / w, 1.0 / (1.0 - w * w));
    let cot = (period / 2.0).tan().recip();
    let square = ((1.0 + e) / 2.0 * cot).powi(2) + ((1.0 - e) / (2.0 * w)).powi(2);
    let half = s * (1.0 + e) / 2.0 * cot;
    let speed = (-half + (half * half - square * (s * s - g * g)).sqrt()) / square;
    // `g cos(phase)` and `-g w sin(phase)` are what the particular solution has at the impact.
    let phase = (-speed * (1.0 - e) / (2.0 * g * w)).atan2((s + speed * (1.0 + e) / 2.0 * cot) / g);
    let acceleration = phase.cos() - s;
    let sum = -2.0 * e * period.cos() + (1.0 + e) * acceleration / speed * period.sin();
    [speed, sum, e * e]
}

/// The oscillator with this stop, driven by `force cos(w t)`.
fn rig(law: Law, force: f64) -> ObservedSystem {
    let model = single_mass(1.0, 1.0, 0.0, false);
    let load = Load { support: vec![], forces: vec![force_at(&model, "mass", 1, force)] };
    let stop = element_at(&model, "mass", law);
    let response = response_of(&model, "mass");
    ObservedSystem { system: System::new(model, &load, vec![stop]).unwrap(), response }
}

/// The same of an orbit that was found.
fn read(orbit: &PeriodicSolution) -> [f64; 3] {
    assert_eq!(orbit.maxima.contacts, 1);
    let [[a, b], [c, d]] = [orbit.floquet_multipliers[0], orbit.floquet_multipliers[1]];
    [orbit.maxima.impact_velocity, a + c, a * c - b * d]
}

/// The same of the orbit with this stop.
fn compliant(law: Law) -> [f64; 3] {
    let rig = rig(law, 1.0);
    read(&find_start(&rig.system, &rig.response, FREQUENCY / TAU, 1, &OrbitSettings::default()).unwrap())
}

/// Largest difference from the rigid stop of `e` at each stiffness, and the slope of its logarithm.
fn convergence(e: f64, stiffnesses: [f64; 2], law: impl Fn(f64) -> Law) -> ([f64; 2], f64) {
    converged(e, stiffnesses, stiffnesses.map(|stiffness| compliant(law(stiffness))))
}

/// The same of what was found with these stiffnesses.
fn converged(e: f64, stiffnesses: [f64; 2], found: [[f64; 3]; 2]) -> ([f64; 2], f64) {
    let rigid = rigid(e);
    let errors = found.map(|found| (0..3).map(|i| (found[i] - rigid[i]).abs()).fold(0.0, f64::max));
    (errors, (errors[1] / errors[0]).ln() / (stiffnesses[1] / stiffnesses[0]).ln())
}

/// Coefficient with which a model lets two bodies alone part with `e`: `(1 + e) c = ln((1 + c)/(1 - e c))`,
/// by bisection.
fn coefficient_for(model: RestitutionModel, e: f64) -> f64 {
    let (mut low, mut high) = (0.05, 0.95);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        let c = model.factor(middle);
        // A factor that is too large leaves less than e.
        let loses_more = e * c >= 1.0 || (1.0 + e) * c < c.ln_1p() - (-e * c).ln_1p();
        if loses_more { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Shooting accepts orbits that are good to 1e-10.
#[test]
fn the_rigid_stop_has_the_closed_form() {
    let found = compliant(Law::Rigid(RigidStop::with_gap(RESTITUTION, GAP).unwrap()));
    for (found, expected) in found.iter().zip(rigid(RESTITUTION)) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
}

/// Lankarani and Nikravesh, and Lee and Wang, take no more than `c = 3/4`, with which 0.58 of the speed is
/// left: they are asked for more.
#[test]
fn stiffer_hertz_contacts_with_restitution_converge_to_the_rigid_stop() {
    for (model, e) in [
        (RestitutionModel::HuntCrossley, RESTITUTION),
        (RestitutionModel::Flores, RESTITUTION),
        (RestitutionModel::Gonthier, RESTITUTION),
        (RestitutionModel::HerbertMcWhannell, RESTITUTION),
        (RestitutionModel::HuGuo, RESTITUTION),
        (RestitutionModel::LankaraniNikravesh, 0.8),
        (RestitutionModel::LeeWang, 0.8),
    ] {
        let coefficient = coefficient_for(model, e);
        let (errors, slope) = convergence(e, [1e8, 1e12], |stiffness| {
            let hertz = HertzStop::with_gap(stiffness, GAP).unwrap();
            Law::Restitution(RestitutionStop::new(hertz, model, coefficient).unwrap())
        });
        assert!(errors[1] < 1e-3, "{model:?}: {errors:?}");
        assert!((slope + 0.4).abs() < 0.01, "{model:?}: {errors:?}, slope {slope}");
    }
}

/// The orbit of `e = 1` with an elastic Hertz stop in place of the rigid one. Nothing damps it, so no motion
/// settles to it: it is corrected from the rigid one, which is the same forwards and backwards about its
/// impact. With the force the other way round that is at half the period, and at phase 0 the mass turns: `x =
/// -g + (s - g) cos(T/2) - V sin(T/2)`.
fn elastic(stiffness: f64) -> [f64; 3] {
    let law = Law::Hertz(HertzStop::with_gap(stiffness, GAP).unwrap());
    let rig = rig(law, -1.0);
    let (half, g) = (PI / FREQUENCY, 1.0 / (1.0 - FREQUENCY * FREQUENCY));
    let turn = -g + (GAP - g) * half.cos() - rigid(1.0)[0] * half.sin();
    let guess = PeriodicSolution {
        frequency_hz: FREQUENCY / TAU,
        period_multiple: 1,
        phase: 0.0,
        nodes: vec![vec![turn, 0.0]],
        floquet_multipliers: vec![[1.0, 0.0]; 2],
        on_circle: Vec::new(),
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    };
    let settings = OrbitSettings::default();
    let range_hz = (0.9 * guess.frequency_hz, 1.1 * guess.frequency_hz);
    let mut walk =
        BranchWalk::new(&rig.system, &rig.response, &guess, Side::Up, range_hz, &settings).unwrap();
    let orbit = walk.start_row().unwrap().solution;
    assert!(orbit.nodes[0][1].abs() < 1e-9, "it turns at phase 0, as the rigid one does: {:?}", orbit.nodes);
    read(&orbit)
}

/// A contact without loss gives the speed back, as a rigid stop with `e = 1` does: multipliers stay on the
/// unit circle, with the product 1.
#[test]
fn stiffer_elastic_hertz_contacts_converge_to_the_rigid_stop_that_loses_nothing() {
    let found = [1e8, 1e12].map(elastic);
    for [.., product] in found {
        assert!((product - 1.0).abs() < 1e-8, "{product}");
    }
    let (errors, slope) = converged(1.0, [1e8, 1e12], found);
    assert!(errors[1] < 1e-3, "{errors:?}");
    assert!((slope + 0.4).abs() < 0.01, "{errors:?}, slope {slope}");
}

/// A spring with a damper that has a fixed part of the critical damping: `e = exp(-(pi - 2 x) tan x)`, `sin
/// x` that part.
#[test]
fn stiffer_springs_with_dampers_converge_to_the_rigid_stop() {
    let restitution = |x: f64| (-(PI - 2.0 * x) * x.tan()).exp();
    let (mut low, mut high) = (0.0, 1.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if restitution(middle) > RESTITUTION { low = middle } else { high = middle }
    }
    let (errors, slope) = convergence(RESTITUTION, [1e6, 1e10], |stiffness: f64| {
        let damping = 2.0 * low.sin() * stiffness.sqrt();
        Law::Linear(LinearStop::with_gap(stiffness, GAP).unwrap().with_damping(damping).unwrap())
    });
    assert!(errors[1] < 1e-3, "{errors:?}");
    assert!((slope + 0.5).abs() < 0.01, "{errors:?}, slope {slope}");
}

/// A stop that stays closed is a spring and a damper more: `|x| = F/|k - m w^2 + i c w|`, and multipliers of
/// modulus `exp(-c T/2)`.
#[test]
fn a_preloaded_stop_that_stays_closed_adds_its_spring_and_its_damper() {
    let (stiffness, damping, force, frequency_hz): (f64, f64, f64, f64) = (3.0, 0.4, 0.2, 0.25);
    let model = single_mass(1.0, 1.0, 0.1, false);
    let load = Load { support: vec![], forces: vec![force_at(&model, "mass", 1, force)] };
    let stop = LinearStop::with_preload(stiffness, 10.0).unwrap().with_damping(damping).unwrap();
    let element = element_at(&model, "mass", Law::Linear(stop));
    let response = response_of(&model, "mass");
    let system = System::new(model, &load, vec![element]).unwrap();
    let orbit = find_start(&system, &response, frequency_hz, 1, &OrbitSettings::default()).unwrap();
    let w = TAU * frequency_hz;
    let amplitude = force / (1.0 + stiffness - w * w).hypot((0.1 + damping) * w);
    // The preload pushes the mass off by `10/(1 + 3)`.
    let expected = amplitude + 2.5;
    assert!((orbit.maxima.displacement - expected).abs() < 1e-8, "{}", orbit.maxima.displacement);
    let [re, im] = orbit.floquet_multipliers[0];
    assert!((re.hypot(im) - (-0.5 * (0.1 + damping) / frequency_hz).exp()).abs() < 1e-9);
}
