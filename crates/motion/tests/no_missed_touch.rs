//! No contact that closes while forces act is missed, and none is invented: random motions against dense
//! sampling.
//!
//! The motion up to the contact does not know of the stop that it meets, so it is computed without that stop,
//! where nothing is searched for, in short steps, and its highest point is found by Newton's method. A stop
//! is then put at distances from that point down to 1e-10 m. Displacements are millimetres about a preload of
//! up to a tenth of a metre: computations in short and in long steps differ by up to 1e-11 m.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::f64::consts::TAU;

use crate::common::{diagonal, element, model};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
    exact::{ExactIntegrator, ExactSettings},
    law::{HertzStop, LinearStop, PowerSpring},
};
use proptest::{prelude::*, test_runner::RngSeed};

/// A structure whose forces always act, and what a further stop reads.
#[derive(Debug, Clone)]
struct Motion {
    frequency_hz: f64,
    modes: Vec<Mode>,
    /// Order and phase of the load.
    load: (u32, f64),
    active: Active,
}

#[derive(Debug, Clone, Copy)]
struct Mode {
    frequency: f64,
    ratio: f64,
    /// Shapes of the element that always acts and of the further stop.
    shapes: [f64; 2],
    /// Displacement and velocity at the start.
    start: [f64; 2],
    /// Amplitude of the load, as a static displacement.
    load: f64,
}

/// What always acts.
#[derive(Debug, Clone, Copy)]
enum Active {
    /// A cubic spring, as stiff at a millimetre as the first mode times this.
    Cubic(f64),
    /// A stop pressed in so far that it never opens; Hertz (`true`) or linear.
    Preloaded(f64, bool),
}

impl Motion {
    fn active_element(&self) -> LocalElement {
        let stiffness = self.modes[0].frequency.powi(2);
        let law = match self.active {
            Active::Cubic(part) => Law::Power(PowerSpring::cubic(part * stiffness / 1e-6).unwrap()),
            Active::Preloaded(part, true) => {
                // As stiff as `part` of the mode at the depth of 0.1 m.
                let k = part * stiffness / (1.5 * 0.1_f64.sqrt());
                Law::Hertz(HertzStop::with_preload(k, k * 0.1_f64.powf(1.5)).unwrap())
            }
            Active::Preloaded(part, false) => {
                Law::Linear(LinearStop::with_preload(part * stiffness, 0.1 * part * stiffness).unwrap())
            }
        };
        element(&self.of(|mode| mode.shapes[0]), 0.0, law)
    }

    fn of(&self, value: impl Fn(&Mode) -> f64) -> Vec<f64> {
        self.modes.iter().map(value).collect()
    }

    fn system(&self, stop: Option<Law>) -> System {
        let frequencies = self.of(|mode| mode.frequency);
        let damping = diagonal(&self.of(|mode| 2.0 * mode.ratio * mode.frequency));
        let (order, phase) = self.load;
        let mut forces = vec![HarmonicForce {
            shape: self.of(|mode| mode.load * mode.frequency.powi(2)),
            harmonic: Harmonic { order, amplitude: 1.0, phase },
        }];
        let active = self.active_element();
        // The preload is held by a constant force, so that the motion is about the origin.
        let balance = -active.law.force(0.0, 0.0).value;
        forces.push(HarmonicForce {
            shape: self.of(|mode| mode.shapes[0]),
            harmonic: Harmonic { order: 0, amplitude: balance, phase: 0.0 },
        });
        let mut elements = vec![active];
        elements.extend(stop.map(|law| element(&self.of(|mode| mode.shapes[1]), 0.0, law)));
        System::new(model(&frequencies, damping), &Load { support: vec![], forces }, elements).unwrap()
    }

    fn start(&self) -> Vec<f64> {
        let mut state = self.of(|mode| mode.start[0]);
        state.extend(self.of(|mode| mode.start[1]));
        state
    }

