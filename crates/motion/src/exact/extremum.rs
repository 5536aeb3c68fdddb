//! Extrema of polynomials that are given at the nodes of a step.

use super::{
    collocation::{FINE, NODES, PLACES, Rule},
    lanes::{add_products, vectorised},
    parabola::closed_in,
};

/// Of places where it is as large up to this part, the table of a polynomial does not tell which is the
/// largest: between two of its entries the value is higher by at most 15 %, where all of eleven zeros lie
/// within the step.
const UNDECIDED: f64 = 0.2;

impl Rule {
    /// Largest magnitude of a polynomial given at the nodes, and where in the variable of the step.
    pub fn extremum(&self, values: &[f64]) -> (f64, f64) {
        let mut table = [0.0; PLACES];
        let weights = |_| values[..NODES].iter().copied();
        add_products(&mut table, self.fine.as_flattened(), PLACES, weights);
        table.iter_mut().for_each(|value| *value = value.abs());
        let table = &table[..=FINE];
        let highest = table.iter().fold(0.0_f64, |highest, value| highest.max(*value));
        let expansion = vectorised(
            #[inline(always)]
            || self.expansion(values),
        );
        let is_top = |i: usize| {
            let [before, after] = [i.checked_sub(1), Some(i + 1)].map(|k| k.and_then(|k| table.get(k)));
            before.is_none_or(|value| *value <= table[i]) && after.is_none_or(|value| *value < table[i])
        };
        let tops = (0..=FINE).filter(|&i| table[i] >= (1.0 - UNDECIDED) * highest && is_top(i));
        tops.map(|i| self.closed_in(&expansion, (i as f64 / FINE as f64, table[i])))
            .fold((highest, 0.0), |best, next| if next.0 >= best.0 { next } else { best })
    }

    /// The largest magnitude about a place at which it is known, by successive parabolas through it and its
    /// neighbours, from half an interval beyond an end of the step inwards.
    fn closed_in(&self, expansion: &[f64; NODES], (place, value): (f64, f64)) -> (f64, f64) {
        let width = 1.0 / FINE as f64;
        let middle = place.clamp(0.5 * width, 1.0 - 0.5 * width);
        let places = [(middle - width).max(0.0), middle, (middle + width).min(1.0)];
        let found = self.sums(expansion, &places);
        let points = std::array::from_fn(|k| (places[k], found[k].abs()));
        let (place, value) = closed_in(points, (place, value), (0.0, 1.0), |s| {
            let [value] = self.sums(expansion, &[s]);
            value.abs()
        });
        (value, place)
    }
}

#[cfg(test)]
mod tests {
    use super::super::collocation::Grading;

    /// `1 - c (s + e) (s - q)^2` is 1 at the inner top q and `1 - c e q^2` at the start, from which it falls:
    /// that is more than the entries of the table about q have, unless one lies at q.
    #[test]
    fn the_higher_of_two_tops_is_found_wherever_it_lies_between_the_entries_of_the_table() {
        let rule = Grading::Smooth.rule();
        for inner in (0..=100).map(|k| 0.6 + 1e-3 * f64::from(k)) {
            let start = 1e-4 / (8.0 * inner * inner);
            let values = rule.s.map(|s| 1.0 - 8.0 * (s + start) * (s - inner).powi(2));
            let (found, place) = rule.extremum(&values);
            assert!(
                (found - 1.0).abs() < 1e-12 && (place - inner).abs() < 1e-6,
                "{inner}: {found} at {place}"
            );
        }
    }
}
