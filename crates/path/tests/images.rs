//! Solutions that are seen in several ways, as an orbit of several periods that may begin in each of them: a
//! loop closes where it comes to its start seen otherwise.

use std::f64::consts::PI;

use crate::support::{range, steps_of};
use hammerbeam_path::{DenseProblem, Image, Judge, Node, PathProblem, PathStop, StartDirection, follow};

/// `x^2 + y^2 = 1`, `lambda = 2 x y`: at `(cos a, sin a)` the parameter is `sin 2 a`, the same at `(-x, -y)`,
/// half a turn later.
fn circle() -> impl PathProblem + Clone {
    DenseProblem::new(2, |z: &[f64], r: &mut [f64], j: &mut [f64]| {
        r.copy_from_slice(&[z[0] * z[0] + z[1] * z[1] - 1.0, z[2] - 2.0 * z[0] * z[1]]);
        j.copy_from_slice(&[2.0 * z[0], 2.0 * z[1], 0.0, -2.0 * z[1], -2.0 * z[0], 1.0]);
        0
    })
}

/// The problem whose solutions have a second image.
struct Twofold<P>(P);

impl<P: PathProblem> PathProblem for Twofold<P> {
    left_to!(0);
}

impl<P: PathProblem> Judge for Twofold<P> {
    fn images(&self) -> usize {
        2
    }

    fn image(&mut self, _: usize, of: &Node) -> Option<Image> {
        let turned = |vector: &[f64]| vec![-vector[0], -vector[1], vector[2]];
        let node = Node { point: turned(&of.point), tangent: turned(&of.tangent) };
        Some(Image { node, magnification: 1.0 })
    }
}

/// Arc length, folds and end of the loop from the angle 0.2 rad.
fn walked(problem: &mut impl PathProblem) -> (f64, usize, PathStop) {
    let start = [0.2_f64.cos(), 0.2_f64.sin(), 0.4_f64.sin()];
    let branch = follow(problem, &start, StartDirection::Increasing, range(-2.0, 2.0), steps_of(0.01));
    let branch = branch.unwrap_or_else(|error| panic!("{error}"));
    let last = &branch.points[branch.points.len() - 1];
    (last.arc_length, branch.folds().count(), branch.stop)
}

#[test]
fn a_loop_closes_where_it_comes_to_an_image_of_its_start() {
    let (whole, folds, stop) = walked(&mut circle());
    assert_eq!((folds, stop), (4, PathStop::Closed));
    let (half, folds, stop) = walked(&mut Twofold(circle()));
    assert_eq!((folds, stop), (2, PathStop::Closed));
    assert!((2.0 * half / whole - 1.0).abs() < 1e-6, "{half} of {whole}");
    // The curve is longer than the circle below it.
    assert!(whole > 2.0 * PI);
}
