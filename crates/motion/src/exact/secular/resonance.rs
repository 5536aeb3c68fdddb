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
//! **Shortly after the start** the motion is small against what it is made of here, and sensitivities there
//! are compared with nothing else. Up to [`EARLY`] radians the power series serves, with `l_j = (m
//! t)^j/j!`:
//!
//! `X = sum_j a_j`, `a_(j+1) = t/(j + 1) (A a_j + l_j u)`, `a_0 = 0`, and for `X_f` the same with `l_j u_f +
//! i w' t l_(j-1) u` in the place of `l_j u`.
//!
//! **Derivatives by the time** follow from the equation itself, `X^(j+1) = A X^(j) + m^j u exp(m t)`.
//!
//! **Bounds.** In the energy norm `sqrt(k |p|^2 + |s|^2)` damping only takes, and the load gives at most `g
//! = |u|` a time: `|X| <= e_0 = g t`. As the norm of A is at most `a = sqrt(k) + c`, the derivatives have
//! the bounds `e_(j+1) = a e_j + w^j g`. With `r = max(a, w)` and all times up to T that is `e_j <= r^(j-1)
//! g (j + r T)`, so for `2 <= j <= J` at most `r^(j-2) (r e_1 + r g (J - 1))` with `e_1 = g (1 + r T)`.
//!
//! **Constant loads** on slow blocks are the case `w = 0`, for which the power series serves up to [`EARLY`]
//! radians of the block, and nothing is lost beyond. The energy norm knows nothing of how slow it is: its
//! bound on p is `1/sqrt(k)` times that on s. But with `|s| <= g t`, `|p| <= |beta| t + g t^2/2`, and from
//! the equation `|s'| <= k |p| + c |s| + |phi|` and so on.

use faer::c64;

use super::{
    super::{elementary::sine_and_cosine, majorant::Majorant, output::Output},
    divided::complex_divided,
};

