//! The format of the record of an orbit, and its rounding.
//!
//! A record is written by the range coder of `coder.rs` and padded with zeros to a multiple of three bytes.
//! It starts with the counts of `counts` below, as numbers of their own kind, and the sampling step in s. The
//! series of `packed` follow, each with the size of its steps: the upper half of an f32, 16 unmodelled bits.
//! A value is a whole number of steps.
//!
//! A series is stored as the order of its predictor and the prediction errors. Order `n` extrapolates the
//! polynomial through the `n` preceding values, with zeros before the first. Velocity and displacement have
//! other predictors: the integral of the acceleration by Simpson's rule, and the integral of the velocity by
//! the trapezoidal rule with a correction by the acceleration, both rounded half up. So their errors are
//! small except where a contact changes the acceleration between its samples.

use super::{
    coder::{Encoder, NumberModel},
    content::{PageImpulse, PageOrbit},
};

/// Steps in the range of a series.
pub(super) const STEPS: f64 = 1_023.0;
/// Steps in the range of the mode with the largest range; all modes have its step size, since they move one
/// drawing.
pub(super) const STEPS_OF_MODES: f64 = 511.0;
/// Steps per decade of a spectrum.
pub(super) const STEPS_OF_A_DECADE: f64 = 50.0;
/// Decades below the largest amplitude at which smaller amplitudes are clipped.
pub(super) const DECADES: f64 = 5.0;
/// Largest number of steps of a value.
const MOST_STEPS: f64 = 4_194_304.0;
/// Highest order of a predictor.
const HIGHEST_ORDER: i32 = 4;

/// Kinds of numbers.
#[derive(Debug, Clone, Copy)]
pub(super) enum Of {
    Head,
    Acceleration,
    Velocity,
    Displacement,
    Support,
    Forces,
    Modes,
    Spectrum,
    InContacts,
}

/// How many kinds there are.
pub(super) const KINDS: usize = 9;

/// A series in steps.
pub(super) struct Stepped {
    pub(super) size: f64,
    pub(super) counts: Vec<i32>,
}

struct Writer {
    encoder: Encoder,
    kinds: [NumberModel; KINDS],
}

impl Writer {
    /// Writes a size, rounded up.
    ///
    /// # Returns
    /// The rounded size.
    fn size(&mut self, size: f64) -> f64 {
        let bits = (size as f32).to_bits();
        let upper = bits.div_ceil(1 << 16).min(0x7f7f);
        self.encoder.plain(upper, 16);
        f64::from(f32::from_bits(upper << 16))
    }

    fn numbers(&mut self, of: Of, numbers: impl IntoIterator<Item = i32>) {
        let kind = &mut self.kinds[of as usize];
        kind.begin();
        numbers.into_iter().for_each(|number| self.encoder.number(kind, number));
    }

    /// Writes whole numbers with the best predictor.
    fn counts(&mut self, of: Of, counts: &[i32]) {
        let cost = |missed: &[i32]| -> u32 {
            missed.iter().map(|number| u32::BITS - number.unsigned_abs().leading_zeros()).sum()
        };
        let mut missed = counts.to_vec();
        let (mut least, mut order, mut best) = (cost(&missed), 0, missed.clone());
        for higher in 1..=HIGHEST_ORDER {
            differences(&mut missed);
            if cost(&missed) < least {
                (least, order) = (cost(&missed), higher);
                best.copy_from_slice(&missed);
            }
        }
        self.numbers(Of::Head, [order]);
        self.numbers(of, best);
    }

    /// Writes a series with the size of its steps.
    fn series(&mut self, of: Of, values: &[f64]) -> Stepped {
        let size = self.size(step(values, STEPS));
        let counts = stepped(values, size);
        self.counts(of, &counts);
        Stepped { size, counts }
    }

    /// Writes a series with a given predictor.
    ///
    /// * `change`: predicted change in steps of the given size after the value with the given index.
    fn continued(&mut self, of: Of, values: &[f64], change: impl Fn(f64, usize) -> f64) -> Stepped {
        let size = self.size(step(values, STEPS));
        let counts = stepped(values, size);
        let missed = (0..counts.len()).map(|k| match k {
            0 => counts[0],
            _ => counts[k] - counts[k - 1] - rounded(change(size, k - 1)),
        });
        self.numbers(of, missed.collect::<Vec<i32>>());
        Stepped { size, counts }
    }
}

