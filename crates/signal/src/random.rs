//! Random numbers from a seed, reproducible on every machine and in every version.
//!
//! SplitMix64 (Steele, Lea and Flood, OOPSLA 2014) for bits, the polar method (Marsaglia and Bray, SIAM Rev.
//! 6 (1964), 260-264) for the normal distribution.

/// A source of random numbers.
#[derive(Debug, Clone)]
pub struct RandomSource {
    state: u64,
    spare: Option<f64>,
}

impl RandomSource {
    /// A source with a seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self { state: seed, spare: None }
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform between 0 and 1, 1 excluded.
    pub fn uniform(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * 2.0_f64.powi(-53)
    }

    /// Normal, mean 0, standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let (u, v) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let square = u * u + v * v;
            if square > 0.0 && square < 1.0 {
                let factor = (-2.0 * square.ln() / square).sqrt();
                self.spare = Some(v * factor);
                return u * factor;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_match_the_normal_distribution() {
        let mut random = RandomSource::new(1);
        let values: Vec<f64> = (0..100_000).map(|_| random.normal()).collect();
        let moment = |power: i32| values.iter().map(|value| value.powi(power)).sum::<f64>() / 1e5;
        // Standard errors 0.003, 0.0045, 0.012, 0.03; four of them.
        assert!(moment(1).abs() < 0.013 && (moment(2) - 1.0).abs() < 0.018);
        assert!(moment(3).abs() < 0.05 && (moment(4) - 3.0).abs() < 0.13);
    }
}
