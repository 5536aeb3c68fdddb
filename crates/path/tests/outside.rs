//! Pairs of multipliers that cross the unit circle within a step in which something turns real are found.
#![allow(clippy::unwrap_used, reason = "a test ends where its path is wrong")]

use hammerbeam_path::{
    Branch, EvaluationError, Judge, Outside, ParameterRange, PathEvents, PathProblem, Settings,
    StartDirection, TestValue, follow,
};

/// A path with multipliers that depend on the unknown alone, the two of a pair one after the other.
struct Multiplied<P> {
    path: P,
    multipliers: fn(f64) -> Vec<(f64, f64)>,
    x: f64,
    /// What it says when asked whether its function jumped.
    jumps: bool,
}

impl<P> Multiplied<P> {
    fn new(path: P, multipliers: fn(f64) -> Vec<(f64, f64)>) -> Self {
        Self { path, multipliers, x: 0.0, jumps: false }
    }
}

/// Where the pair crosses the circle, before the fold at `x = 0`.
const CROSSING: f64 = -1e-3;

/// `λ = -x²` whose point `x` is a fixed point with two multipliers of the product `D = 1 + b tanh((x + a)/a)`
/// and the sum `T = 1 + D + tanh x`.
///
/// `(1 - mu)(1 - mu') = 1 - T + D = -tanh x`: one is at +1 at the fold. With `a = 1e-3` and `b = 0.1` they
/// are complex on the circle at `x = -a`, where `T = 2 - tanh a`; real and outside from about `x = -a/2`,
/// where `T^2 - 4 D = (T - 2)^2 - 4 (1 - T + D)` changes its sign; 1 and 1.1 at the fold; one on either side
/// of the circle behind it. The numbers outside are 0, 2, 2, 1.
fn normal() -> Multiplied<impl PathProblem> {
    let multipliers = |x: f64| {
        let product = 1.0 + 0.1 * ((x - CROSSING) / -CROSSING).tanh();
        pair(0.5 * (1.0 + product + x.tanh()), product)
    };
    Multiplied::new(crate::support::graph(|x| (-x * x, -2.0 * x, 0)), multipliers)
}

/// Half-way between the two crossings, and how far they are from it.
const OUT_AND_IN: (f64, f64) = (0.07, 0.02);

/// `λ = x` with a pair that is outside the circle between the two crossings alone, and one of the product 9
/// that turns real between them.
fn passing() -> Multiplied<impl PathProblem> {
    let multipliers = |x: f64| {
        let (middle, width) = OUT_AND_IN;
        let radius = 1.0 + 0.05 * (1.0 - ((x - middle) / width).powi(2)).max(-10.0);
        let mut all = pair(0.3 * radius, radius * radius);
        all.extend(pair(-3.0 - 2.0 * (x - middle), 9.0));
        all
    };
    Multiplied::new(crate::support::graph(|x| (x, 1.0, 0)), multipliers)
}

/// Two multipliers by half their sum, and their product.
fn pair(half: f64, product: f64) -> Vec<(f64, f64)> {
    let square = half * half - product;
    let root = square.abs().sqrt();
    if square < 0.0 {
        vec![(half, root), (half, -root)]
    } else {
        vec![(half + root, 0.0), (half - root, 0.0)]
    }
}

impl<P: PathProblem> PathProblem for Multiplied<P> {
    left_to!(path but evaluate);

    fn evaluate(&mut self, point: &[f64]) -> Result<(), EvaluationError> {
        self.x = point[0];
        self.path.evaluate(point)
    }
    /// Of the complex pair nearest to the circle.
    fn tests(&mut self, _: &[u32], values: &mut Vec<TestValue>) {
        let multipliers = (self.multipliers)(self.x);
        let pairs = multipliers.iter().filter(|(_, im)| *im > 0.0).map(|(re, im)| 1.0 - re * re - im * im);
        let count = pairs.clone().filter(|value| *value < 0.0).count() as u32;
        let least = pairs.fold(1.0, |least: f64, value| least.min(value.abs()));
        values.clear();
        values.push(TestValue::sign_change(if count.is_multiple_of(2) { least } else { -least }, count));
    }
}

impl<P: PathProblem> Judge for Multiplied<P> {
    fn jumps(&self, _: usize, _: &[f64], _: &[f64]) -> bool {
        self.jumps
    }

