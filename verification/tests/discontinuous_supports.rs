//! Beams on supports that hold them on one side only: `studies/beam-with-stop-at-middle.toml` and
//! `studies/beam-on-lifting-support.toml`.
//!
//! They are of the kinds of van de Vorst, van Campen, de Kraker and Fey (Meccanica 31, 1996, a beam with an
//! elastic stop at its middle) and van de Vorst, Assinck, de Kraker, Fey and van Campen (Experimental
//! Mechanics 36, 1996, a discontinuous support). Of their numbers none is at hand. What is held here are
//! closed forms of Euler and Bernoulli's beam, and what the later paper by van de Vorst says that the first
//! one found: that "higher eigenmodes cause extra (superharmonic) resonance peaks" beside those of one degree
//! of freedom.
#![allow(clippy::unwrap_used, reason = "a test ends where its structure is wrong")]

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, OrbitSettings, Side, SignalStatistics, find_start, read_orbit,
};
use hammerbeam_study::{Model, StudyFile, output_signals};

const MIDDLE: &str = include_str!("../../studies/beam-with-stop-at-middle.toml");
const LIFTING: &str = include_str!("../../studies/beam-on-lifting-support.toml");

const LENGTH: f64 = 1.3;
/// Bending stiffness [N m^2] and mass per length [kg/m].
const BENDING: f64 = 2.1e11 * 0.075 * 0.009 * 0.009 * 0.009 / 12.0;
const LINE_MASS: f64 = 7800.0 * 0.075 * 0.009;
/// Stiffness of the stop at the middle and of the support at the end [N/m].
const STOP: f64 = 1.6e5;
const SUPPORT: f64 = 1.0e5;

fn study(text: &str, changes: &[(&str, &str)]) -> (StudyFile, Model) {
    let text = changes.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old} is not in the study");
        text.replacen(old, new, 1)
    });
    let file = StudyFile::parse("study.toml", text).unwrap();
    let model = Model::build(&file).unwrap();
    (file, model)
}

/// Eigenfrequency [Hz] of the wave number `b/l` over a length `l`.
fn hertz(b: f64, l: f64) -> f64 {
    (b / l).powi(2) * (BENDING / LINE_MASS).sqrt() / TAU
}

