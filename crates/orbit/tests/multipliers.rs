//! Floquet multipliers: unchanged by the number of segments and by the tolerances, and equal to what other
//! means give.
#![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

use std::{f64::consts::TAU, sync::OnceLock};

use crate::common::{beam, chain, recomputed, walk_both, with_segments};
use faer::Mat;
use hammerbeam_motion::{
    Stretch, System,
    general::{GeneralSettings, advance},
};
use hammerbeam_orbit::{OrbitSettings, PeriodicSolution, Response, Segments, find_start, recompute};

/// What two computations of a multiplier may differ by, relative to the largest (or to 1 if that is smaller).
const BOUND: f64 = 1e-8;
/// Multipliers closer than this are compared by their sum and product: each alone is known to the square root
/// only.
const NEARLY_DOUBLE: f64 = 1e-4;

/// The same closer than [`BESIDE`] to a fold or a grazing point: multipliers change there by up to 1e7 per
/// relative change of the orbit, and rounding leaves 1e-13 of it open.
const BOUND_BESIDE: f64 = 5e-6;
/// Distance from a fold or a grazing point [Hz].
const BESIDE: f64 = 2e-4;
/// What rounding leaves open of the frequency of an orbit, relative to it.
///
/// Where a Hertz contact all but opens, multipliers change so fast that they are known to no more than this
/// share of the change: 2e5 per relative change of the frequency at 19.474527 Hz, a corner without an event.
const OPEN: f64 = 3e-13;

type Multiplier = [f64; 2];

fn subject() -> &'static (System, Response) {
    static BEAM: OnceLock<(System, Response)> = OnceLock::new();
    BEAM.get_or_init(beam)
}

/// An orbit of the harmonic branch, and whether a fold or a grazing point lies within [`BESIDE`].
struct Subject {
    orbit: PeriodicSolution,
    beside: bool,
    /// What two computations of its multipliers may differ by.
    bound: f64,
}

/// How much the largest multiplier changes from one orbit to the other, relative to it and to the change of
/// the frequency.
fn rate(one: &PeriodicSolution, other: &PeriodicSolution) -> f64 {
    let change = (largest(one) - largest(other)).abs() / largest(one).max(1.0);
    change * one.frequency_hz / (one.frequency_hz - other.frequency_hz).abs()
}

/// Orbits along the harmonic branch: some forty spread evenly over its rows, the most unstable ones below 25
/// Hz, and all folds and grazing points with the rows beside them.
fn subjects() -> &'static [Subject] {
    static SUBJECTS: OnceLock<Vec<Subject>> = OnceLock::new();
    SUBJECTS.get_or_init(|| {
        let settings = OrbitSettings { max_step: 0.05, ..OrbitSettings::default() };
        let (rows, _) = walk_both(subject(), 30.0, (19.0, 110.0), &settings);
        let inner = 1..rows.len() - 1;
        let special = |k: usize| rows[k].events.fold || rows[k].events.grazing;
        let mut chosen: Vec<usize> = inner.clone().step_by(rows.len() / 40).collect();
        chosen.extend(inner.clone().filter(|&k| special(k - 1) || special(k) || special(k + 1)));
        let mut unstable: Vec<usize> = inner.collect();
        unstable.sort_by(|&a, &b| largest(&rows[b].solution).total_cmp(&largest(&rows[a].solution)));
        chosen.extend(unstable.into_iter().step_by(20).take(12));
        let near = |k: usize, j: usize| {
            (rows[k].solution.frequency_hz - rows[j].solution.frequency_hz).abs() < BESIDE
        };
        let beside = |k: usize| (0..rows.len()).any(|j| special(j) && near(k, j));
        let subject = |k: usize| {
            let [before, orbit, after] = [k - 1, k, k + 1].map(|k| &rows[k].solution);
            let rate = rate(orbit, before).max(rate(orbit, after));
            let bound = if beside(k) { BOUND_BESIDE } else { BOUND.max(OPEN * rate) };
            Subject { orbit: orbit.clone(), beside: beside(k), bound }
        };
        chosen.into_iter().map(subject).collect()
    })
}

fn orbits() -> impl Iterator<Item = &'static PeriodicSolution> {
    subjects().iter().map(|subject| &subject.orbit)
}

fn largest(orbit: &PeriodicSolution) -> f64 {
    modulus(orbit.floquet_multipliers[0])
}

fn modulus([re, im]: Multiplier) -> f64 {
    re.hypot(im)
}

fn times([a, b]: Multiplier, [c, d]: Multiplier) -> Multiplier {
    [a * c - b * d, a * d + b * c]
}

fn plus([a, b]: Multiplier, [c, d]: Multiplier) -> Multiplier {
    [a + c, b + d]
}

