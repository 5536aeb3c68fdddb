//! Where a function that is known with its slope at both ends of an interval has a lowest place inside.
//!
//! With the values `s_0, s_1` and the slopes `m_0, m_1` (by `t` from 0 to 1) Hermite's cubic has the slope
//! `m_0 (1-t)(1-3t) + m_1 t (3t-2) + 6 (s_1-s_0) t (1-t)`, a parabola. A sign change of it from minus to plus
//! is a lowest place, also where both ends rise or both fall: then a highest place lies beside it.

/// An interval in which a function has a lowest place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Dip {
    /// Where it falls towards the lowest place, as fractions of the interval.
    pub(super) from: f64,
    /// Where it has passed it.
    pub(super) to: f64,
}

/// The dip between the ends of an interval; `None` if there is none, or none that comes near zero.
///
/// * `values`, `slopes`: at the ends, by the fraction of the interval.
pub(super) fn between(values: [f64; 2], slopes: [f64; 2]) -> Option<Dip> {
    let [start, end] = slopes;
    let steepest = start.abs().max(end.abs()).max((values[1] - values[0]).abs());
    if values[0].min(values[1]) > steepest {
        return None;
    }
    let middle = 1.5 * (values[1] - values[0]) - 0.25 * (start + end);
    // Slope `start + b t + a t^2` through its values at 0, 1/2 and 1.
    let a = 2.0 * (start + end) - 4.0 * middle;
    let b = end - start - a;
    let turn = (-0.5 * b / a).clamp(0.0, 1.0);
    let at_turn = start + turn * (b + a * turn);
    match (start < 0.0, end > 0.0) {
        (true, true) => Some(Dip { from: 0.0, to: 1.0 }),
        (true, false) => (at_turn > 0.0).then_some(Dip { from: 0.0, to: turn }),
        (false, true) => (at_turn < 0.0).then_some(Dip { from: turn, to: 1.0 }),
        (false, false) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `(t - 1/4)^2 (t + 1)`: falls, has its lowest place at 1/4, rises.
    #[test]
    fn a_lowest_place_between_a_fall_and_a_rise_is_found() {
        let (s, m) = (
            |t: f64| (t - 0.25).powi(2) * (t + 1.0),
            |t: f64| 2.0 * (t - 0.25) * (t + 1.0) + (t - 0.25).powi(2),
        );
        assert_eq!(between([s(0.0), s(1.0)], [m(0.0), m(1.0)]), Some(Dip { from: 0.0, to: 1.0 }));
    }

    /// `t (t - 0.3) (t - 0.6)` rises at 0 and at 1, has its highest place near 0.13 and its lowest near 0.47.
    #[test]
    fn a_lowest_place_behind_a_highest_one_is_found() {
        let (s, m) = (|t: f64| t * (t - 0.3) * (t - 0.6), |t: f64| 3.0 * t * t - 1.8 * t + 0.18);
        let dip = between([s(0.0), s(1.0)], [m(0.0), m(1.0)]).unwrap();
        assert!(m(dip.from) < 0.0 && m(dip.to) > 0.0, "{dip:?}");
        // Upside down the lowest place comes first.
        let dip = between([-s(0.0), -s(1.0)], [-m(0.0), -m(1.0)]).unwrap();
        assert!(dip.from == 0.0 && -m(dip.to) > 0.0, "{dip:?}");
    }

    #[test]
    fn what_only_rises_or_is_far_from_zero_has_no_dip() {
        assert_eq!(between([0.0, 1.0], [1.0, 1.0]), None);
        assert_eq!(between([0.0, 0.0], [1.0, -1.0]), None);
        assert_eq!(between([5.0, 5.0], [-1.0, 1.0]), None);
    }
}
