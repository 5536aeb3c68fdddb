//! Nearest neighbours by a k-d tree, which halves the states along their widest coordinate (Bentley, Commun.
//! ACM 18 (1975), 509-517).

use super::states::DelayStates;

/// States of a leaf.
const LEAF: usize = 12;

/// States in the order of the tree, with its inner nodes.
pub(super) struct NeighbourTree {
    order: Vec<usize>,
    nodes: Vec<Node>,
}

/// The states of `order` from one index to another.
#[derive(Clone, Copy)]
struct Node {
    from: usize,
    to: usize,
    /// Coordinate, value, and the nodes below and above; leaves have none.
    cut: Option<(usize, f64, usize, usize)>,
}

/// A search for a neighbour, and the states that do not count.
struct Search<'a> {
    states: &'a DelayStates<'a>,
    state: usize,
    window: usize,
    beyond: f64,
}

impl NeighbourTree {
    /// A tree of the first `count` states.
    pub(super) fn new(states: &DelayStates, count: usize) -> Self {
        let mut tree = Self { order: (0..count).collect(), nodes: Vec::new() };
        tree.divide(states, 0, count);
        tree
    }

    fn divide(&mut self, states: &DelayStates, from: usize, to: usize) -> usize {
        let index = self.nodes.len();
        self.nodes.push(Node { from, to, cut: None });
        if to - from <= LEAF {
            return index;
        }
        let width = |coordinate: usize| {
            let values = self.order[from..to].iter().map(|&state| states.coordinate(state, coordinate));
            let (low, high) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            high - low
        };
        let widths: Vec<f64> = (0..states.dimension).map(width).collect();
        let coordinate = (0..widths.len()).max_by(|&a, &b| widths[a].total_cmp(&widths[b])).unwrap_or(0);
        if widths[coordinate] <= 0.0 {
            return index;
        }
        let middle = (to - from) / 2;
        let value = |state: usize| states.coordinate(state, coordinate);
        let (_, &mut median, _) = self.order[from..to]
            .select_nth_unstable_by(middle, |&a, &b| value(a).total_cmp(&value(b)).then(a.cmp(&b)));
        let cut = value(median);
        let below = self.divide(states, from, from + middle);
        let above = self.divide(states, from + middle, to);
        self.nodes[index].cut = Some((coordinate, cut, below, above));
        index
    }

    /// The nearest state more than `window` samples away in time and farther away than `beyond`, with its
    /// squared distance.
    pub(super) fn nearest(
        &self,
        states: &DelayStates,
        state: usize,
        window: usize,
        beyond: f64,
    ) -> Option<(usize, f64)> {
        let mut best = None;
        self.search(0, &Search { states, state, window, beyond: beyond * beyond }, &mut best);
        best
    }

    fn search(&self, node: usize, search: &Search, best: &mut Option<(usize, f64)>) {
        let Node { from, to, cut } = self.nodes[node];
        let Some((coordinate, value, below, above)) = cut else {
            for &other in &self.order[from..to] {
                if other.abs_diff(search.state) > search.window {
                    let square = search.states.square(search.state, other);
                    // Ties go to the earlier state, whatever the order of the tree.
                    let closer =
                        best.is_none_or(|(at, least)| square < least || (square == least && other < at));
                    if square > search.beyond && closer {
                        *best = Some((other, square));
                    }
                }
            }
            return;
        };
        let side = search.states.coordinate(search.state, coordinate) - value;
        let (near, far) = if side < 0.0 { (below, above) } else { (above, below) };
        self.search(near, search, best);
        if best.is_none_or(|(_, least)| side * side <= least) {
            self.search(far, search, best);
        }
    }

    /// All states within a radius, more than `window` samples away in time.
    pub(super) fn within(
        &self,
        states: &DelayStates,
        state: usize,
        window: usize,
        radius: f64,
    ) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = vec![0];
        while let Some(node) = open.pop() {
            let Node { from, to, cut } = self.nodes[node];
            let Some((coordinate, value, below, above)) = cut else {
                let near = |other: &&usize| {
                    other.abs_diff(state) > window && states.square(state, **other) <= radius * radius
                };
                found.extend(self.order[from..to].iter().filter(near).copied());
                continue;
            };
            let side = states.coordinate(state, coordinate) - value;
            if side <= radius {
                open.push(below);
            }
            if side >= -radius {
                open.push(above);
            }
        }
        found.sort_unstable();
        found
    }
}
