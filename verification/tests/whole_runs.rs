//! Two Duffing oscillators through the whole run: an isola, and a pair of asymmetric orbits that is one
//! branch.
//!
//! `x'' + c x' + x + x^3 = F cos(2 pi f t)`.
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use crate::common::extensive;
use hammerbeam_orbit::{BranchEventKind, OrbitSettings};
use hammerbeam_verification::{
    attractors::{Random, SimulationEffort, Simulator, attractors, distance},
    random_study::random_study,
    results::Results,
};

fn study(damper: f64, force: f64, range: [f64; 2], more: &str) -> String {
    format!(
        r#"
        [structure]
        kind = "lumped"
        mass = [{{ name = "mass", mass_kg = 1.0 }}]
        spring = [{{ between = ["mass", "ground"], stiffness_n_m = 1.0 }}]
        damper = [{{ between = ["mass", "ground"], damping_n_s_m = {damper} }}]

        [excitation]
        kind = "force"
        at = "mass"
        amplitude_n = {force}
        frequency_hz = [{}, {}]

        [[stop]]
        at = "mass"
        law = "cubic"
        stiffness_n_m3 = 1.0

        {more}
        "#,
        range[0], range[1]
    )
}

fn run(text: &str) -> Results {
    Results::of_run(text, tempfile::tempdir().unwrap().path(), 2).unwrap()
}

fn frequencies(results: &Results, branch: usize, event: BranchEventKind) -> Vec<f64> {
    let rows = results.branches()[branch].rows.iter().filter(|placed| placed.row.events.has(event));
    let mut found: Vec<f64> = rows.map(|placed| placed.row.frequency_hz).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// The 1/3 subharmonic orbits of `c = 0.06`, `F = 3` are joined to no other branch.
fn isola() -> Results {
    let more =
        "[response]\nperiod_multiples = [3]\n[search]\nfrequencies = 6\n[continuation]\nmax_step_hz = 0.002";
    run(&study(0.06, 3.0, [0.4, 1.3], more))
}

#[test]
fn an_isola_is_found_closed_and_only_once() {
    let results = isola();
    assert_eq!(results.branches().len(), 1);
    let record = &results.branches()[0].record;
    for walk in [&record.up, &record.down] {
        assert!(walk.end.as_ref().unwrap().is_closed(), "{:?}", walk.end);
    }
    let folds = frequencies(&results, 0, BranchEventKind::Fold);
    assert_eq!(folds.len(), 2, "a loop turns twice: {folds:?}");
    let mut random = Random::new(3);
    for _ in 0..30 {
        let at = 0.4 + 0.9 * random.part();
        let orbits = results.crossings(at, 3).unwrap();
        let inside = (folds[0]..folds[1]).contains(&at);
        assert_eq!(orbits.len(), if inside { 2 } else { 0 }, "{at} Hz");
        let stable = orbits.iter().filter(|(_, orbit)| orbit.stable()).count();
        assert_eq!(stable, orbits.len() / 2, "{at} Hz");
    }
}

/// Motion from random states settles to a period of three within the loop, and never outside.
#[test]
fn simulation_finds_period_three_within_the_isola_only() {
    let results = isola();
    let folds = frequencies(&results, 0, BranchEventKind::Fold);
    let mut random = Random::new(5);
    let effort = SimulationEffort { states: 40, longest: 3, patience: 600 };
    for share in [-0.05, 0.15, 0.5, 1.05] {
        let at = folds[0] + share * (folds[1] - folds[0]);
        let system = &results.model.system;
        let mut simulator = Simulator::exact(system, at).unwrap();
        let (found, _) = attractors(system, &mut simulator, at, 6.0, &effort, &mut random).unwrap();
        let subharmonic: Vec<_> = found.iter().filter(|attractor| attractor.period() == 3).collect();
        assert_eq!(subharmonic.len(), usize::from((0.0..1.0).contains(&share)), "{at} Hz");
        for attractor in subharmonic {
            let orbits = results.crossings(at, 3).unwrap();
            let stable = &orbits.iter().find(|(_, orbit)| orbit.stable()).unwrap().1;
            let off = attractor.states.iter().map(|state| distance(system, state, &stable.nodes[0]));
            assert!(off.fold(f64::INFINITY, f64::min) < 1e-6, "{at} Hz");
        }
    }
}

/// The pair leaves the symmetric orbits at one branch point and meets them at the other, `c = 0.2`, `F = 15`:
/// both arms and both ends are one branch.
#[test]
fn a_pair_of_mirror_images_is_one_closed_branch_met_from_either_end() {
    let more = "[response]\nperiod_multiples = [1]\n[continuation]\nmax_step_hz = 0.0005\n";
    // Where orbits are looked for has nothing to do with what the branches are.
    let search = if extensive() { "" } else { "[search]\nfrequencies = 8\ntrials = 0" };
    is_one_closed_branch(&run(&study(0.2, 15.0, [0.095, 0.16], &format!("{more}{search}"))));
}

/// The branch points of the symmetric orbits lead there, without any search.
#[test]
fn a_pair_of_mirror_images_is_followed_from_the_branch_point_it_leaves() {
    let more = "[response]\nperiod_multiples = [1]\n[continuation]\nmax_step_hz = 0.0005\n";
    is_one_closed_branch(&run(&study(0.2, 15.0, [0.095, 0.16], &format!("{more}[search]\nfrequencies = 0"))));
}

/// Of the symmetric orbits and the pair that leaves them.
fn is_one_closed_branch(results: &Results) {
    let closed: Vec<usize> = (0..results.branches().len())
        .filter(|&k| results.branches()[k].record.up.end.as_ref().unwrap().is_closed())
        .collect();
    let holding = |k: usize| frequencies(results, k, BranchEventKind::BranchPoint);
    let [pair] = closed[..] else { panic!("{closed:?}") };
    // A branch that starts at one of them has it at its start and, once round, at its end.
    let mut ends = holding(pair);
    ends.dedup_by(|a, b| (*a / *b - 1.0).abs() < 1e-9);
    assert_eq!(ends.len(), 2, "{ends:?}");
    let symmetric: Vec<usize> = (0..results.branches().len()).filter(|&k| k != pair).collect();
    let met: Vec<f64> = symmetric.iter().flat_map(|&k| holding(k)).collect();
    for end in &ends {
        let nearest = met.iter().map(|at| (at / end - 1.0).abs()).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-8, "{end} Hz is {nearest:.1e} off");
    }
    // Inside the interval the pair are two orbits, each the image of the other.
    let at = 0.5 * (ends[0] + ends[1]);
    let number = results.branches()[pair].record.id;
    let crossing = results.crossings(at, 1).unwrap();
    let orbits: Vec<_> = crossing.into_iter().filter(|(branch, _)| *branch == number).collect();
    assert_eq!(orbits.len(), 2);
    let mut exact = hammerbeam_motion::exact::ExactIntegrator::new(
        results.model.system.clone(),
        hammerbeam_motion::exact::ExactSettings { tolerance: OrbitSettings::default().motion_tolerance },
    )
    .unwrap();
    let half = hammerbeam_motion::Stretch { frequency_hz: at, start: 0.0, end: 0.5 };
    let turned: Vec<f64> = exact.advance(&half, &orbits[0].1.nodes[0]).unwrap().iter().map(|z| -z).collect();
    let off = distance(&results.model.system, &turned, &orbits[1].1.nodes[0]);
    assert!(off < 1e-7, "{off:.1e}");
}

