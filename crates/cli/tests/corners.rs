//! Corners at rigid stops: branches go on across them, so that none ends there and none is computed
//! twice; and they lie where the linear response reaches the gap.
use std::f64::consts::TAU;

use hammerbeam_jobs::{StoredBranch, StoredBranches};
use hammerbeam_orbit::{BranchEventKind, StopReason};
use hammerbeam_results::end::BranchEnd;
use hammerbeam_study::Model;

use crate::common::{Workshop, extensive, number, stdout, stored};

/// Two masses in a row with 2 % of damping, one stop: coming down, a walk on states alone lost its way at the
/// corner at 0.04695 Hz, and another branch held the same orbits.
const LOST_WAY: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m0", mass_kg = 1.9218 }, { name = "m1", mass_kg = 1.0922 }]
spring = [
    { between = ["m0", "ground"], stiffness_n_m = 0.669 },
    { between = ["m1", "m0"], stiffness_n_m = 3.3745 },
]
damper = [
    { between = ["m0", "ground"], damping_n_s_m = 0.02268 },
    { between = ["m1", "m0"], damping_n_s_m = 0.11439 },
]
[excitation]
kind = "force"
at = "m0"
amplitude_n = 1.0
frequency_hz = [0.0376, 0.2348]
[[stop]]
name = "s0"
at = "m0"
law = "rigid"
restitution = 0.45
gap_m = 2.47515
side = "below"
"#;

/// A mass between two stops at the same distance: its symmetric orbits graze both at once.
const BETWEEN_STOPS: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 1.0 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["m", "ground"], damping_n_s_m = 0.1 }]
[excitation]
kind = "force"
at = "m"
amplitude_n = 0.4
frequency_hz = [0.08, 0.4]
[[stop]]
name = "above"
at = "m"
law = "rigid"
restitution = 0.7
gap_m = 1.0
side = "above"
[[stop]]
name = "below"
at = "m"
law = "rigid"
restitution = 0.7
gap_m = 1.0
side = "below"
"#;

/// A mass between two stops with 1.2 % of damping: both impacts behind the grazing of its symmetric orbit
/// multiply what is between two motions, by `1/v` each. A first point as near as behind one impact was lost.
const LIGHTLY_BETWEEN_STOPS: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 0.45 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 130.0 }]
[damping]
modal_ratio = 0.012
[excitation]
kind = "force"
at = "m"
amplitude_n = 0.9
frequency_hz = [4.2, 5.5]
[[stop]]
name = "walls"
at = "m"
law = "rigid"
restitution = 0.65
side = "both"
gap_m = 4.0e-3
"#;

/// Two masses with 1 % of damping. A branch of period 3 passes a corner onto itself some periods later, and
/// was stored three times; one of period 2 went on as the harmonic orbit that it meets where that grazes.
/// Up to three walks end in chatter, of some 28 impacts: how far they come into it hangs by rounding, and so
/// whether another walk comes upon that end.
const CHATTERING: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }, { name = "b", mass_kg = 0.7 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 700.0 },
    { between = ["a", "b"], stiffness_n_m = 450.0 },
]
[damping]
modal_ratio = 0.01
[excitation]
kind = "force"
at = "a"
amplitude_n = 2.0
frequency_hz = [1.8, 7.0]
[[stop]]
name = "stop"
at = "b"
law = "rigid"
restitution = 0.7
gap_m = 0.004
side = "above"
[search]
frequencies = 8
starts = 4
trials = 6
[continuation]
max_step_hz = 0.005
[response]
period_multiples = [1, 2, 3]
"#;

const IMPACT_OSCILLATOR: &str = include_str!("../../../studies/impact-oscillator.toml");

/// The study with a short search and steps up to that length; as it is with `HAMMERBEAM_EXTENSIVE=1`.
fn quick(study: &str, longest_step: f64) -> String {
    if extensive() {
        return study.to_owned();
    }
    let search = "[search]\nfrequencies = 6\nstarts = 3\ntrials = 3\n";
    format!("{study}{search}[continuation]\nmax_step_hz = {longest_step}\n")
}

/// Numbers from 0 to 1 without a pattern: multiples of the golden ratio.
fn shares(count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(|k| (f64::from(k) * 0.618_033_988_749_894_9).fract())
}

/// How a branch ends that is whole.
pub(crate) const WHOLE: &[&str] = &["range-end", "closed", "crossing", "shorter-period"];

