//! The exponential of one second-order block in closed form, and those of four at once.
//! Equation (F3) of the book, `docs/theory`.

use super::{
    elementary::{DECAY, TURNING, cosines_and_sines, exponential, exponentials, sine_and_cosine},
    lanes::vectorised,
};

/// Exponential of one block over a time t: `[p; s](t) = [a b; c d] [p; s](0)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Propagator {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub d: f64,
}

impl Propagator {
    /// Propagator of `p'' + c p' + k p = 0` over `time`.
    ///
    /// With `h = c/2`, `D = k - h^2`: `exp(A t) = exp(-h t) (C I + S (A + h I))`, `C = cos(sqrt(D) t)` and
    /// `S = sin(sqrt(D) t)/sqrt(D)`, continued to `D <= 0`.
    #[inline]
    pub fn new(stiffness: f64, damping: f64, time: f64) -> Self {
        let half = 0.5 * damping;
        Self::of(stiffness, half, decayed_cosine_and_sine(stiffness, half, time))
    }

    /// From half the damping, `exp(-h t) C` and `exp(-h t) S`.
    #[inline(always)]
    fn of(stiffness: f64, half: f64, (cosine, sine): (f64, f64)) -> Self {
        Self { a: cosine + half * sine, b: sine, c: -stiffness * sine, d: cosine - half * sine }
    }

    /// The propagator and its derivatives by the damping c and by the stiffness k.
    ///
    /// With `D' = -h`, `h' = 1/2` by c and `D' = 1`, `h' = 0` by k, from `C' = -t S D'/2` and `S' = (t C -
    /// S)/(2 D) D'`, which is `t^3 (-1/6 + D t^2/60 - ...) D'`; for `D << 0` from the exponentials of the two
    /// roots.
    pub fn with_derivatives(stiffness: f64, damping: f64, time: f64) -> (Self, Self, Self) {
        let (k, half, t) = (stiffness, 0.5 * damping, time);
        let discriminant = k - half * half;
        let (cosine, sine) = decayed_cosine_and_sine(stiffness, half, t);
        let square = discriminant * t * t;
        let cosine_k = -0.5 * t * sine;
        let (sine_k, cosine_c, sine_c);
        if square < -SERIES {
            let rate = (-discriminant).sqrt();
            let slow = (-k / (half + rate) * t).exp();
            let fast = (-(half + rate) * t).exp();
            // `d/dc` of the exponents; `1 - h/rate = -k/(rate (h + rate))`.
            let slow_c = 0.5 * t * k / (rate * (half + rate)) * slow;
            let fast_c = -0.5 * t * (1.0 + half / rate) * fast;
            sine_k = -(t * cosine - sine) / (2.0 * rate * rate);
            cosine_c = 0.5 * (slow_c + fast_c);
            sine_c = 0.5 * (slow_c - fast_c) / rate - 0.5 * sine * half / (rate * rate);
        } else {
            sine_k = if square > SERIES {
                0.5 * (t * cosine - sine) / discriminant
            } else {
                (-half * t).exp() * t.powi(3) * sine_series_slope(square)
            };
            cosine_c = -0.5 * t * cosine - half * cosine_k;
            sine_c = -0.5 * t * sine - half * sine_k;
        }
        let itself = Self { a: cosine + half * sine, b: sine, c: -k * sine, d: cosine - half * sine };
        let turn = 0.5 * sine + half * sine_c;
        let by_damping = Self { a: cosine_c + turn, b: sine_c, c: -k * sine_c, d: cosine_c - turn };
        let by_stiffness = Self {
            a: cosine_k + half * sine_k,
            b: sine_k,
            c: -sine - k * sine_k,
            d: cosine_k - half * sine_k,
        };
        (itself, by_damping, by_stiffness)
    }

    /// Applies the propagator to `(p, s)`.
    #[inline]
    pub fn apply(&self, p: f64, s: f64) -> (f64, f64) {
        (self.a * p + self.b * s, self.c * p + self.d * s)
    }
}