/// The record of an orbit.
pub(super) fn packed(orbit: &PageOrbit) -> Vec<u8> {
    let mut writer =
        Writer { encoder: Encoder::new(), kinds: std::array::from_fn(|_| NumberModel::default()) };
    let [samples, .., of_mode, _, _, _] = counts(orbit);
    writer.numbers(Of::Head, counts(orbit).map(|count| i32::try_from(count).unwrap_or(i32::MAX)));
    let distance_s = writer.size((orbit.duration_s / samples as f64).max(0.0));
    let pairs = |pairs: &[[f64; 2]]| fitted(pairs.as_flattened(), 2 * samples);
    let acceleration = writer.series(Of::Acceleration, &pairs(&orbit.acceleration_m_s2));
    let velocity = writer.continued(Of::Velocity, &fitted(&orbit.velocity_m_s, samples), |size, k| {
        velocity_change(&acceleration, size, distance_s, k)
    });
    // The change of the displacement depends on the velocities at both ends, which are written already.
    let displacement = writer.continued(Of::Displacement, &orbit.displacement_m, |size, k| {
        displacement_change((&acceleration, &velocity), size, distance_s, k)
    });
    writer.series(Of::Support, &orbit.support_m);
    for force in &orbit.forces_n {
        writer.series(Of::Forces, &pairs(force));
    }
    let coarsest = orbit.modes.iter().map(|mode| step(mode, STEPS_OF_MODES)).fold(0.0, f64::max);
    let coarsest = writer.size(coarsest);
    for mode in &orbit.modes {
        writer.counts(Of::Modes, &stepped(&fitted(mode, of_mode), coarsest));
    }
    writer.counts(Of::Spectrum, &levels(&orbit.spectrum_m_s2));
    let inside =
        |value: fn(&(usize, f64, f64)) -> f64| -> Vec<f64> { orbit.in_contacts.iter().map(value).collect() };
    writer.counts(Of::InContacts, &stepped(&inside(|at| at.0 as f64), 1.0));
    writer.counts(Of::InContacts, &stepped(&inside(|at| at.1), displacement.size));
    writer.counts(Of::InContacts, &stepped(&inside(|at| at.2), velocity.size));
    for impulse in &orbit.impulses {
        writer.numbers(Of::Head, [i32::try_from(impulse.element).unwrap_or(i32::MAX)]);
        for number in numbers(impulse) {
            writer.encoder.plain((number as f32).to_bits(), 32);
        }
    }
    let mut bytes = writer.encoder.finish();
    bytes.resize(bytes.len().next_multiple_of(3), 0);
    bytes
}

/// Lengths of the series: samples, local elements, samples of the supports, modes, their samples, harmonics,
/// samples in contacts, impulses.
fn counts(orbit: &PageOrbit) -> [usize; 8] {
    [
        orbit.displacement_m.len(),
        orbit.forces_n.len(),
        orbit.support_m.len(),
        orbit.modes.len(),
        orbit.modes.first().map_or(0, Vec::len),
        orbit.spectrum_m_s2.len(),
        orbit.in_contacts.len(),
        orbit.impulses.len(),
    ]
}

/// The numbers of an impulse, each an f32.
pub(super) fn numbers(impulse: &PageImpulse) -> [f64; 5] {
    let [before, after] = impulse.velocity_m_s;
    [impulse.cycles, impulse.impulse_n_s, impulse.displacement_m, before, after]
}

/// Each number minus the preceding one, with a zero before the first: the errors of a predictor become those
/// of the next order.
fn differences(numbers: &mut [i32]) {
    for k in (1..numbers.len()).rev() {
        numbers[k] -= numbers[k - 1];
    }
}

/// Predicted change of a velocity between successive samples, in steps.
pub(super) fn velocity_change(acceleration: &Stepped, size: f64, distance_s: f64, k: usize) -> f64 {
    let at = |place: usize| acceleration.counts.get(place).copied().unwrap_or_default();
    let sum = f64::from(at(2 * k) + 4 * at(2 * k + 1) + at(2 * k + 2));
    distance_s * acceleration.size * sum / 6.0 / size
}

/// Predicted change of a displacement between successive samples, in steps.
pub(super) fn displacement_change(
    (acceleration, velocity): (&Stepped, &Stepped),
    size: f64,
    distance_s: f64,
    k: usize,
) -> f64 {
    let at = |series: &Stepped, place: usize| series.counts.get(place).copied().unwrap_or_default();
    let sum = f64::from(at(velocity, k) + at(velocity, k + 1));
    let bend = f64::from(at(acceleration, 2 * k + 2) - at(acceleration, 2 * k));
    distance_s * (velocity.size * sum / 2.0 - distance_s * acceleration.size * bend / 12.0) / size
}

/// The nearest whole number, clipped to the largest one; 0 for NaN.
pub(super) fn rounded(number: f64) -> i32 {
    (number + 0.5).floor().clamp(-MOST_STEPS, MOST_STEPS) as i32
}

/// Values truncated or padded with zeros to a count.
fn fitted(values: &[f64], count: usize) -> Vec<f64> {
    values.iter().copied().chain(std::iter::repeat(0.0)).take(count).collect()
}

/// Size of the steps of a series: its range has `steps` of them, and no value exceeds the largest number.
fn step(values: &[f64], steps: f64) -> f64 {
    let [low, high] = range(values);
    ((high - low) / steps).max(low.abs().max(high.abs()) / MOST_STEPS)
}

/// Least and largest finite value.
fn range(values: &[f64]) -> [f64; 2] {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if low <= high { [low, high] } else { [0.0, 0.0] }
}

/// Values as whole numbers of steps; infinite values are clipped to the finite range, and NaN becomes its
/// least value.
fn stepped(values: &[f64], size: f64) -> Vec<i32> {
    let [low, high] = range(values);
    let count = |value: &f64| {
        let value = if value.is_nan() { low } else { value.clamp(low, high) };
        if size > 0.0 { rounded(value / size) } else { 0 }
    };
    values.iter().map(count).collect()
}

/// Common logarithms of amplitudes, in steps.
fn levels(amplitudes: &[f64]) -> Vec<i32> {
    let finite = amplitudes.iter().copied().filter(|value| value.is_finite());
    let highest = finite.fold(0.0, f64::max).log10();
    // Without any motion all amplitudes are zero.
    let highest = if highest.is_finite() { highest } else { -300.0 };
    let level = |amplitude: &f64| amplitude.log10().max(highest - DECADES).min(highest);
    amplitudes.iter().map(|amplitude| rounded(STEPS_OF_A_DECADE * level(amplitude))).collect()
}
