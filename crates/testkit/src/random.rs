//! Numbers for tests that try many cases.

/// Numbers from 0 to 1, the same ones for the same seed.
#[derive(Debug, Clone)]
pub struct SeededNumbers(pub u64);

impl SeededNumbers {
    /// The next number, at least 0 and below 1.
    pub fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}