/// A flip 2.5e-10 Hz beside a grazing, with a law for which orbits are not cut into segments. The branch of
/// two periods comes to within 7e-8 of the orbit that flips: it went on as that one, and its flip began the
/// same branch once more.
#[test]
fn a_branch_of_two_periods_ends_at_a_flip_beside_a_grazing_and_is_found_once() {
    let results = run(&random_study(20_091));
    let doubled: Vec<_> =
        results.branches().iter().filter(|branch| branch.record.period_multiple == 2).collect();
    assert_eq!(doubled.len(), 1);
    let end = doubled[0].record.up.end.as_ref().unwrap();
    assert!(end.to_string().contains("met the flip of a branch of shorter period at 0.171659"), "{end}");
}

/// A branch of doubled period begins where the orbits that it leaves are cut in two, so with four segments.
/// An impact that comes to lie over the end of one of them is no end of the branch.
#[test]
fn a_branch_of_doubled_period_passes_impacts_at_the_ends_of_its_segments() {
    let text = r#"
        [structure]
        kind = "lumped"
        mass = [
            { name = "1", mass_kg = 0.06621056984518939 },
            { name = "2", mass_kg = 0.05242480950624889 },
        ]
        damper = [
            { between = ["1", "ground"], damping_n_s_m = 0.00021644257024897384 },
            { between = ["2", "ground"], damping_n_s_m = 0.00024272238344359012 },
        ]
        spring = [
            { between = ["1", "ground"], stiffness_n_m = 0.00037771427618638417 },
            { between = ["2", "ground"], stiffness_n_m = 0.00041069526099431203 },
            { between = ["1", "2"], stiffness_n_m = 0.000584598225287383 },
        ]

        [excitation]
        kind = "force"
        at = "1"
        amplitude_n = 0.0000006882796092932982
        frequency_hz = [0.01627758455478702, 0.021974739148962474]
        phase_rad = 2.3493199784685475

        [[stop]]
        between = ["2", "1"]
        law = "rigid"
        gap_m = 0.0
        restitution = 0.9246058642203513
        side = "above"

        [response]
        period_multiples = [1, 2]

        [search]
        frequencies = 2
        starts = 2
        trials = 2

        [continuation]
        max_step_hz = 0.000056971545941754566
        "#;
    let results = run(text);
    let low = results.range_hz[0];
    let reaches = |multiple: u32| {
        let branches = results.branches().iter().filter(|branch| branch.record.period_multiple == multiple);
        branches.flat_map(|branch| &branch.rows).any(|placed| placed.row.frequency_hz == low)
    };
    assert!(reaches(1) && reaches(2));
    for branch in results.branches() {
        for walk in [&branch.record.up, &branch.record.down] {
            assert!(walk.end.as_ref().unwrap().is_complete(), "{:?}", walk.end);
        }
    }
}