/// Both sides of all branches end as they may, and no orbit is stored twice: at a dozen frequencies, at sixty
/// with `HAMMERBEAM_EXTENSIVE=1`.
pub(crate) fn assert_whole(workshop: &Workshop, range_hz: (f64, f64), ends: &[&str]) {
    for end in workshop.table("results/export/ends.csv") {
        let ends_well = ends.contains(&end["end"].as_str());
        assert!(ends_well, "{end:?}");
    }
    let (model, branches) = stored(workshop);
    let (looks, crossings) = if extensive() { (60, 12) } else { (12, 4) };
    for share in shares(looks) {
        let frequency_hz = range_hz.0 + share * (range_hz.1 - range_hz.0);
        let twice = branches.held_twice(&model, frequency_hz).unwrap();
        assert!(twice.is_empty(), "at {frequency_hz} Hz branches {twice:?} hold the same orbit");
    }
    for share in shares(crossings) {
        assert_crossed(&model, &branches, range_hz.0 + share * (range_hz.1 - range_hz.0));
    }
}

/// Each pair of rows between which a branch crosses a frequency has an orbit there.
fn assert_crossed(model: &Model, branches: &StoredBranches, frequency_hz: f64) {
    let orbits = branches.crossings(model, frequency_hz, |_| true).unwrap();
    for branch in branches.branches() {
        let below =
            branch.rows.windows(2).map(|pair| [0, 1].map(|k| pair[k].row.frequency_hz < frequency_hz));
        let pairs = below.filter(|[one, other]| one != other).count();
        let found = orbits.iter().filter(|(id, _)| *id == branch.record.id).count();
        // An image counts to the branch that it is one of.
        let fits = if model.system.is_symmetric() { found >= pairs } else { found == pairs };
        assert!(fits, "branch {} at {frequency_hz} Hz: {found} of {pairs}", branch.record.id);
    }
}

/// How both sides of all branches end, with the number of the branch.
pub(crate) fn ends(branches: &StoredBranches) -> Vec<(u32, BranchEnd)> {
    let sides = |branch: &StoredBranch| [branch.record.up.end.clone(), branch.record.down.end.clone()];
    let branches = branches.branches().iter();
    branches
        .flat_map(|branch| sides(branch).into_iter().flatten().map(|end| (branch.record.id, end)))
        .collect()
}

/// Frequencies of the grazings on all branches.
pub(crate) fn grazings(workshop: &Workshop) -> Vec<f64> {
    let (_, branches) = stored(workshop);
    let rows = branches.branches().iter().flat_map(|branch| &branch.rows).map(|placed| &placed.row);
    rows.filter(|row| row.events.has(BranchEventKind::Grazing)).map(|row| row.frequency_hz).collect()
}

#[test]
fn a_branch_goes_on_across_corners_and_no_other_one_holds_its_orbits() {
    assert_whole(&Workshop::exported(&quick(LOST_WAY, 2e-4)), (0.0376, 0.2348), WHOLE);
}

#[test]
fn a_symmetric_orbit_goes_on_where_it_grazes_both_stops() {
    assert_whole(&Workshop::exported(&quick(BETWEEN_STOPS, 5e-4)), (0.08, 0.4), WHOLE);
}

#[test]
fn a_lightly_damped_symmetric_orbit_goes_on_where_it_grazes_both_stops() {
    let workshop = Workshop::exported(&quick(LIGHTLY_BETWEEN_STOPS, 2e-3));
    assert_whole(&workshop, (4.2, 5.5), WHOLE);
    let off = grazings(&workshop).into_iter().map(|hz| from_gap([0.45, 130.0, 0.012, 0.9, 4.0e-3], hz));
    let off: Vec<f64> = off.collect();
    assert!(off.len() == 1 && off[0].abs() < 1e-8, "{off:?}");
}

/// One mass between two rigid stops, with that damping ratio.
fn between_stops(ratio: f64, range_hz: [f64; 2]) -> String {
    one_mass([0.3, 120.0, ratio, 0.5], range_hz, "restitution = 0.88\nside = \"both\"\ngap_m = 0.009")
}

/// Its orbits of three periods, lightly damped.
fn between_stops_in_three_periods(range_hz: [f64; 2], longest_step: f64) -> Workshop {
    let study = between_stops(0.012, range_hz);
    Workshop::exported(&format!(
        "{study}[response]\nperiod_multiples = [3]\n[continuation]\nmax_step_hz = {longest_step}\n"
    ))
}

