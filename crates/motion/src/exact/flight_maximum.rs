//! The largest displacement and acceleration of the response point in a flight.
//!
//! Both are sums of known functions with a known bound `B` on their second derivative: over an interval of
//! length h they exceed the larger end value by at most `B h^2/8`. Intervals that cannot beat the best value
//! so far are dropped, the others halved, with Newton's method on the derivative: where the interval is
//! proved concave and the method settles inside it, the maximum is found; elsewhere halving goes on down to
//! [`ACCURACY`].

use super::ExactIntegrator;

/// Relative accuracy to which maxima in flight are enclosed.
const ACCURACY: f64 = 1e-12;
/// Part of the best value by which an interval of the first grid may exceed its ends.
const EXCESS: f64 = 0.01;
/// Steps of Newton's method to a turn.
const NEWTON: usize = 8;

/// A flight that was flown.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flown<'a> {
    /// The stretch it is in.
    pub piece: usize,
    pub start: f64,
    pub duration: f64,
    /// Homogeneous block state at its start.
    pub state: &'a [f64],
    /// Elements that were held on rigid stops.
    pub held: &'a [usize],
}

impl ExactIntegrator {
    /// Largest magnitude of displacement (0) or acceleration (2) of an output over a flight, not below
    /// `best`.
    pub(super) fn flight_maximum(
        &self,
        flown: &Flown,
        (output, derivative): (usize, usize),
        best: f64,
    ) -> f64 {
        if self.flight_bound(flown, (output, derivative)) <= best {
            return best;
        }
        let flight = FlightFunction::new(self, flown, (output, derivative));
        let ends = [flight.at(0.0).0.abs(), flight.at(flown.duration).0.abs()];
        let mut best = best.max(ends[0]).max(ends[1]);
        // At most four thousand intervals to begin with.
        let count = flight.places(EXCESS * best).min(4096);
        let mut values = flight.on_grid(count);
        values.iter_mut().for_each(|value| *value = value.abs());
        let highest = (0..=count).fold(0, |high, i| if values[i] > values[high] { i } else { high });
        best = best.max(values[highest]);
        let width = flown.duration / count as f64;
        // What is found next to the highest value leaves little of the others.
        let nearest = highest.saturating_sub(1)..(highest + 1).min(count);
        for i in nearest.clone().chain((0..count).filter(|i| !nearest.contains(i))) {
            let place = |i: usize| (i as f64 * width, values[i]);
            flight.refine(place(i), place(i + 1), &mut best);
        }
        best
    }

    /// Bound on the magnitude of displacement (0) or acceleration (2) of an output over a flight: each block
    /// within its energy norm.
    pub(super) fn flight_bound(&self, flown: &Flown, (index, derivative): (usize, usize)) -> f64 {
        let (output, n) = (&self.outputs[index], self.blocks.count());
        let until = flown.start + flown.duration;
        let (factors, mut bound) = if derivative == 0 {
            let driven = self.drive.magnitude(index) + self.drive.secular_magnitude(output, until);
            (&output.value_bound, driven)
        } else {
            (&output.second_bound, self.drive.bounds(index, output, until).0)
        };
        for i in 0..n {
            bound += factors[i] * self.energy_norm(flown.state, i);
            // A rigid block moves on.
            if derivative == 0 && self.blocks.stiffness[i] <= 0.0 {
                let (p, s) = (flown.state[i], flown.state[n + i]);
                bound += output.row[i].abs() * (p.abs() + s.abs() * flown.duration);
            }
        }
        bound
    }
}

/// Where Newton's method comes to a rest of a function of the time of a flight of that duration from near
/// one, and the value there.
///
/// * `at`: the function and its first two derivatives.
pub(super) fn turn_of(at: impl Fn(f64) -> (f64, f64, f64), near: f64, duration: f64) -> (f64, f64) {
    let (mut time, mut value) = (near, at(near));
    for _ in 0..NEWTON {
        let step = -value.1 / value.2;
        if !step.is_finite() {
            break;
        }
        time += step;
        value = at(time);
        if step.abs() <= 1e-9 * duration {
            break;
        }
    }
    (time, value.0)
}

