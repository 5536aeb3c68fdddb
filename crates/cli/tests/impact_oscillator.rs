//! The example of an impact oscillator, from the study file to verified branches, against its closed form.
//! Equations (I1) to (I3) and (G5) of the book, `docs/validation`.
//!
//! `x'' + c x' + x = F cos W t`, `x <= g`, `x' -> -e x'`. Over the period `T = 2 pi/W` the free motion is `[a
//! b; k d]`. An orbit with one impact of the speed v in a period has, with the particular motion p and its
//! velocity p' at the impact, `X = g - p`:
//!
//! `-p' - e v = X (1 - a)/b`, `(1 + e) v = X (k - (1 - d)(1 - a)/b)`, `p^2 + (p'/W)^2 = A^2`, `A = F/|1 -
//! W^2 + i c W|`,
//!
//! a quadratic equation for X. Its multipliers have the product `e^2 exp(-c T)` and the sum `-e (a + d) + b
//! (a_+ + e a_-)/v`, with the accelerations `a_- = F cos W t - c v - g` and `a_+ = a_- + c (1 + e) v`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::{f64::consts::TAU, fs};

use crate::common::{Workshop, assert_success, stdout};
use serde_json::Value;

const STUDY: &str = include_str!("../../../studies/impact-oscillator.toml");
const DAMPING: f64 = 0.04;
const FORCE: f64 = 0.4;
const GAP: f64 = 1.0;
const RESTITUTION: f64 = 0.8;

/// Speed of impact and sum of the multipliers of both orbits with one impact in a period, and the root by
/// which they differ, which vanishes at the fold.
fn closed_form_with_root(frequency_hz: f64) -> Option<([[f64; 2]; 2], f64)> {
    let (w, period, e) = (TAU * frequency_hz, frequency_hz.recip(), RESTITUTION);
    let (half, root) = (0.5 * DAMPING, (1.0 - 0.25 * DAMPING * DAMPING).sqrt());
    let decay = (-half * period).exp();
    let (cosine, sine) = (decay * (root * period).cos(), decay * (root * period).sin() / root);
    let [a, b, k, d] = [cosine + half * sine, sine, -sine, cosine - half * sine];
    let amplitude = FORCE / (1.0 - w * w).hypot(DAMPING * w);
    let speed_over_x = (k - (1.0 - d) * (1.0 - a) / b) / (1.0 + e);
    let slope = (1.0 - a) / b + e * speed_over_x;
    // X^2 (1 + slope^2/w^2) - 2 g X + g^2 - A^2 = 0.
    let (square, constant) = (1.0 + (slope / w).powi(2), GAP * GAP - amplitude * amplitude);
    let discriminant = GAP * GAP - square * constant;
    if discriminant < 0.0 {
        return None;
    }
    // The force is `(1 - W^2) p + c p'` turned back: `F cos W t = p'' + c p' + p = (1 - W^2) p + c p'`.
    let of = |sign: f64| {
        let x = (GAP + sign * discriminant.sqrt()) / square;
        let (speed, p, rate) = (speed_over_x * x, GAP - x, -slope * x);
        let before = (1.0 - w * w) * p + DAMPING * rate - DAMPING * speed - GAP;
        let after = before + DAMPING * (1.0 + e) * speed;
        [speed, -e * (a + d) + b * (after + e * before) / speed]
    };
    Some(([of(1.0), of(-1.0)], discriminant.sqrt()))
}

fn closed_form(frequency_hz: f64) -> Option<[[f64; 2]; 2]> {
    Some(closed_form_with_root(frequency_hz)?.0)
}

fn product(frequency_hz: f64) -> f64 {
    RESTITUTION.powi(2) * (-DAMPING / frequency_hz).exp()
}