/// How far the linear response of `k - m W^2 + i c W` is from the gap, relative to it.
///
/// * `[mass, stiffness, ratio, force, gap]`: in SI units, of the damping the ratio.
fn from_gap([mass, stiffness, ratio, force, gap]: [f64; 5], frequency_hz: f64) -> f64 {
    let w = TAU * frequency_hz;
    let dynamic = (stiffness - mass * w * w).hypot(2.0 * ratio * (stiffness * mass).sqrt() * w);
    force / dynamic / gap - 1.0
}

/// A mass on a spring with a rigid stop.
///
/// * `[mass, stiffness, ratio, force]`: in SI units, of the damping the ratio.
pub(crate) fn one_mass(
    [mass, stiffness, ratio, force]: [f64; 4],
    [low, high]: [f64; 2],
    stop: &str,
) -> String {
    format!(
        "[structure]\nkind = \"lumped\"\nmass = [{{ name = \"m\", mass_kg = {mass} }}]\n\
         spring = [{{ between = [\"m\", \"ground\"], stiffness_n_m = {stiffness} }}]\n\
         [damping]\nmodal_ratio = {ratio}\n[excitation]\nkind = \"force\"\nat = \"m\"\n\
         amplitude_n = {force}\nfrequency_hz = [{low}, {high}]\n[[stop]]\nname = \"s\"\nat = \"m\"\n\
         law = \"rigid\"\n{stop}\n"
    )
}

/// Behind that corner both impacts lie near the ends of the two segments, and a disturbance grows by 1e10 in
/// a period: over one segment the orbit is lost.
#[test]
fn a_symmetric_orbit_goes_on_whose_impacts_come_near_the_ends_of_its_halves() {
    for ratio in [0.012, 0.02] {
        let workshop = Workshop::exported(&quick(&between_stops(ratio, [3.7, 4.0]), 5e-4));
        assert_whole(&workshop, (3.7, 4.0), WHOLE);
        assert_eq!(grazings(&workshop).len(), 1, "{ratio}");
    }
}

/// Four slow impacts within three periods, over which a disturbance becomes 1e11 times as large: cut in two,
/// 10 000 solutions brought the branch no further.
#[test]
fn an_orbit_of_many_slow_impacts_is_cut_more_than_once() {
    let workshop = between_stops_in_three_periods([2.336, 2.75], 2e-3);
    // Near the harmonic orbit, which all branches come to, they lie too close together for `assert_whole`.
    let ends = workshop.table("results/export/ends.csv");
    assert!(ends.iter().all(|end| WHOLE.contains(&end["end"].as_str())), "{ends:?}");
    let rows = workshop.table("results/export/branches.csv").len();
    assert!(rows < 3000, "{rows} solutions");
}

/// Towards the grazing of the harmonic orbit, where it ends, all impacts of an orbit of three periods become
/// slow at once: a disturbance becomes 1e30 times as large in a period. Equations condensed to one node had
/// nothing left of that, and 5000 solutions brought the branch no further.
#[test]
fn a_branch_is_followed_into_the_grazing_of_many_slow_impacts() {
    let workshop = between_stops_in_three_periods([2.33, 2.6], 5e-3);
    let ends = workshop.table("results/export/ends.csv");
    assert!(ends.iter().all(|end| WHOLE.contains(&end["end"].as_str())), "{ends:?}");
    let met = ends.iter().filter(|end| end["end"] == "shorter-period");
    let off = met.map(|end| from_gap([0.3, 120.0, 0.012, 0.5, 0.009], number(end, "frequency_hz")));
    let off: Vec<f64> = off.collect();
    // Half of the relative change of the frequency would be one of 1e-7.
    assert!(!off.is_empty() && off.iter().all(|off| off.abs() < 1e-6), "{off:?}");
    let rows = workshop.table("results/export/branches.csv").len();
    assert!(rows < 1000, "{rows} solutions");
}

/// Where an orbit of three periods grazes both stops at once, its asymmetric arms, with the one impact, go on
/// as their mirror images, with the other. 1.5e-6 Hz before that the impact is slower than 1e-7 of the orbit:
/// the corner has to be seen from farther away. From there a turn beside the other stop may be taken for what
/// grazes; taken for all that did, it led to the symmetric branch.
#[test]
fn an_asymmetric_arm_goes_on_to_where_the_symmetric_orbit_grazes_both_stops() {
    let workshop = between_stops_in_three_periods([3.78, 3.96], 1e-3);
    assert_whole(&workshop, (3.78, 3.96), WHOLE);
}

