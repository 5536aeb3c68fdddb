//! The branch of an impact oscillator between its two grazings, and how its largest multiplier grows towards
//! each of them.

use std::f64::consts::TAU;

use hammerbeam::{
    BranchRow, Side, Study,
    figure::{
        Bifurcation, DataAxis, DataDiagram, DataLabel, DataLook, DataPanel, DataSeries, Figure, LabelSide,
    },
};

use super::{Outcome, compared, style};

const STUDY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../studies/impact-oscillator.toml");
/// Of the study: `x'' + c x' + x = F cos(W t)` in front of a stop at g that sends back with e.
const DAMPING: f64 = 0.04;
const RESTITUTION: f64 = 0.8;
const GAP: f64 = 1.0;
const FORCE: f64 = 0.4;
/// Rows that are compared with the closed form, by their impact speed (m/s), and those that are drawn.
const SLOWEST: f64 = 1e-4;
const COMPARED_FROM: f64 = 1e-2;
const DRAWN_IN_A_DECADE: f64 = 8.0;

/// The largest modulus of a multiplier of an orbit with one impact of the speed v, by (G5).
fn largest_multiplier(frequency_hz: f64, v: f64) -> f64 {
    let (w, period) = (TAU * frequency_hz, 1.0 / frequency_hz);
    let (half, root) = (0.5 * DAMPING, (1.0 - 0.25 * DAMPING * DAMPING).sqrt());
    let decay = (-half * period).exp();
    let (sine, cosine) = (decay * (root * period).sin() / root, decay * (root * period).cos());
    let (a, b, k, d) = (cosine + half * sine, sine, -sine, cosine - half * sine);
    // The particular motion at the impact, from the periodicity of what is left.
    let x = (1.0 + RESTITUTION) * v / (k - (1.0 - d) * (1.0 - a) / b);
    let slope = -x * (1.0 - a) / b - RESTITUTION * v;
    let before = (1.0 - w * w) * (GAP - x) + DAMPING * slope - DAMPING * v - GAP;
    let after = before + DAMPING * (1.0 + RESTITUTION) * v;
    let sum = -RESTITUTION * (a + d) + b * (after + RESTITUTION * before) / v;
    let product = RESTITUTION * RESTITUTION * (-DAMPING * period).exp();
    let square = 0.25 * sum * sum - product;
    if square < 0.0 { product.sqrt() } else { 0.5 * sum.abs() + square.sqrt() }
}

fn modulus(row: &BranchRow) -> f64 {
    let [re, im] = row.solution.floquet_multipliers[0];
    re.hypot(im)
}

fn speed(row: &BranchRow) -> f64 {
    row.solution.maxima.impact_velocity
}

/// Draws the branch and its multipliers.
pub fn draw() -> Outcome<Figure> {
    let study = Study::read(STUDY)?;
    let start = study.orbits(0.08, 1)?.swap_remove(0);
    let rows: Vec<BranchRow> = study.follow(&start, Side::Up)?.collect::<Result<_, _>>()?;
    let panels = vec![branch(&rows), growth(&rows)];
    let description = "impact speed over frequency with two grazings, a flip and a fold; largest multiplier \
                       over the impact speed";
    Ok(DataDiagram { panels, description: description.to_owned() }.draw(&style())?)
}

/// The impact speed along the branch.
fn branch(rows: &[BranchRow]) -> DataPanel {
    let at = |row: &BranchRow| (row.solution.frequency_hz, speed(row));
    let (mut series, mut labels) = (Vec::new(), Vec::new());
    let mut start = 0;
    while start < rows.len() {
        let stable = rows[start].solution.stable();
        let end = rows[start..].iter().position(|row| row.solution.stable() != stable);
        let end = end.map_or(rows.len(), |length| start + length);
        let (name, look) =
            if stable { ("stable", DataLook::Stable) } else { ("unstable", DataLook::Unstable) };
        series.push(DataSeries::new(name, look, rows[start..rows.len().min(end + 1)].iter().map(at)));
        start = end;
    }
    for (name, mark, side) in [
        ("grazing", Bifurcation::Grazing, LabelSide::Below),
        ("flip", Bifurcation::Flip, LabelSide::Right),
        ("fold", Bifurcation::Fold, LabelSide::Right),
    ] {
        // The multipliers jump at a grazing, which makes it a flip or a fold as well.
        let is_there = |row: &&BranchRow| match mark {
            Bifurcation::Grazing => row.events.grazing,
            Bifurcation::Flip => row.events.flip && !row.events.grazing,
            _ => row.events.fold && !row.events.grazing,
        };
        let places: Vec<(f64, f64)> = rows.iter().filter(is_there).map(at).collect();
        assert!(places.len() == if mark == Bifurcation::Grazing { 2 } else { 1 }, "{name}: {places:?}");
        if mark == Bifurcation::Grazing {
            compare_grazings(&places);
        }
        // Right of the flip the branch rises.
        let lower = if mark == Bifurcation::Flip { 0.12 } else { 0.0 };
        let label = |&(f, v): &(f64, f64)| DataLabel { at: (f, v - lower), text: name.to_owned(), side };
        labels.extend(places.iter().map(label));
        series.push(DataSeries::new("", DataLook::Events(mark), places));
    }
    DataPanel {
        labels,
        ..DataPanel::new(
            DataAxis::linear("Excitation frequency (Hz)").between(0.1, 0.28),
            DataAxis::linear("Impact speed (m/s)").between(-0.4, 3.0),
            series,
        )
    }
}

