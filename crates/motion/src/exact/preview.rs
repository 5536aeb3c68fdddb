//! A quick motion through a contact that has just closed: when it opens, and how it moves until then.
//!
//! A force step that ends with a release is solved for its length as well (`event.rs`), from a first guess of
//! it. A guess that is good to 1e-5 of the contact takes two solutions of the step, one that is some percent
//! off three, of many more iterations each. Such a guess costs a fraction of one solution: free motion is
//! exact, and the force acts in impulses, in the composition of order four
//!
//! `K(h/6) E(h/2) K'(2h/3) E(h/2) K(h/6)`, `K(t) x = x + t B F(r)`, `K'` the same with `F + h^2/24 G F' F`,
//!
//! with the mobility `G = C A B` (Chin, Phys. Lett. A 226 (1997), 344-348, scheme A). It holds for one force
//! that depends on its displacement alone. Behind the release the motion is free, so the release is where its
//! Taylor polynomial at the end of the last step vanishes, seen backwards.
//!
//! Nothing of it is in the result: steps are solved, located and accepted as from any other guess.

use super::{ExactIntegrator, flight::clearance_of, propagator::Propagator, run::Run};

/// Steps in the time that a contact is expected to last.
const STEPS: f64 = 14.0;
/// Most steps.
const MOST: usize = 32;
/// Steps of Newton's method to the release.
const NEWTON_STEPS: usize = 4;

/// Displacements of an element through a contact.
#[derive(Debug, Default)]
pub(crate) struct Preview {
    /// Time of the first displacement [s].
    start: f64,
    /// Time between two of them [s].
    spacing: f64,
    displacements: Vec<f64>,
}

impl Preview {
    /// The displacement at a time, by the cubic through four neighbours; `None` outside.
    pub fn at(&self, time: f64) -> Option<f64> {
        let place = (time - self.start) / self.spacing;
        let last = self.displacements.len().checked_sub(4)?;
        if !(0.0..=(last + 3) as f64).contains(&place) {
            return None;
        }
        let first = (place as usize).saturating_sub(1).min(last);
        let x = place - first as f64;
        let [a, b, c, d] = [x, x - 1.0, x - 2.0, x - 3.0];
        let y = &self.displacements[first..first + 4];
        Some((0.5 * a * b * d * -y[2] + 0.5 * a * c * d * y[1]) + (a * b * c * y[3] - b * c * d * y[0]) / 6.0)
    }

    /// Forgets the contact.
    pub fn clear(&mut self) {
        self.displacements.clear();
    }
}

impl ExactIntegrator {
    /// In what time the contact of an element opens that has just closed, and is expected to last `about` so
    /// long; the motion up to there is kept in `run`. `None` where more than that force acts or the load is
    /// resonant, or if it does not open so soon.
    pub(super) fn preview(&mut self, run: &mut Run, element: usize, about: f64) -> Option<f64> {
        let contact = self.closed_contact(run, element)?;
        let is_alone = self.step.active == [element] && !self.step.damped && run.stuck.is_empty();
        if !is_alone || self.laws[element].has_kinks() {
            return None;
        }
        let step = about / STEPS;
        let mut driven = self.drive.equidistant_values(element, run.time, 0.5 * step)?;
        let (law, output, input) = (&self.laws[element], &self.outputs[element], &self.inputs[element]);
        let gradient = step * step / 24.0 * self.mobility[element][element];
        self.blocks.propagators(0.5 * step, &mut self.propagators);
        let (propagators, preview) = (&self.propagators, &mut run.preview);
        let mut state = run.state.clone();
        let mut displacement = run.start[element].jet.value;
        (preview.start, preview.spacing) = (run.time, 0.5 * step);
        preview.displacements.clear();
        preview.displacements.push(displacement);
        let is_open = |displacement: f64| -contact.sign * (displacement - contact.level) > 0.0;
        let mut opens = None;
        for count in 1..=MOST {
            push(input, step / 6.0 * law.force(displacement, 0.0).value, &mut state);
            drift(propagators, &mut state);
            displacement = read(&output.row, &state) + driven.advance();
            preview.displacements.push(displacement);
            let force = law.force(displacement, 0.0);
            push(input, step / 1.5 * force.value * (1.0 + gradient * force.slope), &mut state);
            drift(propagators, &mut state);
            displacement = read(&output.row, &state) + driven.advance();
            preview.displacements.push(displacement);
            push(input, step / 6.0 * law.force(displacement, 0.0).value, &mut state);
            if is_open(displacement) {
                opens = Some(count as f64 * step);
                break;
            }
        }
        let end = opens?;
        let jet = self.output_jet(&state, element, run.time + end);
        let clearance = clearance_of(jet, contact.level, contact.sign);
        let jerk = -contact.sign * read(&output.jerk_row, &state);
        let snap = -contact.sign * read(&output.snap_row, &state);
        let mut back = 0.0;
        for _ in 0..NEWTON_STEPS {
            let rate =
                |t: f64| clearance.slope + t * (clearance.curvature + t * (0.5 * jerk + t * snap / 6.0));
            let value = clearance.value
                + back
                    * (clearance.slope
                        + back * (0.5 * clearance.curvature + back * (jerk / 6.0 + back * snap / 24.0)));
            back -= value / rate(back);
        }
        (back <= 0.0 && back >= -step).then_some(end + back)
    }
}

