//! The largest displacement and acceleration of the response point in a flight.
//!
//! Both are sums of known functions with a known bound `B` on their second derivative: over an interval of length h they
//! exceed the larger end value by at most `B h^2/8`. Intervals that cannot beat the best value so far are dropped, the
//! others halved, with Newton's method on the derivative: where the interval is proved concave and the method settles inside
//! it, the maximum is found; elsewhere halving goes on down to [`ACCURACY`].

use super::{ExactIntegrator, block::Propagator};

/// Relative accuracy to which maxima in flight are enclosed.
const ACCURACY: f64 = 1e-12;

/// A flight that was flown.
#[derive(Debug, Clone)]
pub(super) struct Flown {
    /// The stretch it is in.
    pub piece: usize,
    pub start: f64,
    pub duration: f64,
    pub state: Vec<f64>,
    /// Elements that were held on rigid stops.
    pub held: Vec<usize>,
}

impl ExactIntegrator {
    /// Largest magnitude of displacement (0) or acceleration (2) of an output over a flight, not below `best`.
    pub(super) fn flight_maximum(
        &self,
        flown: &Flown,
        (output, derivative): (usize, usize),
        best: f64,
    ) -> f64 {
        let flight = FlightFunction::new(self, flown, (output, derivative));
        let mut best = best;
        if flight.largest <= best {
            return best;
        }
        let (first, last) = (flight.at(0.0), flight.at(flown.duration));
        best = best.max(first.0.abs()).max(last.0.abs());
        // Short enough for the curvature to add a tenth of the best, and at most four thousand intervals to begin with.
        let spacing = if flight.bound > 0.0 { (0.8 * best / flight.bound).sqrt() } else { flown.duration };
        let count = (flown.duration / spacing).ceil().clamp(1.0, 4096.0) as usize;
        let values = flight.on_grid(count);
        best = values.iter().fold(best, |best, value| best.max(value.abs()));
        let width = flown.duration / count as f64;
        for (i, ends) in values.windows(2).enumerate() {
            flight.refine(
                (i as f64 * width, ends[0].abs()),
                ((i + 1) as f64 * width, ends[1].abs()),
                &mut best,
            );
        }
        best
    }
}

/// A function of the time of a flight: an output or its second derivative.
struct FlightFunction<'a> {
    integrator: &'a ExactIntegrator,
    flown: &'a Flown,
    output: usize,
    derivative: usize,
    /// Rows of the function and of its first two derivatives.
    rows: [Vec<f64>; 3],
    /// Bound on the second derivative of the function.
    bound: f64,
    /// Bound on the third derivative of the function; infinite where none is known.
    third: f64,
    /// Bound on the function.
    largest: f64,
}

impl<'a> FlightFunction<'a> {
    fn new(integrator: &'a ExactIntegrator, flown: &'a Flown, (index, derivative): (usize, usize)) -> Self {
        let (output, blocks, drive) = (&integrator.outputs[index], &integrator.blocks, &integrator.drive);
        let n = blocks.count();
        let until = flown.start + flown.duration;
        let mut row = output.row.clone();
        (0..derivative).for_each(|_| row = blocks.row_times_system(&row));
        let slope = blocks.row_times_system(&row);
        let curvature = blocks.row_times_system(&slope);
        let energy = |factors: &[f64]| {
            let norm =
                |i: usize| (blocks.stiffness[i] * flown.state[i].powi(2) + flown.state[n + i].powi(2)).sqrt();
            (0..n).map(|i| factors[i] * norm(i)).sum::<f64>()
        };
        let driven = drive.bounds(index, output, until);
        let second = energy(&output.second_bound) + driven.0;
        let (bound, third, largest) = if derivative == 0 {
            (second, energy(&output.third_bound) + driven.1, f64::INFINITY)
        } else {
            let fourth = energy(&output.fourth_bound) + drive.fourth_bound(index, output, until);
            (fourth, f64::INFINITY, second)
        };
        Self {
            integrator,
            flown,
            output: index,
            derivative,
            rows: [row, slope, curvature],
            bound,
            third,
            largest,
        }
    }

    /// Function and its first two derivatives at `time` after the start of the flight.
    fn at(&self, time: f64) -> (f64, f64, f64) {
        let blocks = &self.integrator.blocks;
        let n = blocks.count();
        let mut sums = self.driven(time);
        for i in 0..n {
            let propagator = Propagator::new(blocks.stiffness[i], blocks.damping[i], time);
            let (p, s) = propagator.apply(self.flown.state[i], self.flown.state[n + i]);
            for (sum, row) in sums.iter_mut().zip(&self.rows) {
                *sum += row[i] * p + row[n + i] * s;
            }
        }
        (sums[0], sums[1], sums[2])
    }