/// Around the resonance of a mode with 0.2 % of damping the steady response is some hundred times the
/// motion between the stops. What rounding left of their difference was enlarged by slow impacts, and steps
/// hung in it: 5000 solutions brought the branch no further.
#[test]
fn a_lightly_damped_orbit_goes_on_beside_a_grazing_near_the_resonance() {
    let stop = "restitution = 0.9312\nside = \"both\"\ngap_m = 0.00032714";
    let study = one_mass([0.138531, 7009.63, 0.002, 1.1286], [35.7, 35.85], stop);
    let study = format!("{study}[response]\nperiod_multiples = [1, 2]\n");
    assert_whole(&Workshop::exported(&quick(&study, 0.01)), (35.7, 35.85), WHOLE);
}

/// The branch of two periods comes to that of one at a grazing, at which nothing leaves in a direction that
/// the orbit of one period would tell.
#[test]
fn nothing_is_missed_beside_a_grazing_at_which_a_stored_branch_ends() {
    let stop = "restitution = 0.82\nside = \"above\"\ngap_m = 5.5e-6";
    let study = one_mass([2.1e-6, 330.0, 0.008, 4.1e-5], [1900.0, 2100.0], stop);
    let workshop = Workshop::with(&format!("{study}[response]\nperiod_multiples = [1, 2]\n"));
    let run = workshop.compute(&["--json"]);
    let report: serde_json::Value = serde_json::from_str(&stdout(&run)).unwrap();
    let ends = report["branches"].as_array().unwrap().iter().map(|branch| &branch["up"]["stop_reason"]);
    assert!(ends.into_iter().any(|end| end == "shorter-period"), "{report}");
    assert_eq!(report["failed"].as_array().unwrap().len(), 0, "{report}");
}

#[test]
fn a_branch_ends_early_in_chatter_alone_and_none_is_stored_again_some_periods_later() {
    let workshop = Workshop::exported(CHATTERING);
    assert_whole(&workshop, (1.8, 7.0), &[WHOLE, &["chatter", "joins"]].concat());
    let (_, branches) = stored(&workshop);
    let ends = ends(&branches);
    let chattering = ends.iter().filter_map(|(branch, end)| match end {
        BranchEnd::Walk(StopReason::Chatter { element, place: frequency_hz, .. }) if element == "stop" => {
            Some((*branch, *frequency_hz))
        }
        _ => None,
    });
    let chattering: Vec<(u32, f64)> = chattering.collect();
    assert!((1..=3).contains(&chattering.len()), "{ends:?}");
    // A branch joins another one only where that was lost in chatter.
    let is_lost = |end: &BranchEnd| match end {
        BranchEnd::Joins { branch, frequency_hz } => {
            branch.is_some_and(|other| chattering.contains(&(other, *frequency_hz)))
        }
        _ => true,
    };
    assert!(ends.iter().all(|(_, end)| is_lost(end)), "{ends:?}");
}

/// `A = F/|1 - W^2 + i c W|` reaches the gap: `(1 - W^2)^2 + (c W)^2 = (F/g)^2`. Whether the impact comes or
/// goes there, and with one stop or with two at once.
#[test]
fn a_grazing_lies_within_its_uncertainty_of_the_closed_form() {
    for (study, damping) in [(IMPACT_OSCILLATOR, 0.04_f64), (BETWEEN_STOPS, 0.1)] {
        let workshop = Workshop::exported(study);
        let force = 0.4_f64;
        let (half, constant) = (1.0 - 0.5 * damping * damping, 1.0 - force * force);
        let root = (half * half - constant).sqrt();
        let grazings = grazings(&workshop);
        let events = workshop.table("results/export/events.csv");
        for square in [half - root, half + root] {
            let expected = square.sqrt() / TAU;
            let off = |row: &crate::common::Row| (number(row, "frequency_hz") - expected).abs();
            let grazings = events.iter().filter(|row| grazings.contains(&number(row, "frequency_hz")));
            let nearest = grazings.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
            let uncertainty = number(nearest, "uncertainty_hz");
            assert!(off(nearest) <= uncertainty, "{expected}: {nearest:?}");
            assert!(uncertainty < 1e-8 * expected, "{nearest:?}");
        }
    }
}