/// Four blocks, for which propagators are made at once where all of them oscillate (`D > 0`).
#[derive(Debug, Clone, Copy)]
pub(super) struct Four {
    stiffness: [f64; 4],
    /// Half the damping.
    half: [f64; 4],
    /// `sqrt(D)`.
    frequency: [f64; 4],
    /// Longest time within the reach of `elementary.rs`; not a number if one does not oscillate.
    reach: f64,
}

impl Four {
    pub fn new(stiffness: [f64; 4], damping: [f64; 4]) -> Self {
        let half = damping.map(|damping| 0.5 * damping);
        let discriminant: [f64; 4] = std::array::from_fn(|i| stiffness[i] - half[i] * half[i]);
        let frequency = discriminant.map(f64::sqrt);
        let largest = |values: &[f64; 4]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let oscillate = discriminant.iter().all(|d| *d >= f64::MIN_POSITIVE);
        let reach = (TURNING / largest(&frequency)).min(DECAY / largest(&half));
        // What just reaches it may round to what lies beyond.
        let reach = if oscillate { (1.0 - f64::EPSILON) * reach } else { f64::NAN };
        Self { stiffness, half, frequency, reach }
    }

    /// Bit by bit those of [`Propagator::new`]; `None` where these have to serve.
    #[inline]
    pub fn propagators(&self, time: f64) -> Option<Quad> {
        let serves = time.abs() <= self.reach;
        if !serves {
            return None;
        }
        let Self { stiffness, half, frequency, .. } = self;
        let (angles, exponents) = (frequency.map(|w| w * time), half.map(|h| -h * time));
        // On its own: together with the rest the compiler does not make vectors of it.
        let mut decays = [0.0; 4];
        vectorised(
            #[inline(always)]
            || decays = exponentials(&exponents),
        );
        let mut quad = Quad::default();
        vectorised(
            #[inline(always)]
            || {
                let [cosines, sines] = cosines_and_sines(&angles);
                for i in 0..4 {
                    let (half, k) = (half[i], stiffness[i]);
                    let (cosine, sine) = (decays[i] * cosines[i], decays[i] * sines[i] / frequency[i]);
                    quad.a[i] = cosine + half * sine;
                    quad.b[i] = sine;
                    quad.c[i] = -k * sine;
                    quad.d[i] = cosine - half * sine;
                }
            },
        );
        Some(quad)
    }
}

/// Propagators of four blocks, entry by entry.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Quad {
    a: [f64; 4],
    b: [f64; 4],
    c: [f64; 4],
    d: [f64; 4],
}

impl Quad {
    pub fn propagator(&self, lane: usize) -> Propagator {
        Propagator { a: self.a[lane], b: self.b[lane], c: self.c[lane], d: self.d[lane] }
    }
}

/// Magnitude of `D t^2` up to which the derivative of S comes from its series.
const SERIES: f64 = 0.5;

/// `d/dx` of `sin(sqrt(x))/sqrt(x)`: `sum_m (-1)^m m x^(m-1)/(2 m + 1)!`.
fn sine_series_slope(x: f64) -> f64 {
    let mut sum = 0.0;
    let mut term = -1.0 / 6.0;
    for m in 1..10 {
        let m = f64::from(m);
        sum += m * term;
        term *= -x / ((2.0 * m + 2.0) * (2.0 * m + 3.0));
    }
    sum
}

