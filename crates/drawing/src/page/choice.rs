//! Which orbits a page carries: in which order they are taken until it is full.
//!
//! First the ends of every branch and the bifurcations of stable solutions, since a reader goes there. Then
//! every 2^k-th solution of all branches end to end, with smaller and smaller k, so that wherever the page is
//! full the orbits are spread evenly along the branches; among them, one to three, the other bifurcations.

use hammerbeam_results::store::PlacedRow;

/// Most of the orbits that a page carries,
const MOST: usize = 6000;
/// solutions to each of them, where there are more than a few,
const SOLUTIONS_TO_AN_ORBIT: usize = 4;
/// and how many a page carries of few solutions.
const FEW: usize = 100;
/// Orbits that are spread to each bifurcation among them.
const SPREAD: usize = 3;

/// Numbers of solutions, counted over all branches end to end, in the order in which their orbits are wanted.
pub fn order(branches: &[Vec<PlacedRow>]) -> Vec<u32> {
    let count: usize = branches.iter().map(Vec::len).sum();
    let mut first_of_all = Vec::new();
    let mut others = Vec::new();
    let mut first = 0;
    for branch in branches {
        for (place, placed) in branch.iter().enumerate() {
            let is_bifurcation = placed.row.events.is_bifurcation();
            let is_stable =
                |place: usize| branch.get(place).is_some_and(|placed| placed.row.stability.may_be_stable());
            let beside_stable = is_stable(place) || is_stable(place.wrapping_sub(1)) || is_stable(place + 1);
            let is_end = place == 0 || place + 1 == branch.len();
            if is_end || is_bifurcation && beside_stable {
                first_of_all.push(first + place);
            } else if is_bifurcation {
                others.push(first + place);
            }
        }
        first += branch.len();
    }
    let most = (count / SOLUTIONS_TO_AN_ORBIT).clamp(FEW, MOST);
    let mut wanted = Wanted { taken: vec![false; count], order: Vec::new(), most };
    for number in first_of_all {
        wanted.take(number);
    }
    let mut others = others.into_iter();
    let mut spread = 0;
    for exponent in (0..=count.max(1).next_power_of_two().ilog2()).rev() {
        for number in (0..count).step_by(1 << exponent) {
            spread += usize::from(wanted.take(number));
            if spread == SPREAD {
                spread = 0;
                others.next().map(|other| wanted.take(other));
            }
        }
    }
    wanted.order
}

struct Wanted {
    taken: Vec<bool>,
    order: Vec<u32>,
    most: usize,
}

impl Wanted {
    /// Takes a number that is not taken yet, while there is room; says whether it did.
    fn take(&mut self, number: usize) -> bool {
        let is_new = self.order.len() < self.most && !std::mem::replace(&mut self.taken[number], true);
        if is_new {
            self.order.push(number as u32);
        }
        is_new
    }
}

#[cfg(test)]
mod tests {
    use hammerbeam_orbit::{BranchEventKind, EventSet, Side, Stability};
    use hammerbeam_results::row::Row;

    use super::*;

    /// A branch that is stable in its first half, with flips at these places.
    fn branch(count: usize, flips: &[usize]) -> Vec<PlacedRow> {
        let row = |place: usize| Row {
            events: EventSet::of([(flips.contains(&place), BranchEventKind::Flip)]),
            stability: if place < count / 2 { Stability::Stable } else { Stability::Unstable },
            ..Row::default()
        };
        (0..count).map(|place| PlacedRow { side: Side::Up, number: place as u32, row: row(place) }).collect()
    }

    #[test]
    fn ends_and_bifurcations_of_stable_solutions_come_first() {
        let order = order(&[branch(1000, &[300, 800]), branch(1, &[]), Vec::new(), branch(999, &[])]);
        assert_eq!(order[..6], [0, 300, 999, 1000, 1001, 1999]);
        assert!(order.contains(&800), "that of unstable solutions is among the others");
    }

    #[test]
    fn no_orbit_comes_twice_and_all_are_spread() {
        let mut order = order(&[branch(1000, &[]), branch(3000, &[])]);
        assert_eq!(order.len(), 4000 / SOLUTIONS_TO_AN_ORBIT);
        order.sort_unstable();
        // Every fourth solution at least would be 4 apart; the last halving of the step is not complete.
        assert!(order.windows(2).all(|pair| (1..=8).contains(&(pair[1] - pair[0]))));
    }

    #[test]
    fn of_few_solutions_and_of_none_nothing_is_left_out() {
        assert_eq!(order(&[branch(70, &[5])]).len(), 70);
        assert_eq!(order(&[]), Vec::<u32>::new());
        assert_eq!(order(&[Vec::new()]).len(), 0);
    }
}
