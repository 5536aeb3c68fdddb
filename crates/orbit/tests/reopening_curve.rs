//! A curve of flips that comes to the reopening of a contact: beyond it the contact opens and is pressed on
//! again at once, so that its flight, and with it the steps of the curve, shrink to nothing.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System,
    law::{HertzStop, RestitutionModel, RestitutionStop},
};
use hammerbeam_orbit::{
    CurveEnd, CurveKind, CurveSettings, CurveWalk, OrbitMaxima, OrbitSettings, PeriodicSolution, Response,
    Side,
};
use hammerbeam_structure::ReducedModel;

const MASS: f64 = 1.733;
/// Next to the end of the curve, which this is a row of.
const GAP: f64 = 0.40378398548294736;
/// More than it takes, and few enough to fail soon.
const MOST_ROWS: usize = 200;

/// A mass on a spring above a stop, which it strikes four times in two periods of the force.
fn bouncing() -> (System, Response) {
    let shape = 1.0 / MASS.sqrt();
    let model = ReducedModel {
        natural_frequencies: vec![(2.51 / MASS).sqrt()],
        damping: faer::mat![[0.05 / MASS]],
        points: vec![],
        supports: vec![],
        uniform_acceleration: vec![MASS.sqrt()],
    };
    let harmonic = Harmonic { order: 1, amplitude: 1.29, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![shape], harmonic }] };
    let elastic = HertzStop::with_gap(29.87, GAP).unwrap();
    let law = RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, 0.66).unwrap();
    let law = Law::Restitution(law);
    let stop = LocalElement { name: "stop".into(), shape: vec![-shape], support_ratios: vec![0.0], law };
    (
        System::new(model, &load, vec![stop]).unwrap(),
        Response { shape: vec![shape], support_ratios: vec![0.0] },
    )
}

#[test]
fn a_curve_ends_where_a_contact_splits() {
    let (system, response) = bouncing();
    let start = PeriodicSolution {
        frequency_hz: 0.06722472483193466,
        period_multiple: 2,
        phase: 0.0,
        nodes: vec![vec![0.713918680574752, -0.1815670869739648]],
        floquet_multipliers: vec![],
        on_circle: Vec::new(),
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    };
    let settings = CurveSettings {
        parameter: Parameter::gap(0),
        range: (0.15, 0.6),
        range_hz: (0.06, 0.12),
        max_step: 0.5,
        max_rows: MOST_ROWS,
    };
    let (kind, orbits) = (CurveKind::Flip, OrbitSettings::default());
    let mut walk = CurveWalk::new(&system, &response, &start, (kind, Side::Up), &settings, &orbits).unwrap();
    let end = loop {
        if let Err(end) = walk.step().unwrap() {
            break end;
        }
    };
    let CurveEnd::ContactReopens { parameter, element, phase } = end else { panic!("{end:?}") };
    assert_eq!(element, "stop");
    // The last contact of the four begins with a ten-thousandth of the speed of the others, at this phase.
    assert!((phase - 0.4919).abs() < 1e-3, "{phase}");
    assert!((GAP..GAP + 1e-4).contains(&parameter), "{parameter}");
}
