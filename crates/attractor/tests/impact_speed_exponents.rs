//! Exponents in chaos with impact-speed-dependent laws, by the exact integrator and by a
//! second method that shares nothing with it: the general integrator's variational equations, and Gram and
//! Schmidt instead of reflections.
//!
//! The rule for the sum of the exponents, which has a part that these laws alone have, is held to the
//! determinants of the second method, too. Neither integrator starts within such a contact: that method goes
//! from one excitation period at whose start the contact is open to the next such one, which is a *leg*.
#![allow(clippy::unwrap_used, reason = "tests")]

use std::collections::VecDeque;

use crate::common::{element, model};
use faer::Mat;
use hammerbeam_attractor::{
    LyapunovSettings, Part, SectionMap, Spectrum, SystemMap, distance, lyapunov, state_scales,
};
use hammerbeam_motion::{
    Harmonic, HarmonicForce, Law, Load, Stretch, System,
    exact::ExactSettings,
    general::{GeneralSettings, advance},
    law::{HertzStop, RestitutionModel, RestitutionStop},
};

const FREQUENCY_HZ: f64 = 0.44;

/// Modes of these circular frequencies and 1 % damping, driven and stopped at a point that all of them move
/// alike.
fn system(frequencies: &[f64], model_of_loss: RestitutionModel) -> System {
    let n = frequencies.len();
    let damping = Mat::from_fn(n, n, |i, j| if i == j { 0.02 * frequencies[i] } else { 0.0 });
    let harmonic = Harmonic { order: 1, amplitude: 1.0, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0; n], harmonic }] };
    let hertz = HertzStop::with_gap(1e3, 0.0).unwrap();
    let law = Law::Restitution(RestitutionStop::new(hertz, model_of_loss, 0.8).unwrap());
    System::new(model(frequencies, damping), &load, vec![element(&vec![1.0; n], 0.0, law)]).unwrap()
}