fn separation([a, b]: Multiplier, [c, d]: Multiplier) -> f64 {
    (a - c).hypot(b - d)
}

/// The largest difference of two sets of multipliers relative to `max(1, |mu_1|)`; nearly double ones by sum
/// and product.
fn difference(found: &[Multiplier], expected: &[Multiplier]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let mut rest = found.to_vec();
    let partner = |value: &Multiplier| {
        let nearest = (0..rest.len())
            .min_by(|&i, &j| separation(rest[i], *value).total_cmp(&separation(rest[j], *value)))
            .unwrap();
        (*value, rest.swap_remove(nearest))
    };
    let mut pairs: Vec<(Multiplier, Multiplier)> = expected.iter().map(partner).collect();
    let mut worst = 0.0_f64;
    while let Some(first) = pairs.pop() {
        let (mut cluster, mut others) = (vec![first], Vec::new());
        for pair in pairs {
            let near = cluster.iter().any(|member| separation(member.0, pair.0) < NEARLY_DOUBLE);
            if near { cluster.push(pair) } else { others.push(pair) }
        }
        pairs = others;
        let fold = |join: fn(Multiplier, Multiplier) -> Multiplier, start: Multiplier| {
            let join_both = |(a, b), &(c, d): &(Multiplier, Multiplier)| (join(a, c), join(b, d));
            let (a, b) = cluster.iter().fold((start, start), join_both);
            separation(a, b)
        };
        worst = worst.max(fold(plus, [0.0, 0.0])).max(fold(times, [1.0, 0.0]));
    }
    worst / expected.iter().map(|value| modulus(*value)).fold(1.0, f64::max)
}

/// The same point of the branch with other settings has the same multipliers, to this bound; returns the
/// difference.
fn assert_unchanged(orbit: &PeriodicSolution, bound: f64, settings: &OrbitSettings, what: &str) -> f64 {
    let (system, response) = subject();
    let reference = recompute(system, response, orbit, &with_segments(1)).unwrap();
    let other = recompute(system, response, orbit, settings).unwrap();
    if let Segments::Fixed(count) = settings.segments {
        assert_eq!(other.nodes.len(), count);
    }
    let error = difference(&other.floquet_multipliers, &reference.floquet_multipliers);
    assert!(
        error <= bound,
        "{what}: {error:.1e} at {} Hz, |mu_1| = {}",
        orbit.frequency_hz,
        largest(&reference)
    );
    error
}

fn assert_all_unchanged(settings: &OrbitSettings, what: &str) {
    let mut above = 0;
    for Subject { orbit, bound, .. } in subjects() {
        above += usize::from(assert_unchanged(orbit, *bound, settings, what) > BOUND);
    }
    let beside = subjects().iter().filter(|subject| subject.beside).count();
    let raised = subjects().iter().filter(|subject| !subject.beside && subject.bound > BOUND).count();
    assert!(raised <= 3, "{raised} orbits change too fast away from folds and grazing points");
    // Even there most keep the general bound.
    assert!(beside >= 38 && 2 * above < beside, "{what}: {above} of {beside} above the bound");
}

#[test]
fn orbits_are_stable_and_strongly_unstable() {
    assert!(orbits().any(PeriodicSolution::stable));
    assert!(orbits().filter(|orbit| largest(orbit) > 300.0).count() >= 5);
    assert!(orbits().any(|orbit| orbit.maxima.contacts == 3));
}

#[test]
fn multipliers_of_four_segments_are_those_of_one() {
    assert_all_unchanged(&with_segments(4), "4 segments");
}

#[test]
fn multipliers_of_sixteen_segments_are_those_of_one() {
    assert_all_unchanged(&with_segments(16), "16 segments");
}

#[test]
fn multipliers_do_not_change_when_every_tolerance_is_halved() {
    let OrbitSettings { tolerance, motion_tolerance, .. } = OrbitSettings::default();
    let halved = OrbitSettings {
        tolerance: 0.5 * tolerance,
        motion_tolerance: 0.5 * motion_tolerance,
        ..with_segments(1)
    };
    assert_all_unchanged(&halved, "halved tolerances");
}

/// Near 53 Hz the orbit of two excitation periods has nine contacts and more.
#[test]
fn multipliers_of_an_orbit_of_many_contacts_do_not_depend_on_the_segments() {
    let (system, response) = subject();
    let orbit = find_start(system, response, 53.0, 2, &OrbitSettings::default()).unwrap();
    assert!(orbit.maxima.contacts >= 9, "{} contacts", orbit.maxima.contacts);
    for segments in [4, 16] {
        assert_unchanged(&orbit, BOUND, &with_segments(segments), &format!("{segments} segments"));
    }
}

