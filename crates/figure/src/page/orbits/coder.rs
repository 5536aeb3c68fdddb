//! Whole numbers as bits: an adaptive range coder of two symbols.
//!
//! Numbers come in series of some kinds. Of a number the length of its magnitude in bits is written first,
//! one after the other "it is longer than `j`", then its sign, then the bits below the leading one. Each
//! "longer than `j`" has odds of its own, for each kind and for each sum of the lengths of the two numbers
//! before it in the series: what is small is followed by what is small. The bit below the leading one has
//! odds, too, for each kind and length; the sign and the others are written as they are.
//!
//! Odds are the probability of "no", in 65 536ths, with the number of times that they were met: each time
//! they go to what came by one part in that number plus one, rounded towards zero. Before that they say that
//! a length is like the mean of the two before.
//!
//! # Source
//! Martin, *Range encoding*, Video and Data Recording Conference, Southampton 1979; how carries are handled
//! is that of Pavlov's LZMA.

/// Below this range another byte is written.
const LEAST_RANGE: u32 = 1 << 24;
/// Sums of two lengths that are told apart.
const SUMS: usize = 16;
/// Lengths of a number in bits, 0 included.
const LENGTHS: usize = 33;
/// How often odds count as met at first, and at most.
const MET: [i32; 2] = [2, 40];

/// The probability of a bit that is not set, in 65 536ths.
#[derive(Debug, Clone, Copy)]
struct Odds {
    unset: i32,
    met: i32,
}

impl Odds {
    fn new(unset: i32) -> Self {
        Self { unset, met: MET[0] }
    }

    fn learn(&mut self, is_set: bool) {
        let aim = if is_set { 0 } else { 65_536 };
        self.unset = (self.unset + (aim - self.unset) / (self.met + 1)).clamp(64, 65_536 - 64);
        self.met = (self.met + 1).min(MET[1]);
    }
}

/// What was learned of the numbers of a kind.
#[derive(Debug, Clone)]
pub(super) struct Kind {
    longer: Vec<Odds>,
    below_leading: Vec<Odds>,
    /// Lengths of the two numbers before.
    before: [usize; 2],
}

impl Default for Kind {
    fn default() -> Self {
        let odds = |place: usize| {
            let (sum, length) = ((place / LENGTHS) as i32, (place % LENGTHS) as i32);
            Odds::new((32_768 + 6_000 * (2 * length - sum)).clamp(4_096, 61_440))
        };
        Self {
            longer: (0..SUMS * LENGTHS).map(odds).collect(),
            below_leading: vec![Odds::new(32_768); LENGTHS],
            before: [0; 2],
        }
    }
}

impl Kind {
    /// Another series begins.
    pub(super) fn begin(&mut self) {
        self.before = [0; 2];
    }

    /// Where the odds for lengths of the next number begin.
    fn row(&self) -> usize {
        self.before.iter().sum::<usize>().min(SUMS - 1) * LENGTHS
    }

    fn had(&mut self, length: usize) {
        self.before = [length, self.before[0]];
    }
}

/// Writes numbers.
#[derive(Debug)]
pub(super) struct Encoder {
    bytes: Vec<u8>,
    low: u64,
    range: u32,
    /// The byte that a carry may still change, and how many of 255 follow it.
    held: Option<u8>,
    full: usize,
}

impl Encoder {
    pub(super) fn new() -> Self {
        Self { bytes: Vec::new(), low: 0, range: u32::MAX, held: None, full: 0 }
    }

    /// Writes a number of a kind.
    pub(super) fn number(&mut self, kind: &mut Kind, number: i32) {
        let magnitude = number.unsigned_abs();
        let length = (u32::BITS - magnitude.leading_zeros()) as usize;
        let row = kind.row();
        for j in 0..=length.min(LENGTHS - 2) {
            self.bit(&mut kind.longer[row + j], j < length);
        }
        kind.had(length);
        if length > 0 {
            self.plain(u32::from(number < 0), 1);
        }
        if length > 1 {
            self.bit(&mut kind.below_leading[length], magnitude >> (length - 2) & 1 == 1);
            self.plain(magnitude, length - 2);
        }
    }

    /// Writes the lowest bits of a number as they are, the highest of them first.
    pub(super) fn plain(&mut self, number: u32, bits: usize) {
        for bit in (0..bits).rev() {
            self.range >>= 1;
            if number >> bit & 1 == 1 {
                self.low += u64::from(self.range);
            }
            self.fill();
        }
    }

    fn bit(&mut self, odds: &mut Odds, is_set: bool) {
        let bound = (self.range >> 16) * odds.unset.cast_unsigned();
        if is_set {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        odds.learn(is_set);
        self.fill();
    }

    fn fill(&mut self) {
        while self.range < LEAST_RANGE {
            self.range <<= 8;
            self.shift();
        }
    }

    /// Gives away the highest byte, which may still get a carry.
    fn shift(&mut self) {
        let carry = (self.low >> 32) as u8;
        if carry == 1 || self.low < 0xff00_0000 {
            self.bytes.extend(self.held.map(|byte| byte.wrapping_add(carry)));
            self.bytes.extend(std::iter::repeat_n(0xff_u8.wrapping_add(carry), self.full));
            (self.held, self.full) = (Some((self.low >> 24) as u8), 0);
        } else {
            self.full += 1;
        }
        self.low = (self.low << 8) & 0xffff_ffff;
    }

    /// The bytes, without zeros at their end: who reads finds zeros there.
    pub(super) fn finish(mut self) -> Vec<u8> {
        // The number within the range that has most zeros at its end.
        self.low = (self.low + u64::from(LEAST_RANGE) - 1) & !u64::from(LEAST_RANGE - 1);
        for _ in 0..5 {
            self.shift();
        }
        while self.bytes.last() == Some(&0) {
            self.bytes.pop();
        }
        self.bytes
    }
}

#[cfg(test)]
pub(super) mod reader {
    //! Reads what was written, as the page does.

    use super::*;

    pub struct Decoder<'a> {
        bytes: &'a [u8],
        at: usize,
        code: u32,
        range: u32,
    }

    impl<'a> Decoder<'a> {
        pub fn new(bytes: &'a [u8]) -> Self {
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

        pub fn plain(&mut self, bits: usize) -> u32 {
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

        pub fn number(&mut self, kind: &mut Kind) -> i32 {
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
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::{reader::Decoder, *};

    fn written(numbers: &[i32]) -> Vec<u8> {
        let (mut encoder, mut kind) = (Encoder::new(), Kind::default());
        numbers.iter().for_each(|number| encoder.number(&mut kind, *number));
        encoder.finish()
    }

    fn read(bytes: &[u8], count: usize) -> Vec<i32> {
        let (mut decoder, mut kind) = (Decoder::new(bytes), Kind::default());
        (0..count).map(|_| decoder.number(&mut kind)).collect()
    }

    proptest! {
        #[test]
        fn numbers_come_back(numbers in prop::collection::vec(prop_oneof![-3..=3_i32, any::<i32>()], 0..400)) {
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