fn chaotic_ones() -> [(&'static str, System); 3] {
    [
        ("lankarani-nikravesh", system(&[1.0], RestitutionModel::LankaraniNikravesh)),
        ("flores", system(&[1.0], RestitutionModel::Flores)),
        ("flores, two modes", system(&[1.0, 3.3], RestitutionModel::Flores)),
    ]
}

fn map(system: &System) -> SystemMap {
    SystemMap::new(system.clone(), FREQUENCY_HZ, 1, ExactSettings::default()).unwrap()
}

fn is_open(system: &System, state: &[f64]) -> bool {
    system.depth_in_contact(0, FREQUENCY_HZ, 0.0, state).is_none_or(|depth| depth <= 0.0)
}

/// A state of the attractor with an open contact, and the map that has come to it.
fn on_the_attractor(system: &System) -> (SystemMap, Vec<f64>) {
    let mut map = map(system);
    let mut state = vec![0.0; map.dimension()];
    state[0] = -0.5;
    for period in 0.. {
        state = map.advance(period, &state).unwrap();
        if period > 200 && is_open(system, &state) {
            break;
        }
    }
    (map, state)
}

/// Tangent vectors under Gram and Schmidt, in the scales of the system.
struct Frame {
    vectors: Vec<Vec<f64>>,
    scales: Vec<f64>,
}

impl Frame {
    fn new(system: &System) -> Self {
        let scales = state_scales(system, FREQUENCY_HZ);
        let unit = |i: usize| (0..scales.len()).map(|k| f64::from(u8::from(k == i))).collect();
        Self { vectors: (0..scales.len()).map(unit).collect(), scales }
    }

    /// Carries the vectors along, and gives the logarithms of their growth. Twice is enough against rounding.
    fn carry(&mut self, matrix: &Mat<f64>) -> Vec<f64> {
        let n = self.scales.len();
        let scaled = |i: usize, j: usize| matrix[(i, j)] * self.scales[j] / self.scales[i];
        let mut growth = Vec::new();
        let mut carried: Vec<Vec<f64>> = Vec::new();
        for vector in &self.vectors {
            let mut image: Vec<f64> =
                (0..n).map(|i| (0..n).map(|j| scaled(i, j) * vector[j]).sum()).collect();
            for _ in 0..2 {
                for known in &carried {
                    let share: f64 = image.iter().zip(known).map(|(a, b)| a * b).sum();
                    image.iter_mut().zip(known).for_each(|(a, b)| *a -= share * b);
                }
            }
            let length = image.iter().map(|a| a * a).sum::<f64>().sqrt();
            growth.push(length.ln());
            carried.push(image.iter().map(|a| a / length).collect());
        }
        self.vectors = carried;
        growth
    }
}

/// The general integrator from a state with an open contact over some periods.
fn general(system: &System, state: &[f64], periods: usize) -> (Vec<f64>, Mat<f64>) {
    let stretch = Stretch { frequency_hz: FREQUENCY_HZ, start: 0.0, end: periods as f64 };
    let flow = advance(system, &stretch, state, &GeneralSettings::with_tolerance(1e-13)).unwrap().flow;
    (flow.state, flow.by_state)
}

/// A leg of the general integrator's own motion: its periods, the state after it, the fundamental matrix.
fn leg(system: &System, state: &[f64]) -> (usize, Vec<f64>, Mat<f64>) {
    for periods in 1.. {
        let (end, matrix) = general(system, state, periods);
        if is_open(system, &end) {
            return (periods, end, matrix);
        }
    }
    unreachable!("a contact that never opens")
}

/// Along one motion of the exact integrator both give the same growth in every leg: what they differ by is
/// the error of the fundamental matrices, 1e-9 of their largest entries, over what the direction that shrinks
/// most leaves of them, a thousandth at worst. Errors of legs have either sign.
#[test]
fn both_methods_give_the_same_growth_along_one_motion() {
    for (name, system) in chaotic_ones() {
        let (mut map, mut state) = on_the_attractor(&system);
        let mut frames = [Frame::new(&system), Frame::new(&system)];
        let mut sums = [vec![0.0; state.len()], vec![0.0; state.len()]];
        let (mut periods, mut legs) = (0, 0);
        while periods < 150 {
            let mut matrices = VecDeque::new();
            let mut end = state.clone();
            let mut volume = 0.0;
            while matrices.is_empty() || !is_open(&system, &end) {
                let (next, matrix) = map.flow(Part::whole(periods), &end).unwrap();
                (end, periods) = (next, periods + 1);
                volume += map.growth_of_volume().unwrap();
                matrices.push_front(matrix);
            }
            let (other, of_general) = general(&system, &state, matrices.len());
            let exact = matrices.into_iter().reduce(|later, earlier| later * earlier).unwrap();
            assert!(distance(&frames[0].scales, &end, &other) < 1e-8, "{name}: {end:?} {other:?}");
            let growth = [frames[0].carry(&exact), frames[1].carry(&of_general)];
            let of_general = growth[1].iter().sum::<f64>();
            assert!((volume / of_general - 1.0).abs() < 1e-6, "{name}, leg {legs}: {volume} {of_general}");
            for i in 0..state.len() {
                let difference = growth[0][i] - growth[1][i];
                assert!(difference.abs() < 1e-6, "{name}, leg {legs}: {growth:?}");
                sums[0][i] += growth[0][i];
                sums[1][i] += growth[1][i];
            }
            (state, legs) = (end, legs + 1);
        }
        let exponents = sums.map(|sum| sum.iter().map(|sum| sum / periods as f64).collect::<Vec<_>>());
        for (a, b) in exponents[0].iter().zip(&exponents[1]) {
            assert!((a - b).abs() < 1e-7, "{name}: {exponents:?}");
        }
        assert!(legs > 75 && exponents[0][0] > 0.1, "{name}: {legs} legs, {exponents:?}");
    }
}

/// Each on its own motion, from the same state: the motions part by a factor e in three to four periods, from
/// 1e-11 to 1e-7 in about thirty, and until then the growth is the same leg by leg.
#[test]
fn growth_is_the_same_until_the_motions_part() {
    for (name, system) in chaotic_ones() {
        let (mut map, start) = on_the_attractor(&system);
        let mut frames = [Frame::new(&system), Frame::new(&system)];
        let mut states = [start.clone(), start];
        let (mut period, mut together) = (0, 0);
        loop {
            let (periods, end, matrix) = leg(&system, &states[1]);
            let growth_of_general = frames[1].carry(&matrix);
            let mut exact = Mat::identity(end.len(), end.len());
            for _ in 0..periods {
                let (next, matrix) = map.flow(Part::whole(period), &states[0]).unwrap();
                exact = matrix * exact;
                (states[0], period) = (next, period + 1);
            }
            let growth = frames[0].carry(&exact);
            states[1] = end;
            let apart = distance(&frames[0].scales, &states[0], &states[1]);
            if apart > 1e-7 {
                break;
            }
            together += periods;
            // A state that is off by 1e-7 meets the stop with another speed, and what an impact stretches
            // goes with one over that.
            for (a, b) in growth.iter().zip(&growth_of_general) {
                assert!((a - b).abs() < 1e-4, "{name}, period {period}: {growth:?} {growth_of_general:?}");
            }
        }
        assert!(together >= 20, "{name}: they part after {together} periods");
    }
}

/// Exponents of the second method alone, over so many blocks of legs: mean and half width of 95 per cent
/// [1/s].
fn by_general(system: &System, start: &[f64], blocks: usize, legs: usize) -> Vec<(f64, f64)> {
    let mut frame = Frame::new(system);
    let mut state = start.to_vec();
    let mut of_blocks = vec![Vec::new(); state.len()];
    for block in 0..=blocks {
        let (mut sum, mut time) = (vec![0.0; state.len()], 0.0);
        for _ in 0..legs {
            let (periods, end, matrix) = leg(system, &state);
            sum.iter_mut().zip(frame.carry(&matrix)).for_each(|(sum, growth)| *sum += growth);
            time += periods as f64 / FREQUENCY_HZ;
            state = end;
        }
        // The vectors turn into their directions over the first.
        if block > 0 {
            of_blocks.iter_mut().zip(&sum).for_each(|(values, sum)| values.push(sum / time));
        }
    }
    let interval = |values: Vec<f64>| {
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0);
        // Student's t for 19 degrees of freedom.
        (mean, 2.093 * (variance / count).sqrt())
    };
    of_blocks.into_iter().map(interval).collect()
}

