//! Orbits as records that are decoded one at a time.
//!
//! A record, little-endian: seven u16 (samples N, steps S, local elements E, samples of a mode K, modes M, harmonics H, samples in contacts C), then for each series its least value and its
//! step as f32, then the series, then zeros up to a multiple of three bytes. The series are displacement (N),
//! velocity (N), acceleration (2 S), displacement of the support (K), the force of each local element (2 S), the coordinate of each mode (K), the common logarithms of the
//! amplitudes of the harmonics of the acceleration (H), and of what is carried within contacts the number of the sample before it, displacement and velocity (C each).
//!
//! Displacement and velocity are smooth at this distance of samples. A contact may be much shorter: of acceleration and forces the least and the largest value
//! in each of some steps are carried, in their order in time, so that no peak is lost.
//!
//! A value is a whole number `k` of steps above the least one; written are the second differences `k_i - 2 k_(i-1) + k_(i-2)` (with zero
//! before the first), signs folded (`2 d`, `-2 d - 1`), seven bits to a byte, the lowest first, the highest bit set where another byte follows; behind a zero stands, in the same way, how many more of them follow. Most take one byte.
//! Modes have one step in common, that of the mode that moves most, since all of them move the same drawing.

use std::collections::BTreeMap;

/// Steps in the range of a series.
const STEPS: f64 = 4_095.0;

/// What orbits get at least, however much else there is (bytes).
pub(super) const LEAST_BYTES: usize = 2_000_000;

/// An orbit over its period, from phase 0 of the excitation on, the end of the period left out. All lengths at most 65 535.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageOrbit {
    /// Displacement of the response point at equal steps (m).
    pub displacement_m: Vec<f64>,
    /// Its velocity at the same instants (m/s).
    pub velocity_m_s: Vec<f64>,
    /// What happens within contacts, which may be shorter than the distance of samples: number of the sample before it, displacement (m) and velocity (m/s).
    pub in_contacts: Vec<(usize, f64, f64)>,
    /// Least and largest acceleration in each of some equal steps, in their order in time (m/s²).
    pub acceleration_m_s2: Vec<[f64; 2]>,
    /// The same of the force of each local element (N).
    pub forces_n: Vec<Vec<[f64; 2]>>,
    /// Displacement of the support (m) at equal steps of its own; as many as those of a mode.
    pub support_m: Vec<f64>,
    /// Coordinates (kg^1/2 m) of the modes that are drawn, at the same instants as the support.
    pub modes: Vec<Vec<f64>>,
    /// Amplitudes of the harmonics 1, 2, ... of the orbit frequency in the acceleration (m/s²).
    pub spectrum_m_s2: Vec<f64>,
}

/// An orbit, packed.
#[derive(Debug, Clone, PartialEq)]
pub struct OrbitRecord(Vec<u8>);

impl PageOrbit {
    /// The orbit as it is carried.
    #[must_use]
    pub fn record(&self) -> OrbitRecord {
        OrbitRecord(packed(self))
    }
}

/// Orbits of some solutions, packed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitRecords {
    records: BTreeMap<u32, Vec<u8>>,
    length: usize,
}

impl OrbitRecords {
    /// Adds the orbit of a solution unless all of them would be longer than `most` bytes; says whether it did.
    ///
    /// * `solution`: its number, counted from 0 over all branches end to end.
    pub fn insert(&mut self, solution: u32, record: OrbitRecord, most: usize) -> bool {
        let fits = self.length + record.0.len() <= most;
        if fits && !self.records.contains_key(&solution) {
            self.length += record.0.len();
            self.records.insert(solution, record.0);
        }
        fits
    }

    /// Number of orbits.
    #[must_use]
    pub fn count(&self) -> usize {
        self.records.len()
    }

    /// Length of all records (bytes).
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Solutions that have an orbit.
    pub(super) fn solutions(&self) -> Vec<u32> {
        self.records.keys().copied().collect()
    }

    /// Where each record begins in the bytes.
    pub(super) fn offsets(&self) -> Vec<usize> {
        let place = |at: &mut usize, record: &Vec<u8>| {
            *at += record.len();
            Some(*at - record.len())
        };
        self.records.values().scan(0, place).collect()
    }

    /// All records, one after the other.
    pub(super) fn bytes(&self) -> Vec<u8> {
        self.records.values().flatten().copied().collect()
    }
}

