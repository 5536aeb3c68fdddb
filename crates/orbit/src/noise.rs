//! Numbers that look random and are always the same ones: splitmix64.
//!
//! # Source
//! Steele, Lea and Flood, OOPSLA 2014.

/// A sequence of random bits.
#[derive(Debug, Clone)]
pub(crate) struct Noise(u64);

impl Noise {
    /// The sequence of this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Uniform from -1 to 1.
    pub fn signed(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Uniform from 0 to 1.
    pub fn share(&mut self) -> f64 {
        0.5 * (1.0 + self.signed())
    }

    /// A place in a list of this length, which is not empty.
    pub fn below(&mut self, length: usize) -> usize {
        ((self.share() * length as f64) as usize).min(length - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First number of the reference implementation from the seed 0.
    #[test]
    fn numbers_are_those_of_splitmix64() {
        assert_eq!(Noise::new(0).bits(), 0xe220_a839_7b1d_cdaf);
    }
}
