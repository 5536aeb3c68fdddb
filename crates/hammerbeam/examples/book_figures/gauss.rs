//! Gauss' rules on [0, 1] for the weights `1` and `2 s`, from the recurrence of the orthonormal polynomials.

/// A weight of [0, 1] with the integral 1.
#[derive(Clone, Copy, PartialEq)]
pub enum Weight {
    /// `1`: Legendre's polynomials.
    One,
    /// `2 s`: Jacobi's of the exponents 0 and 1.
    Rising,
}

impl Weight {
    /// Values at x of [-1, 1] of the orthonormal polynomials of the degrees 0 to n.
    ///
    /// `r_(k+1) P_(k+1) = (x - a_k) P_k - r_k P_(k-1)` with the coefficients of Jacobi's polynomials.
    fn polynomials(self, x: f64, n: usize) -> Vec<f64> {
        let middle = |k: f64| match self {
            Self::One => 0.0,
            Self::Rising => 1.0 / ((2.0 * k + 1.0) * (2.0 * k + 3.0)),
        };
        let root = |k: f64| match self {
            Self::One => k / (4.0 * k * k - 1.0).sqrt(),
            Self::Rising => (k * (k + 1.0)).sqrt() / (2.0 * k + 1.0),
        };
        let mut values = vec![1.0];
        for k in 0..n {
            let below = if k == 0 { 0.0 } else { root(k as f64) * values[k - 1] };
            values.push(((x - middle(k as f64)) * values[k] - below) / root(k as f64 + 1.0));
        }
        values
    }

    /// Nodes and weights of the rule with n nodes.
    pub fn rule(self, n: usize) -> Vec<(f64, f64)> {
        let christoffel = |x: f64| 1.0 / self.polynomials(x, n - 1).iter().map(|p| p * p).sum::<f64>();
        self.roots(n).into_iter().map(|x| (0.5 * (1.0 + x), christoffel(x))).collect()
    }

    /// Roots of the polynomial of degree n, by bisection: those of the degree below lie between them.
    fn roots(self, n: usize) -> Vec<f64> {
        let mut roots: Vec<f64> = Vec::new();
        for degree in 1..=n {
            let ends: Vec<f64> = [-1.0].into_iter().chain(roots).chain([1.0]).collect();
            let value = |x: f64| self.polynomials(x, degree)[degree];
            let between = |pair: &[f64]| {
                let (mut low, mut high) = (pair[0], pair[1]);
                let rises = value(high) > value(low);
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if (value(middle) > 0.0) == rises { high = middle } else { low = middle }
                }
                0.5 * (low + high)
            };
            roots = ends.windows(2).map(between).collect();
        }
        roots
    }
}
