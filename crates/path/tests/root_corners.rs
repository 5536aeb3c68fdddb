//! Corners behind which `R` changes like a square root, as at grazing of a rigid stop.
//!
//! `R = J z + b nu(g . z)`, `nu(c) = sqrt(2 c)` for `c > 0`, else 0, in two unknowns and the parameter. Where
//! `g . z <= 0` the path is the line along t with `J t = 0`; behind the surface it is `z = w nu + p nu^2/2`
//! with `J w = -b`, `g . w = 0`, `J p = 0`, `g . p = 1`.

use crate::support::{range, steps_of};
use hammerbeam_path::{Branch, DenseProblem, PathProblem, PathStop, Settings, StartDirection, follow};

type Vector = [f64; 3];

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn combined(a: f64, x: Vector, b: f64, y: Vector) -> Vector {
    [a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]]
}

/// One problem of the family.
#[derive(Debug, Clone, Copy)]
struct Graze {
    rows: [Vector; 2],
    jump: [f64; 2],
    normal: Vector,
}

impl Graze {
    /// Numbers without a pattern.
    fn number(seed: u32) -> Self {
        let value = |k: u32| (f64::from(seed) * 1.7 + f64::from(k * k) * 0.9).sin();
        let vector = |k: u32| [value(k), value(k + 1), value(k + 2)];
        Self { rows: [vector(1), vector(4)], jump: [value(7), value(8)], normal: vector(9) }
    }

    fn problem(self) -> impl PathProblem + Clone {
        DenseProblem::new(2, move |z: &[f64], r: &mut [f64], j: &mut [f64]| {
            let z = [z[0], z[1], z[2]];
            let depth = dot(self.normal, z);
            let nu = (2.0 * depth.max(0.0)).sqrt();
            for i in 0..2 {
                r[i] = dot(self.rows[i], z) + self.jump[i] * nu;
                for k in 0..3 {
                    let steep = if nu > 0.0 { self.jump[i] * self.normal[k] / nu } else { 0.0 };
                    j[3 * i + k] = self.rows[i][k] + steep;
                }
            }
            u64::from(depth > 0.0)
        })
        .with_root_corners()
    }

    /// The line before the surface, oriented towards it, of length one.
    fn line(self) -> Vector {
        let along = cross(self.rows[0], self.rows[1]);
        let size = dot(along, along).sqrt() * dot(self.normal, along).signum();
        combined(1.0 / size, along, 0.0, along)
    }

    /// The path behind the surface.
    fn root(self, nu: f64) -> Vector {
        let [first, second] = self.rows;
        let determinant = dot(first, cross(second, self.normal));
        let pushed =
            combined(-self.jump[0], cross(second, self.normal), -self.jump[1], cross(self.normal, first));
        let line = self.line();
        combined(nu / determinant, pushed, 0.5 * nu * nu / dot(self.normal, line), line)
    }

    /// Distance of a point from the path.
    fn distance(self, z: &[f64]) -> f64 {
        let z = [z[0], z[1], z[2]];
        let depth = dot(self.normal, z);
        let line = self.line();
        let on_line = combined(depth / dot(self.normal, line), line, 0.0, line);
        let nearest = if depth > 0.0 { self.root((2.0 * depth).sqrt()) } else { on_line };
        let off = combined(1.0, z, -1.0, nearest);
        dot(off, off).sqrt()
    }

    fn depth(self, z: &[f64]) -> f64 {
        dot(self.normal, [z[0], z[1], z[2]])
    }

    /// Follows the path from a point on it in this direction, between -20 and 20.
    fn from(self, start: Vector, along: Vector) -> Branch {
        let direction = StartDirection::Along(&along);
        let settings = Settings { max_points: 5000, ..steps_of(0.01) };
        follow(&mut self.problem(), &start, direction, range(-20.0, 20.0), settings).expect("it starts")
    }
}

/// A point is good to 1e-9 and its depth with it, so `nu` is to `1e-9/nu`.
fn assert_on_path(graze: Graze, branch: &Branch) {
    let along = graze.root(1e-6);
    let stretch = 1.0 + dot(along, along).sqrt() / 1e-6;
    for point in &branch.points {
        let nu = (2.0 * graze.depth(&point.point).max(0.0)).sqrt();
        let allowed = 1e-8 * stretch * (1.0 + 1.0 / nu.max(1e-5));
        let off = graze.distance(&point.point);
        assert!(off < allowed, "{graze:?}: {off} off at nu = {nu}");
    }
}

#[test]
fn the_path_goes_on_behind_a_corner_onto_the_root() {
    let mut passed = 0;
    for seed in 0..40 {
        let graze = Graze::number(seed);
        let line = graze.line();
        let start = combined(-0.5, line, 0.0, line);
        let branch = graze.from(start, line);
        assert!(matches!(branch.stop, PathStop::RangeEnd | PathStop::Budget), "{graze:?}: {:?}", branch.stop);
        assert_on_path(graze, &branch);
        let deepest = branch.points.iter().map(|point| graze.depth(&point.point)).fold(0.0, f64::max);
        passed += u32::from(deepest > 1e-3);
        // It turns where the parameter of the parabola does.
        let (slope, bend) = (graze.root(1e-9)[2] / 1e-9, line[2] / dot(graze.normal, line));
        let turns = usize::from(slope * line[2] < 0.0) + usize::from(slope * bend < 0.0);
        if deepest > 1e-3 && -slope / bend < 1.0 {
            assert_eq!(branch.folds().count(), turns, "{graze:?}");
        }
    }
    assert_eq!(passed, 40);
}

#[test]
fn the_path_goes_on_behind_a_corner_off_the_root() {
    for seed in 0..40 {
        let graze = Graze::number(seed);
        let start = graze.root(0.3);
        let back = combined(1.0, graze.root(0.299), -1.0, start);
        let branch = graze.from(start, back);
        assert!(matches!(branch.stop, PathStop::RangeEnd | PathStop::Budget), "{graze:?}: {:?}", branch.stop);
        assert_on_path(graze, &branch);
        let last = branch.points.last().map(|point| graze.depth(&point.point));
        assert!(last.is_some_and(|depth| depth < 0.0), "{graze:?}: {last:?}");
    }
}
