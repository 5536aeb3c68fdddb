//! No contact of a free flight is missed, and none is invented: random flights against dense sampling with
//! refinement.
//!
//! The sampling is a closed form of its own. Levels are set at distances from the highest point of the flight
//! down to 1e-13 m, with displacements of millimetres: rounding decides only below some 1e-16 m.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{diagonal, element, model};
use faer::c64;
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, Stretch, System,
    law::{HertzStop, LinearStop},
};
use proptest::{prelude::*, test_runner::RngSeed};

/// A random flight of a linear structure.
#[derive(Debug, Clone)]
struct Flight {
    frequency_hz: f64,
    modes: Vec<Mode>,
    /// Orders and phases of two harmonic forces.
    loads: [(u32, f64); 2],
}

#[derive(Debug, Clone)]
struct Mode {
    frequency: f64,
    ratio: f64,
    shape: f64,
    /// Displacement and velocity at the start, displacements per frequency in millimetres.
    start: [f64; 2],
    /// Amplitudes of the forces, as static displacements.
    load: [f64; 2],
}

impl Flight {
    /// Displacement at a time, its velocity and its acceleration.
    fn at(&self, time: f64) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for mode in &self.modes {
            let [q, v] = mode.start;
            let mut homogeneous = [q, v];
            for (amplitude, omega) in self.steady(mode) {
                homogeneous[0] -= amplitude.re;
                homogeneous[1] += amplitude.im * omega;
                let turned = amplitude * c64::new((omega * time).cos(), (omega * time).sin());
                sum[0] += mode.shape * turned.re;
                sum[1] -= mode.shape * omega * turned.im;
                sum[2] -= mode.shape * omega * omega * turned.re;
            }
            let (decay, damped) =
                (mode.ratio * mode.frequency, mode.frequency * (1.0 - mode.ratio * mode.ratio).sqrt());
            let root = c64::new(-decay, damped);
            let coefficient = c64::new(homogeneous[0], -(homogeneous[1] + decay * homogeneous[0]) / damped);
            let turned =
                coefficient * c64::new((damped * time).cos(), (damped * time).sin()) * (-decay * time).exp();
            for (derivative, factor) in [c64::new(1.0, 0.0), root, root * root].into_iter().enumerate() {
                sum[derivative] += mode.shape * (turned * factor).re;
            }
        }
        sum
    }

    /// Steady amplitudes of a mode with their circular frequencies.
    fn steady(&self, mode: &Mode) -> [(c64, f64); 2] {
        std::array::from_fn(|k| {
            let (order, phase) = self.loads[k];
            let omega = TAU * self.frequency_hz * f64::from(order);
            let force = c64::new(phase.cos(), if order == 0 { 0.0 } else { phase.sin() })
                * (mode.load[k] * mode.frequency * mode.frequency);
            let stiffness = mode.frequency * mode.frequency;
            (force / c64::new(stiffness - omega * omega, 2.0 * mode.ratio * mode.frequency * omega), omega)
        })
    }

    fn fastest(&self) -> f64 {
        let load = TAU * self.frequency_hz * f64::from(self.loads[0].0.max(self.loads[1].0));
        self.modes.iter().map(|mode| mode.frequency).fold(load, f64::max)
    }

    /// Dense samples over one cycle: forty to a turn of the fastest component.
    fn samples(&self) -> Vec<(f64, [f64; 3])> {
        let duration = 1.0 / self.frequency_hz;
        let count = (40.0 * self.fastest() * duration / TAU).ceil().max(100.0) as usize;
        (0..=count).map(|k| k as f64 / count as f64 * duration).map(|time| (time, self.at(time))).collect()
    }

    /// The highest point over one cycle, maxima refined by Newton's method, and when; `None` unless it is
    /// inside and well above the start.
    fn highest(&self) -> Option<(f64, f64)> {
        let samples = self.samples();
        let mut best = (0.0, f64::NEG_INFINITY);
        for window in samples.windows(2) {
            let [(before, [_, rising, _]), (after, [_, falling, _])] = [window[0], window[1]];
            if rising > 0.0 && falling <= 0.0 {
                let mut time = 0.5 * (before + after);
                for _ in 0..40 {
                    let [_, velocity, acceleration] = self.at(time);
                    time = (time - velocity / acceleration).clamp(before, after);
                }
                let height = self.at(time)[0];
                if height > best.1 {
                    best = (time, height);
                }
            }
        }
        let end = samples[samples.len() - 1].1[0].max(samples[0].1[0]);
        (best.1 > end + 1e-5).then_some(best)
    }

    /// The system with a stop at this level.
    fn system(&self, level: f64, hertz: bool) -> System {
        let of = |f: &dyn Fn(&Mode) -> f64| self.modes.iter().map(f).collect::<Vec<f64>>();
        let frequencies = of(&|mode| mode.frequency);
        let damping = diagonal(&of(&|mode| 2.0 * mode.ratio * mode.frequency));
        let forces = (0..2)
            .map(|k| HarmonicForce {
                shape: of(&|mode| mode.load[k] * mode.frequency * mode.frequency),
                harmonic: Harmonic { order: self.loads[k].0, amplitude: 1.0, phase: self.loads[k].1 },
            })
            .collect();
        let law = if hertz {
            Law::Hertz(HertzStop::with_gap(1e6, level).unwrap())
        } else {
            Law::Linear(LinearStop::with_gap(1e3, level).unwrap())
        };
        let load = Load { support: vec![], forces };
        System::new(model(&frequencies, damping), &load, vec![element(&of(&|mode| mode.shape), 0.0, law)])
            .unwrap()
    }

    /// Number of contacts from the start up to `time`.
    fn contacts(&self, level: f64, time: f64, hertz: bool) -> u32 {
        let system = self.system(level, hertz);
        let state: Vec<f64> =
            (0..2).flat_map(|part| self.modes.iter().map(move |mode| mode.start[part])).collect();
        let mut exact = crate::common::integrator(&system);
        let stretch = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: time * self.frequency_hz };
        exact.advance(&stretch, &state).unwrap();
        exact.touches()[0]
    }
}

