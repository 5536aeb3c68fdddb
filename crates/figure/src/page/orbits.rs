//! Orbits as records that are decoded one at a time.
//!
//! A record, little-endian: six u16 (samples, channels, samples of a mode, modes, multipliers, 0), then for each channel and each mode its least value and its
//! step as f32, then the multipliers as pairs of f32, then each channel and each mode, then zeros up to a multiple of three bytes.
//! The channels are displacement, velocity and acceleration of the response point, displacement of the support, then the force of each local element.
//!
//! A sample is a whole number `k` of steps above the least value; written are its second differences `k_i - 2 k_(i-1) + k_(i-2)` (with zero
//! before the first), signs folded (`2 d`, `-2 d - 1`), seven bits to a byte, the lowest first, the highest bit set where another byte follows. Motions are smooth at this
//! distance of samples, so that most of them take one byte.

use std::collections::BTreeMap;

use crate::OrbitSample;

/// Channels that are not forces.
const PLAIN_CHANNELS: usize = 4;
/// Steps in the range of a channel: what is drawn is good to 6e-5 of it over 2.
const CHANNEL_STEPS: f64 = 16_383.0;
/// Steps in the range of a mode, which only moves a drawing.
const MODE_STEPS: f64 = 4_095.0;

/// An orbit over its period, from phase 0 of the excitation on.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PageOrbit {
    /// Samples at equal steps, the end of the period left out; at most 65 535.
    pub samples: Vec<OrbitSample>,
    /// Modal coordinates (kg^1/2 m) of the modes that are drawn, each at equal steps, the end of the period left out; their number divides that of the samples.
    pub modes: Vec<Vec<f64>>,
    /// Floquet multipliers.
    pub multipliers: Vec<[f64; 2]>,
}

/// Orbits of some solutions, packed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OrbitRecords {
    records: BTreeMap<u32, Vec<u8>>,
    length: usize,
}

