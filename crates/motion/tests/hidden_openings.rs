//! Contacts that open for an instant while the excitation acts, against the closed form of the piecewise
//! linear oscillator.
//!
//! `x'' + c x' + x + k max(x, 0) = a cos(w t + b)`: linear while the contact is open, and while it is closed.
//! The motion is put down at a bottom, `x = -opening`, `x' = 0`, and followed both ways in closed form.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{diagonal, element, model};
use hammerbeam_motion::{
    Flow, Harmonic, HarmonicForce, Law, Load, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::LinearStop,
};

const DAMPING: f64 = 0.1;
const AMPLITUDE: f64 = 1.0;

#[derive(Debug, Clone, Copy)]
struct Oscillator {
    stiffness: f64,
    frequency_hz: f64,
    /// Of the load at the time 0, at which the displacement is lowest.
    phase: f64,
}

/// A motion in one of the two regimes.
#[derive(Debug, Clone, Copy)]
struct Piece {
    oscillator: Oscillator,
    /// Of both springs, if both act.
    stiffness: f64,
    /// Time, displacement and velocity.
    from: (f64, [f64; 2]),
}

impl Piece {
    fn particular(&self, time: f64) -> [f64; 2] {
        let w = TAU * self.oscillator.frequency_hz;
        let (real, imaginary) = (self.stiffness - w * w, w * DAMPING);
        let size = AMPLITUDE / (real * real + imaginary * imaginary);
        let (sine, cosine) = (w * time + self.oscillator.phase).sin_cos();
        let (a, b) = (size * real, size * imaginary);
        [a * cosine + b * sine, w * (b * cosine - a * sine)]
    }

    /// What a deviation becomes over a time.
    fn turned(&self, time: f64) -> [[f64; 2]; 2] {
        let (d, decay) = (0.5 * DAMPING, (-0.5 * DAMPING * time).exp());
        let w = (self.stiffness - d * d).sqrt();
        let (sine, cosine) = (w * time).sin_cos();
        let (c, s) = (decay * cosine, decay * sine / w);
        [[c + d * s, s], [-self.stiffness * s, c - d * s]]
    }

    fn at(&self, time: f64) -> [f64; 2] {
        let (start, here) = (self.particular(self.from.0), self.particular(time));
        let deviation = [self.from.1[0] - start[0], self.from.1[1] - start[1]];
        let turned = self.turned(time - self.from.0);
        std::array::from_fn(|i| here[i] + turned[i][0] * deviation[0] + turned[i][1] * deviation[1])
    }
}

fn times(a: [[f64; 2]; 2], b: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    std::array::from_fn(|i| std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j]))
}

/// Start, end and the derivative of the end by the start.
type Passage = ([f64; 2], [f64; 2], [[f64; 2]; 2]);

/// Such a motion from `before` the bottom to `behind` it: start, end and the derivative of the end by the
/// start; `None` where the contact opens once more.
fn closed_form(oscillator: Oscillator, opening: f64, (before, behind): (f64, f64)) -> Option<Passage> {
    let flight = Piece { oscillator, stiffness: 1.0, from: (0.0, [-opening, 0.0]) };
    let acceleration = AMPLITUDE * oscillator.phase.cos() + opening;
    let crossing = |side: f64| {
        let mut time = side * (2.0 * opening / acceleration).sqrt();
        for _ in 0..20 {
            let [x, v] = flight.at(time);
            time -= x / v;
        }
        time
    };
    let (opens, closes) = (crossing(-1.0), crossing(1.0));
    let pressed = |time: f64| Piece {
        oscillator,
        stiffness: 1.0 + oscillator.stiffness,
        from: (time, [0.0, flight.at(time)[1]]),
    };
    let (first, last) = (pressed(opens), pressed(closes));
    let stays = |piece: Piece, end: f64| {
        (1..=400)
            .all(|k| piece.at(piece.from.0 + (end - piece.from.0) * f64::from(k) / 400.0)[0] > 1e-3 * opening)
    };
    let derivative = times(
        last.turned(behind - closes),
        times(flight.turned(closes - opens), first.turned(opens + before)),
    );
    (stays(first, -before) && stays(last, behind)).then(|| (first.at(-before), last.at(behind), derivative))
}

/// The same by the integrator, and how often the contact closed.
fn computed(oscillator: Oscillator, start: [f64; 2], (before, behind): (f64, f64)) -> (Flow, u32) {
    let shape = vec![1.0];
    let harmonic = Harmonic { order: 1, amplitude: AMPLITUDE, phase: oscillator.phase };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: shape.clone(), harmonic }] };
    let stop = Law::Linear(LinearStop::with_gap(oscillator.stiffness, 0.0).unwrap());
    let system = System::new(model(&[1.0], diagonal(&[DAMPING])), &load, vec![element(&shape, 0.0, stop)]);
    let mut integrator = ExactIntegrator::new(system.unwrap(), ExactSettings::default()).unwrap();
    let periods = |time: f64| oscillator.frequency_hz * time;
    // One period later, since stretches do not start before the phase 0.
    let (start_phase, end_phase) = (4.0 - periods(before), 4.0 + periods(behind));
    let stretch = Stretch { frequency_hz: oscillator.frequency_hz, start: start_phase, end: end_phase };
    let flow = integrator.flow(&stretch, &start).unwrap();
    (flow, integrator.touches()[0])
}

/// Numbers in [0, 1) that fill a square evenly.
fn spread(k: u32) -> [f64; 4] {
    [0.754_877_67, 0.569_840_29, 0.819_172_51, 0.671_043_61]
        .map(|step: f64| (0.5 + f64::from(k) * step).fract())
}

#[test]
fn a_contact_that_opens_for_an_instant_while_a_load_acts_is_two() {
    let mut tried = 0;
    for k in 0..60 {
        let [of_stiffness, of_frequency, of_phase, of_times] = spread(k);
        let oscillator = Oscillator {
            stiffness: [0.4, 1.0, 5.0, 30.0][(4.0 * of_stiffness) as usize],
            frequency_hz: 0.03 + 0.12 * of_frequency,
            phase: 2.4 * (of_phase - 0.5),
        };
        let span = 4.0 / (1.0 + oscillator.stiffness).sqrt();
        let times = (span * (0.02 + 0.9 * of_times), span * (0.02 + 0.9 * of_phase));
        for exponent in 4..=28 {
            let opening = 10.0_f64.powf(-0.5 * f64::from(exponent));
            let Some((start, end, derivative)) = closed_form(oscillator, opening, times) else { continue };
            tried += 1;
            let (flow, touches) = computed(oscillator, start, times);
            let case = format!("opening {opening:e} of {oscillator:?} over {times:?}");
            // Less than the error of a step may be none.
            if opening > 3e-11 {
                assert_eq!(touches, 1, "{case}");
            }
            let allowed = 2e-8 + 1e-10 / opening.sqrt();
            for i in 0..2 {
                assert!((flow.state[i] - end[i]).abs() < 2e-10, "{case}: {:?}, not {end:?}", flow.state);
                for j in 0..2 {
                    let error = (flow.by_state[(i, j)] - derivative[i][j]).abs();
                    assert!(opening < 3e-11 || error < allowed, "{case}: {error:e} of {derivative:?}");
                }
            }
        }
    }
    assert!(tried > 500, "{tried}");
}
