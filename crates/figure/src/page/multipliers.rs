//! Floquet multipliers of every solution, the largest ones.
//!
//! Columns over all solutions, packed as `packed.rs` describes. First a u16 of each solution, whose lowest
//! four bits are the number of its entries and whose bit `4 + k` marks entry `k` as a pair. Then the first
//! number of each solution that has one, then the second, and so on. An entry is a real multiplier, or the
//! real and the positive imaginary part of a pair. A number is an f32 without its lowest byte: truncated, not
//! rounded, so that a multiplier within the unit circle stays there. The relative error is below 2^-15.

use super::packed::Packer;

/// Largest number of entries of a solution.
const MOST_ENTRIES: usize = 12;

/// Multipliers of solutions.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MultiplierRecords {
    heads: Vec<u16>,
    /// By the place of a number in its solution.
    numbers: Vec<Vec<f32>>,
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
        self.heads.push(pairs.fold(entries.len() as u16, |head, (k, _)| head | 1 << (4 + k)));
        let numbers = entries.iter().flat_map(|(re, im)| [Some(*re), *im]).flatten();
        for (place, number) in numbers.enumerate() {
            if place == self.numbers.len() {
                self.numbers.push(Vec::new());
            }
            self.numbers[place].push(number as f32);
        }
        self.most = self.most.max(multipliers.len());
    }

    /// Number of solutions.
    #[must_use]
    pub fn count(&self) -> usize {
        self.heads.len()
    }

    /// The largest number of multipliers of a solution, including those that are not stored.
    pub(super) fn most(&self) -> usize {
        self.most
    }

    /// All columns.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut packer = Packer::default();
        packer.whole(self.heads.iter().map(|head| u64::from(*head)), 2);
        for column in &self.numbers {
            packer.whole(column.iter().map(|number| u64::from(number.to_bits() >> 8)), 3);
        }
        packer.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::{super::packed::tests::Unpacker, *};

    /// Reads the columns as their description says.
    fn read(records: &MultiplierRecords) -> Vec<Vec<[f64; 2]>> {
        let mut columns = Unpacker::new(&records.bytes());
        let heads = columns.whole(records.count(), 2);
        let length = |head: u64| ((head & 15) + u64::from((head >> 4).count_ones())) as usize;
        let most = heads.iter().map(|head| length(*head)).max().unwrap_or(0);
        let numbers: Vec<Vec<u64>> = (0..most)
            .map(|place| columns.whole(heads.iter().filter(|head| length(**head) > place).count(), 3))
            .collect();
        let mut next: Vec<_> = numbers.iter().map(|column| column.iter()).collect();
        let solution = |head: &u64| {
            let mut place = 0;
            let mut number = || {
                place += 1;
                f64::from(f32::from_bits((*next[place - 1].next().unwrap() as u32) << 8))
            };
            (0..head & 15)
                .map(|k| [number(), if head >> (4 + k) & 1 == 1 { number() } else { 0.0 }])
                .collect()
        };
        heads.iter().map(solution).collect()
    }

    #[test]
    fn real_ones_and_pairs_come_back_and_none_leaves_the_unit_circle() {
        let mut records = MultiplierRecords::default();
        records.push(&[[-53.125, 0.0], [0.999_999, 0.0], [0.3, -0.4], [0.3, 0.4], [1e-9, 0.0]]);
        records.push(&[]);
        records.push(&[[f64::INFINITY, 0.0], [f64::NAN, 0.0]]);
        let found = read(&records);
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
        assert_eq!(read(&records), [many[..MOST_ENTRIES].to_vec()]);
        assert_eq!(records.most(), 40);
    }
}
