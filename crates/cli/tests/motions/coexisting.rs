//! `basins` where two attractors lie on two branches: each is matched with its own.

use std::f64::consts::TAU;

use serde_json::Value;

use super::{DUFFING, document};
use crate::common::{Workshop, assert_success};

/// Attractors of a grid over the state of a mass, with the branches of a run beside it.
fn attractors(workshop: &Workshop, frequency: &str, [x, y]: [&str; 2]) -> Vec<Value> {
    assert_success(&workshop.compute(&[]));
    let basins = ["basins", "study.toml", "--frequency", frequency, "--x", x, "--y", y, "--grid", "10"];
    let found = document(workshop, &[&basins[..], &["--results", "results", "--json"]].concat());
    assert_eq!(found["cells_not_computed"], 0);
    found["attractors"].as_array().unwrap().clone()
}

/// The stored solution of a branch that is nearest to a frequency.
#[derive(Debug)]
struct Nearest {
    branch: u64,
    period: f64,
    frequency_hz: f64,
    displacement: f64,
    contacts: f64,
    stable: bool,
}

/// One of every branch of the results.
fn nearest(workshop: &Workshop, frequency_hz: f64) -> Vec<Nearest> {
    let text = workshop.csv("results");
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    let number = |row: &[&str], name: &str| {
        let index = rows[0].iter().position(|column| *column == name).unwrap();
        row[index].parse::<f64>().unwrap()
    };
    let mut found: Vec<Nearest> = Vec::new();
    let stable = rows[0].iter().position(|column| *column == "stable").unwrap();
    for row in &rows[1..] {
        let new = Nearest {
            branch: number(row, "branch") as u64,
            period: number(row, "period_multiple"),
            frequency_hz: number(row, "frequency_hz"),
            displacement: number(row, "max_abs_displacement_m"),
            contacts: number(row, "contacts"),
            stable: row[stable] == "true",
        };
        let off = |row: &Nearest| (row.frequency_hz - frequency_hz).abs();
        match found.iter_mut().find(|known| known.branch == new.branch) {
            Some(known) if off(known) <= off(&new) => {}
            Some(known) => *known = new,
            None => found.push(new),
        }
    }
    found
}

/// Displacement and velocity of a mass of 1 kg at phase 0.
fn state(attractor: &Value) -> [f64; 2] {
    [0, 1].map(|i| attractor["modal_state"][i].as_f64().unwrap())
}

/// Between the folds of the hardening spring, which lie beyond the range of this study: three branches of one
/// period, the small and the large motion and the unstable one between them. A motion that is nearly a
/// harmonic one has the amplitude `|q - i v/W|`, which is that of its branch and far from those of the
/// others.
#[test]
fn two_motions_of_one_period_are_on_the_branches_of_their_amplitudes() {
    let study = DUFFING.replace("frequency_hz = [0.08, 0.5]", "frequency_hz = [0.22, 0.28]");
    let workshop = Workshop::with(&format!("{study}\n[continuation]\nmax_step_hz = 0.005\n"));
    let found = attractors(&workshop, "0.25", ["q1=-2..2", "v1=-3..3"]);
    let branches = nearest(&workshop, 0.25);
    assert_eq!((found.len(), branches.len()), (2, 3), "{found:?} {branches:?}");
    for attractor in &found {
        let [q, v] = state(attractor);
        let amplitude = q.hypot(v / (TAU * 0.25));
        let far = |known: &&Nearest| (known.displacement / amplitude).ln().abs();
        let own = branches.iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap();
        assert_eq!(attractor["branch"], own.branch, "{attractor} {branches:?}");
        assert!(far(&own) < 0.2, "{attractor} {branches:?}");
    }
    assert_ne!(found[0]["branch"], found[1]["branch"]);
}

/// Real and imaginary part of `F/(1 - W^2 + i c W)` [m].
fn linear(frequency_hz: f64) -> [f64; 2] {
    let w = TAU * frequency_hz;
    let (real, imaginary) = (1.0 - w * w, 0.04 * w);
    [0.4 * real, -0.4 * imaginary].map(|part| part / (real * real + imaginary * imaginary))
}

/// Above its resonance the mass may stay away from its rigid stop, and then moves as `Re F/(1 - W^2 + i c W)
/// exp(i W t)`, or strike it in every second period: branches of one and of two periods.
#[test]
fn a_motion_that_strikes_and_one_that_does_not_are_on_their_branches() {
    let workshop = Workshop::driven_mass(
        r#"
        frequency_hz = [0.41, 0.43]
        [[stop]]
        at = "m"
        side = "above"
        gap_m = 0.2
        law = "rigid"
        restitution = 0.9
        [response]
        period_multiples = [1, 2]
        [search]
        frequencies = 3
        [continuation]
        max_step_hz = 0.002
        "#,
    );
    let found = attractors(&workshop, "0.42", ["q1=-1..0.2", "v1=-1..1"]);
    let mut branches = nearest(&workshop, 0.42);
    // Between both there is a saddle.
    branches.retain(|known| known.stable);
    assert_eq!((found.len(), branches.len()), (2, 2), "{found:?} {branches:?}");
    for attractor in &found {
        let own = branches.iter().find(|known| attractor["branch"] == known.branch).unwrap();
        assert_eq!(attractor["period"].as_f64(), Some(own.period), "{attractor} {own:?}");
        let ([q, v], [real, imaginary]) = (state(attractor), linear(0.42));
        let away = (q - real).hypot(v + TAU * 0.42 * imaginary);
        if own.period == 1.0 {
            // A motion has come to an attractor, or repeats, within 1e-8 of its size, and comes closer by 5 %
            // in a period.
            assert!(away < 1e-6 && own.contacts == 0.0, "{attractor} {own:?}");
            let [real, imaginary] = linear(own.frequency_hz);
            assert!((own.displacement - real.hypot(imaginary)).abs() < 1e-9, "{own:?}");
        } else {
            assert!(away > 0.1 && own.contacts > 0.0, "{attractor} {own:?}");
        }
    }
    assert_ne!(found[0]["branch"], found[1]["branch"]);
}
