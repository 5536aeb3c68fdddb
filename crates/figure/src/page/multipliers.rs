//! Floquet multipliers of every solution, the largest ones.
//!
//! One record per solution in sequence, little-endian: a u16 whose lowest four bits are the number of entries
//! and whose bit `4 + k` marks entry `k` as a pair, then the entries. An entry is a real multiplier, or the
//! real and the positive imaginary part of a pair. A number is an f32 without its lowest byte: truncated, not
//! rounded, so that a multiplier within the unit circle stays there. The relative error is below 2^-15.

/// Largest number of entries of a solution.
const MOST_ENTRIES: usize = 12;

/// Multipliers of solutions, packed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplierRecords {
    bytes: Vec<u8>,
    solutions: usize,
    most: usize,
}

impl MultiplierRecords {
    /// Adds the multipliers of the next solution, in the order of all branches; none if they are unknown.
    ///
    /// * `multipliers`: largest modulus first, a pair side by side.
    pub fn push(&mut self, multipliers: &[[f64; 2]]) {
        let mut entries = Vec::new();
        let mut rest = multipliers;
        while let ([[re, im], behind @ ..], true) = (rest, entries.len() < MOST_ENTRIES) {
            let is_pair = *im != 0.0;
            entries.push((*re, is_pair.then(|| im.abs())));
            rest = if is_pair { behind.get(1..).unwrap_or_default() } else { behind };
        }
        let pairs = entries.iter().enumerate().filter(|(_, (_, im))| im.is_some());
        let head = pairs.fold(entries.len() as u16, |head, (k, _)| head | 1 << (4 + k));
        self.bytes.extend(head.to_le_bytes());
        let numbers = entries.iter().flat_map(|(re, im)| [Some(*re), *im]).flatten();
        self.bytes.extend(numbers.flat_map(cut));
        self.solutions += 1;
        self.most = self.most.max(multipliers.len());
    }

    /// Number of solutions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.solutions
    }

    /// The largest number of multipliers of a solution, including those that are not stored.
    pub(super) fn most(&self) -> usize {
        self.most
    }

    /// All records in sequence.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }
}

/// The upper three bytes of a number as f32.
fn cut(number: f64) -> [u8; 3] {
    let [_, low, middle, high] = (number as f32).to_le_bytes();
    [low, middle, high]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the records as their description says.
    fn read(mut bytes: &[u8]) -> Vec<Vec<[f64; 2]>> {
        let mut solutions = Vec::new();
        while let Some((head, rest)) = bytes.split_first_chunk::<2>() {
            bytes = rest;
            let head = u16::from_le_bytes(*head);
            let mut number = || {
                let (&[low, middle, high], rest) = bytes.split_first_chunk::<3>().unwrap();
                bytes = rest;
                f64::from(f32::from_le_bytes([0, low, middle, high]))
            };
            let entry = |k: u16| [number(), if head >> (4 + k) & 1 == 1 { number() } else { 0.0 }];
            solutions.push((0..head & 15).map(entry).collect());
        }
        solutions
    }

    #[test]
    fn real_ones_and_pairs_come_back_and_none_leaves_the_unit_circle() {
        let mut records = MultiplierRecords::default();
        records.push(&[[-53.125, 0.0], [0.999_999, 0.0], [0.3, -0.4], [0.3, 0.4], [1e-9, 0.0]]);
        records.push(&[]);
        records.push(&[[f64::INFINITY, 0.0], [f64::NAN, 0.0]]);
        let found = read(records.bytes());
        let meant = [[-53.125, 0.0], [0.999_999, 0.0], [0.3, 0.4], [1e-9, 0.0]];
        assert_eq!(found[0].len(), meant.len());
        for (found, meant) in found[0].iter().flatten().zip(meant.as_flattened()) {
            assert!((found - meant).abs() <= meant.abs() * 2.0_f64.powi(-15), "{found} {meant}");
        }
        assert!(found[0][1][0] < 1.0);
        assert!(found[1].is_empty());
        assert!(found[2][0][0] == f64::INFINITY && found[2][1][0].is_nan());
        assert_eq!((records.count(), records.most()), (3, 5));
    }

    #[test]
    fn of_many_the_largest_are_kept() {
        let mut records = MultiplierRecords::default();
        let many: Vec<[f64; 2]> = (0..40).map(|k| [2.0_f64.powi(-k), 0.0]).collect();
        records.push(&many);
        assert_eq!(read(records.bytes()), [many[..MOST_ENTRIES].to_vec()]);
        assert_eq!(records.most(), 40);
    }
}