/// Where a function changes its sign.
fn zero(function: impl Fn(f64) -> f64, (mut low, mut high): (f64, f64)) -> f64 {
    let sign = function(low).signum();
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if function(middle).signum() == sign { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Grazing of the linear motion: `(1 - W^2)^2 + (c W)^2 = (F/g)^2`.
fn grazing() -> [f64; 2] {
    let (half, constant) = (1.0 - 0.5 * DAMPING * DAMPING, 1.0 - (FORCE / GAP).powi(2));
    let root = (half * half - constant).sqrt();
    [half - root, half + root].map(|square| square.sqrt() / TAU)
}

struct Row {
    frequency: f64,
    displacement: f64,
    speed: f64,
    contacts: u32,
    multiplier: [f64; 2],
    impulse: f64,
    event: String,
}

fn rows(csv: &str) -> Vec<Row> {
    let heads: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    let read = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let text = |name: &str| cells[heads.iter().position(|head| *head == name).unwrap()];
        let number = |name: &str| text(name).parse::<f64>().unwrap();
        Row {
            frequency: number("frequency_hz"),
            displacement: number("max_abs_displacement_m"),
            speed: number("max_impact_velocity_m_s"),
            contacts: text("contacts").parse().unwrap(),
            multiplier: [number("leading_multiplier_re"), number("leading_multiplier_im")],
            impulse: number("impulse_n_s"),
            event: text("event").to_owned(),
        }
    };
    csv.lines().skip(1).map(read).collect()
}

#[test]
fn the_example_is_run_to_its_closed_form_and_verified() {
    let workshop = Workshop::with(STUDY);
    assert_success(&workshop.compute(&[]));
    let rows = rows(&workshop.csv("results"));
    // What a state is off by the speed is off, more beside the fold, and no more beside the corner.
    let with_one = rows.iter().filter(|row| row.contacts == 1);
    let beside_the_corner = with_one.clone().filter(|row| row.speed < 1e-4).count();
    assert!(beside_the_corner >= 5, "{beside_the_corner}");
    for row in with_one {
        let Some((orbits, root)) = closed_form_with_root(row.frequency) else { continue };
        let off =
            orbits.map(|[speed, _]| (row.speed - speed).abs()).into_iter().fold(f64::INFINITY, f64::min);
        assert!(off * root.min(1.0) < 1e-10, "{} Hz, {} m/s: {off:e} m/s off", row.frequency, row.speed);
    }
    let mut compared = 0;
    for row in rows.iter().filter(|row| row.contacts == 1 && row.speed > 1e-3) {
        let f = row.frequency;
        let orbits = closed_form(f).into_iter().flatten();
        let nearest = orbits.min_by(|x, y| (x[0] - row.speed).abs().total_cmp(&(y[0] - row.speed).abs()));
        // Near a fold the speed goes like the root of the frequency, so stored solutions, good to 1e-12, have
        // it to 1e-6. At a fold itself there may be none by rounding.
        let Some([speed, sum]) = nearest else {
            let beside = [1.0 - 1e-9, 1.0 + 1e-9].map(|factor| closed_form(factor * f));
            assert!(row.event.contains("fold") || beside.iter().any(Option::is_some), "no orbit at {f} Hz");
            continue;
        };
        assert!((row.speed - speed).abs() < 1e-6 + 1e-9 / speed, "{f}: {} {speed}", row.speed);
        assert!((row.impulse - (1.0 + RESTITUTION) * row.speed).abs() < 1e-9);
        // `mu^2 - sum mu + product = 0`, relative to its terms.
        let [re, im] = row.multiplier;
        let residual = [re * re - im * im - sum * re + product(f), 2.0 * re * im - sum * im];
        let size = (re * re + im * im).max(product(f));
        assert!(residual[0].hypot(residual[1]) < 1e-4 * size, "{f} Hz, speed {speed}: {re} {im}");
        compared += 1;
    }
    assert!(compared > 2500, "{compared} orbits with one impact in a period");
    // Linear response below the gap, grazing where it reaches it.
    for row in rows.iter().filter(|row| row.contacts == 0) {
        let w = TAU * row.frequency;
        let amplitude = FORCE / (1.0 - w * w).hypot(DAMPING * w);
        assert!((row.displacement / amplitude - 1.0).abs() < 1e-9 && amplitude < 1.0 + 1e-9);
    }
    for expected in grazing() {
        let found = rows.iter().filter(|row| row.event.contains("grazing"));
        let nearest = found.map(|row| (row.frequency - expected).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-7, "grazing at {expected} Hz, {nearest:e} off");
    }
    // The fold is where both orbits meet, the flip where `1 + sum + product` vanishes.
    let fold = zero(|f| if closed_form(f).is_some() { 1.0 } else { -1.0 }, (0.25, 0.26));
    let of_positive_speed =
        |f: f64| closed_form(f).unwrap().into_iter().find(|orbit| orbit[0] > 0.0).unwrap();
    let flip = zero(|f| 1.0 + of_positive_speed(f)[1] + product(f), (0.14, 0.17));
    for (event, expected) in [("fold", fold), ("flip", flip)] {
        let found = rows.iter().filter(|row| row.event == event);
        let nearest = found.map(|row| (row.frequency - expected).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-10, "{event} at {expected} Hz, {nearest:e} off");
    }
    let verified = workshop.hammerbeam(&["verify", "results", "--sample", "500", "--json"]);
    assert_success(&verified);
    let verified: Value = serde_json::from_str(&stdout(&verified)).unwrap();
    assert_eq!(verified["disagreements"].as_array().map(Vec::len), Some(0), "{verified}");
}

/// The figures of an orbit with one impact: the impulse that stops unit mass at its speed and throws it back,
/// and a velocity that jumps.
#[test]
fn the_impulse_of_an_orbit_is_drawn_as_the_closed_form_has_it() {
    let workshop = Workshop::with(STUDY);
    let output =
        workshop.hammerbeam(&["orbit", "study.toml", "--frequency", "0.2", "--out", "drawn", "--json"]);
    assert_success(&output);
    let speeds = closed_form(0.2).unwrap().map(|[speed, _]| speed);
    let read = |name: &str| fs::read_to_string(workshop.path("drawn").join(name)).unwrap();
    let words = speeds.map(|speed| {
        let impulse: f64 = format!("{:.3e}", (1.0 + RESTITUTION) * speed).parse().unwrap();
        format!("impulse of the impact on a rigid stop: {impulse} N s")
    });
    let history = read("orbit-1-history.svg");
    assert!(words.iter().any(|words| history.contains(words)), "{words:?}");
    assert!(history.contains(">Impulse (N s)<") && !history.contains("Local force"));
    assert!(read("orbit-1-phase.svg").contains(">jump at an impact<"));
}

/// While a constant force holds the mass on its stop, it is at rest: what the stop presses with is part of
/// its acceleration.
#[test]
fn a_mass_that_is_held_has_no_acceleration() {
    let load = "[[load]]\nkind = \"force\"\nat = \"mass\"\namplitude_n = 0.9\norder = 0\n";
    // Bounces that lose more come to their end within the period.
    let study =
        STUDY.replacen("[0.08, 0.5]", "[0.02, 0.5]", 1).replacen("restitution = 0.8", "restitution = 0.5", 1);
    let workshop = Workshop::with(&format!("{study}\n{load}"));
    let arguments = ["simulate", "study.toml", "--frequency", "0.05", "--out", "motion"];
    let samples = ["--periods", "2", "--samples-per-period", "400", "--transient-periods", "5"];
    assert_success(&workshop.hammerbeam(&[&arguments[..], &samples].concat()));
    let table = fs::read_to_string(workshop.path("motion/samples.csv")).unwrap();
    let titles: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let column = |word: &str| titles.iter().position(|title| title.contains(word)).unwrap();
    let wanted = ["velocity", "acceleration", "force"].map(column);
    let rows = table.lines().skip(1).map(|line| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        wanted.map(|column| cells[column])
    });
    let held: Vec<[f64; 3]> = rows.filter(|[_, _, force]| *force < -0.1).collect();
    assert!(held.len() > 100, "{} samples", held.len());
    assert!(
        held.iter().all(|[velocity, acceleration, _]| velocity.abs() < 1e-12 && acceleration.abs() < 1e-12)
    );
}

/// Orbits of two periods with one impact in them: where it vanishes the linear motion is left, whose branch
/// is another one.
#[test]
fn orbits_of_two_periods_end_where_their_impact_vanishes() {
    let workshop = Workshop::exported(&format!("{STUDY}\n[response]\nperiod_multiples = [1, 2]\n"));
    let of_two = |row: &crate::common::Row| row["period_multiple"] == "2";
    let ends = workshop.table("results/export/ends.csv");
    let grazing: Vec<f64> = ends
        .iter()
        .filter(|row| of_two(row) && row["message"].contains("grazing of a branch of shorter period"))
        .map(|row| crate::common::number(row, "frequency_hz"))
        .collect();
    let [expected, _] = self::grazing();
    assert!(grazing.iter().any(|hz| (hz / expected - 1.0).abs() < 1e-6), "{grazing:?}, {expected}");
    let rows = workshop.table("results/export/branches.csv");
    let free = rows.iter().filter(|row| of_two(row) && row["contacts"] == "0");
    assert!(free.count() <= grazing.len(), "stretches of the linear motion are called of period 2");
    assert!(rows.iter().filter(|row| of_two(row)).count() > 500);
}
