//! What the equations do not say: kinds of solutions, what is known of their stability, and what is the same
//! solution seen otherwise.
//!
//! A follower asks it of one [`Judge`] that the problem hands over. Every question has an answer that
//! stands for "nothing is known", which is the default: with it a path is followed by its equations alone.

use crate::{point::PathEvents, predictor::Node};

/// How many multipliers of the solution at the last evaluated point lie outside the unit circle: of a
/// solution that is a fixed point of a map, say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Outside {
    /// Those that certainly do.
    pub least: u32,
    /// With those that may, since they are critical at the events or on the circle to rounding.
    pub most: u32,
    /// How many are critical at the events: one at a fold, the pair at a Neimark-Sacker point.
    pub critical: u32,
}

/// A corner behind which `R` changes like a square root, or before which it did, as the judge knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct RootCorner {
    /// The corner itself.
    pub corner: Vec<f64>,
    /// A point beside it on the side without the root, or without any: it stands for the corner, which cannot
    /// be evaluated.
    pub beside: Vec<f64>,
    /// Within which the parameter of that point equals the parameter of the corner.
    pub uncertainty: f64,
    /// Points of the path behind it, in the order in which they should be tried, each with another one
    /// farther behind it that gives the direction.
    pub behind: Vec<[Vec<f64>; 2]>,
    /// Whether more than one square root sets in at once: then the determinant may change its sign.
    pub is_multiple: bool,
    /// Work that it took, in evaluations.
    pub evaluations: u64,
}

/// A point of a path with its unit tangent, seen otherwise.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Point and unit tangent.
    pub node: Node,
    /// How many times as large as in the point an error may be in its image, 1 or more.
    pub magnification: f64,
}

/// Answers what the equations `R(x, λ) = 0` do not say, at the point at which they were evaluated last
/// where it does not say otherwise.
pub trait Judge {
    /// What kind of solution this is: equal along one smooth arc, different where `R` may lose derivatives
    /// (for an impact problem: a hash of the sequence of contacts, which changes at grazing).
    fn signature(&self) -> u64 {
        0
    }

    /// Weights of that part of a point by which a stretch that was walked before is known: the first
    /// unknowns, and the parameter last. `None` for all of it, with the weights of the problem.
    ///
    /// A problem that changes its unknowns on the way (see [`Follower::transfer`](crate::Follower::transfer))
    /// names a part that stays, enough to distinguish solutions, with weights that stay.
    fn memory_weights(&self) -> Option<Vec<f64>> {
        None
    }

    /// Multipliers outside the unit circle, where these events were found; `None` if nothing is known.
    ///
    /// They cross the circle at folds, branch points and zeros of test functions only. What crosses it and
    /// turns real within one step escapes the test functions; here it shows.
    fn outside(&mut self, events: PathEvents) -> Option<Outside> {
        let _ = events;
        None
    }

    /// Numbers, asked for with the test functions, by which [`hides_zeros`](Self::hides_zeros) and
    /// [`jumps`](Self::jumps) compare a point with the next.
    fn note(&mut self, numbers: &mut Vec<f64>) {
        numbers.clear();
    }

    /// Whether zeros of the test functions that undo each other lie between two neighbouring points of one
    /// smooth arc, by the numbers noted there.
    ///
    /// A test function that is made of several things may vanish for one of them and for another in between,
    /// and be the same on both sides.
    fn hides_zeros(&self, before: &[f64], behind: &[f64]) -> bool {
        let _ = (before, behind);
        false
    }

    /// Whether a test function jumped between two neighbouring points of one smooth arc, at which it has
    /// different signs, since what it is made of changed its kind; by the numbers noted there.
    fn jumps(&self, index: usize, before: &[f64], behind: &[f64]) -> bool {
        let _ = (index, before, behind);
        false
    }

    /// Distance of any point from the nearest solution that this path can meet at branch points only, in the
    /// norm of the weights; infinite if there is none, or if nothing is known.
    ///
    /// An orbit of N periods solves the same equations as one of a divisor of N that is gone through several
    /// times, a solution without a symmetry the same as one with it. Such a path is tangent to nothing: a
    /// point that comes that close is a jump. What was evaluated last stays so.
    ///
    /// Where that distance vanishes the path goes on as an image of what it has come along, and the parameter
    /// turns; a path for which that is not so has to end there.
    fn distance_to_simpler(&mut self, point: &[f64]) -> f64 {
        let _ = point;
        f64::INFINITY
    }

    /// How many images a solution has: itself, and the same one seen otherwise, as an orbit that begins some
    /// excitation periods later. A path that comes back to an image of its start has closed.
    fn images(&self) -> usize {
        1
    }

    /// A point of the path and its tangent as their image `k`, from 1 to below [`images`](Self::images), at
    /// the same parameter; `None` if it cannot be computed, or not well enough: then the path does not close
    /// there. What was evaluated last stays so.
    fn image(&mut self, k: usize, of: &Node) -> Option<Image> {
        let _ = (k, of);
        None
    }

    /// Whether `R` may change like a square root behind a change of signature, so that its derivatives grow
    /// without bound there (impacts on rigid stops, at grazing).
    fn has_root_corners(&self) -> bool {
        false
    }

    /// The corner that lies ahead of a point of the path, if it can be computed: where `R` begins or ceases
    /// to change like a square root.
    ///
    /// It is looked for from the point, whatever was evaluated last; then another point may be evaluated.
    ///
    /// * `reach`: about how far ahead it lies at most.
    /// * `lies_ahead`: whether a corner that was found is one ahead.
    fn root_corner(
        &mut self,
        point: &[f64],
        reach: f64,
        lies_ahead: &dyn Fn(&[f64]) -> bool,
    ) -> Option<RootCorner> {
        let _ = (point, reach, lies_ahead);
        None
    }
}
