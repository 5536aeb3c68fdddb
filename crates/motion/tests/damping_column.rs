//! The column of the flow by the added damping ratio, against the variational equations of the general
//! integrator (not differences), and a closed form.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{element, hertz, modal_damping, model, paper_beam, settled, uniform_beam};
use faer::{Mat, c64};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, Parameter, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    general::{Column, GeneralSettings, Point, VectorField, integrate},
    law::{LinearStop, PowerSpring},
};

/// `dz/dx = g(x, z; p)/f` of a system over the phase x, with its damping ratio as parameter: `dg/dp = [0; -2
/// w_i v_i]`.
///
/// Written for this test from the equations of motion; elements must not move with the support.
struct Damped<'a> {
    system: &'a System,
    frequency_hz: f64,
}

impl Damped<'_> {
    fn displacement(&self, element: usize, state: &[f64]) -> f64 {
        self.system.elements()[element].shape.iter().zip(state).map(|(a, b)| a * b).sum()
    }

    /// Force and slope; of a law of onset 1.5 or a spring, which need no continuation.
    fn add_forces(&self, at: Point<'_>, column: Option<&[f64]>, rate: &mut [f64]) {
        for (e, element) in self.system.elements().iter().enumerate() {
            let force = element.law.force(self.displacement(e, at.state), 0.0);
            let value = column.map_or(force.value, |column| force.slope * self.displacement(e, column));
            rate.iter_mut().zip(&element.shape).for_each(|(r, phi)| *r += value * phi / self.frequency_hz);
        }
    }

    fn add_linear(&self, state: &[f64], rate: &mut [f64]) {
        let (n, model) = (self.system.dof(), self.system.model());
        for i in 0..n {
            let damping: f64 = (0..n).map(|j| model.damping[(i, j)] * state[n + j]).sum();
            rate[i] = state[n + i] / self.frequency_hz;
            rate[n + i] = -(model.natural_frequencies[i].powi(2) * state[i] + damping) / self.frequency_hz;
        }
    }
}

impl VectorField for Damped<'_> {
    fn dimension(&self) -> usize {
        2 * self.system.dof()
    }

    fn parts(&self) -> usize {
        2
    }

    fn raise_magnitudes(&self, _: Column, magnitudes: &mut [f64]) {
        magnitudes[0] = magnitudes[0].max(1e-8);
        magnitudes[1] = magnitudes[1].max(TAU * self.frequency_hz * magnitudes[0]);
    }

    fn evaluate(&mut self, at: Point<'_>, derivative: &mut [f64]) {
        let n = self.system.dof();
        self.add_linear(at.state, derivative);
        for (index, &order) in self.system.orders().iter().enumerate() {
            let load = self.system.modal_load(index, TAU * self.frequency_hz);
            let angle = TAU * f64::from(order) * at.time;
            let turn = c64::new(angle.cos(), angle.sin());
            let amplitudes = derivative[n..].iter_mut().zip(&load.amplitude);
            amplitudes.for_each(|(rate, amplitude)| *rate += (*amplitude * turn).re / self.frequency_hz);
        }
        self.add_forces(at, None, &mut derivative[n..]);
    }

    fn tangents(&mut self, at: Point<'_>, columns: &[f64], derivatives: &mut [f64]) {
        let size = self.dimension();
        for (column, rate) in columns.chunks_exact(size).zip(derivatives.chunks_exact_mut(size)) {
            self.add_linear(column, rate);
            self.add_forces(at, Some(column), &mut rate[size / 2..]);
        }
    }

    fn add_by_parameter(&mut self, at: Point<'_>, _: &[f64], sum: &mut [f64]) {
        let n = self.system.dof();
        for (i, w) in self.system.model().natural_frequencies.iter().enumerate() {
            sum[n + i] -= 2.0 * w * at.state[n + i] / self.frequency_hz;
        }
    }

    fn switches(&self) -> usize {
        self.system.elements().iter().map(|e| e.law.contacts().len()).sum()
    }

    fn switching(&self, _: f64, state: &[f64], values: &mut [f64]) {
        let contacts = self.system.elements().iter().enumerate().flat_map(|(e, element)| {
            let r = self.displacement(e, state);
            element.law.contacts().iter().map(move |c| c.sign * (r - c.level)).collect::<Vec<f64>>()
        });
        values.iter_mut().zip(contacts).for_each(|(value, found)| *value = found);
    }
}