    fn outside(&mut self, events: PathEvents) -> Option<Outside> {
        let mut left = (self.multipliers)(self.x);
        let all = left.len();
        if events.fold {
            remove_nearest(&mut left, |(re, im)| (re - 1.0).hypot(im));
        }
        if events.zeros > 0 {
            let off_circle = |(re, im): (f64, f64)| if im == 0.0 { 9.0 } else { (re.hypot(im) - 1.0).abs() };
            (0..2).for_each(|_| remove_nearest(&mut left, off_circle));
        }
        let critical = (all - left.len()) as u32;
        let least = left.iter().filter(|(re, im)| re.hypot(*im) > 1.0).count() as u32;
        Some(Outside { least, most: least + critical, critical })
    }
}

fn remove_nearest(multipliers: &mut Vec<(f64, f64)>, distance: impl Fn((f64, f64)) -> f64) {
    let numbered = multipliers.iter().enumerate();
    let nearest = numbered.min_by(|a, b| distance(*a.1).total_cmp(&distance(*b.1))).unwrap().0;
    multipliers.remove(nearest);
}

fn steps_of(step: f64) -> Settings {
    Settings { max_step_length: step, sheet_distance: 1e-2, ..Settings::default() }
}

/// The unknown where the test function vanishes, along the path from a start to the end of the range.
fn zeros<P: PathProblem>(
    mut problem: Multiplied<P>,
    start: [f64; 2],
    settings: Settings,
) -> (Vec<f64>, Branch) {
    let range = ParameterRange::new(-1.0, 1.0).unwrap();
    let branch = follow(&mut problem, &start, StartDirection::Increasing, range, settings).unwrap();
    let zeros = branch.points.iter().filter(|point| point.events.zeros == 1);
    (zeros.map(|point| point.point[0]).collect(), branch)
}

#[test]
fn the_crossing_is_found_from_either_side_whatever_the_step() {
    for (start, step) in [(-0.9, 0.3), (-0.9, 0.1), (-0.9, 0.007), (0.9, 0.3), (0.9, 0.1), (0.9, 0.007)] {
        let (found, branch) = zeros(normal(), [start, -start * start], steps_of(step));
        assert_eq!(found.len(), 1, "from {start} in steps of {step}: {found:?}");
        assert!((found[0] - CROSSING).abs() < 1e-9, "{found:?}");
        assert_eq!(branch.folds().count(), 1);
        // The interval of a thousandth is not walked in steps as short as that throughout.
        assert!(branch.points.len() < 60 + (4.0 / step) as usize, "{} points", branch.points.len());
    }
}

#[track_caller]
fn assert_both_crossings(settings: Settings) {
    let (middle, width) = OUT_AND_IN;
    for start in (0..40).map(|k| -0.9 + 0.005 * f64::from(k)) {
        let (found, branch) = zeros(passing(), [start, start], settings.clone());
        assert_eq!(found.len(), 2, "from {start}: {found:?}");
        let off = (found[0] - (middle - width)).abs().max((found[1] - (middle + width)).abs());
        assert!(off < 1e-9, "from {start}: {found:?}");
        assert!(branch.points.len() < 60, "{} points", branch.points.len());
    }
}

/// Behind the step the number of pairs outside is another one, since one has turned real, and the zero that
/// shows it may be either.
#[test]
fn both_crossings_are_found_while_another_pair_turns_real() {
    assert_both_crossings(steps_of(0.3));
}

/// They lie nearer to each other than changes of the signature are resolved.
#[test]
fn both_crossings_are_found_within_a_step_that_would_do_for_a_change_of_signature() {
    assert_both_crossings(Settings { signature_step: 0.1, ..steps_of(0.3) });
}

/// A pair outside the circle that turns real is searched for a crossing, unless the judge knows better.
#[test]
fn a_jump_that_the_judge_knows_is_not_searched() {
    let turning = |x: f64| pair(-3.0 - 2.0 * (x - OUT_AND_IN.0), 9.0);
    let evaluations = |jumps: bool| {
        let path = crate::support::graph(|x| (x, 1.0, 0));
        let problem = Multiplied { jumps, ..Multiplied::new(path, turning) };
        let (found, branch) = zeros(problem, [-0.9, -0.9], steps_of(0.3));
        assert_eq!(found.len(), 0, "{found:?}");
        branch.counters.evaluations
    };
    let (searched, known) = (evaluations(false), evaluations(true));
    assert!(known + 8 < searched, "{known} and {searched} evaluations");
}

/// What crosses the circle is searched whatever the judge says: the numbers outside decide.
#[test]
fn a_crossing_that_the_judge_takes_for_a_jump_is_found() {
    for start in [-0.9, 0.9] {
        let problem = Multiplied { jumps: true, ..normal() };
        let (found, _) = zeros(problem, [start, -start * start], steps_of(0.1));
        assert_eq!(found.len(), 1, "from {start}: {found:?}");
        assert!((found[0] - CROSSING).abs() < 1e-9, "{found:?}");
    }
}
