//! A harmonic load at or near the resonance of a block that damping hardly holds.
//!
//! From rest the complex motion X, of which the real part counts, is `G(A) u` with the block's matrix A, the
//! load `u = [beta; phi]` and
//!
//! `G(l) = int_0^t exp(l (t - v) + m v) dv = f[l, m]`, `f(l) = exp(l t)`, `m = i w`,
//!
//! a divided difference of f. A function of a matrix with the eigenvalues `l_1, l_2 = -c/2 +- i n`, `n =
//! sqrt(k - c^2/4)`, is its polynomial through both,
//!
//! `G(A) = G(l_1) + D (A - l_1)`, `D = (G(l_1) - G(l_2))/(2 i n)`.
//!
//! Near resonance `l_1` meets m: there `G(l_1) = exp(m t) t e_1((l_1 - m) t)` by `divided.rs`, whatever the
//! distance, with `l_1 - m = -c/2 + i (k - c^2/4 - w^2)/(n + w)`. The other eigenvalue and the difference of
//! both are some 2 w away, so `G(l_2) = (exp(l_2 t) - exp(m t))/(l_2 - m)` and D divide by nothing small. The
//! steady response and what of it dies out, each of which has no bound at resonance, are never formed.
//!
//! **By the frequency**, at fixed time, `m' = i w'`, and `df[l, m]/dm = f[l, m, m] = H(l)`:
//!
//! `X_f = G(A) u_f + i w' H(A) u`, `H(l_1) = exp(m t) t^2 e_2((l_1 - m) t)`, `H(l_2) = (t exp(m t) -
//! G(l_2))/(m - l_2)`,
//!
//! with the polynomial through both again.
//!
//! **Derivatives by the time** follow from the equation itself, `X^(j+1) = A X^(j) + m^j u exp(m t)`.
//!
//! **Bounds.** In the energy norm `sqrt(k |p|^2 + |s|^2)` damping only takes, and the load gives at most `g
//! = |u|` a time: `|X| <= e_0 = g t`. As the norm of A is at most `a = sqrt(k) + c`, the derivatives have
//! the bounds `e_(j+1) = a e_j + w^j g`. With `r = max(a, w)` and all times up to T that is `e_j <= r^(j-1)
//! g (j + r T)`, so for `2 <= j <= J` at most `r^(j-2) (r e_1 + r g (J - 1))` with `e_1 = g (1 + r T)`.

use faer::c64;

use super::{
    super::{elementary::sine_and_cosine, majorant::Majorant, output::Output},
    divided::complex_divided,
};

/// The load and its block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Resonant {
    stiffness: f64,
    damping: f64,
    /// w, and its derivative by the excitation frequency.
    frequency: (f64, f64),
    /// `[beta, phi]` at the start.
    input: [c64; 2],
    input_by_frequency: [c64; 2],
}

/// A function of the block's matrix, `constant + linear A`.
#[derive(Debug, Clone, Copy)]
struct OfMatrix {
    constant: c64,
    linear: c64,
}

/// What the motion is made of at a time.
struct Parts {
    /// `exp(i w t)`.
    rotation: c64,
    /// `G(A)` and `H(A)`.
    motion: OfMatrix,
    by_frequency: OfMatrix,
}

impl Resonant {
    pub fn new(
        (stiffness, damping): (f64, f64),
        input: [c64; 2],
        input_by_frequency: [c64; 2],
        frequency: (f64, f64),
    ) -> Self {
        Self { stiffness, damping, frequency, input, input_by_frequency }
    }

    /// `[p, s]` at `time` after the start, and its derivatives by the time.
    pub fn derivatives<const N: usize>(&self, time: f64) -> [[f64; 2]; N] {
        let Parts { rotation, motion, .. } = self.parts(time);
        let mut state = self.apply(motion, self.input).map(|value| value.re);
        let mut load = self.input.map(|value| value * rotation);
        std::array::from_fn(|_| {
            let here = state;
            let restored = self.stiffness * here[0] + self.damping * here[1];
            state = [here[1] + load[0].re, load[1].re - restored];
            load = load.map(|value| value * c64::new(0.0, self.frequency.0));
            here
        })
    }

    /// Derivatives of `[p, s]` and of its rate by the frequency.
    pub fn by_frequency(&self, time: f64) -> [[f64; 2]; 2] {
        let Parts { rotation, motion, by_frequency } = self.parts(time);
        let turning = c64::new(0.0, self.frequency.1);
        let (own, turned) =
            (self.apply(motion, self.input_by_frequency), self.apply(by_frequency, self.input));
        let [p, s] = [0, 1].map(|row| (own[row] + turning * turned[row]).re);
        let load = [0, 1]
            .map(|row| ((self.input_by_frequency[row] + turning * time * self.input[row]) * rotation).re);
        [[p, s], [s + load[0], load[1] - self.stiffness * p - self.damping * s]]
    }

    /// Bounds on what `output` reads of the block, until `until`, and on its derivatives.
    ///
    /// * `block`: the place of the block.
    pub fn bounds<const N: usize>(&self, block: usize, output: &Output, until: f64) -> [f64; N] {
        let (size, rate) = (self.size(), self.rate());
        let (mut norm, mut load) = (size * until, size);
        std::array::from_fn(|_| {
            let here = norm;
            (norm, load) = (rate * here + load, load * self.frequency.0);
            output.value_bound[block] * here
        })
    }

    /// The same of all derivatives.
    pub fn majorant(&self, block: usize, output: &Output, until: f64) -> Majorant {
        let rate = self.rate().max(self.frequency.0);
        let size = output.value_bound[block] * self.size();
        let further = f64::from(Majorant::DERIVATIVES - 1);
        Majorant { speed: size * (1.0 + rate * until), rate, acceleration: size * rate * further }
    }

    /// `|u|`.
    fn size(&self) -> f64 {
        let [beta, phi] = self.input.map(|value| value.norm_sqr());
        (self.stiffness * beta + phi).sqrt()
    }

    /// `a`.
    fn rate(&self) -> f64 {
        self.stiffness.sqrt() + self.damping
    }

    fn parts(&self, t: f64) -> Parts {
        let ((w, _), half) = (self.frequency, 0.5 * self.damping);
        let square = self.stiffness - half * half;
        let n = square.sqrt();
        let (sin, cos) = sine_and_cosine(w * t);
        let rotation = c64::new(cos, sin);
        let (near, far) = (c64::new(-half, n), c64::new(-half, -n));
        let apart = c64::new(-half, (square - w * w) / (n + w)) * t;
        let [first, second] = complex_divided(apart);
        let of_far = far - c64::new(0.0, w);
        let vibration = rotation * (apart * first + 1.0);
        let motion = [rotation * first * t, (vibration.conj() - rotation) / of_far];
        let by_frequency = [rotation * second * (t * t), (motion[1] - rotation * t) / of_far];
        let through = |[at_near, at_far]: [c64; 2]| {
            let linear = (at_near - at_far) / c64::new(0.0, 2.0 * n);
            OfMatrix { constant: at_near - near * linear, linear }
        };
        Parts { rotation, motion: through(motion), by_frequency: through(by_frequency) }
    }

    fn apply(&self, of: OfMatrix, [p, s]: [c64; 2]) -> [c64; 2] {
        let moved = [s, -p * self.stiffness - s * self.damping];
        [of.constant * p + of.linear * moved[0], of.constant * s + of.linear * moved[1]]
    }
}