/// `x += impulse B`.
fn push(input: &[f64], impulse: f64, state: &mut [f64]) {
    state.iter_mut().zip(input).for_each(|(x, entry)| *x += impulse * entry);
}

fn drift(propagators: &[Propagator], state: &mut [f64]) {
    let (positions, velocities) = state.split_at_mut(propagators.len());
    for ((p, s), propagator) in positions.iter_mut().zip(velocities).zip(propagators) {
        (*p, *s) = propagator.apply(*p, *s);
    }
}

fn read(row: &[f64], state: &[f64]) -> f64 {
    row.iter().zip(state).map(|(entry, x)| entry * x).sum()
}

#[cfg(test)]
mod tests {
    use faer::Mat;
    use hammerbeam_structure::ReducedModel;

    use super::*;
    use crate::{
        Law, Load, LocalElement, Stretch, System,
        exact::ExactSettings,
        law::{HertzStop, LinearStop},
    };

    const STRETCH: Stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: 1.0 };

    /// When a free mass of 1 kg leaves a stop that it meets with 1 m/s, by the quick motion, from a forecast
    /// that is off by some percent.
    fn release(law: Law, about: f64) -> f64 {
        let model = ReducedModel {
            damping: Mat::zeros(1, 1),
            natural_frequencies: vec![0.0],
            points: vec![],
            supports: vec![],
            uniform_acceleration: vec![0.0],
        };
        let element = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![0.0], law };
        let system = System::new(model, &Load::default(), vec![element]).unwrap();
        let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
        let mut run = integrator.begin(&STRETCH, &[0.0, 1.0], false).unwrap();
        run.closed[0] = Some(0);
        integrator.note_start(&mut run, 1.0);
        integrator.set_active(&run);
        integrator.preview(&mut run, 0, about).unwrap()
    }

    /// Half a period of the mass on the spring.
    #[test]
    fn the_quick_motion_leaves_a_linear_stop_after_half_a_period() {
        let expected = std::f64::consts::PI / 1e3;
        for off in [0.85, 0.95, 1.0, 1.1] {
            let found = release(Law::Linear(LinearStop::with_gap(1e6, 0.0).unwrap()), off * expected);
            assert!((found / expected - 1.0).abs() < 1e-4, "{off}: {found} {expected}");
        }
    }

    /// Hertz' contact time of an impact: `2 int_0^1 dx/sqrt(1 - x^2.5) = 2.943275` times the depth `(5/(4
    /// K))^0.4` over the speed.
    #[test]
    fn the_quick_motion_leaves_a_hertz_stop_after_the_time_of_hertz() {
        let stiffness: f64 = 1e8;
        let expected = 2.943_275 * (1.25 / stiffness).powf(0.4);
        for off in [0.85, 0.95, 1.0, 1.1] {
            let found = release(Law::Hertz(HertzStop::with_gap(stiffness, 0.0).unwrap()), off * expected);
            assert!((found / expected - 1.0).abs() < 5e-5, "{off}: {found} {expected}");
        }
    }

    #[test]
    fn a_cubic_is_met_between_the_displacements_that_are_kept() {
        let cubic = |t: f64| 1.0 + t * (-2.0 + t * (0.5 + 3.0 * t));
        let (start, spacing) = (2.0, 0.25);
        let displacements = (0..9).map(|k| cubic(spacing * f64::from(k))).collect();
        let preview = Preview { start, spacing, displacements };
        for place in [0.0, 0.1, 0.6, 1.0, 1.7, 2.0] {
            let found = preview.at(start + place).unwrap();
            assert!((found - cubic(place)).abs() < 1e-12, "{place}: {found}");
        }
        assert!(preview.at(start - 1e-3).is_none() && preview.at(start + 2.1).is_none());
        assert!(Preview::default().at(0.0).is_none());
    }
}