/// Where the linear amplitude reaches the gap: `(1 - W^2)^2 + (c W)^2 = (F/g)^2`.
fn compare_grazings(places: &[(f64, f64)]) {
    let half = 1.0 - 0.5 * DAMPING * DAMPING;
    let root = (half * half - 1.0 + (FORCE / GAP).powi(2)).sqrt();
    for ((found, _), square) in places.iter().zip([half - root, half + root]) {
        let off = (found * TAU / square.sqrt() - 1.0).abs();
        compared(&format!("grazing: at {found:.8} Hz, off by {off:.1e}"));
        assert!(off < 1e-9, "the linear motion grazes the stop: {off:e}");
    }
}

/// The largest multiplier over the impact speed, on both ways to a grazing.
fn growth(rows: &[BranchRow]) -> DataPanel {
    let one_impact = |row: &&BranchRow| row.solution.maxima.contacts == 1 && speed(row) > SLOWEST;
    let compared_rows: Vec<&BranchRow> = rows.iter().filter(one_impact).collect();
    let off = |row: &&BranchRow| {
        (modulus(row) / largest_multiplier(row.solution.frequency_hz, speed(row)) - 1.0).abs()
    };
    let mut offs: Vec<f64> = compared_rows.iter().filter(|row| speed(row) > COMPARED_FROM).map(off).collect();
    offs.sort_by(f64::total_cmp);
    let (median, largest) = (offs[offs.len() / 2], offs[offs.len() - 1]);
    compared(&format!("grazing: {} multipliers off by {median:.1e}, {largest:.1e} at most", offs.len()));
    assert!(median < 1e-13 && largest < 1e-10, "(G5): {median:e}, {largest:e}");

    let fold = rows.iter().position(|row| row.events.fold && !row.events.grazing).unwrap_or(rows.len());
    let (lower, upper) = rows.split_at(fold);
    let mut series = Vec::new();
    for (name, part, number) in
        [("towards the lower grazing", lower, 0), ("towards the upper grazing", upper, 1)]
    {
        let part: Vec<&BranchRow> = part.iter().filter(one_impact).collect();
        let mut closed: Vec<(f64, f64)> = part
            .iter()
            .map(|row| (speed(row), largest_multiplier(row.solution.frequency_hz, speed(row))))
            .collect();
        closed.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut taken = Vec::new();
        let is_new = |row: &&&BranchRow| {
            let place = (DRAWN_IN_A_DECADE * speed(row).log10()).round() as i64;
            let new = !taken.contains(&place);
            taken.push(place);
            new
        };
        let drawn: Vec<(f64, f64)> =
            part.iter().filter(is_new).map(|row| (speed(row), modulus(row))).collect();
        series.push(DataSeries::new("closed form (G5)", DataLook::Pale, closed));
        series.push(DataSeries::new(name, DataLook::Dots(number), drawn));
    }
    let inverse = [1e-4, 1e-1].map(|v| (v, 0.3 / v));
    series.push(DataSeries::new("slope −1", DataLook::Line(2), inverse));
    DataPanel {
        levels: vec![1.0],
        ..DataPanel::new(
            DataAxis::logarithmic("Impact speed (m/s)").between(7e-5, 5.0),
            DataAxis::logarithmic("Largest multiplier, modulus (–)").between(0.3, 4e4),
            series,
        )
    }
}
