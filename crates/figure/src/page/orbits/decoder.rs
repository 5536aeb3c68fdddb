//! Reads what was written, as the page does.

use super::coder::{LEAST_RANGE, LENGTHS, NumberModel, Odds};

pub(super) struct Decoder<'a> {
    bytes: &'a [u8],
    at: usize,
    code: u32,
    range: u32,
}

impl<'a> Decoder<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let mut decoder = Self { bytes, at: 0, code: 0, range: u32::MAX };
        for _ in 0..4 {
            decoder.code = decoder.code << 8 | decoder.next();
        }
        decoder
    }

    fn next(&mut self) -> u32 {
        self.at += 1;
        self.bytes.get(self.at - 1).map_or(0, |byte| u32::from(*byte))
    }

    fn fill(&mut self) {
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.code = self.code << 8 | self.next();
        }
    }

    fn bit(&mut self, odds: &mut Odds) -> bool {
        let bound = (self.range >> 16) * odds.unset.cast_unsigned();
        let is_set = self.code >= bound;
        if is_set {
            self.code -= bound;
            self.range -= bound;
        } else {
            self.range = bound;
        }
        odds.learn(is_set);
        self.fill();
        is_set
    }

    pub(super) fn plain(&mut self, bits: usize) -> u32 {
        (0..bits).fold(0, |number, _| {
            self.range >>= 1;
            let is_set = self.code >= self.range;
            if is_set {
                self.code -= self.range;
            }
            self.fill();
            number << 1 | u32::from(is_set)
        })
    }

    pub(super) fn number(&mut self, kind: &mut NumberModel) -> i32 {
        let row = kind.row();
        let mut length = 0;
        while length < LENGTHS - 1 && self.bit(&mut kind.longer[row + length]) {
            length += 1;
        }
        kind.had(length);
        if length == 0 {
            return 0;
        }
        let is_negative = self.plain(1) == 1;
        let magnitude = if length > 1 {
            let below = u32::from(self.bit(&mut kind.below_leading[length]));
            (2 | below) << (length - 2) | self.plain(length - 2)
        } else {
            1
        };
        if is_negative { 0_i32.wrapping_sub_unsigned(magnitude) } else { magnitude.cast_signed() }
    }
}

mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::page::orbits::coder::Encoder;

    fn written(numbers: &[i32]) -> Vec<u8> {
        let (mut encoder, mut kind) = (Encoder::new(), NumberModel::default());
        numbers.iter().for_each(|number| encoder.number(&mut kind, *number));
        encoder.finish()
    }

    fn read(bytes: &[u8], count: usize) -> Vec<i32> {
        let (mut decoder, mut kind) = (Decoder::new(bytes), NumberModel::default());
        (0..count).map(|_| decoder.number(&mut kind)).collect()
    }

    proptest! {
        #[test]
        fn numbers_come_back(
            numbers in prop::collection::vec(prop_oneof![-3..=3_i32, any::<i32>()], 0..400),
        ) {
            prop_assert_eq!(read(&written(&numbers), numbers.len()), numbers);
        }
    }

    /// Carries run through bytes of 255: many improbable bits after each other.
    #[test]
    fn numbers_that_are_not_expected_come_back() {
        let numbers: Vec<i32> = (0..3000).map(|k| if k % 97 == 0 { i32::MIN } else { 0 }).collect();
        assert_eq!(read(&written(&numbers), numbers.len()), numbers);
        assert_eq!(read(&[], 4), read(&written(&read(&[], 4)), 4));
    }

    /// Signs by chance cost a bit each; of magnitudes that are always 0 or 1, with equal chances, a bit. So
    /// 1.5 bits a number; 3 per cent more is what learning costs.
    #[test]
    fn numbers_take_hardly_more_than_their_entropy() {
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32
        };
        let numbers: Vec<i32> = (0..4000)
            .map(|_| if random() % 2 == 0 { 0 } else { 1 - 2 * (random() % 2).cast_signed() })
            .collect();
        let bits = 8.0 * written(&numbers).len() as f64 / numbers.len() as f64;
        assert!((1.5..1.5 * 1.03).contains(&bits), "{bits}");
    }
}
