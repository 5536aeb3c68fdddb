//! Which orbits a page carries: in which order they are taken until it is full.
//!
//! First the ends of every branch and the bifurcations, since a reader goes there; then every 2^k-th solution of all branches end to end, with smaller and
//! smaller k, so that wherever the page is full the orbits are spread evenly along the branches.

use super::Placed;

/// Most of the orbits that a page carries.
pub const MOST: usize = 6000;

/// Numbers of solutions, counted over all branches end to end, in the order in which their orbits are wanted.
pub fn order(branches: &[Vec<Placed>]) -> Vec<u32> {
    let count: usize = branches.iter().map(Vec::len).sum();
    let mut taken = vec![false; count];
    let mut order = Vec::new();
    let mut take = |number: usize| {
        if order.len() < MOST && !std::mem::replace(&mut taken[number], true) {
            order.push(number as u32);
        }
    };
    let mut first = 0;
    for branch in branches {
        for (place, placed) in branch.iter().enumerate() {
            let events = &placed.row.events;
            let is_bifurcation = events.fold || events.flip || events.neimark_sacker || events.branch_point;
            if place == 0 || place + 1 == branch.len() || is_bifurcation {
                take(first + place);
            }
        }
        first += branch.len();
    }
    let mut step = count.next_power_of_two();
    while step > 0 {
        (0..count).step_by(step).for_each(&mut take);
        step /= 2;
    }
    order
}
