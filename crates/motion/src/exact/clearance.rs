//! Certified search for the first contact. Equations (C1) to (C5) and (C10) of the book, `docs/theory`.
//!
//! The clearance `d(t) = -sign (r - level)` of an open contact is positive. With bounds `|d''| <= B_2` and
//! `|d'''| <= B_3` that hold for the time ahead, two steps provably cannot jump over a zero of `d`:
//!
//! * `h_2`, the positive root of `d + d' h - B_2 h^2/2`;
//! * `h_3`, the first positive root of `d + d' h + d'' h^2/2 - B_3 h^3/6`.
//!
//! Repeated, they converge on the first contact, quadratically where it is crossed with some speed. Over the
//! time `d''/B_3` the clearance is convex. Where it has its minimum well inside that stretch (`-d'/d''` is
//! less than half of it), the minimum is found by Newton's method: if it is above minus the rounding margin,
//! the whole convex stretch is passed at once, since nowhere in it is `d` lower; if it is below, Newton's
//! method from the left runs monotonically into the crossing (the tangent of a convex function lies below
//! it). A contact whose minimum is within the margin is grazed, without force. The margin is what rounding
//! leaves undecided: `8 eps` times the sum of the magnitudes of the terms of `r` in flight, somewhat more in
//! a force step (`touching.rs`).
//!
//! The same holds if `d''` is only known from below: all that is used of it is that it is not smaller.
//!
//! **Fast blocks.** A block that vibrates fast with a small amplitude makes `B_3` large, and so `h_3` short,
//! though it moves the clearance by little. Let F be some blocks of an output that are in flight, `e_i` the
//! energy norm of block i and `g_i` its factor in the value (`output.rs`): their part of the clearance stays
//! within `A = sum_F g_i e_i`, since the energy norm of a free block does not grow. So the part of the other
//! blocks and of the loads, less A, is nowhere above the clearance, and its `B_2` and `B_3` are without what
//! the blocks of F have in them. Both safe steps of that function are safe for the clearance. F is made of
//! the blocks, from the last on, for which A stays below a fifth of the clearance; where they have less than
//! half of `B_3`, or make the step longer by less than a tenth, they stay. The beam of the paper needs 10
//! looks a period instead of 16.

use super::drive::Jet;

/// Bounds for a clearance over the time ahead.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ClearanceBounds {
    pub second: f64,
    pub third: f64,
    /// Rounding margin of the clearance [m].
    pub margin: f64,
}

/// What is known after a look at the clearance at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Look {
    /// No contact for this time [s], counted from the look.
    FreeFor(f64),
    /// Contact now.
    Contact,
    /// A minimum lies this far ahead, inside a convex stretch of that length.
    MinimumAhead { at: f64, convex: f64 },
}

/// How much longer the step of a function below the clearance has to be.
const WORTH: f64 = 1.1;

/// Looks at a clearance `d` with its derivatives.
///
/// * `below`: another function that is nowhere above the clearance in the time ahead, and bounds on it; the
///   steps that it allows are safe, too.
pub(crate) fn look(
    clearance: Jet,
    bounds: ClearanceBounds,
    below: impl FnOnce() -> Option<(Jet, ClearanceBounds)>,
) -> Look {
    let Jet { value, slope, curvature } = clearance;
    let convex = if bounds.third > 0.0 { curvature / bounds.third } else { f64::INFINITY };
    if slope < 0.0 && curvature > 0.0 {
        let at = -slope / curvature;
        let lowest = value + 0.5 * slope * at;
        if at < 0.5 * convex && (value <= bounds.margin || lowest < 0.1 * value) {
            return Look::MinimumAhead { at, convex };
        }
    }
    if value <= bounds.margin && (slope < 0.0 || (slope == 0.0 && curvature < 0.0)) {
        return Look::Contact;
    }
    // Within the margin and not falling: what the motion does within the margin is not looked at, so that
    // every look gets on.
    let step = longer_step(Jet { value: value.max(bounds.margin), ..clearance }, bounds);
    let below = below().filter(|(below, _)| below.value > bounds.margin);
    let further = below.map_or(0.0, |(below, bounds)| longer_step(below, bounds));
    // Just before a contact all steps are Newton's; that of the clearance rounds as the next look does.
    Look::FreeFor(if further > WORTH * step { further } else { step })
}

/// The longer one of the safe steps.
fn longer_step(Jet { value, slope, curvature }: Jet, bounds: ClearanceBounds) -> f64 {
    safe_step(value, slope, bounds.second).max(safe_cubic_step(value, slope, curvature, bounds.third))
}

/// What a convex stretch holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Convex {
    /// No contact in all of it, down to the margin.
    Free,
    /// The contact closes at this time [s], counted from the look.
    ContactAt(f64),
}

/// Newton steps to a minimum, and to the crossing before it; both converge quadratically.
const NEWTON_STEPS: usize = 60;

/// Decides a stretch in which the clearance is convex.
///
/// * `clearance`: the clearance at a time after the look.
/// * `at`: about where its minimum is; `length`: length of the stretch (the minimum may lie beyond its end);
///   `start`: time of the look, for rounding.
pub(crate) fn decide_convex(
    mut clearance: impl FnMut(f64) -> Jet,
    (at, length): (f64, f64),
    start: f64,
    margin: f64,
) -> Convex {
    let mut ahead = at.min(length);
    let mut lowest = clearance(ahead);
    for _ in 0..NEWTON_STEPS {
        let next = (ahead - lowest.slope / lowest.curvature).clamp(0.0, length);
        let step = next - ahead;
        if step.abs() <= 1e-14 * (start + ahead) || step.is_nan() {
            break;
        }
        ahead = next;
        lowest = clearance(ahead);
    }
    if lowest.value >= -margin {
        return Convex::Free;
    }
    let mut before = 0.0;
    for _ in 0..NEWTON_STEPS {
        let here = clearance(before);
        if here.value <= margin || here.slope >= 0.0 {
            break;
        }
        before -= here.value / here.slope;
    }
    Convex::ContactAt(before)
}