/// Radians of the load, or of the block under a constant load, up to which the power series serves.
const EARLY: f64 = 1.0;
/// Its terms: they fall like `j/j!`, and the first one left out is below 1e-20 of the first.
const TERMS: u32 = 22;

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
        let rotation = self.rotation(time);
        let mut state = self.motion(time, rotation).map(|value| value.re);
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
        let (rotation, turning) = (self.rotation(time), c64::new(0.0, self.frequency.1));
        let [p, s] = self.motion_by_frequency(time, rotation).map(|value| value.re);
        let load = [0, 1]
            .map(|row| ((self.input_by_frequency[row] + turning * time * self.input[row]) * rotation).re);
        [[p, s], [s + load[0], load[1] - self.stiffness * p - self.damping * s]]
    }

    /// Bounds on what `output` reads of the block, until `until`, and on its derivatives.
    ///
    /// * `block`: the place of the block.
    pub fn bounds<const N: usize>(&self, block: usize, output: &Output, until: f64) -> [f64; N] {
        if self.frequency.0 == 0.0 {
            return self.bounds_of_slow(block, output, until);
        }
        let (size, rate) = (self.size(), self.rate());
        let (mut norm, mut load) = (size * until, size);
        std::array::from_fn(|_| {
            let here = norm;
            (norm, load) = (rate * here + load, load * self.frequency.0);
            output.value_bound[block] * here
        })
    }

    /// The same for a constant load.
    fn bounds_of_slow<const N: usize>(&self, block: usize, output: &Output, until: f64) -> [f64; N] {
        let rows = [block, output.row.len() / 2 + block].map(|place| output.row[place].abs());
        let [beta, phi] = self.input.map(|value| value.norm());
        let speed = self.size() * until;
        let (mut state, mut load) = ([(beta + 0.5 * speed) * until, speed], [beta, phi]);
        std::array::from_fn(|_| {
            let [p, s] = state;
            state = [s + load[0], self.stiffness * p + self.damping * s + load[1]];
            load = [0.0; 2];
            rows[0] * p + rows[1] * s
        })
    }

    /// The same of all derivatives.
    pub fn majorant(&self, block: usize, output: &Output, until: f64) -> Majorant {
        let rate = self.rate().max(self.frequency.0);
        let size = output.value_bound[block] * self.size();
        let further = f64::from(Majorant::DERIVATIVES - 1);
        let speed = if self.frequency.0 == 0.0 {
            let [_, speed] = self.bounds_of_slow(block, output, until);
            speed
        } else {
            size * (1.0 + rate * until)
        };
        Majorant { speed, rate, acceleration: size * rate * further }
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

    /// Whether the power series serves.
    fn is_early(&self, t: f64) -> bool {
        let rate = if self.frequency.0 == 0.0 { self.rate() } else { self.frequency.0 };
        rate * t.abs() <= EARLY
    }

    /// `exp(m t)`.
    fn rotation(&self, t: f64) -> c64 {
        let (sin, cos) = sine_and_cosine(self.frequency.0 * t);
        c64::new(cos, sin)
    }

    /// `X`.
    fn motion(&self, t: f64, rotation: c64) -> [c64; 2] {
        if self.is_early(t) {
            return self.early(t, |now, _| self.input.map(|u| u * now));
        }
        let [motion, _] = self.at_eigenvalues(t, rotation);
        self.apply(motion, self.input)
    }

    /// `X_f`.
    fn motion_by_frequency(&self, t: f64, rotation: c64) -> [c64; 2] {
        let turning = c64::new(0.0, self.frequency.1);
        if self.is_early(t) {
            let load = |row: usize, now: c64, before: c64| {
                self.input_by_frequency[row] * now + self.input[row] * before * turning * t
            };
            return self.early(t, |now, before| [0, 1].map(|row| load(row, now, before)));
        }
        let [motion, moved] = self.at_eigenvalues(t, rotation);
        let [own, turned] = [self.apply(motion, self.input_by_frequency), self.apply(moved, self.input)];
        [0, 1].map(|row| own[row] + turning * turned[row])
    }

    /// The power series.
    ///
    /// * `load`: what takes the place of `l_j u`, from `l_j` and `l_(j-1)`.
    fn early(&self, t: f64, load: impl Fn(c64, c64) -> [c64; 2]) -> [c64; 2] {
        let zero = c64::new(0.0, 0.0);
        let (mut term, mut sum) = ([zero; 2], [zero; 2]);
        let (mut now, mut before) = (c64::new(1.0, 0.0), zero);
        for j in 1..=TERMS {
            let (moved, load, part) = (self.times(term), load(now, before), t / f64::from(j));
            term = [0, 1].map(|row| (moved[row] + load[row]) * part);
            sum = [0, 1].map(|row| sum[row] + term[row]);
            (now, before) = (now * c64::new(0.0, self.frequency.0 * part), now);
        }
        sum
    }

    /// `G` and `H` at both eigenvalues.
    fn at_eigenvalues(&self, t: f64, rotation: c64) -> [[c64; 2]; 2] {
        let (w, half, n) = (self.frequency.0, 0.5 * self.damping, self.turning());
        let apart = c64::new(-half, (self.stiffness - half * half - w * w) / (n + w)) * t;
        let [first, second] = complex_divided(apart);
        let of_far = c64::new(-half, -n - w);
        let vibration = rotation * (apart * first + 1.0);
        let motion = [rotation * first * t, (vibration.conj() - rotation) / of_far];
        [motion, [rotation * second * (t * t), (motion[1] - rotation * t) / of_far]]
    }

    /// n.
    fn turning(&self) -> f64 {
        (self.stiffness - 0.25 * self.damping * self.damping).sqrt()
    }

    /// What a function of the matrix, from its values at both eigenvalues, makes of a load.
    fn apply(&self, [near, far]: [c64; 2], load: [c64; 2]) -> [c64; 2] {
        let (n, half) = (self.turning(), 0.5 * self.damping);
        let linear = (near - far) / c64::new(0.0, 2.0 * n);
        let constant = near - c64::new(-half, n) * linear;
        let moved = self.times(load);
        [0, 1].map(|row| constant * load[row] + linear * moved[row])
    }

    /// A times a complex state.
    fn times(&self, [p, s]: [c64; 2]) -> [c64; 2] {
        [s, -p * self.stiffness - s * self.damping]
    }
}