/// Beside a grazing an impact of the speed v makes `1/v` times as much of what a state is off: rows are
/// corrected until they close, too (before, they missed it by 6e-8).
#[test]
fn orbits_beside_a_grazing_close() {
    let workshop = Workshop::exported(IMPACT_OSCILLATOR);
    for row in workshop.table("results/export/branches.csv") {
        assert!(number(&row, "residual") < 3e-10, "{row:?}");
    }
}

/// Three masses of which the last is between two stops, which it meets in chatter: behind the grazing of both
/// at 2.1459 Hz the first orbit that is known has faster impacts than at the fold beside it. Taken for one
/// before the fold, it led the branch back to where it came from.
#[test]
fn a_corner_is_left_behind_a_fold_that_is_nearer_to_it_than_the_first_known_orbit() {
    let workshop = Workshop::exported(
        r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.899 }, { name = "b", mass_kg = 1.602 }, { name = "c", mass_kg = 1.267 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 172.43 },
    { between = ["b", "a"], stiffness_n_m = 155.78 },
    { between = ["c", "b"], stiffness_n_m = 314.2 },
]
damper = [
    { between = ["a", "ground"], damping_n_s_m = 3.29005 },
    { between = ["b", "a"], damping_n_s_m = 2.97236 },
    { between = ["c", "b"], damping_n_s_m = 5.99509 },
]
[excitation]
kind = "support-motion"
at = "ground"
amplitude_m = 0.01
frequency_hz = [1.0, 2.41766]
[[stop]]
name = "walls"
at = "c"
law = "rigid"
restitution = 0.334
gap_m = 0.0051778
side = "both"
[search]
frequencies = 2
starts = 2
trials = 2
[continuation]
max_step_hz = 0.0050659
"#,
    );
    assert_whole(&workshop, (1.0, 2.41766), WHOLE);
}

/// Motions of three periods between two stops. Where their impacts become ever slower, at 2.91304 Hz, those
/// of many branches come together, nearer than they are known, and part again. One of 10 impacts and one of
/// 11 differ by less than 1e-4.
#[test]
fn branches_that_come_together_in_slow_impacts_are_not_one() {
    let stop = "restitution = 0.55\nside = \"both\"\ngap_m = 0.0121";
    let oscillator = one_mass([0.23, 611.0, 0.019, 5.1], [2.7, 4.0], stop);
    let further = "[response]\nperiod_multiples = [3]\n[continuation]\nmax_step_hz = 0.0252\n";
    let ends = Workshop::exported(&(oscillator + further)).table("results/export/ends.csv");
    assert!(ends.len() >= 20, "{ends:?}");
    assert!(ends.iter().all(|end| WHOLE.contains(&end["end"].as_str())), "{ends:?}");
}

/// Over the gap of both sides the symmetric orbit of two impacts grazes where that is the amplitude of the
/// linear response, and goes on without them. Before, the column of the gap was one of differences, and the
/// branch was lost beside it.
#[test]
fn a_branch_over_the_gap_of_both_sides_goes_on_across_their_grazing() {
    let oscillator = [0.73, 311.0, 0.047, 1.7];
    let stop = "restitution = 0.71\nside = \"both\"\ngap_m = 0.005";
    let vary = "[[vary]]\nparameter = \"stop.s.gap_m\"\nrange = [0.0031, 0.0123]\n\
        frequency_hz = 2.03\nsteps = 300\n";
    let workshop = Workshop::exported(&(one_mass(oscillator, [2.0, 2.06], stop) + vary));
    let ends = workshop.table("results/export/parameter_ends.csv");
    let mut reached: Vec<f64> = ends.iter().map(|end| number(end, "parameter")).collect();
    reached.sort_by(f64::total_cmp);
    assert_eq!(reached, [0.0031, 0.0123], "{ends:?}");
    let events = workshop.table("results/export/parameter_events.csv");
    let last = events.iter().max_by(|a, b| number(a, "parameter").total_cmp(&number(b, "parameter")));
    let (last, [m, k, ratio, force]) = (last.unwrap(), oscillator);
    let relative = from_gap([m, k, ratio, force, number(last, "parameter")], 2.03);
    let uncertainty = number(last, "uncertainty") / number(last, "parameter");
    assert!(last["event"] == "grazing" && relative.abs() <= uncertainty, "{relative:e}: {last:?}");
    assert!(uncertainty < 1e-8, "{last:?}");
}