/// Largest error of the column against the variational equations, relative to the largest entry of
/// displacements and of velocities; and how often contacts closed.
fn error(system: &System, stretch: &Stretch, state: &[f64]) -> (f64, u32) {
    let mut integrator = ExactIntegrator::new(system.clone(), ExactSettings { tolerance: 1e-13 }).unwrap();
    integrator.differentiate_by(Some(Parameter::ADDED_DAMPING_RATIO)).unwrap();
    let found = integrator.flow(stretch, state).unwrap().by_parameter;
    let contacts = integrator.touches().iter().sum();
    let mut field = Damped { system, frequency_hz: stretch.frequency_hz };
    let settings = GeneralSettings::with_tolerance(1e-13);
    let expected = integrate(&mut field, stretch.start, stretch.end, state, &settings).unwrap().by_parameter;
    let of_half = |half: std::ops::Range<usize>| {
        let largest = expected[half.clone()].iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        half.map(|i| (found[i] - expected[i]).abs()).fold(0.0, f64::max) / largest
    };
    let n = found.len() / 2;
    (of_half(0..n).max(of_half(n..2 * n)), contacts)
}

const SHAPE: [f64; 3] = [-1.4, 1.1, -0.9];

/// Three modes with a Hertz stop and a cubic spring, under constant and harmonic forces; `damper` couples
/// them.
fn three_modes(frequencies: [f64; 3], (ratio, damper): (f64, f64), laws: &[Law]) -> System {
    let row = [0.5, -0.7, 0.9];
    let modal = modal_damping(&frequencies, ratio);
    let damping = Mat::from_fn(3, 3, |i, j| modal[(i, j)] + damper * row[i] * row[j]);
    let force = |shape: [f64; 3], order, amplitude, phase| HarmonicForce {
        shape: shape.to_vec(),
        harmonic: Harmonic { order, amplitude, phase },
    };
    let forces = vec![
        force([0.6, 0.2, 0.1], 0, -1.0, 0.0),
        force([2.3, 0.4, 0.2], 1, 0.5, 0.4),
        force([0.3, -0.5, 0.4], 3, 0.5, 2.0),
    ];
    let elements = laws.iter().map(|law| element(&SHAPE, 0.0, law.clone())).collect();
    System::new(model(&frequencies, damping), &Load { support: vec![], forces }, elements).unwrap()
}

const STATE: [f64; 6] = [2e-3, 1e-3, -1e-5, -0.15, 0.02, 0.001];

/// From modes as blocks to dampers that make all of them overdamped; with two equal modes, and one that is
/// rigid, on which a constant load acts.
#[test]
fn the_column_solves_the_variational_equations() {
    let laws = [hertz(5e5, 2e-4), Law::Power(PowerSpring::cubic(1e8).unwrap())];
    let stretch = Stretch { frequency_hz: 6.0, start: 0.1, end: 1.05 };
    for frequencies in [[3.5, 23.0, 111.0], [3.5, 23.0, 23.0], [0.0, 23.0, 111.0]] {
        for (ratio, damper) in [(0.02, 0.0), (0.0, 0.0), (0.01, 0.1), (0.01, 3.0), (0.0, 40.0), (0.01, 4e3)] {
            let system = three_modes(frequencies.map(|f| TAU * f), (ratio, damper), &laws);
            let (error, contacts) = error(&system, &stretch, &STATE);
            assert!(contacts > 0, "{frequencies:?} {ratio} {damper}: no contact");
            // Both integrators have a tolerance of 1e-13 a step; 7e-13 was found.
            assert!(error < 1e-11, "{frequencies:?} {ratio} {damper}: {error:e}");
        }
    }
}