/// Positive root of `d + d' h - B h^2/2`.
fn safe_step(value: f64, slope: f64, bound: f64) -> f64 {
    let root = (slope * slope + 2.0 * bound * value).sqrt();
    if slope >= 0.0 {
        return if bound > 0.0 { (slope + root) / bound } else { f64::INFINITY };
    }
    2.0 * value / (root - slope)
}

/// A step just below the first positive root of `d + d' h + d'' h^2/2 - B h^3/6`.
fn safe_cubic_step(value: f64, slope: f64, curvature: f64, bound: f64) -> f64 {
    let cubic = |h: f64| value + h * (slope + h * (0.5 * curvature - bound * h / 6.0));
    if bound <= 0.0 {
        let no_root = slope >= 0.0 && curvature >= 0.0;
        return if no_root { f64::INFINITY } else { 0.0 };
    }
    // After the last extremum (a maximum, since -B h^3 wins) the cubic falls; before it, it must be shown to
    // be positive.
    let discriminant = curvature * curvature + 2.0 * bound * slope;
    let (mut h, mut beyond) = if discriminant > 0.0 {
        let root = discriminant.sqrt();
        let (low, high) = ((curvature - root) / bound, (curvature + root) / bound);
        if high <= 0.0 || (low > 0.0 && cubic(low) <= 0.0) || cubic(high) <= 0.0 {
            return 0.0;
        }
        (high, 2.0 * high)
    } else if value > 0.0 && slope < 0.0 {
        // It falls all the way.
        (0.0, -2.0 * value / slope)
    } else {
        return 0.0;
    };
    // Beyond the maximum, and its turning point, the cubic is concave and falls: Newton's method comes to the
    // root from beyond.
    while cubic(beyond) > 0.0 {
        h = beyond;
        beyond *= 2.0;
    }
    for _ in 0..8 {
        let slope = slope + beyond * (curvature - 0.5 * bound * beyond);
        let next = beyond - cubic(beyond) / slope;
        let near = beyond - next <= 1e-3 * next;
        beyond = next;
        if near {
            break;
        }
    }
    let safe = beyond * (1.0 - 1e-6);
    if safe > h && cubic(safe) > 0.0 { safe } else { h }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bounds(second: f64, third: f64) -> ClearanceBounds {
        ClearanceBounds { second, third, margin: 1e-18 }
    }

    #[test]
    fn safe_steps_stay_before_the_root_of_their_polynomial() {
        for &(value, slope, curvature) in
            &[(1.0, -1.0, 0.5), (1e-6, 0.3, -2.0), (1e-3, -1e-3, 1.0), (0.0, 1e-3, 5.0), (2.0, 0.0, -1.0)]
        {
            let bound: f64 = 7.0;
            let h: f64 = safe_cubic_step(value, slope, curvature, bound);
            for part in 1..=100 {
                let t = h * f64::from(part) / 100.0;
                let lower: f64 = value + t * (slope + t * (0.5 * curvature - bound * t / 6.0));
                assert!(lower >= -1e-15, "{value} {slope} {curvature}: {lower} at {t}");
            }
        }
    }

    #[test]
    fn a_clearance_that_closes_inside_the_margin_is_a_contact() {
        let closing = Jet { value: 1e-19, slope: -1.0, curvature: 0.0 };
        assert_eq!(look(closing, bounds(1.0, 1.0), || None), Look::Contact);
        let opening = Jet { value: -1e-12, slope: 1.0, curvature: 0.0 };
        assert!(matches!(look(opening, bounds(1.0, 1.0), || None), Look::FreeFor(h) if h > 0.0));
    }

    #[test]
    fn a_convex_stretch_is_free_down_to_its_minimum() {
        let parabola = |lowest: f64| {
            move |t: f64| Jet { value: lowest + 0.5 * (t - 1.0).powi(2), slope: t - 1.0, curvature: 1.0 }
        };
        for (lowest, length, expected) in [
            (1e-12, 2.5, Convex::Free),
            (-1e-19, 2.5, Convex::Free),
            // Its lowest point in the stretch is the end.
            (-1e-6, 0.5, Convex::Free),
        ] {
            assert_eq!(decide_convex(parabola(lowest), (1.0, length), 0.0, 1e-18), expected, "{lowest}");
        }
        for depth in [1e-3_f64, 1e-9, 1e-13] {
            let Convex::ContactAt(time) = decide_convex(parabola(-depth), (0.9, 2.5), 0.0, 1e-18) else {
                panic!("{depth} is a contact")
            };
            assert!((time - (1.0 - (2.0 * depth).sqrt())).abs() < 1e-9, "{depth}: {time}");
        }
    }

    #[test]
    fn a_shallow_minimum_is_announced() {
        let near_grazing = Jet { value: 0.5e-6, slope: -1e-3 + 1e-9, curvature: 1.0 };
        assert!(matches!(look(near_grazing, bounds(50.0, 10.0), || None), Look::MinimumAhead { .. }));
    }
}
