//! A random sample of what is stored, the same for the same seed.

/// Numbers that look random: splitmix64.
///
/// # Source
/// Steele, Lea and Flood, *Fast splittable pseudorandom number generators*, OOPSLA 2014.
struct SplitMix(u64);

impl SplitMix {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number from 0 to below 1.
    fn fraction(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// `count` of the numbers from 0 to below `total`, ascending, each choice as likely; all if there are no
/// more.
///
/// # Source
/// Knuth, *The Art of Computer Programming*, volume 2, section 3.4.2, algorithm S.
pub(super) fn sample(total: u64, count: u64, seed: u64) -> Vec<u64> {
    let mut random = SplitMix(seed);
    let mut chosen = Vec::new();
    let mut wanted = count.min(total);
    for number in 0..total {
        if random.fraction() * ((total - number) as f64) < wanted as f64 {
            chosen.push(number);
            wanted -= 1;
        }
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_has_its_size_and_is_the_same_for_the_same_seed() {
        for (total, count) in [(0, 5), (3, 5), (5, 5), (1000, 1), (1000, 100)] {
            let chosen = sample(total, count, 7);
            assert_eq!(chosen.len() as u64, count.min(total));
            assert!(chosen.windows(2).all(|pair| pair[0] < pair[1]) && chosen.iter().all(|n| *n < total));
            assert_eq!(chosen, sample(total, count, 7));
        }
        assert_ne!(sample(1000, 100, 7), sample(1000, 100, 8));
    }

    /// The mean of 100 numbers below 1000 is 499.5 with a standard deviation of 27.4.
    #[test]
    fn samples_are_spread_evenly() {
        let mean = |seed| sample(1000, 100, seed).iter().sum::<u64>() as f64 / 100.0;
        let means: f64 = (0..100).map(mean).sum::<f64>() / 100.0;
        assert!((means - 499.5).abs() < 4.0 * 2.74, "{means}");
    }

    /// The first numbers of the published generator for the seed 1234567.
    #[test]
    fn numbers_are_those_of_splitmix64() {
        let mut random = SplitMix(1_234_567);
        assert_eq!([random.next(), random.next()], [6_457_827_717_110_365_317, 3_203_168_211_198_807_973]);
    }
}
