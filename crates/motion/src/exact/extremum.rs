//! The largest magnitude of a polynomial over a step, given at its nodes: from a table of places, and closed in by parabolas.

use super::{
    collocation::{FINE, NODES, PLACES, Rule},
    lanes::{add_products, vectorised},
};

/// Parabolas by which the largest value of a polynomial is closed in.
const PARABOLAS: usize = 6;

impl Rule {
    /// Largest magnitude of a polynomial given at the nodes, and where in the variable of the step.
    pub fn extremum(&self, values: &[f64]) -> (f64, f64) {
        let mut table = [0.0; PLACES];
        let weights = |_| values[..NODES].iter().copied();
        add_products(&mut table, self.fine.as_flattened(), PLACES, weights);
        table.iter_mut().for_each(|value| *value = value.abs());
        let best = (0..=FINE).fold(0, |best, i| if table[i] > table[best] { i } else { best });
        // Successive parabolas through the best place and its neighbours, from half an interval beyond an end of the step inwards.
        let width = 1.0 / FINE as f64;
        let expansion = vectorised(
            #[inline(always)]
            || self.expansion(values),
        );
        let middle = (best as f64 * width).clamp(0.5 * width, 1.0 - 0.5 * width);
        let places = [(middle - width).max(0.0), middle, (middle + width).min(1.0)];
        let found = self.sums(&expansion, &places);
        let mut points: [(f64, f64); 3] = std::array::from_fn(|k| (places[k], found[k].abs()));
        let mut largest = (table[best], best as f64 * width);
        for _ in 0..PARABOLAS {
            let Some(s) = vertex(points) else { break };
            let s = s.clamp(0.0, 1.0);
            let [value] = self.sums(&expansion, &[s]);
            let next = (s, value.abs());
            if next.1 > largest.0 {
                largest = (next.1, s);
            }
            // Keep the three points around the best.
            let worst = (0..3).fold(0, |w, k| if points[k].1 < points[w].1 { k } else { w });
            points[worst] = next;
        }
        largest
    }
}

/// Place of the maximum of the parabola through three points, if it has one.
fn vertex([(a, at_a), (b, at_b), (c, at_c)]: [(f64, f64); 3]) -> Option<f64> {
    let (left, right) = ((at_b - at_a) / (b - a), (at_c - at_b) / (c - b));
    let curvature = (right - left) / (c - a);
    let place = 0.5 * (a + b) - 0.5 * left / curvature;
    (curvature < 0.0 && place.is_finite()).then_some(place)
}
