//! The top of a smooth function by successive parabolas.

/// Parabolas by which a top is closed in.
const PARABOLAS: usize = 6;

/// Place and value of the highest place about a top, within a range of places.
///
/// * `points`: places and values of three places around it; `highest`: of the highest one known.
pub(super) fn closed_in(
    mut points: [(f64, f64); 3],
    mut highest: (f64, f64),
    (low, high): (f64, f64),
    value: impl Fn(f64) -> f64,
) -> (f64, f64) {
    for _ in 0..PARABOLAS {
        let Some(place) = vertex(points) else { break };
        let place = place.clamp(low, high);
        let next = (place, value(place));
        if next.1 > highest.1 {
            highest = next;
        }
        // Keep the three points around the best.
        let worst = (0..3).fold(0, |w, k| if points[k].1 < points[w].1 { k } else { w });
        points[worst] = next;
    }
    highest
}

/// Place of the maximum of the parabola through three points, if it has one.
fn vertex([(a, at_a), (b, at_b), (c, at_c)]: [(f64, f64); 3]) -> Option<f64> {
    let (left, right) = ((at_b - at_a) / (b - a), (at_c - at_b) / (c - b));
    let curvature = (right - left) / (c - a);
    let place = 0.5 * (a + b) - 0.5 * left / curvature;
    (curvature < 0.0 && place.is_finite()).then_some(place)
}
