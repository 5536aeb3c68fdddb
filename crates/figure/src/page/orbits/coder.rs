//! Whole numbers as bits: an adaptive range coder of two symbols.
//!
//! Numbers form series of several kinds. For each number the length of its magnitude in bits is written
//! first, as a sequence of decisions "longer than `j`", then its sign, then the bits below the leading one.
//! Each decision has its own odds for each kind and for each sum of the lengths of the two preceding numbers
//! of the series, since small numbers follow small ones. The bit below the leading one has odds for each kind
//! and length; the sign and the other bits are written unmodelled.
//!
//! Odds are the probability of "no" in 65 536ths, with a count of their updates. Each update moves them
//! towards the outcome by one part in that count plus one, rounded towards zero. Initial odds expect a length
//! near the mean of the two preceding ones.
//!
//! # Source
//! Martin, *Range encoding*, Video and Data Recording Conference, Southampton 1979; carries are handled as in
//! Pavlov's LZMA.

/// Range below which another byte is written.
pub(super) const LEAST_RANGE: u32 = 1 << 24;
/// Number of distinguished sums of two lengths.
const SUMS: usize = 16;
/// Lengths of a number in bits, 0 included.
pub(super) const LENGTHS: usize = 33;
/// Initial and largest count of updates.
const MET: [i32; 2] = [2, 40];

/// The probability of a bit that is not set, in 65 536ths.
#[derive(Debug, Clone, Copy)]
pub(super) struct Odds {
    pub(super) unset: i32,
    met: i32,
}

impl Odds {
    fn new(unset: i32) -> Self {
        Self { unset, met: MET[0] }
    }

    pub(super) fn learn(&mut self, is_set: bool) {
        let aim = if is_set { 0 } else { 65_536 };
        self.unset = (self.unset + (aim - self.unset) / (self.met + 1)).clamp(64, 65_536 - 64);
        self.met = (self.met + 1).min(MET[1]);
    }
}

/// Adaptive model of the numbers of a kind.
#[derive(Debug, Clone)]
pub(super) struct NumberModel {
    pub(super) longer: Vec<Odds>,
    pub(super) below_leading: Vec<Odds>,
    /// Lengths of the two numbers before.
    before: [usize; 2],
}

impl Default for NumberModel {
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

impl NumberModel {
    /// Starts another series.
    pub(super) fn begin(&mut self) {
        self.before = [0; 2];
    }

    /// Index of the first odds for the length of the next number.
    pub(super) fn row(&self) -> usize {
        self.before.iter().sum::<usize>().min(SUMS - 1) * LENGTHS
    }

    pub(super) fn had(&mut self, length: usize) {
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
    pub(super) fn number(&mut self, kind: &mut NumberModel, number: i32) {
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

    /// Writes the lowest bits of a number unmodelled, the highest of them first.
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

    /// Outputs the highest byte, which a carry may still change.
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

    /// The bytes without trailing zeros, which the decoder supplies.
    pub(super) fn finish(mut self) -> Vec<u8> {
        // The number within the range with the most trailing zeros.
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
