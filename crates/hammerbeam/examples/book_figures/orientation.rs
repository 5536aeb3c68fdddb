//! A fold that is sharper than the step, walked with the angle rule (O5) and with the determinant (O4).

use hammerbeam::figure::{
    DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide,
};

use super::{Outcome, style};

/// Distance of the fold from the origin, distance of its arms, and how much they bend.
const TIP: f64 = 0.02;
const WIDTH: f64 = 0.035;
const BEND: f64 = 0.5;
const STEP: f64 = 0.17;

/// Parameter and solution.
type Point = [f64; 2];

/// Which tangent goes on.
#[derive(Clone, Copy, PartialEq)]
enum Rule {
    Angle,
    Determinant,
}

/// The branch is where `R = l^2 - (h/w)^2 - t^2` vanishes, with the height `h = x + b l^2`.
fn height([parameter, solution]: Point) -> f64 {
    solution + BEND * parameter * parameter
}

fn residual(z: Point) -> f64 {
    z[0] * z[0] - (height(z) / WIDTH).powi(2) - TIP * TIP
}

fn gradient(z: Point) -> Point {
    let by_height = -2.0 * height(z) / (WIDTH * WIDTH);
    [2.0 * z[0] + by_height * 2.0 * BEND * z[0], by_height]
}

/// The point of the arm `l < 0` at `h = w a`.
fn on_branch(a: f64) -> Point {
    let parameter = -a.hypot(TIP);
    [parameter, WIDTH * a - BEND * parameter * parameter]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn determinant(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn difference(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// A unit tangent, in either direction.
fn tangent(z: Point) -> Point {
    let [x, y] = gradient(z);
    let length = x.hypot(y);
    [y / length, -x / length]
}

fn times(factor: f64, [x, y]: Point) -> Point {
    [factor * x, factor * y]
}

/// Newton's method (O2) on the plane at a step ahead; `None` where it does not converge nearby.
fn corrected(z: Point, direction: Point, step: f64) -> Option<Point> {
    let mut guess = [z[0] + step * direction[0], z[1] + step * direction[1]];
    for _ in 0..30 {
        let slope = gradient(guess);
        let below = determinant(slope, direction);
        if below.abs() < 1e-9 {
            return None;
        }
        let (first, second) = (residual(guess), dot(direction, difference(guess, z)) - step);
        let correction = [
            (first * direction[1] - second * slope[1]) / below,
            (second * slope[0] - first * direction[0]) / below,
        ];
        guess = difference(guess, correction);
        if correction[0].abs().max(correction[1].abs()) < 1e-13 {
            let moved = difference(guess, z);
            return (guess[0] < 0.0 && moved[0].hypot(moved[1]) < 2.0 * step).then_some(guess);
        }
    }
    None
}

/// Points of a branch walked towards its fold.
fn walk(rule: Rule, count: usize) -> Vec<Point> {
    let mut points = vec![on_branch(-0.85)];
    let mut direction = tangent(points[0]);
    direction = times(direction[0].signum(), direction);
    let sign = determinant(gradient(points[0]), direction).signum();
    while points.len() < count {
        let z = points[points.len() - 1];
        let halves = (0..40).map(|k| STEP * 0.5_f64.powi(k));
        let Some(next) = halves.into_iter().find_map(|step| corrected(z, direction, step)) else { break };
        let turned = tangent(next);
        direction = match rule {
            Rule::Angle => times(dot(turned, direction).signum(), turned),
            Rule::Determinant => times(sign * determinant(gradient(next), turned).signum(), turned),
        };
        points.push(next);
    }
    assert!(points.len() == count, "the walk goes on");
    points
}

/// Draws both walks.
pub fn draw() -> Outcome<Figure> {
    let panel = |rule: Rule, count: usize, heading: &str| {
        let points = walk(rule, count);
        let is_on_upper = |k: usize| height(points[k]) > 0.0;
        assert!(!is_on_upper(3) && is_on_upper(4), "both walks land on the upper arm at point 5");
        let runs_back = !is_on_upper(count - 1);
        assert!(runs_back == (rule == Rule::Angle), "the angle rule runs back, the determinant does not");
        let pair = |point: &Point| (point[0], point[1]);
        let branch = (0..=800).map(|k| on_branch(-0.95 + 1.9 * f64::from(k) / 800.0));
        let branch: Vec<(f64, f64)> = branch.map(|point| pair(&point)).collect();
        let crowded = |k: usize| {
            let [x, y] = difference(points[k], points[k.max(1) - 1]);
            k > 0 && x.hypot(y) < 0.03
        };
        // Points at one place have one label.
        let labels = (0..count).filter(|k| !crowded(*k)).map(|k| {
            let last = (k + 1..count).take_while(|k| crowded(*k)).last();
            DataLabel {
                at: pair(&points[k]),
                text: last.map_or((k + 1).to_string(), |last| format!("{}–{}", k + 1, last + 1)),
                side: if is_on_upper(k) { LabelSide::Above } else { LabelSide::Below },
            }
        });
        let look = DataLook::Dots(if rule == Rule::Angle { 1 } else { 0 });
        DataPanel {
            heading: heading.to_owned(),
            labels: labels.collect(),
            ..DataPanel::new(
                DataAxis::linear("Parameter (–)").between(-1.0, 0.1),
                DataAxis::linear("Solution (–)").between(-0.5, 0.07),
                vec![
                    DataSeries::new("branch", DataLook::Pale, branch),
                    DataSeries::new("points of the walk", look, points.iter().map(pair)),
                ],
            )
        }
    };
    let panels =
        vec![panel(Rule::Angle, 14, "Angle rule (O5)"), panel(Rule::Determinant, 9, "Determinant rule (O4)")];
    let description = "two walks round a sharp fold: the angle rule returns on the lower arm, the \
                       determinant rule goes on"
        .to_owned();
    Ok(DataDiagram { panels, description }.draw(&style())?)
}
