//! The shooting equations of a Duffing oscillator before Newton's method, and the multipliers along its
//! branch.

use std::f64::consts::TAU;

use hammerbeam::{
    BranchRow, PeriodicSolution, Side, Study,
    figure::{DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide},
};

use super::{Outcome, compared, style};

const STUDY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/duffing.toml");
const FREQUENCY_HZ: f64 = 0.25;
const DAMPING: f64 = 0.1;
const SEGMENTS: usize = 4;
/// Nodes before Newton's method, relative to states of the orbit.
const BESIDE: [f64; SEGMENTS] = [1.15, 0.85, 1.2, 0.85];
/// Steps of the method of Runge and Kutta in a segment, and from one drawn point to the next.
const STEPS: usize = 2000;
const DRAWN: usize = 20;

/// `x'' + c x' + x + x^3 = 0.3 cos(W t)` from a state at a phase over a segment, by the method of Runge and
/// Kutta: the states at the phases that are drawn.
fn flow(start: [f64; 2], phase: f64) -> Vec<[f64; 2]> {
    let rate = |phase: f64, [x, v]: [f64; 2]| [v, 0.3 * (TAU * phase).cos() - DAMPING * v - x - x * x * x];
    let (turn, step) = (1.0 / (SEGMENTS * STEPS) as f64, 1.0 / (FREQUENCY_HZ * (SEGMENTS * STEPS) as f64));
    let added = |[x, v]: [f64; 2], by: f64, [dx, dv]: [f64; 2]| [x + by * dx, v + by * dv];
    let mut states = vec![start];
    let mut state = start;
    for k in 0..STEPS {
        let at = phase + turn * k as f64;
        let k1 = rate(at, state);
        let k2 = rate(at + 0.5 * turn, added(state, 0.5 * step, k1));
        let k3 = rate(at + 0.5 * turn, added(state, 0.5 * step, k2));
        let k4 = rate(at + turn, added(state, step, k3));
        for (slope, share) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
            state = added(state, share * step / 6.0, slope);
        }
        if (k + 1) % DRAWN == 0 {
            states.push(state);
        }
    }
    states
}

/// Draws both, and checks that the orbit is periodic and that Liouville's formula (P6) holds.
pub fn draw() -> Outcome<Figure> {
    let study = Study::read(STUDY)?;
    let orbits = study.orbits(FREQUENCY_HZ, 1)?;
    let largest = orbits.iter().max_by(|a, b| a.maxima.displacement.total_cmp(&b.maxima.displacement));
    let start = study.orbits(0.08, 1)?.swap_remove(0);
    let rows: Vec<BranchRow> = study.follow(&start, Side::Up)?.collect::<Result<_, _>>()?;
    let panels = vec![segments(largest.ok_or("there are orbits")?), multipliers(&rows)];
    let description = "four segments whose ends miss the next nodes; multipliers in the complex plane";
    Ok(DataDiagram { panels, description: description.to_owned() }.draw(&style())?)
}

/// The orbit, and segments that start beside it.
fn segments(solution: &PeriodicSolution) -> DataPanel {
    let phase = |k: usize| solution.phase + k as f64 / SEGMENTS as f64;
    let first = [solution.nodes[0][0], solution.nodes[0][1]];
    let (mut orbit, mut nodes) = (vec![first], Vec::new());
    for k in 0..SEGMENTS {
        let [x, v] = orbit[orbit.len() - 1];
        nodes.push([BESIDE[k] * x, BESIDE[k] * v]);
        orbit.extend(flow([x, v], phase(k)).into_iter().skip(1));
    }
    let last = orbit[orbit.len() - 1];
    let off = (last[0] - first[0]).abs().max((last[1] - first[1]).abs());
    compared(&format!("shooting: the orbit comes back to {off:.1e}"));
    assert!(off < 1e-8, "the orbit is periodic: {off:e}");

    let pair = |state: &[f64; 2]| (state[0], state[1]);
    let mut series = vec![DataSeries::new("orbit", DataLook::Pale, orbit.iter().map(pair))];
    let mut residuals = Vec::new();
    for (k, node) in nodes.iter().enumerate() {
        let segment = flow(*node, phase(k));
        residuals.push(vec![pair(&segment[segment.len() - 1]), pair(&nodes[(k + 1) % SEGMENTS])]);
        series.push(DataSeries::new("segment", DataLook::Line(0), segment.iter().map(pair)));
    }
    for residual in residuals {
        series.push(DataSeries::new("residual", DataLook::Line(1), residual));
    }
    series.push(DataSeries::new("node", DataLook::Dots(0), nodes.iter().map(pair)));
    let names = nodes.iter().enumerate().map(|(k, node)| DataLabel {
        at: (node[0], node[1]),
        text: format!("node {k}"),
        side: if node[0] > 0.0 { LabelSide::Above } else { LabelSide::Below },
    });
    DataPanel {
        labels: names.collect(),
        ..DataPanel::new(
            DataAxis::linear("Displacement (m)").between(-2.0, 2.0),
            DataAxis::linear("Velocity (m/s)").between(-3.0, 3.0),
            series,
        )
    }
}

/// The multipliers of the rows of a branch, and the unit circle.
fn multipliers(rows: &[BranchRow]) -> DataPanel {
    let solutions = || rows.iter().map(|row| &row.solution);
    let product = |solution: &PeriodicSolution| {
        let [[a, b], [c, d]] = [solution.floquet_multipliers[0], solution.floquet_multipliers[1]];
        a * c - b * d
    };
    let off = solutions()
        .map(|solution| (product(solution) * (DAMPING / solution.frequency_hz).exp() - 1.0).abs())
        .fold(0.0, f64::max);
    compared(&format!("shooting: products of {} pairs of multipliers off by {off:.1e}", rows.len()));
    assert!(off < 1e-13, "(P6): {off:e}");
    let folds: Vec<&BranchRow> = rows.iter().filter(|row| row.events.fold).collect();
    assert!(folds.len() == 2, "the branch has two folds");
    let largest = |row: &&BranchRow| {
        let [re, im] = row.solution.floquet_multipliers[0];
        (re, im)
    };
    let folds: Vec<(f64, f64)> = folds.iter().map(largest).collect();
    assert!(folds.iter().all(|(re, im)| (re - 1.0).abs() < 1e-6 && *im == 0.0), "folds are at +1: {folds:?}");

    let circle = (0..=360).map(|k| TAU * f64::from(k) / 360.0).map(|angle| (angle.cos(), angle.sin()));
    // Of solutions whose multipliers have hardly moved one is drawn.
    let mut drawn: Vec<(f64, f64)> = Vec::new();
    for solution in solutions() {
        let [re, im] = solution.floquet_multipliers[0];
        let has_moved =
            drawn.chunks(2).last().is_none_or(|last| (re - last[0].0).hypot(im - last[0].1) > 0.01);
        if has_moved {
            drawn.extend(solution.floquet_multipliers.iter().map(|[re, im]| (*re, *im)));
        }
    }
    DataPanel {
        equal_units: true,
        levels: vec![0.0],
        uprights: vec![0.0],
        labels: vec![DataLabel { at: (1.0, 0.14), text: "both folds".into(), side: LabelSide::Right }],
        ..DataPanel::new(
            DataAxis::linear("Real part (–)").between(-1.3, 2.1),
            DataAxis::linear("Imaginary part (–)").between(-1.2, 1.2),
            vec![
                DataSeries::new("unit circle", DataLook::Pale, circle),
                DataSeries::new("multipliers", DataLook::Specks(0), drawn),
                DataSeries::new("fold", DataLook::Circles(1), folds),
            ],
        )
    }
}