impl OrbitRecords {
    /// Adds the orbit of a solution unless all records would be longer than `most` bytes; says whether it did.
    ///
    /// * `solution`: its number, counted from 0 over all branches end to end.
    pub fn insert(&mut self, solution: u32, orbit: &PageOrbit, most: usize) -> bool {
        let record = packed(orbit);
        let fits = self.length + record.len() <= most;
        if fits && !self.records.contains_key(&solution) {
            self.length += record.len();
            self.records.insert(solution, record);
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
    let elements = orbit.samples.first().map_or(0, |sample| sample.forces_n.len());
    let plain: [fn(&OrbitSample) -> f64; PLAIN_CHANNELS] = [
        |sample| sample.displacement_m,
        |sample| sample.velocity_m_s,
        |sample| sample.acceleration_m_s2,
        |sample| sample.support_m.unwrap_or(0.0),
    ];
    let channel = |value: &dyn Fn(&OrbitSample) -> f64| orbit.samples.iter().map(value).collect::<Vec<f64>>();
    let mut channels: Vec<Vec<f64>> = plain.iter().map(|value| channel(value)).collect();
    for element in 0..elements {
        channels.push(channel(&|sample| sample.forces_n.get(element).copied().unwrap_or(0.0)));
    }
    let of_mode = orbit.modes.first().map_or(0, Vec::len);
    let counts =
        [orbit.samples.len(), channels.len(), of_mode, orbit.modes.len(), orbit.multipliers.len(), 0];
    let mut bytes: Vec<u8> = counts.iter().flat_map(|&count| (count as u16).to_le_bytes()).collect();
    let channels = channels.iter().map(|values| (values, range(values, CHANNEL_STEPS)));
    let modes = orbit.modes.iter().map(|values| (values, range(values, MODE_STEPS)));
    let series: Vec<(&Vec<f64>, [f32; 2])> = channels.chain(modes).collect();
    bytes.extend(series.iter().flat_map(|(_, range)| range).flat_map(|number| number.to_le_bytes()));
    bytes.extend(orbit.multipliers.iter().flatten().flat_map(|number| (*number as f32).to_le_bytes()));
    for (values, range) in &series {
        write(&mut bytes, values, *range);
    }
    let length = bytes.len().next_multiple_of(3);
    bytes.resize(length, 0);
    bytes
}

/// Least value and step of a channel.
fn range(values: &[f64], steps: f64) -> [f32; 2] {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    if low >= high {
        [if low == high { low as f32 } else { 0.0 }, 0.0]
    } else {
        [low as f32, ((high - low) / steps) as f32]
    }
}

/// Writes the second differences of a series; what is not finite has the least value.
fn write(bytes: &mut Vec<u8>, values: &[f64], [low, step]: [f32; 2]) {
    let [mut last, mut slope] = [0_i32; 2];
    for value in values {
        let count = if step > 0.0 { (value - f64::from(low)) / f64::from(step) } else { 0.0 };
        let count = count.round() as i32; // not a number becomes 0
        let change = count - last;
        let bend = change - slope;
        (last, slope) = (count, change);
        let mut left = ((bend << 1) ^ (bend >> 31)).cast_unsigned();
        while left >= 0x80 {
            bytes.push(left as u8 | 0x80);
            left >>= 7;
        }
        bytes.push(left as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads a record as its description says; channels, then modes.
    fn read(record: &[u8]) -> Vec<Vec<f64>> {
        let count = |k: usize| usize::from(u16::from_le_bytes(record[2 * k..2 * k + 2].try_into().unwrap()));
        let number = |at: usize| f64::from(f32::from_le_bytes(record[at..at + 4].try_into().unwrap()));
        let (channels, modes) = (count(1), count(3));
        let mut at = 12 + 8 * (channels + modes + count(4));
        let mut series = Vec::new();
        for k in 0..channels + modes {
            let (low, step) = (number(12 + 8 * k), number(16 + 8 * k));
            let (mut last, mut slope, mut values) = (0_i64, 0_i64, Vec::new());
            for _ in 0..if k < channels { count(0) } else { count(2) } {
                let (mut folded, mut shift) = (0_i64, 0);
                loop {
                    let byte = record[at];
                    at += 1;
                    folded |= i64::from(byte & 0x7f) << shift;
                    shift += 7;
                    if byte < 0x80 {
                        break;
                    }
                }
                slope += if folded % 2 == 0 { folded / 2 } else { -(folded + 1) / 2 };
                last += slope;
                values.push(low + step * last as f64);
            }
            series.push(values);
        }
        assert!(record.len() - at < 3 && record.len().is_multiple_of(3));
        series
    }

    fn orbit(samples: usize) -> PageOrbit {
        let sample = |k: usize| OrbitSample {
            displacement_m: 1e-3 * (0.3 * k as f64).sin(),
            velocity_m_s: if k % 2 == 0 { -1e4 } else { 1e4 },
            forces_n: vec![k as f64, f64::NAN],
            ..OrbitSample::default()
        };
        PageOrbit {
            samples: (0..samples).map(sample).collect(),
            modes: vec![(0..samples / 2).map(|k| (k as f64).cos()).collect()],
            multipliers: vec![[f64::INFINITY, 0.0]; 2],
        }
    }

    #[test]
    fn samples_are_good_to_half_a_step() {
        let orbit = orbit(200);
        let series = read(&packed(&orbit));
        assert_eq!((series.len(), series[6].len()), (7, 100));
        // Half a step, and the rounding of 16 383 steps as f32.
        let good = 0.5 / CHANNEL_STEPS + 1e-7;
        for (k, sample) in orbit.samples.iter().enumerate() {
            assert!((series[0][k] - sample.displacement_m).abs() < good * 2e-3, "{k}");
            assert!((series[1][k] - sample.velocity_m_s).abs() < good * 2e4, "{k}");
            assert!((series[4][k] - sample.forces_n[0]).abs() < good * 199.0, "{k}");
            assert_eq!((series[3][k], series[5][k]), (0.0, 0.0));
        }
        for (found, meant) in series[6].iter().zip(&orbit.modes[0]) {
            assert!((found - meant).abs() < 2.0 * (0.5 / MODE_STEPS + 1e-7));
        }
    }

    #[test]
    fn records_stand_in_the_order_of_the_solutions_and_within_their_budget() {
        let (mut records, length) = (OrbitRecords::default(), packed(&orbit(10)).len());
        for solution in [7, 0, 7] {
            assert!(records.insert(solution, &orbit(10), 3 * length));
        }
        assert!(records.insert(9, &orbit(10), 3 * length));
        assert!(!records.insert(8, &orbit(10), 3 * length));
        assert_eq!(records.solutions(), [0, 7, 9]);
        assert_eq!(records.offsets(), [0, length, 2 * length]);
        assert_eq!((records.length(), records.bytes().len()), (3 * length, 3 * length));
    }
}
