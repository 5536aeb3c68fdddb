//! Chatter and sticking of one mass against a recursion of its own: closed form from impact to impact,
//! impacts by sampling and bisection.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{diagonal, element, integrator, model};
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, Stretch, System, law::RigidStop};

/// `x'' + c x' + x = h + f cos(w t)`, `x <= 0`, `x' -> -e x'`.
struct Oscillator {
    damping: f64,
    constant: f64,
    force: f64,
    frequency: f64,
    restitution: f64,
}

impl Oscillator {
    /// Particular solution and its rate.
    fn steady(&self, t: f64) -> [f64; 2] {
        let (w, c) = (self.frequency, self.damping);
        let (real, imaginary) = (1.0 - w * w, c * w);
        let size = self.force / (real * real + imaginary * imaginary);
        let (sin, cos) = (w * t).sin_cos();
        let value = size * (real * cos + imaginary * sin);
        [self.constant + value, size * w * (imaginary * cos - real * sin)]
    }

    /// State at t from a state at t_0.
    fn fly(&self, t: f64, t_0: f64, state: [f64; 2]) -> [f64; 2] {
        let ([p, v], [p_0, v_0]) = (self.steady(t), self.steady(t_0));
        let (q, s, half) = (state[0] - p_0, state[1] - v_0, 0.5 * self.damping);
        let root = (1.0 - half * half).sqrt();
        let (sin, cos) = (root * (t - t_0)).sin_cos();
        let decay = (-half * (t - t_0)).exp();
        let slope = (s + half * q) / root;
        [p + decay * (q * cos + slope * sin), v + decay * (s * cos - (q + half * s) / root * sin)]
    }

    /// The first impact after t_0, by samples of a part of the time in which the load could bring the mass
    /// back, and bisection.
    fn next_impact(&self, t_0: f64, state: [f64; 2], end: f64) -> Option<f64> {
        let most = self.constant.abs() + self.force.abs() + 1.0;
        let first = (0.2 * state[1].abs() / most).clamp(1e-13, 1e-3);
        let mut before = t_0 + 0.5 * first;
        while before < end {
            let after = before + (0.1 * (before - t_0)).clamp(first, 1e-3);
            if self.fly(after, t_0, state)[0] > 0.0 {
                let (mut low, mut high) = (before, after);
                for _ in 0..80 {
                    let middle = 0.5 * (low + high);
                    if self.fly(middle, t_0, state)[0] > 0.0 { high = middle } else { low = middle }
                }
                return Some(low).filter(|time| *time < end);
            }
            before = after;
        }
        None
    }

    /// State at the end, number of impacts before the mass first stuck, and the times at which it stuck and
    /// was let go for the first time.
    fn advance(&self, mut state: [f64; 2], end: f64) -> ([f64; 2], [f64; 2]) {
        let (mut time, mut first) = (0.0, [f64::NAN; 2]);
        while let Some(impact) = self.next_impact(time, state, end) {
            let speed = self.fly(impact, time, state)[1];
            (time, state) = (impact, [0.0, -self.restitution * speed]);
            let press = self.constant + self.force * (self.frequency * time).cos();
            if press > 0.0 && speed < 1e-8 {
                // The rest of the chatter takes no time, and the mass stays until the load turns.
                let gone = (-self.constant / self.force).acos() / self.frequency;
                let period = TAU / self.frequency;
                let left = gone + period * ((time - gone) / period).ceil();
                if first[0].is_nan() {
                    first = [time, left];
                }
                if left >= end {
                    return ([0.0, 0.0], first);
                }
                // From rest with no acceleration: the first instants are a parabola of third order, which the
                // sampling would not tell from zero.
                let jerk = self.force * self.frequency * (self.frequency * left).sin();
                let instant = 1e-4;
                (time, state) = (left + instant, self.fly(left + instant, left, [0.0, 0.0]));
                assert!(state[0] < 0.0 && jerk > 0.0);
            }
        }
        (self.fly(end, time, state), first)
    }
}

#[test]
fn chatter_and_sticking_are_those_of_the_recursion() {
    for (restitution, force, frequency) in [(0.6, 1.0, 0.4), (0.3, 1.5, 0.9), (0.75, 2.0, 0.5)] {
        let own = Oscillator { damping: 0.1, constant: 0.2, force, frequency, restitution };
        let load = |order, amplitude| HarmonicForce {
            shape: vec![1.0],
            harmonic: Harmonic { order, amplitude, phase: 0.0 },
        };
        let load = Load { support: vec![], forces: vec![load(0, 0.2), load(1, force)] };
        let stop = element(&[1.0], 0.0, Law::Rigid(RigidStop::with_gap(restitution, 0.0).unwrap()));
        let system = System::new(model(&[1.0], diagonal(&[0.1])), &load, vec![stop]).unwrap();
        let mut exact = integrator(&system);
        let frequency_hz = frequency / TAU;
        for cycles in [0.4, 0.9, 1.3, 2.2] {
            let stretch = Stretch { frequency_hz, start: 0.0, end: cycles };
            let trace = exact.trace(&stretch, &[-0.5, 0.3], &[]).unwrap();
            let (expected, [stuck, left]) = own.advance([-0.5, 0.3], stretch.duration());
            for (found, expected) in trace.state.iter().zip(expected) {
                assert!((found - expected).abs() < 1e-9, "{cycles}: {:?} {expected:?}", trace.state);
            }
            let held = trace.contacts.iter().find(|contact| contact.peak_force > 0.0);
            assert_eq!(held.is_some(), !stuck.is_nan());
            if let Some(held) = held {
                // Both cut the chatter, at other speeds.
                assert!((held.begin.as_ref().unwrap().time - stuck).abs() < 1e-5);
                assert!(held.end.is_none_or(|end| (end - left).abs() < 1e-12));
            }
        }
    }
}