/// The zero of a function between two places where it changes its sign.
fn zero(of: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(of(low) * of(high) < 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if of(low) * of(middle) <= 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// The lowest eigenfrequency [Hz] with a spring k at the shape p: `1 + k sum p_i^2/(w_i^2 - w^2) = 0` between
/// the first two modes that the spring moves.
fn lowest_with_spring(model: &Model, point: &str, stiffness: f64) -> f64 {
    let reduced = model.system.model();
    let shape = &reduced.point(point).unwrap().shape;
    let moved: Vec<(f64, f64)> = shape
        .iter()
        .zip(&reduced.natural_frequencies)
        .filter(|(p, _)| p.abs() > 1e-6)
        .map(|(p, w)| (*p, *w))
        .collect();
    let of = |w: f64| 1.0 + stiffness * moved.iter().map(|(p, own)| p * p / (own * own - w * w)).sum::<f64>();
    zero(of, moved[0].1 * (1.0 + 1e-9), moved[1].1 * (1.0 - 1e-9)) / TAU
}

/// A pinned beam has the wave numbers `n pi`. Its symmetric modes with a spring k in the middle, whose half
/// is `sin(b s) - cos b/cosh b sinh(b s)`, those of `4 E I (b/l)^3 cos b + k (sin b - cos b tanh b) = 0`, l =
/// L/2.
#[test]
fn frequencies_of_the_beam_with_its_stop_open_and_closed_are_those_of_the_continuous_beam() {
    let (_, model) = study(MIDDLE, &[]);
    for (n, w) in (1..).zip(&model.system.model().natural_frequencies[..4]) {
        // Forty cubic elements.
        assert_relative_eq!(w / TAU, hertz(f64::from(n) * PI, LENGTH), max_relative = 1e-5);
    }
    let half = 0.5 * LENGTH;
    let closed =
        |b: f64| 4.0 * BENDING * (b / half).powi(3) * b.cos() + STOP * (b.sin() - b.cos() * b.tanh());
    let exact = hertz(zero(closed, 1.6, 3.9), half);
    // Four modes with the static answer of all others.
    assert_relative_eq!(lowest_with_spring(&model, "middle", STOP), exact, max_relative = 1e-4);
}

/// The harmonic branch from one end of a range to the other.
fn walk(model: &Model, (low, high): (f64, f64)) -> Vec<BranchRow> {
    let (system, response) = (&model.system, &model.response);
    let settings = OrbitSettings::for_range((low, high));
    let start = find_start(system, response, low, 1, &settings).unwrap();
    let mut walk = BranchWalk::new(system, response, &start, Side::Up, (low, high), &settings).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    while walk.step(&mut rows).unwrap().is_none() {}
    rows
}

/// Frequencies of the maxima of the displacement over the frequency along a branch.
fn peaks(rows: &[BranchRow], size: impl Fn(&BranchRow) -> f64) -> Vec<f64> {
    let is_peak = |w: &&[BranchRow]| size(&w[0]) < size(&w[1]) && size(&w[1]) >= size(&w[2]);
    rows.windows(3).filter(is_peak).map(|w| w[1].solution.frequency_hz).collect()
}

/// One mode against the stop is a bilinear oscillator without a gap: what it does is in proportion to the
/// load, and it is in resonance at `2 f1 f2/(f1 + f2)`, which a damping D lowers by parts of D^2.
#[test]
fn one_mode_is_in_resonance_at_the_bilinear_frequency_and_higher_modes_add_peaks() {
    let force = ("unbalance_mass_kg = 0.05 ", "amplitude_n = 4.0 ");
    let plain = [force, ("eccentricity_m = 0.02\n", "")];
    let one_mode = [plain[0], plain[1], ("\"free-interface\"", "\"truncation\""), ("250.0", "30.0")];
    let (_, model) = study(MIDDLE, &one_mode);
    assert_eq!(model.system.dof(), 1);
    let [open, closed] = [model.system.model().natural_frequencies[0] / TAU, {
        let p = model.system.model().point("middle").unwrap().shape[0];
        (model.system.model().natural_frequencies[0].powi(2) + STOP * p * p).sqrt() / TAU
    }];
    let bilinear = 2.0 * open * closed / (open + closed);
    let of_one = walk(&model, (14.0, 25.0));
    let size = |row: &BranchRow| row.solution.maxima.displacement;
    let resonance = of_one.iter().max_by(|a, b| size(a).total_cmp(&size(b))).unwrap();
    assert_relative_eq!(resonance.solution.frequency_hz, bilinear, max_relative = 2e-3);
    let (_, all) = study(MIDDLE, &plain);
    let of_all = walk(&all, (14.0, 25.0));
    let acceleration = |row: &BranchRow| row.solution.maxima.acceleration;
    let [of_one, of_all] = [&of_one, &of_all].map(|rows| peaks(rows, acceleration).len());
    assert!(of_all > of_one, "{of_all} peaks with the higher modes, {of_one} without");
}

/// Static reaction of the support under the weight of the beam [N], see the study.
fn static_reaction() -> f64 {
    let weight = LINE_MASS * 9.81;
    SUPPORT * weight * LENGTH.powi(4) / (8.0 * BENDING) / (1.0 + SUPPORT * LENGTH.powi(3) / (3.0 * BENDING))
}

/// What the support feels at a frequency.
fn reaction(file: &StudyFile, model: &Model, frequency_hz: f64) -> SignalStatistics {
    let settings = OrbitSettings::default();
    let orbit = find_start(&model.system, &model.response, frequency_hz, 1, &settings).unwrap();
    let mut integrator = ExactIntegrator::new(model.system.clone(), ExactSettings::default()).unwrap();
    let signals = output_signals(model, &file.study.outputs, &model.system).unwrap();
    read_orbit(&mut integrator, &orbit, &signals, 3).unwrap().remove(0)
}

/// Amplitude of the reaction while the end stays down, `k |y|` of the modes on a spring:
/// `(w_i^2 - W^2 + 2 D w_i W i) q_i = f p_i - k s_i sum_j s_j q_j`, so `y = f a/(1 + k b)` with the
/// receptances `a = sum s_i p_i/d_i` and `b = sum s_i^2/d_i`.
fn amplitude_while_down(model: &Model, frequency_hz: f64) -> f64 {
    let (reduced, w) = (model.system.model(), TAU * frequency_hz);
    let (end, shaken) = (&reduced.point("end").unwrap().shape, &reduced.point("shaker").unwrap().shape);
    let (mut a, mut b) = ([0.0; 2], [1.0, 0.0]);
    for (i, own) in reduced.natural_frequencies.iter().enumerate() {
        let (re, im) = (own * own - w * w, 2.0 * 0.02 * own * w);
        let square = re * re + im * im;
        for (part, value) in [re / square, -im / square].into_iter().enumerate() {
            a[part] += end[i] * shaken[i] * value;
            b[part] += SUPPORT * end[i] * end[i] * value;
        }
    }
    SUPPORT * 6.0 * a[0].hypot(a[1]) / b[0].hypot(b[1])
}

#[test]
fn the_end_rests_with_its_static_reaction_and_lifts_off_where_the_dynamic_one_reaches_it() {
    let (file, model) = study(LIFTING, &[]);
    let rest = static_reaction();
    let down = reaction(&file, &model, 8.0);
    let swing = amplitude_while_down(&model, 8.0);
    // The weight bends all modes, of which the reduction keeps four and the static answer at the end.
    assert_relative_eq!(down.mean, rest, max_relative = 1e-3);
    assert_relative_eq!(down.harmonics[0][0].hypot(down.harmonics[0][1]), swing, max_relative = 1e-8);
    assert_relative_eq!(down.minimum, down.mean - swing, max_relative = 1e-8);
    let amplitude = |f: &f64| amplitude_while_down(&model, *f);
    let frequencies = (0..2200).map(|k| 8.0 + 0.01 * f64::from(k));
    let resonance = frequencies.max_by(|f, g| amplitude(f).total_cmp(&amplitude(g))).unwrap();
    let lift = zero(|f| amplitude(&f) - down.mean, 8.0, resonance);
    let rows = walk(&model, (8.0, 30.0));
    let grazing = rows.iter().find(|row| row.events.grazing).unwrap();
    assert_relative_eq!(grazing.solution.frequency_hz, lift, max_relative = 1e-7);
    let beyond = reaction(&file, &model, 1.005 * lift);
    assert!(beyond.minimum.abs() < 1e-10 && beyond.maximum > 2.0 * down.mean, "{beyond:?}");
}