/// Long after they have parted: two samples of one attractor, whose intervals meet.
#[test]
fn long_averages_of_both_methods_are_within_their_intervals() {
    for (name, system) in chaotic_ones() {
        let (mut map, start) = on_the_attractor(&system);
        let settings = LyapunovSettings { aligning: 30, averaged: 2000 };
        let found: Spectrum = lyapunov(&mut map, &start, settings).unwrap();
        let expected = found.expected_sum.unwrap();
        assert!((found.sum / expected - 1.0).abs() < 1e-6, "{name}: {} against {expected}", found.sum);
        assert!(found.exponents[0].low() > 0.0, "{name}: {:?}", found.exponents);
        let other = by_general(&system, &start, 20, 60);
        for (exponent, (value, half_width)) in found.exponents.iter().zip(other) {
            let bound = exponent.half_width + half_width;
            assert!((exponent.value - value).abs() < bound, "{name}: {exponent:?}, {value} +- {half_width}");
        }
    }
}

/// A contact that takes nearly all speed out of its impact while a constant force presses it: rounding of the
/// velocity makes errors in it that shorter steps do not lessen, and steps were shortened thousands of times.
/// Exponents and their sum are reported all the same.
#[test]
fn a_contact_that_swallows_its_impact_takes_steps_of_its_motion() {
    let (mass, stiffness, damping) = (0.587_f64, 2.009_f64, 0.117_f64);
    let shape = mass.sqrt().recip();
    let force = |order: u32, amplitude: f64| HarmonicForce {
        shape: vec![shape],
        harmonic: Harmonic { order, amplitude, phase: 0.0 },
    };
    let load = Load { support: vec![], forces: vec![force(1, 1.0), force(0, -0.169)] };
    let hertz = HertzStop::with_gap(1e6, 0.4).unwrap();
    let law = Law::Restitution(RestitutionStop::new(hertz, RestitutionModel::Flores, 0.02).unwrap());
    let model = model(&[(stiffness / mass).sqrt()], faer::mat![[damping / mass]]);
    let system = System::new(model, &load, vec![element(&[-shape], 0.0, law)]).unwrap();
    let mut map = SystemMap::new(system, 0.2691, 1, ExactSettings::default()).unwrap();
    let mut state = vec![0.0; 2];
    for period in 0..50 {
        state = map.advance(period, &state).unwrap();
    }
    let before = map.integrator().counts().steps;
    let found = lyapunov(&mut map, &state, LyapunovSettings { aligning: 0, averaged: 20 }).unwrap();
    let steps = map.integrator().counts().steps - before;
    assert!((found.sum / found.expected_sum.unwrap() - 1.0).abs() < 1e-6, "{found:?}");
    assert!(found.expected_sum.unwrap() < -1.0, "nothing is swallowed: {found:?}");
    assert!(steps < 40_000, "{steps} steps in 20 periods");
}