/// In resonance the particular solution starts from rest, and drives the change of its own and of other
/// blocks.
#[test]
fn the_column_is_exact_on_eigenfrequencies_of_undamped_and_nearly_undamped_structures() {
    let stretch = Stretch { frequency_hz: 3.5, start: 0.1, end: 2.3 };
    let laws = [hertz(5e5, 2e-4)];
    for frequencies in [[3.5, 23.0, 111.0], [3.5, 10.5, 40.0]] {
        for damper in [0.0, 1e-4, 1e-3] {
            let system = three_modes(frequencies.map(|f| TAU * f), (0.0, damper), &laws);
            let (error, contacts) = error(&system, &stretch, &STATE);
            assert!(
                contacts > 0 && error < 1e-10,
                "{frequencies:?} {damper}: {error:e}, {contacts} contacts"
            );
        }
    }
}

/// The paper's beam over several contacts, and a beam whose high modes make steps too long for the power
/// series.
#[test]
fn the_column_of_beams_solves_the_variational_equations() {
    let paper = paper_beam();
    let stiff = uniform_beam(14);
    for (system, frequency_hz) in [(&paper, 22.0), (&paper, 41.0), (&stiff, 31.0)] {
        let state = settled(system, frequency_hz, 30, 0.0);
        let (error, contacts) = error(system, &Stretch { frequency_hz, start: 0.0, end: 1.0 }, &state);
        assert!(contacts > 0 && error < 1e-9, "{frequency_hz} Hz: {error:e}, {contacts} contacts");
    }
}

/// A linear stop that stays closed takes long smooth steps.
#[test]
fn the_column_is_exact_in_a_permanent_contact() {
    let law = Law::Linear(LinearStop::with_preload(3e4, 30.0).unwrap());
    let system = three_modes([3.5, 23.0, 900.0].map(|f| TAU * f), (0.01, 3.0), &[law]);
    let stretch = Stretch { frequency_hz: 6.0, start: 0.1, end: 1.05 };
    let error = error(&system, &stretch, &STATE.map(|z| 0.1 * z)).0;
    assert!(error < 1e-10, "{error:e}");
}

/// `q'' + 2 z w q' + w^2 q = a cos(w t)` from rest at `z = 0`: `q = a t sin(w t)/(2 w)` and
/// `dq/dz = -(a/4)(t^2 sin(w t) - t cos(w t)/w + sin(w t)/w^2)`, since `s'' + w^2 s = -2 w q'`.
#[test]
fn damping_takes_from_a_resonance_what_the_closed_form_says() {
    let (w, a) = (TAU * 2.0, 3.0);
    let harmonic = Harmonic { order: 1, amplitude: a, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let system = System::new(model(&[w], modal_damping(&[w], 0.0)), &load, vec![]).unwrap();
    let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
    integrator.differentiate_by(Some(Parameter::ADDED_DAMPING_RATIO)).unwrap();
    for cycles in [0.3, 1.0, 7.25] {
        let flow =
            integrator.flow(&Stretch { frequency_hz: 2.0, start: 0.0, end: cycles }, &[0.0, 0.0]).unwrap();
        let t = cycles / 2.0;
        let (sin, cos) = (w * t).sin_cos();
        let q = -0.25 * a * (t * t * sin - t * cos / w + sin / (w * w));
        let v = -0.25 * a * (t * t * w * cos + 3.0 * t * sin);
        assert!(
            (flow.by_parameter[0] - q).abs() < 1e-12 * a * t * t,
            "{cycles}: {:?} {q}",
            flow.by_parameter
        );
        assert!((flow.by_parameter[1] - v).abs() < 1e-12 * a * t * t * w, "{cycles}: {v}");
    }
}