    /// The highest point that the further stop reads over one cycle, and when; `None` unless it is inside and
    /// well above both ends.
    fn highest(&self) -> Option<(f64, f64)> {
        let mut sampler = Sampler::new(self);
        let fastest = self.modes.iter().map(|mode| mode.frequency).fold(0.0, f64::max);
        let count = (24.0 * fastest / TAU / self.frequency_hz).ceil().max(60.0) as usize;
        let states = sampler.states(count);
        let read = |state: &[f64]| {
            let shape = self.of(|mode| mode.shapes[1]);
            let part = |offset: usize| shape.iter().zip(&state[offset..]).map(|(c, q)| c * q).sum::<f64>();
            (part(0), part(shape.len()))
        };
        let mut best = (0.0, f64::NEG_INFINITY);
        for (k, pair) in states.windows(2).enumerate() {
            let (before, after) = (read(&pair[0]), read(&pair[1]));
            if before.1 > 0.0 && after.1 <= 0.0 && before.0.max(after.0) > best.1 - 1e-5 {
                // Secants on the velocity, halved where they leave the bracket.
                let (mut low, mut high) = ((0.0, before.1), (1.0, after.1));
                let mut place = 0.5;
                let mut height = f64::NEG_INFINITY;
                for _ in 0..60 {
                    let there = read(&sampler.between(&pair[0], k, count, place));
                    height = there.0.max(height);
                    if there.1 > 0.0 {
                        low = (place, there.1);
                    } else {
                        high = (place, there.1);
                    }
                    if high.0 - low.0 < 1e-9 {
                        break;
                    }
                    let secant = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
                    let close = 0.02 * (high.0 - low.0);
                    place = secant.clamp(low.0 + close, high.0 - close);
                }
                if height > best.1 {
                    best = ((k as f64 + place) / count as f64, height);
                }
            }
        }
        let ends = read(&states[0]).0.max(read(&states[count]).0);
        (best.1 > ends + 1e-5).then_some(best)
    }

    /// Number of contacts of a stop at this level over a part of the cycle.
    fn contacts(&self, level: f64, part: f64, hertz: bool) -> u32 {
        let law = if hertz {
            Law::Hertz(HertzStop::with_gap(1e6, level).unwrap())
        } else {
            Law::Linear(LinearStop::with_gap(1e3, level).unwrap())
        };
        let mut exact = ExactIntegrator::new(self.system(Some(law)), FINE).unwrap();
        let stretch = Stretch { frequency_hz: self.frequency_hz, start: 0.0, end: part };
        exact.advance(&stretch, &self.start()).unwrap();
        *exact.touches().last().unwrap()
    }
}

const FINE: ExactSettings = ExactSettings { tolerance: 1e-13 };

/// The motion without the further stop.
struct Sampler<'a> {
    motion: &'a Motion,
    exact: ExactIntegrator,
}

impl<'a> Sampler<'a> {
    fn new(motion: &'a Motion) -> Self {
        Self { motion, exact: ExactIntegrator::new(motion.system(None), FINE).unwrap() }
    }

    fn states(&mut self, count: usize) -> Vec<Vec<f64>> {
        let mut states = vec![self.motion.start()];
        for k in 0..count {
            states.push(self.between(&states[k].clone(), k, count, 1.0));
        }
        states
    }

    /// The state at a part of the way from the k-th sample to the next.
    fn between(&mut self, state: &[f64], k: usize, count: usize, part: f64) -> Vec<f64> {
        let phase = |place: f64| place / count as f64;
        let (start, end) = (phase(k as f64), phase(k as f64 + part));
        self.exact.advance(&Stretch { frequency_hz: self.motion.frequency_hz, start, end }, state).unwrap()
    }
}

prop_compose! {
    fn modes()(frequency in 1.0f64..3.3, ratio in prop_oneof![Just(0.0), 0.0f64..0.1, 0.1f64..0.9],
               shapes in [-1.0f64..1.0, -1.0f64..1.0], start in [-1.0f64..1.0, -1.0f64..1.0],
               load in -1.0f64..1.0)
              -> Mode {
        let frequency = TAU * 10f64.powf(frequency);
        // Faster modes are smaller, as in structures.
        let size = 3e-3 / (frequency / 63.0).powf(1.2);
        let start = [size * start[0], size * start[1] * frequency];
        Mode { frequency, ratio, shapes, start, load: size * load }
    }
}

fn active() -> impl Strategy<Value = Active> {
    prop_oneof![
        (0.01f64..3.0).prop_map(Active::Cubic),
        ((0.05f64..3.0), any::<bool>()).prop_map(|(part, hertz)| Active::Preloaded(part, hertz)),
    ]
}

prop_compose! {
    fn motions()(frequency_hz in 5.0f64..60.0, modes in prop::collection::vec(modes(), 1..5),
                 load in (1u32..4, 0.0f64..TAU), active in active()) -> Motion {
        Motion { frequency_hz, modes, load, active }
    }
}

fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(11),
        failure_persistence: None,
        max_global_rejects: 100_000,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(cases(150))]

    /// A stop just below the highest point is struck, one just above it is not.
    #[test]
    fn under_force_what_is_reached_is_touched_and_nothing_else(motion in motions(), hertz in any::<bool>()) {
        let highest = motion.highest();
        prop_assume!(highest.is_some_and(|(_, height)| height > 1e-5));
        let (_, height) = highest.unwrap();
        for distance in [1e-6, 1e-9, 1e-10] {
            prop_assert_eq!(motion.contacts(height + distance, 1.0, hertz), 0, "{:e} above", distance);
            prop_assert!(motion.contacts(height - distance, 1.0, hertz) > 0, "{distance:e} below");
        }
    }
}