prop_compose! {
    fn modes()(frequency in 1.0f64..4.0, ratio in prop_oneof![Just(0.0), 0.0f64..0.1, 0.1f64..0.9],
               shape in -2.0f64..2.0, start in [-1.0f64..1.0, -1.0f64..1.0],
               load in [-1.0f64..1.0, -1.0f64..1.0])
              -> Mode {
        let frequency = TAU * 10f64.powf(frequency);
        // Faster modes are smaller, as in structures.
        let size = 1e-2 / (frequency / 10.0).powf(1.2);
        let start = [size * start[0], size * start[1] * frequency];
        Mode { frequency, ratio, shape, start, load: load.map(|l| size * l) }
    }
}

prop_compose! {
    fn flights()(frequency_hz in 5.0f64..60.0, modes in prop::collection::vec(modes(), 1..7),
                 loads in [(0u32..4, 0.0f64..TAU), (1u32..8, 0.0f64..TAU)]) -> Flight {
        Flight { frequency_hz, modes, loads }
    }
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(7),
        failure_persistence: None,
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// A stop just below the highest point is struck, one just above it is not.
    #[test]
    fn a_flight_touches_what_it_reaches_and_nothing_else(flight in flights(), hertz in any::<bool>()) {
        let highest = flight.highest();
        prop_assume!(highest.is_some_and(|(_, height)| height > 1e-5));
        let (_, height) = highest.unwrap();
        let end = 1.0 / flight.frequency_hz;
        for distance in [1e-6, 1e-9, 1e-11, 1e-12, 1e-13] {
            prop_assert_eq!(flight.contacts(height + distance, end, hertz), 0, "{:e} above", distance);
            prop_assert!(flight.contacts(height - distance, end, hertz) > 0, "{distance:e} below");
        }
    }

    /// The first crossing of a level is found when it happens.
    #[test]
    fn the_first_contact_is_found_in_time(flight in flights(), part in 0.01f64..0.99) {
        let highest = flight.highest();
        let start = flight.at(0.0)[0];
        prop_assume!(highest.is_some_and(|(_, height)| height > start.max(0.0) + 1e-5));
        let level = start.max(0.0) + part * (highest.unwrap().1 - start.max(0.0));
        let samples = flight.samples();
        let after = samples.iter().position(|(_, at)| at[0] > level).unwrap();
        let (mut low, mut high) = (samples[after - 1].0, samples[after].0);
        // A crossing between two samples that are both below would come earlier: the search below would then
        // fail.
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if flight.at(middle)[0] > level { high = middle } else { low = middle }
        }
        let window = 1e-9 / flight.frequency_hz;
        prop_assume!(flight.at(high)[1] > 1e-6);
        prop_assert_eq!(flight.contacts(level, low - window, true), 0);
        prop_assert_eq!(flight.contacts(level, high + window, true), 1);
    }
}