fn packed(orbit: &PageOrbit) -> Vec<u8> {
    let flat = |pairs: &Vec<[f64; 2]>| pairs.iter().flatten().copied().collect::<Vec<f64>>();
    let mut series =
        vec![orbit.displacement_m.clone(), orbit.velocity_m_s.clone(), flat(&orbit.acceleration_m_s2)];
    series.push(orbit.support_m.clone());
    series.extend(orbit.forces_n.iter().map(flat));
    series.extend(orbit.modes.iter().cloned());
    series.push(orbit.spectrum_m_s2.iter().map(|amplitude| amplitude.log10()).collect());
    let inside = |value: fn(&(usize, f64, f64)) -> f64| orbit.in_contacts.iter().map(value).collect();
    series.extend([inside(|at| at.0 as f64), inside(|at| at.1), inside(|at| at.2)]);
    let counts = [
        orbit.displacement_m.len(),
        orbit.acceleration_m_s2.len(),
        orbit.forces_n.len(),
        orbit.support_m.len(),
        orbit.modes.len(),
        orbit.spectrum_m_s2.len(),
        orbit.in_contacts.len(),
    ];
    let mut bytes: Vec<u8> = counts.iter().flat_map(|&count| (count as u16).to_le_bytes()).collect();
    let mut ranges: Vec<[f32; 2]> = series.iter().map(|values| range(values)).collect();
    let modes = &mut ranges[4 + orbit.forces_n.len()..4 + orbit.forces_n.len() + orbit.modes.len()];
    let coarsest = modes.iter().fold(0.0_f32, |most, [_, step]| most.max(*step));
    modes.iter_mut().for_each(|[_, step]| *step = coarsest);
    bytes.extend(ranges.iter().flatten().flat_map(|number| number.to_le_bytes()));
    for (values, range) in series.iter().zip(ranges) {
        write(&mut bytes, values, range);
    }
    let length = bytes.len().next_multiple_of(3);
    bytes.resize(length, 0);
    bytes
}

/// Least value and step of a series.
fn range(values: &[f64]) -> [f32; 2] {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    match low.partial_cmp(&high) {
        Some(std::cmp::Ordering::Less) => [low as f32, ((high - low) / STEPS) as f32],
        Some(std::cmp::Ordering::Equal) => [low as f32, 0.0],
        _ => [0.0, 0.0],
    }
}

/// Writes the second differences of a series; an infinite value is the least or the largest one, what is not a number the least.
fn write(bytes: &mut Vec<u8>, values: &[f64], [low, step]: [f32; 2]) {
    let [mut last, mut slope, mut zeros] = [0_i32; 3];
    for value in values {
        let count = if step > 0.0 { (value - f64::from(low)) / f64::from(step) } else { 0.0 };
        let count = count.round().clamp(0.0, STEPS) as i32; // not a number becomes 0
        let change = count - last;
        let bend = change - slope;
        (last, slope) = (count, change);
        if bend == 0 {
            zeros += 1;
        } else {
            write_zeros(bytes, std::mem::take(&mut zeros));
            write_number(bytes, ((bend << 1) ^ (bend >> 31)).cast_unsigned());
        }
    }
    write_zeros(bytes, zeros);
}

fn write_zeros(bytes: &mut Vec<u8>, zeros: i32) {
    if zeros > 0 {
        bytes.push(0);
        write_number(bytes, (zeros - 1).cast_unsigned());
    }
}

