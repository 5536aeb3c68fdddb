//! Lagrange rows: recognised, and eliminated with one coordinate each.
//!
//! A multiplier has no mass and no stiffness of its own: its row of `K` is a condition `sum_j b_j y_j = 0`.
//! Of each condition the coordinate with the largest coefficient is expressed by the others.

use std::collections::BTreeMap;

use super::SymmetricMatrix;

/// Coefficients below this part of the largest of a condition are rounding.
const NOTHING: f64 = 1e-12;

/// Rows that are conditions.
pub(super) fn lagrange_rows(stiffness: &SymmetricMatrix, mass: &SymmetricMatrix) -> Vec<usize> {
    let (diagonal, occupied, massive) = (stiffness.diagonal(), stiffness.occupied(), mass.occupied());
    (0..stiffness.size()).filter(|&row| diagonal[row] == 0.0 && occupied[row] && !massive[row]).collect()
}

/// The conditions of some rows, by coordinate; other multipliers left out.
pub(super) fn conditions(stiffness: &SymmetricMatrix, rows: &[usize]) -> Vec<BTreeMap<usize, f64>> {
    let mut place = vec![None; stiffness.size()];
    rows.iter().enumerate().for_each(|(condition, &row)| place[row] = Some(condition));
    let mut conditions = vec![BTreeMap::new(); rows.len()];
    for (row, column, value) in stiffness.entries() {
        for (own, other) in [(row, column), (column, row)] {
            if let (Some(condition), None) = (place[own], place[other]) {
                conditions[condition].insert(other, value);
            }
        }
    }
    conditions
}

/// What each dependent coordinate is of the others.
#[derive(Debug, Default)]
pub(super) struct Dependent {
    /// `y_p = sum_j c_j y_j`, no dependent one among the others.
    pub expressions: BTreeMap<usize, BTreeMap<usize, f64>>,
}

impl Dependent {
    /// Eliminates one coordinate of each condition.
    ///
    /// * `may_depend`: coordinates that can be expressed by others.
    pub fn of(conditions: Vec<BTreeMap<usize, f64>>, may_depend: impl Fn(usize) -> bool) -> Self {
        let mut dependent = Self::default();
        for condition in conditions {
            let largest = condition.values().fold(0.0_f64, |largest, value| largest.max(value.abs()));
            let mut left = dependent.substituted(&condition);
            left.retain(|_, value| value.abs() > NOTHING * largest);
            let pivot = left.iter().filter(|(coordinate, _)| may_depend(**coordinate));
            let pivot = pivot.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()).then(b.0.cmp(a.0)));
            let Some((&pivot, &weight)) = pivot else { continue };
            left.remove(&pivot);
            left.values_mut().for_each(|value| *value /= -weight);
            for expression in dependent.expressions.values_mut() {
                if let Some(factor) = expression.remove(&pivot) {
                    left.iter()
                        .for_each(|(&other, value)| *expression.entry(other).or_default() += factor * value);
                }
            }
            dependent.expressions.insert(pivot, left);
        }
        dependent
    }

    fn substituted(&self, condition: &BTreeMap<usize, f64>) -> BTreeMap<usize, f64> {
        let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
        for (&coordinate, &value) in condition {
            match self.expressions.get(&coordinate) {
                None => *sums.entry(coordinate).or_default() += value,
                Some(expression) => expression
                    .iter()
                    .for_each(|(&other, factor)| *sums.entry(other).or_default() += value * factor),
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn conditions_that_depend_on_one_another_are_eliminated_once() {
        let condition = |terms: &[(usize, f64)]| terms.iter().copied().collect::<BTreeMap<_, _>>();
        let conditions = vec![
            condition(&[(0, 1.0), (1, -1.0)]),
            condition(&[(1, 2.0), (2, -1.0)]),
            condition(&[(0, 2.0), (2, -1.0)]),
        ];
        let dependent = Dependent::of(conditions, |_| true);
        assert_eq!(dependent.expressions.len(), 2);
        let free: Vec<usize> = (0..3).filter(|row| !dependent.expressions.contains_key(row)).collect();
        // Every solution is a multiple of (1, 1, 2).
        let shape = [1.0, 1.0, 2.0];
        for (row, expression) in &dependent.expressions {
            let value: f64 = expression.iter().map(|(other, factor)| factor * shape[*other]).sum();
            assert!((value - shape[*row]).abs() < 1e-15, "{free:?}");
        }
    }
}
