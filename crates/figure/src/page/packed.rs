//! Columns of numbers in few bytes.
//!
//! Along a branch a column is smooth, and so are the bits of its numbers as integers. A column becomes the
//! second differences of these integers, modulo their width. Each is folded so that small ones of either
//! sign have small codes: `d` becomes `2 d`, or `-2 d - 1` where it is negative. The lowest bytes of all
//! codes come first, then the next ones, up to the highest, which are mostly zero. The whole is deflated
//! (RFC 1951). A number comes back bit for bit.

use std::io::Write;

use flate2::{Compression, write::DeflateEncoder};

/// Columns end to end, before they are deflated.
#[derive(Debug, Clone, Default)]
pub(super) struct Packer {
    bytes: Vec<u8>,
}

impl Packer {
    /// A column of eight bytes a number.
    pub(super) fn double(&mut self, numbers: impl Iterator<Item = f64>) {
        self.whole(numbers.map(f64::to_bits), 8);
    }

    /// A column of four bytes a number: the nearest single ones.
    pub(super) fn single(&mut self, numbers: impl Iterator<Item = f64>) {
        self.whole(numbers.map(|number| u64::from((number as f32).to_bits())), 4);
    }

    /// A column of integers of so many bytes each, one to eight; higher ones are left out.
    pub(super) fn whole(&mut self, numbers: impl Iterator<Item = u64>, width: usize) {
        let shift = 64 - 8 * width as u32;
        let (mut last, mut step) = (0_u64, 0_u64);
        let code = |number: u64| {
            // In the highest bytes, where wrapping is that of the width.
            let number = number << shift;
            let next = number.wrapping_sub(last);
            let difference = (next.wrapping_sub(step) as i64) >> shift;
            (last, step) = (number, next);
            ((difference << 1) ^ (difference >> 63)) as u64
        };
        let codes: Vec<u64> = numbers.map(code).collect();
        for byte in 0..width {
            self.bytes.extend(codes.iter().map(|code| code.to_le_bytes()[byte]));
        }
    }

    /// All columns, deflated; nothing of nothing.
    pub(super) fn finish(self) -> Vec<u8> {
        if self.bytes.is_empty() {
            return Vec::new();
        }
        let mut encoder = DeflateEncoder::new(Vec::new(), Compression::new(6));
        encoder.write_all(&self.bytes).and_then(|()| encoder.finish()).expect("memory takes every byte")
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::io::Read;

    use flate2::read::DeflateDecoder;
    use proptest::prelude::*;

    use super::*;

    /// Reads columns as the page does.
    pub(in crate::page) struct Unpacker {
        bytes: Vec<u8>,
        at: usize,
    }

    impl Unpacker {
        pub(in crate::page) fn new(deflated: &[u8]) -> Self {
            let mut bytes = Vec::new();
            if !deflated.is_empty() {
                DeflateDecoder::new(deflated).read_to_end(&mut bytes).unwrap();
            }
            Self { bytes, at: 0 }
        }

        pub(in crate::page) fn whole(&mut self, count: usize, width: usize) -> Vec<u64> {
            let mask = u64::MAX >> (64 - 8 * width);
            let (mut value, mut step) = (0_u64, 0_u64);
            let planes = &self.bytes[self.at..self.at + count * width];
            self.at += count * width;
            let code =
                |k: usize| (0..width).map(|byte| u64::from(planes[byte * count + k]) << (8 * byte)).sum();
            let mut next = |code: u64| {
                step = step.wrapping_add((code >> 1) ^ (code & 1).wrapping_neg());
                value = value.wrapping_add(step) & mask;
                value
            };
            (0..count).map(code).map(&mut next).collect()
        }

        pub(in crate::page) fn double(&mut self, count: usize) -> Vec<f64> {
            self.whole(count, 8).into_iter().map(f64::from_bits).collect()
        }

        pub(in crate::page) fn single(&mut self, count: usize) -> Vec<f32> {
            self.whole(count, 4).into_iter().map(|bits| f32::from_bits(bits as u32)).collect()
        }

        pub(in crate::page) fn is_at_the_end(&self) -> bool {
            self.at == self.bytes.len()
        }
    }

    proptest! {
        #[test]
        fn columns_come_back_bit_for_bit(
            doubles in prop::collection::vec(any::<f64>(), 0..40),
            wholes in prop::collection::vec(0_u64..1 << 24, 0..40),
        ) {
            let mut packer = Packer::default();
            packer.double(doubles.iter().copied());
            packer.whole(wholes.iter().copied(), 3);
            packer.single(doubles.iter().copied());
            let mut columns = Unpacker::new(&packer.finish());
            let bits = |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
            prop_assert_eq!(bits(&columns.double(doubles.len())), bits(&doubles));
            prop_assert_eq!(columns.whole(wholes.len(), 3), wholes);
            let single = columns.single(doubles.len());
            let single: Vec<u32> = single.iter().map(|number| number.to_bits()).collect();
            let wanted: Vec<u32> = doubles.iter().map(|number| (*number as f32).to_bits()).collect();
            prop_assert_eq!(single, wanted);
            prop_assert!(columns.is_at_the_end());
        }
    }

    #[test]
    fn a_smooth_column_takes_half_of_its_bytes() {
        let mut packer = Packer::default();
        packer.double((0..10_000).map(|k| 30.0 + (f64::from(k) * 1e-3).sin()));
        assert!(packer.finish().len() < 40_000);
    }
}