/// Multipliers of the variational equations of the general integrator, by the eigenvalues of the linear
/// algebra library.
fn general_multipliers(system: &System, orbit: &PeriodicSolution) -> Vec<Multiplier> {
    let n = system.dof();
    let stretch =
        Stretch { frequency_hz: orbit.frequency_hz, start: 0.0, end: f64::from(orbit.period_multiple) };
    let flow =
        advance(system, &stretch, &orbit.nodes[0], &GeneralSettings::with_tolerance(1e-13)).unwrap().flow;
    let frequencies = &system.model().natural_frequencies;
    let scale = |i: usize| if i < n { frequencies[i] } else { 1.0 };
    let scaled = Mat::from_fn(2 * n, 2 * n, |i, j| flow.by_state[(i, j)] * scale(i) / scale(j));
    scaled.eigenvalues().unwrap().iter().map(|value| [value.re, value.im]).collect()
}

/// The general integrator bounds each step by 1e-13 of the largest entry: over the few hundred steps of a
/// period its monodromy is good to 1e-10 or so of that.
#[test]
fn multipliers_are_those_of_the_general_integrator() {
    for orbit in subjects().iter().filter(|subject| !subject.beside).map(|subject| &subject.orbit).step_by(4)
    {
        let error = difference(&orbit.floquet_multipliers, &general_multipliers(&subject().0, orbit));
        assert!(error <= BOUND, "{error:.1e} at {} Hz, |mu_1| = {}", orbit.frequency_hz, largest(orbit));
    }
}

/// Liouville: `det M = exp(-T tr C)`, as the stop has no damping. The smallest multipliers are 1e-13 of a
/// matrix of entries up to 1e3.
#[test]
fn product_of_the_multipliers_is_exp_of_minus_t_times_the_trace_of_the_damping() {
    let damping = &subject().0.model().damping;
    let trace: f64 = (0..6).map(|i| damping[(i, i)]).sum();
    for orbit in orbits() {
        let logarithm: f64 = orbit.floquet_multipliers.iter().map(|value| modulus(*value).ln()).sum();
        let error = (logarithm + trace / orbit.frequency_hz).abs();
        assert!(error < 1e-7, "{error:.1e} at {} Hz", orbit.frequency_hz);
    }
}

#[test]
fn multipliers_of_a_linear_system_are_exp_of_its_eigenvalues_times_the_period() {
    assert_exponentials(&chain(false));
}

#[test]
fn multipliers_beside_a_stop_out_of_reach_are_those_of_the_linear_system() {
    assert_exponentials(&chain(true));
}

/// `q'' + C q' + diag(w^2) q = b`: multipliers are `exp(lambda T)` with the eigenvalues of `[0 W; -W -C]`,
/// `W = diag(w)`, displacements scaled with `W`.
fn assert_exponentials((system, response): &(System, Response)) {
    let (model, n) = (system.model(), system.dof());
    let w = &model.natural_frequencies;
    let first_order = Mat::from_fn(2 * n, 2 * n, |i, j| match (i < n, j < n) {
        (true, false) if j - n == i => w[i],
        (false, true) if i - n == j => -w[j],
        (false, false) => -model.damping[(i - n, j - n)],
        _ => 0.0,
    });
    let eigenvalues = first_order.eigenvalues().unwrap();
    assert!(
        (0..n).any(|i| (0..i).any(|j| model.damping[(i, j)].abs() > 0.05)),
        "the dampers couple the modes"
    );
    for frequency_hz in [1.0, 4.5, 20.0] {
        for period_multiple in [1, 3] {
            let period = f64::from(period_multiple) / frequency_hz;
            let expected: Vec<Multiplier> = eigenvalues
                .iter()
                .map(|lambda| {
                    let (radius, angle) = ((lambda.re * period).exp(), lambda.im * period);
                    [radius * angle.cos(), radius * angle.sin()]
                })
                .collect();
            for segments in [1, 4, 16] {
                let orbit = find_start(system, response, frequency_hz, 1, &with_segments(segments)).unwrap();
                let over_one = PeriodicSolution { period_multiple, ..orbit };
                let found = recomputed(system, response, &over_one, &with_segments(segments));
                let error = difference(&found.floquet_multipliers, &expected);
                // Sine and cosine of angles up to 130, and the eigenvalues of both matrices.
                assert!(
                    error < 1e-12,
                    "{error:.1e} at {frequency_hz} Hz, {period_multiple} periods, {segments} segments"
                );
            }
        }
    }
    assert!(eigenvalues.iter().all(|lambda| lambda.im.abs() < 20.0 * TAU));
}
