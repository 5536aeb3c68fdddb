//! Smallest and largest value of a panel: of the polynomial through its nodes, ends included.
//!
//! The polynomial is `y(s) = sum_d a_d P_d(2 s - 1)` with `a_d = (2 d + 1) sum_k w_k y_k P_d(2 s_k - 1)`,
//! which the Gauss rule has exactly. It is looked at on [`PLACES`] equal steps; from each place that is
//! higher than its neighbours Newton's method goes to the zero of the derivative beside it. An error `e` of
//! the place is one of `y'' e^2/2` of the value.

use std::sync::OnceLock;

use hammerbeam_motion::exact::{PANEL_NODES, panel_rule};

/// Steps of the table on which extrema are looked for: eight for each half wave of the fastest polynomial.
const PLACES: usize = 64;
/// Steps of Newton's method.
const NEWTON: usize = 6;
/// Part of its spread on the table by which a polynomial may exceed the table between two places.
const BETWEEN: f64 = 0.1;

type Nodal = [f64; PANEL_NODES];

/// Weights of nodal values in the values of the table and in the coefficients of Legendre.
struct Table {
    places: Vec<Nodal>,
    coefficients: [Nodal; PANEL_NODES],
}

impl Table {
    fn get() -> &'static Self {
        static TABLE: OnceLock<Table> = OnceLock::new();
        TABLE.get_or_init(|| {
            let mut coefficients = [[0.0; PANEL_NODES]; PANEL_NODES];
            for (k, (s, weight)) in panel_rule().iter().enumerate() {
                for (degree, value) in legendre(*s).into_iter().enumerate() {
                    coefficients[degree][k] = (2 * degree + 1) as f64 * weight * value[0];
                }
            }
            let place = |i: usize| -> Nodal {
                let values = legendre(i as f64 / PLACES as f64);
                std::array::from_fn(|k| (0..PANEL_NODES).map(|d| coefficients[d][k] * values[d][0]).sum())
            };
            Self { places: (0..=PLACES).map(place).collect(), coefficients }
        })
    }
}

/// Legendre polynomials on [0, 1] at a place, each with its first two derivatives.
fn legendre(s: f64) -> [[f64; 3]; PANEL_NODES] {
    let x = 2.0 * s - 1.0;
    let mut values = [[0.0; 3]; PANEL_NODES];
    values[0] = [1.0, 0.0, 0.0];
    values[1] = [x, 1.0, 0.0];
    for degree in 2..PANEL_NODES {
        let (d, [one, two]) = (degree as f64, [values[degree - 1], values[degree - 2]]);
        let (a, b) = ((2.0 * d - 1.0) / d, (d - 1.0) / d);
        values[degree] = [
            a * x * one[0] - b * two[0],
            a * (one[0] + x * one[1]) - b * two[1],
            a * (2.0 * one[1] + x * one[2]) - b * two[2],
        ];
    }
    // Derivatives by s.
    values.map(|[value, slope, curvature]| [value, 2.0 * slope, 4.0 * curvature])
}

/// The smallest and the largest value, of the given ones and of a panel with these values at its nodes.
pub(super) fn extrema(values: &Nodal, [minimum, maximum]: [f64; 2]) -> [f64; 2] {
    let largest = largest(values, maximum);
    let turned = values.map(|value| -value);
    [-self::largest(&turned, -minimum), largest]
}

/// The largest of a value and the values of a panel.
fn largest(values: &Nodal, mut best: f64) -> f64 {
    let table = Table::get();
    let at: Vec<f64> = table.places.iter().map(|weights| dot(weights, values)).collect();
    let (low, high) = at
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)));
    if high + BETWEEN * (high - low) <= best {
        return best;
    }
    best = best.max(high);
    let coefficients = table.coefficients.map(|weights| dot(&weights, values));
    for i in 0..=PLACES {
        let is_top = (i == 0 || at[i - 1] <= at[i]) && (i == PLACES || at[i + 1] <= at[i]);
        if is_top && at[i] + BETWEEN * (high - low) > best {
            best = best.max(turn(&coefficients, i as f64 / PLACES as f64));
        }
    }
    best
}

/// The value where the polynomial turns, near a place.
fn turn(coefficients: &Nodal, near: f64) -> f64 {
    let step = 1.0 / PLACES as f64;
    let (low, high) = ((near - step).max(0.0), (near + step).min(1.0));
    let (mut place, mut best) = (near, f64::NEG_INFINITY);
    for _ in 0..NEWTON {
        let mut jet = [0.0; 3];
        for (coefficient, values) in coefficients.iter().zip(legendre(place)) {
            (0..3).for_each(|k| jet[k] += coefficient * values[k]);
        }
        best = best.max(jet[0]);
        let next = (place - jet[1] / jet[2]).clamp(low, high);
        if next.is_nan() || next == place {
            break;
        }
        place = next;
    }
    best
}

fn dot(a: &Nodal, b: &Nodal) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    const NONE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

    fn nodal(of: impl Fn(f64) -> f64) -> Nodal {
        panel_rule().map(|(s, _)| of(s))
    }

    /// `cos(4 s - p)`, the fastest wave of a panel: its extremum is 1 inside, else the larger end value. At
    /// an end the polynomial is off by `4^16/16!/C(32, 16)` at most, 3.4e-13: the product of the distances to
    /// the nodes is `1/C(32, 16)` there.
    #[test]
    fn extrema_of_the_fastest_wave_are_the_closed_form_for_every_phase() {
        for phase in (0..628).map(|k| 0.01 * f64::from(k)) {
            let [minimum, maximum] = extrema(&nodal(|s| (4.0 * s - phase).cos()), NONE);
            let passes = |turn: f64| {
                (0..3)
                    .any(|k| (0.0..=4.0).contains(&(phase + turn + std::f64::consts::TAU * f64::from(k - 1))))
            };
            let ends = [(phase).cos(), (4.0 - phase).cos()];
            let high = if passes(0.0) { 1.0 } else { ends[0].max(ends[1]) };
            let low = if passes(std::f64::consts::PI) { -1.0 } else { ends[0].min(ends[1]) };
            assert!((maximum - high).abs() < 3.5e-13, "{phase}: {maximum} {high}");
            assert!((minimum - low).abs() < 3.5e-13, "{phase}: {minimum} {low}");
        }
    }

    /// Two tops of almost one height: `1 - 8 (s + e)(s - q)^2` is 1 at q and less than that at its start.
    #[test]
    fn the_higher_of_two_tops_is_found() {
        for inner in (0..=100).map(|k| 0.6 + 1e-3 * f64::from(k)) {
            let start = 1e-4 / (8.0 * inner * inner);
            let [_, maximum] = extrema(&nodal(|s| 1.0 - 8.0 * (s + start) * (s - inner).powi(2)), NONE);
            assert!((maximum - 1.0).abs() < 1e-13, "{inner}: {maximum}");
        }
    }

    #[test]
    fn what_was_larger_before_stays() {
        assert_eq!(extrema(&nodal(|s| s), [-3.0, 5.0]), [-3.0, 5.0]);
        let [minimum, maximum] = extrema(&nodal(|s| s), NONE);
        // Sums of sixteen terms of order 1, with factors up to 31.
        assert!(minimum.abs() < 1e-14 && (maximum - 1.0).abs() < 1e-14, "{minimum} {maximum}");
    }
}