/// A function of the time of a flight: an output or its second derivative.
pub(super) struct FlightFunction<'a> {
    integrator: &'a ExactIntegrator,
    flown: &'a Flown<'a>,
    output: usize,
    derivative: usize,
    /// Rows of the function and of its first two derivatives.
    rows: [&'a [f64]; 3],
    /// Bound on the second derivative of the function.
    bound: f64,
    /// Bound on the third derivative of the function.
    third: f64,
}

impl<'a> FlightFunction<'a> {
    pub fn new(
        integrator: &'a ExactIntegrator,
        flown: &'a Flown<'a>,
        (index, derivative): (usize, usize),
    ) -> Self {
        let (output, drive) = (&integrator.outputs[index], &integrator.drive);
        let until = flown.start + flown.duration;
        let energy = |factors: &[f64]| {
            let blocks = factors.iter().enumerate();
            blocks.map(|(i, factor)| factor * integrator.energy_norm(flown.state, i)).sum::<f64>()
        };
        let (rows, factors, driven) = if derivative == 0 {
            let rows = [&output.row, &output.velocity_row, &output.acceleration_row];
            (rows, [&output.second_bound, &output.third_bound], drive.bounds(index, output, until))
        } else {
            let rows = [&output.acceleration_row, &output.jerk_row, &output.snap_row];
            let driven = (drive.fourth_bound(index, output, until), drive.fifth_bound(index, output, until));
            (rows, [&output.fourth_bound, &output.fifth_bound], driven)
        };
        Self {
            integrator,
            flown,
            output: index,
            derivative,
            rows: rows.map(Vec::as_slice),
            bound: energy(factors[0]) + driven.0,
            third: energy(factors[1]) + driven.1,
        }
    }

    /// Duration of the flight.
    pub fn duration(&self) -> f64 {
        self.flown.duration
    }

    /// Number of equal intervals over which the curvature adds at most this to the values at their ends; one
    /// where nothing bends.
    pub fn places(&self, excess: f64) -> usize {
        let spacing = if self.bound > 0.0 { (8.0 * excess / self.bound).sqrt() } else { self.flown.duration };
        (self.flown.duration / spacing).ceil().max(1.0) as usize
    }

    /// Function and its first two derivatives at `time` after the start of the flight.
    pub fn at(&self, time: f64) -> (f64, f64, f64) {
        let blocks = &self.integrator.blocks;
        let n = blocks.count();
        let mut sums = self.driven(time);
        blocks.for_propagators(time, |i, propagator| {
            let (p, s) = propagator.apply(self.flown.state[i], self.flown.state[n + i]);
            for (sum, row) in sums.iter_mut().zip(&self.rows) {
                *sum += row[i] * p + row[n + i] * s;
            }
        });
        (sums[0], sums[1], sums[2])
    }

    /// Particular part of the function and of its first two derivatives.
    fn driven(&self, time: f64) -> [f64; 3] {
        let (it, time) = (self.integrator, self.flown.start + time);
        let output = &it.outputs[self.output];
        let jet = match self.derivative {
            0 => it.drive.jet(self.output, output, time),
            _ => it.drive.acceleration_jet(self.output, output, time),
        };
        [jet.value, jet.slope, jet.curvature]
    }

    /// The function at `count + 1` equal steps over the flight.
    pub fn on_grid(&self, count: usize) -> Vec<f64> {
        let blocks = &self.integrator.blocks;
        let n = blocks.count();
        let step = self.flown.duration / count as f64;
        let mut propagators = Vec::with_capacity(n);
        blocks.propagators(step, &mut propagators);
        let mut state = self.flown.state.to_vec();
        let mut values = Vec::with_capacity(count + 1);
        for place in 0..=count {
            let mut value = self.driven(place as f64 * step)[0];
            for i in 0..n {
                value += self.rows[0][i] * state[i] + self.rows[0][n + i] * state[n + i];
            }
            blocks.apply(&propagators, &mut state);
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

    /// Free vibration `A cos(t + p)` over many durations and phases: the largest displacement is 1 where
    /// `cos` passes an extremum, else the larger end value.
    #[test]
    fn largest_displacement_of_a_cosine_is_the_closed_form_for_every_phase_and_duration() {
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
            supports: vec![],
            uniform_acceleration: vec![1.0],
        };
        let system = System::new(model, &Load::default(), Vec::new()).unwrap();
        let mut integrator =
            ExactIntegrator::watching(system, ExactSettings::default(), Some((&[1.0], &[0.0]))).unwrap();
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