fn write_number(bytes: &mut Vec<u8>, mut left: u32) {
    while left >= 0x80 {
        bytes.push(left as u8 | 0x80);
        left >>= 7;
    }
    bytes.push(left as u8);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a record as its description says.
    fn read(record: &[u8]) -> Vec<Vec<f64>> {
        let count = |k: usize| usize::from(u16::from_le_bytes(record[2 * k..2 * k + 2].try_into().unwrap()));
        let number = |at: usize| f64::from(f32::from_le_bytes(record[at..at + 4].try_into().unwrap()));
        let [n, steps, elements, of_mode, modes, harmonics, inside] = std::array::from_fn(count);
        let mut lengths = vec![n, n, 2 * steps, of_mode];
        lengths.extend(vec![2 * steps; elements]);
        lengths.extend(vec![of_mode; modes]);
        lengths.extend([harmonics, inside, inside, inside]);
        let mut at = 14 + 8 * lengths.len();
        let mut series = Vec::new();
        for (k, length) in lengths.into_iter().enumerate() {
            let (low, step) = (number(14 + 8 * k), number(18 + 8 * k));
            let (mut last, mut slope, mut zeros, mut values) = (0_i64, 0_i64, 0_i64, Vec::new());
            let mut next = || {
                let (mut found, mut shift) = (0_i64, 0);
                loop {
                    let byte = record[at];
                    at += 1;
                    found |= i64::from(byte & 0x7f) << shift;
                    shift += 7;
                    if byte < 0x80 {
                        return found;
                    }
                }
            };
            for _ in 0..length {
                if zeros > 0 {
                    zeros -= 1;
                } else {
                    let folded = next();
                    zeros = if folded == 0 { next() } else { 0 };
                    slope += if folded % 2 == 0 { folded / 2 } else { -(folded + 1) / 2 };
                }
                last += slope;
                values.push(low + step * last as f64);
            }
            series.push(values);
        }
        assert!(record.len() - at < 3 && record.len().is_multiple_of(3));
        series
    }

    fn orbit(samples: usize) -> PageOrbit {
        let times = || (0..samples).map(|k| k as f64);
        PageOrbit {
            displacement_m: times().map(|t| 1e-3 * (0.3 * t).sin()).collect(),
            velocity_m_s: times().map(|t| if t % 2.0 == 0.0 { -1e4 } else { 1e4 }).collect(),
            in_contacts: vec![(3, 0.5, -1.0), (3, 0.75, 0.0), (samples - 1, 1.0, 1.0)],
            acceleration_m_s2: times().map(|t| [-t, t]).collect(),
            forces_n: vec![times().map(|t| [t, 0.0]).collect(), vec![[f64::NAN, 0.0]; samples]],
            support_m: vec![0.25; samples / 2],
            modes: [1.0, 1e-2]
                .map(|size| (0..samples / 2).map(|k| size * (k as f64).cos()).collect())
                .to_vec(),
            spectrum_m_s2: vec![100.0, 0.0, 1e-3],
        }
    }

    #[test]
    fn values_are_good_to_half_a_step() {
        let orbit = orbit(200);
        let series = read(&packed(&orbit));
        assert_eq!(series.len(), 12);
        // Half a step, and the rounding of 4095 steps as f32.
        let good = 0.5 / STEPS + 1e-7;
        let near = |found: &[f64], meant: &[f64], range: f64| {
            assert_eq!(found.len(), meant.len());
            for (found, meant) in found.iter().zip(meant) {
                assert!((found - meant).abs() < good * range, "{found} {meant}");
            }
        };
        near(&series[0], &orbit.displacement_m, 2e-3);
        near(&series[1], &orbit.velocity_m_s, 2e4);
        near(&series[2], &orbit.acceleration_m_s2.concat(), 398.0);
        near(&series[3], &orbit.support_m, 1.0);
        near(&series[4], &orbit.forces_n[0].concat(), 199.0);
        near(&series[5], &vec![0.0; 400], 1.0);
        near(&series[6], &orbit.modes[0], 2.0);
        near(&series[7], &orbit.modes[1], 2.0);
        near(&series[9], &[3.0, 3.0, 199.0], 196.0);
        near(&series[10], &[0.5, 0.75, 1.0], 0.5);
        near(&series[11], &[-1.0, 0.0, 1.0], 2.0);
    }

    #[test]
    fn spectra_are_logarithms_and_no_amplitude_is_the_least_one() {
        let spectrum = read(&packed(&orbit(10))).remove(8);
        for (found, meant) in spectrum.iter().zip([2.0, -3.0, -3.0]) {
            assert!((found - meant).abs() < 5.0 * (0.5 / STEPS + 1e-7));
        }
    }

    #[test]
    fn records_stand_in_the_order_of_the_solutions_and_within_their_budget() {
        let (mut records, length) = (OrbitRecords::default(), packed(&orbit(10)).len());
        for solution in [7, 0, 7] {
            assert!(records.insert(solution, orbit(10).record(), 3 * length));
        }
        assert!(records.insert(9, orbit(10).record(), 3 * length));
        assert!(!records.insert(8, orbit(10).record(), 3 * length));
        assert_eq!(records.solutions(), [0, 7, 9]);
        assert_eq!(records.offsets(), [0, length, 2 * length]);
        assert_eq!((records.length(), records.bytes().len()), (3 * length, 3 * length));
    }
}
