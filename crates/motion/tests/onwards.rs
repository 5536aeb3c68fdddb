//! Flows that go on within a contact whose law remembers its impact: chained, they are the flow over the
//! whole.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{beam_with, integrator, settled};
use hammerbeam_motion::{
    Law, Stretch,
    exact::MotionError,
    law::{HertzStop, RestitutionModel, RestitutionStop},
};

/// The beam over a cycle that begins in flight, cut into pieces many of which begin and end within contacts:
/// the product of their matrices is the matrix of the whole, which needs no memory.
#[test]
fn chained_flows_have_the_matrix_of_the_whole() {
    for (stiffness, model, e, frequency_hz) in [
        (1e6, RestitutionModel::LankaraniNikravesh, 0.5, 36.0),
        (1e7, RestitutionModel::Flores, 0.6, 41.0),
        (3e7, RestitutionModel::Gonthier, 0.7, 28.0),
    ] {
        let elastic = HertzStop::with_gap(stiffness, 0.0).unwrap();
        let system = beam_with(0.015, Law::Restitution(RestitutionStop::new(elastic, model, e).unwrap()));
        let n = 2 * system.dof();
        let relative = |state: &[f64]| -> f64 {
            state.iter().zip(&system.elements()[0].shape).map(|(q, phi)| q * phi).sum()
        };
        let start = (0..40)
            .map(|k| f64::from(k) / 40.0)
            .find(|phase| relative(&settled(&system, frequency_hz, 30, *phase)) < -1e-4)
            .unwrap();
        let state = settled(&system, frequency_hz, 30, start);
        let stretch = Stretch { frequency_hz, start, end: start + 1.0 };
        let whole = integrator(&system).flow(&stretch, &state).unwrap();
        let (mut exact, parts) = (integrator(&system), 96);
        let (mut at, mut product) = (state, faer::Mat::<f64>::identity(n, n));
        let mut inside = 0;
        for part in 0..parts {
            let phase = |part: i32| start + f64::from(part) / f64::from(parts);
            let stretch = Stretch { frequency_hz, start: phase(part), end: phase(part + 1) };
            if relative(&at) > 1e-7 {
                inside += 1;
                let refused = exact.flow(&stretch, &at).unwrap_err();
                assert!(matches!(refused, MotionError::StartsInContact { .. }), "{refused}");
            }
            let flow = exact.flow_onwards(&stretch, &at).unwrap();
            product = flow.by_state * product;
            at = flow.state;
        }
        assert!(inside > 1, "{model:?}: {inside} pieces begin within a contact");
        let largest = whole.by_state.norm_max();
        let error = (product - &whole.by_state).norm_max() / largest;
        // Each piece has the tolerance of the integrator.
        assert!(error < 1e-8, "{model:?}: {error:e}");
    }
}