/// `exp(-h t) C(t)` and `exp(-h t) S(t)` of [`Propagator::new`].
#[inline]
fn decayed_cosine_and_sine(stiffness: f64, half: f64, time: f64) -> (f64, f64) {
    let discriminant = stiffness - half * half;
    let square = discriminant * time * time;
    if discriminant >= f64::MIN_POSITIVE {
        let frequency = discriminant.sqrt();
        let (sin, cos) = sine_and_cosine(frequency * time);
        let decay = exponential(-half * time);
        return (decay * cos, decay * sin / frequency);
    }
    if square < -1e-4 {
        let rate = (-discriminant).sqrt();
        // The slow root is k / (h + rate), free of the cancellation in h - rate.
        let slow = exponential(-stiffness / (half + rate) * time);
        let fast = exponential(-(half + rate) * time);
        return (0.5 * (slow + fast), 0.5 * (slow - fast) / rate);
    }
    let decay = exponential(-half * time);
    let cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    let sine = time * (1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)));
    (decay * cosine, decay * sine)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taylor(stiffness: f64, damping: f64, time: f64) -> Propagator {
        let steps = 1 << 12;
        let h = time / f64::from(steps);
        let mut columns = [(1.0, 0.0), (0.0, 1.0)];
        for column in &mut columns {
            for _ in 0..steps {
                let (mut term, mut sum) = (*column, *column);
                for m in 1..12 {
                    let scale = h / f64::from(m);
                    term = (term.1 * scale, (-stiffness * term.0 - damping * term.1) * scale);
                    sum = (sum.0 + term.0, sum.1 + term.1);
                }
                *column = sum;
            }
        }
        Propagator { a: columns[0].0, b: columns[1].0, c: columns[0].1, d: columns[1].1 }
    }

    #[test]
    fn propagator_equals_the_power_series_for_every_kind_of_damping() {
        for damping in [0.0, 0.3, 1.9999, 2.0, 2.0001, 3.0, 40.0] {
            for stiffness in [1.0, 0.0] {
                let (exact, series) =
                    (Propagator::new(stiffness, damping, 1.7), taylor(stiffness, damping, 1.7));
                for (x, y) in
                    [(exact.a, series.a), (exact.b, series.b), (exact.c, series.c), (exact.d, series.d)]
                {
                    assert!((x - y).abs() < 1e-12, "{damping} {stiffness}: {x} {y}");
                }
            }
        }
    }

    /// Against differences of fourth order of the propagator itself, for every kind of damping and on both
    /// sides of the series.
    #[test]
    fn derivatives_of_the_propagator_are_those_of_differences() {
        let entries = |x: Propagator| [x.a, x.b, x.c, x.d];
        for (stiffness, damping, time) in [
            (1.0, 0.0, 1.7),
            (1.0, 0.3, 0.2),
            (1.0, 0.3, 30.0),
            (1.0, 1.9999, 1.7),
            (1.0, 2.0, 1.7),
            (1.0, 2.3, 1.7),
            (1.0, 2.6, 1.7),
            (0.3, 40.0, 20.0),
            (0.0, 2.0, 1.7),
            (0.0, 0.0, 1.7),
        ] {
            let (itself, by_damping, by_stiffness) = Propagator::with_derivatives(stiffness, damping, time);
            assert_eq!(itself.b, Propagator::new(stiffness, damping, time).b);
            let difference = |at: &dyn Fn(f64) -> Propagator| {
                let h = 1e-3 / time.max(1.0);
                let [x, y, z, w] = [-2.0, -1.0, 1.0, 2.0].map(|k: f64| entries(at(k * h)));
                std::array::from_fn::<f64, 4, _>(|i| (8.0 * (z[i] - y[i]) - (w[i] - x[i])) / (12.0 * h))
            };
            let by_c = difference(&|step| Propagator::new(stiffness, damping + step, time));
            let by_k = difference(&|step| Propagator::new(stiffness + step, damping, time));
            for (found, expected) in [(by_damping, by_c), (by_stiffness, by_k)] {
                for (found, expected) in entries(found).iter().zip(expected) {
                    // The rounding of the differences is 1e-16 over a step of 1e-3/t.
                    let error = (found - expected).abs() / (1.0 + expected.abs());
                    assert!(
                        error < 1e-11 * time.max(1.0),
                        "{stiffness} {damping} {time}: {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn long_overdamped_flight_neither_overflows_nor_cancels() {
        let propagator = Propagator::new(1e-3, 1e3, 1e4);
        let slow = 2e-3 / (1e3 + (1e6_f64 - 4e-3).sqrt());
        assert!((propagator.a / (-slow * 1e4_f64).exp() - 1.0).abs() < 1e-8);
        // A stiffness of which the square of the damping leaves next to nothing: over 2e6 s the slow root
        // makes exp(-1.3).
        let stiff = Propagator::new(1.3, 2e6, 2e6);
        let slow = 2.6 / (2e6 + (4e12_f64 - 5.2).sqrt());
        assert!((stiff.a / (-slow * 2e6_f64).exp() - 1.0).abs() < 1e-12, "{}", stiff.a);
    }
}