    /// Particular part of the function and of its first two derivatives (those of the acceleration by differences suffice: they
    /// only steer Newton's method).
    fn driven(&self, time: f64) -> [f64; 3] {
        let output = &self.integrator.outputs[self.output];
        let jet = |t: f64| self.integrator.drive.jet(self.output, output, self.flown.start + t);
        if self.derivative == 0 {
            let here = jet(time);
            return [here.value, here.slope, here.curvature];
        }
        let step = 1e-3 / self.integrator.drive.circular_frequency();
        let (before, here, after) =
            (jet(time - step).curvature, jet(time).curvature, jet(time + step).curvature);
        [here, (after - before) / (2.0 * step), (after - 2.0 * here + before) / (step * step)]
    }

    /// The function at `count + 1` equal steps over the flight.
    fn on_grid(&self, count: usize) -> Vec<f64> {
        let blocks = &self.integrator.blocks;
        let n = blocks.count();
        let step = self.flown.duration / count as f64;
        let propagators: Vec<Propagator> =
            (0..n).map(|i| Propagator::new(blocks.stiffness[i], blocks.damping[i], step)).collect();
        let mut state = self.flown.state.clone();
        let mut values = Vec::with_capacity(count + 1);
        for place in 0..=count {
            let jet = self.integrator.drive.jet(
                self.output,
                &self.integrator.outputs[self.output],
                self.flown.start + place as f64 * step,
            );
            let mut value = if self.derivative == 0 { jet.value } else { jet.curvature };
            for i in 0..n {
                value += self.rows[0][i] * state[i] + self.rows[0][n + i] * state[n + i];
                (state[i], state[n + i]) = propagators[i].apply(state[i], state[n + i]);
            }
            values.push(value);
        }
        values
    }

    /// Raises `best` to the largest magnitude in an interval, given the magnitudes at its ends.
    fn refine(&self, (a, at_a): (f64, f64), (b, at_b): (f64, f64), best: &mut f64) {
        let excess = self.bound * (b - a) * (b - a) / 8.0;
        if at_a.max(at_b) + excess <= *best * (1.0 + ACCURACY) || b - a <= f64::EPSILON * b {
            return;
        }
        let middle = 0.5 * (a + b);
        let mut time = middle;
        let mut value = self.at(middle);
        let at_middle = value.0.abs();
        *best = best.max(at_middle);
        // Concave all over the interval: the maximum that Newton's method settles at is the only one.
        let concave = value.0.signum() * value.2 + 0.5 * self.third * (b - a) < 0.0;
        let mut settled = false;
        for _ in 0..8 {
            if value.0 * value.2 >= 0.0 {
                break;
            }
            let step = -value.1 / value.2;
            time += step;
            if !(a..=b).contains(&time) {
                break;
            }
            value = self.at(time);
            *best = best.max(value.0.abs());
            if step.abs() <= 1e-7 * (b - a) {
                settled = true;
                break;
            }
        }
        if concave && settled {
            return;
        }
        self.refine((a, at_a), (middle, at_middle), best);
        self.refine((middle, at_middle), (b, at_b), best);
    }
}

#[cfg(test)]
mod tests {
    use faer::Mat;
    use hammerbeam_structure::{PointOutput, ReducedModel};

    use crate::{
        Load, Stretch, System,
        exact::{ExactIntegrator, ExactSettings},
    };

    /// Free vibration `A cos(t + p)` over many durations and phases: the largest displacement is 1 where `cos` passes an
    /// extremum, else the larger end value.
    #[test]
    fn largest_displacement_of_a_cosine_is_the_closed_form_for_every_phase_and_duration() {
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratio: 0.0 }],
            support: None,
            uniform_acceleration: vec![1.0],
        };
        let system = System::new(model, &Load::default(), Vec::new()).unwrap();
        let mut integrator =
            ExactIntegrator::watching(system, ExactSettings::default(), Some((&[1.0], 0.0))).unwrap();
        for k in 0..4000 {
            let phase = std::f64::consts::PI * f64::from(k % 199) / 199.0;
            let duration = 0.01 + 4.0 * f64::from(k % 251) / 251.0;
            let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end: duration };
            let maxima = integrator.observe(&[(stretch, &[phase.cos(), -phase.sin()])]).unwrap();
            let passes = phase + duration >= std::f64::consts::PI || phase == 0.0;
            let exact = if passes { 1.0 } else { phase.cos().abs().max((phase + duration).cos().abs()) };
            assert!(
                (maxima.displacement - exact).abs() < 1e-8,
                "{phase} {duration}: {} {exact}",
                maxima.displacement
            );
        }
    }
}
