//! Curves of bifurcations beside grazings, and of grazings from both sides, with the real command.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;

use crate::common::{Workshop, assert_success, stdout};

/// A mass on a spring and a damper [kg, N/m, N s/m] beside stops, under a force [N] in a range of frequency
/// [Hz].
fn oscillator([mass, stiffness, damping]: [f64; 3], force: f64, range: [f64; 2], stops: &str) -> String {
    let step = (range[1] - range[0]) / 1000.0;
    format!(
        r#"
[structure]
kind = "lumped"
mass = [{{ name = "mass", mass_kg = {mass} }}]
spring = [{{ between = ["mass", "ground"], stiffness_n_m = {stiffness} }}]
damper = [{{ between = ["mass", "ground"], damping_n_s_m = {damping} }}]
[excitation]
kind = "force"
at = "mass"
amplitude_n = {force:?}
frequency_hz = {range:?}
{stops}
[response]
point = "mass"
[search]
frequencies = 0
trials = 0
[continuation]
max_step_hz = {step:e}
"#
    )
}

/// A stop of the mass, with the rest of its keys.
fn stop(name: &str, keys: &str) -> String {
    format!("[[stop]]\nname = \"{name}\"\nat = \"mass\"\n{keys}\n")
}

/// A bilinear oscillator beside stops.
fn bilinear(stops: &str) -> String {
    oscillator([1.0, 1.0, 0.1], 1.0, [0.05, 0.4], stops)
}

/// An oscillator whose stop has a damper, under a force: where it is grazed, multipliers jump.
fn with_a_damped_stop(force: f64) -> String {
    let keys =
        "law = \"linear\"\nstiffness_n_m = 29.19\ndamping_n_s_m = 0.784\nside = \"below\"\ngap_m = 1.0";
    oscillator([1.758, 1.881, 0.05], force, [0.06, 0.08], &stop("stop", keys))
}

fn curve(of: &str, near_hz: f64, parameter: &str, range: [f64; 2]) -> String {
    format!("[[curve]]\nof = \"{of}\"\nnear_hz = {near_hz}\nparameter = \"{parameter}\"\nrange = {range:?}\n")
}

/// The columns of that name of an exported table.
fn columns<const N: usize>(workshop: &Workshop, table: &str, names: [&str; N]) -> Vec<[String; N]> {
    let text = fs::read_to_string(workshop.path(&format!("results/export/{table}"))).unwrap();
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let places = names.map(|name| header.iter().position(|column| *column == name).unwrap());
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        places.map(|place| cells[place].to_owned())
    };
    lines.map(row).collect()
}

/// On the way the depth of a contact becomes smaller than the steps of differences: motions that barely touch
/// took thousands of steps once, with derivatives by a parameter of their stop, and the curves ended.
#[test]
fn curves_of_folds_and_flips_pass_contacts_that_are_barely_touched() {
    let curve = |of, near_hz| curve(of, near_hz, "stop.stop.stiffness_n_m", [2.0, 60.0]);
    let stop = stop("stop", "law = \"linear\"\nstiffness_n_m = 10.0\nside = \"above\"\ngap_m = 1.0");
    let (fold, flip) = (curve("fold", 0.0990914), curve("flip", 0.082927));
    let workshop = Workshop::exported(&format!("{}{fold}{flip}", bilinear(&stop)));
    let ends = columns(&workshop, "curve_ends.csv", ["of", "side", "parameter", "message", "state"]);
    assert_eq!(ends.len(), 4);
    for [of, side, parameter, message, state] in ends {
        assert_eq!(message, "end of the range of the parameter", "{of}, {side}");
        // Both curves turn at the least stiffness that has such points.
        assert_eq!(parameter, "60.0", "{of}, {side}");
        assert_eq!(state.split(' ').count(), 2);
    }
}

/// A mass between two stops touches both half a period apart as long as its motion is linear: the curve is
/// that of the linear amplitude, whether they are one two-sided stop or two. Where one of two is moved away
/// alone, the other is struck.
#[test]
fn a_symmetric_orbit_grazes_both_of_its_stops() {
    let stop = |name: &str, law: &str| stop(name, &format!("{law}\nstiffness_n_m = 30.0\ngap_m = 0.6"));
    let two_sided = (stop("stop", "law = \"two-sided\""), "stop.stop.gap_m", [0.2, 1.0]);
    let linear = |name: &str, side: &str| stop(name, &format!("law = \"linear\"\nside = \"{side}\""));
    let pair = || linear("stop", "above") + &linear("other", "below");
    let both = (pair(), "excitation.amplitude_n", [0.7, 2.0]);
    let one_of_two = (pair(), "stop.stop.gap_m", [0.3, 0.7]);
    for (number, (stops, parameter, range)) in [two_sided, both, one_of_two].into_iter().enumerate() {
        let grazing = curve("grazing", 0.26, parameter, range);
        let study = bilinear(&stops).replace("[0.05, 0.4]", "[0.2, 0.4]");
        let workshop = Workshop::exported(&format!("{study}{grazing}"));
        let rows = columns(&workshop, "curves.csv", ["parameter", "frequency_hz"]);
        assert!(rows.len() > 20 && rows.len() < 1000, "{parameter}: {} rows", rows.len());
        for row in rows {
            let [value, frequency_hz] = row.each_ref().map(|cell| cell.parse::<f64>().unwrap());
            if number == 2 && value > 0.6 {
                continue;
            }
            let w = std::f64::consts::TAU * frequency_hz;
            let amplitude = 1.0 / (1.0 - w * w).hypot(0.1 * w);
            let expected = if parameter == "stop.stop.gap_m" { value } else { 0.6 / value };
            assert!(
                (amplitude / expected - 1.0).abs() < 1e-8,
                "{parameter} {value}: {amplitude}, {expected}"
            );
        }
        let ends = columns(&workshop, "curve_ends.csv", ["message"]);
        assert!(ends.iter().all(|[message]| message.starts_with("end of the")), "{parameter}: {ends:?}");
    }
}

/// A constant load p moves the orbits of such a mass by p (its spring has 1 N/m). The curve is that of one
/// stop, `A + p = 1`: it goes on to where the motion leaves the other, and ends, with that one grazed to
/// 1e-6, where it would be struck.
#[test]
fn a_grazing_curve_ends_where_the_opposite_stop_would_be_struck() {
    let stop = |name: &str, side: &str| {
        stop(name, &format!("law = \"rigid\"\nrestitution = 0.8\ngap_m = 1.0\nside = \"{side}\""))
    };
    let load = "[[load]]\nkind = \"force\"\nat = \"mass\"\norder = 0\namplitude_n = 0.0\n";
    let stops = stop("upper", "above") + &stop("lower", "below") + load;
    let study = oscillator([1.0, 1.0, 0.04], 0.4, [0.105, 0.13], &stops);
    let [below, above] =
        [[-0.05, 0.0], [0.0, 0.05]].map(|range| curve("grazing", 0.1234, "load.1.amplitude_n", range));
    let workshop = Workshop::exported(&format!("{study}{below}{above}"));
    let rows = columns(&workshop, "curves.csv", ["parameter", "frequency_hz"]);
    assert!(rows.len() > 20 && rows.len() < 300, "{} rows", rows.len());
    for row in rows {
        let [load, frequency_hz] = row.map(|cell| cell.parse::<f64>().unwrap());
        let w = std::f64::consts::TAU * frequency_hz;
        let amplitude = 0.4 / (1.0 - w * w).hypot(0.04 * w);
        assert!((amplitude + load.abs() - 1.0).abs() < 3e-6, "{load}: {amplitude}");
    }
    let ends = columns(&workshop, "curve_ends.csv", ["message"]);
    let ended = |start: &str| ends.iter().filter(|[message]| message.starts_with(start)).count();
    assert_eq!((ended("lower is grazed as well at"), ended("end of the range")), (1, 3), "{ends:?}");
}

/// Two rigid stops that a linear motion comes to touch at once: its branch turns the corner and goes on with
/// impacts on both, and the corner moves on its curve. With a force F over a damped mass on a spring (1 kg, 1
/// N/m, c) the amplitude `F/((1 - w^2)^2 + c^2 w^2)^(1/2)` is the gap there.
#[test]
fn a_symmetric_branch_turns_the_corner_at_two_rigid_stops() {
    const GAP: f64 = 0.6;
    const DAMPING: f64 = 0.06;
    let grazing_hz = |force: f64| {
        let (half, rest) = (1.0 - 0.5 * DAMPING * DAMPING, 1.0 - (force / GAP).powi(2));
        (half + (half * half - rest).sqrt()).sqrt() / std::f64::consts::TAU
    };
    let keys = |side: &str| format!("law = \"rigid\"\nrestitution = 0.7\nside = \"{side}\"\ngap_m = {GAP}");
    let stops = stop("above", &keys("above")) + &stop("below", &keys("below"));
    let study = oscillator([1.0, 1.0, DAMPING], 1.0, [0.24, 0.3], &stops)
        .replace("frequencies = 0", "frequencies = 2");
    let curve = curve("grazing", 0.26, "excitation.amplitude_n", [0.9, 1.2]);
    let (study, _) = study.split_once("[continuation]").unwrap();
    let workshop = Workshop::exported(&format!("{study}[continuation]\nmax_step_hz = 0.0005\n{curve}"));
    let events = columns(
        &workshop,
        "events.csv",
        ["event", "frequency_hz", "uncertainty_hz", "contact_change", "branch"],
    );
    let corners: Vec<_> = events.iter().filter(|row| row[0].contains("grazing")).collect();
    assert_eq!(corners.len(), 1, "{events:?}");
    let [event, hz, uncertainty, change, branch] = corners[0];
    let [hz, uncertainty]: [f64; 2] = [hz, uncertainty].map(|text| text.parse().unwrap());
    assert_eq!(event, "fold+grazing");
    assert!((hz - grazing_hz(1.0)).abs() < uncertainty && uncertainty < 1e-6, "{hz} {uncertainty}");
    assert!(change == "+1 +2" || change == "-1 -2", "{change}");
    // From the end of the range without contact to the same end with two.
    for [of, end, message] in columns(&workshop, "ends.csv", ["branch", "end", "message"]) {
        assert_eq!(end, "range-end", "branch {of}: {message}");
    }
    let rows = columns(&workshop, "branches.csv", ["branch", "contacts", "frequency_hz"]);
    let of_branch: Vec<_> = rows.iter().filter(|row| row[0] == *branch).collect();
    let ends = [of_branch[0], of_branch[of_branch.len() - 1]]
        .map(|[_, contacts, hz]| (contacts.as_str(), hz.as_str()));
    assert!(ends == [("0", "0.3"), ("2", "0.3")] || ends == [("2", "0.3"), ("0", "0.3")], "{ends:?}");
    let curve = columns(&workshop, "curves.csv", ["parameter", "frequency_hz"]);
    assert!(curve.len() > 30);
    for row in curve {
        let [force, hz]: [f64; 2] = row.map(|text| text.parse().unwrap());
        assert!((hz / grazing_hz(force) - 1.0).abs() < 1e-8, "{force} N: {hz} Hz, not {}", grazing_hz(force));
    }
}

/// The flip comes to a grazing on both sides, and on from there is where the multiplier jumps: it took
/// thousands of short steps there once.
#[test]
fn a_curve_ends_where_it_meets_a_grazing() {
    let flip = curve("flip", 0.071713, "excitation.amplitude_n", [0.4, 6.8]);
    let workshop = Workshop::exported(&format!("{}{flip}", with_a_damped_stop(1.696)));
    let ends = columns(&workshop, "curve_ends.csv", ["parameter", "frequency_hz", "message"]);
    assert_eq!(ends.len(), 2);
    let grazing = |end: &[String; 3]| {
        assert!(end[2].starts_with("met a grazing at excitation.amplitude_n = "), "{}", end[2]);
        // The branch at that force grazes there.
        let workshop = Workshop::exported(&with_a_damped_stop(end[0].parse().unwrap()));
        let frequency_hz: f64 = end[1].parse().unwrap();
        let events = columns(&workshop, "events.csv", ["event", "frequency_hz"]);
        let is_near = |hz: &String| (hz.parse::<f64>().unwrap() / frequency_hz - 1.0).abs() < 1e-6;
        assert!(events.iter().any(|[event, hz]| event.contains("grazing") && is_near(hz)), "{events:?}");
    };
    ends.iter().for_each(grazing);
    assert!(columns(&workshop, "curves.csv", ["parameter"]).len() < 2000);
}

/// A contact that is closed, opens for an instant and closes: without a gap the motion is proportional to the
/// force, so the curve over it is a straight line.
#[test]
fn a_grazing_from_inside_is_followed() {
    let keys = "law = \"linear\"\nstiffness_n_m = 6.29\nside = \"below\"\ngap_m = 0.0";
    let study = oscillator([0.864, 2.033, 0.2], 0.613, [0.0598, 0.0603], &stop("stop", keys));
    let curve = curve("grazing", 0.06005, "excitation.amplitude_n", [0.1, 2.5]);
    let workshop = Workshop::exported(&format!("{study}{curve}"));
    let events = columns(&workshop, "events.csv", ["event", "frequency_hz"]);
    let [[_, grazing]] = &events.iter().filter(|row| row[0] == "grazing").collect::<Vec<_>>()[..] else {
        panic!("{events:?}")
    };
    let rows = columns(&workshop, "curves.csv", ["parameter", "frequency_hz", "max_abs_displacement_m"]);
    let rows: Vec<[f64; 3]> =
        rows.iter().map(|row| row.each_ref().map(|cell| cell.parse().unwrap())).collect();
    let [first, last] = [rows[0], rows[rows.len() - 1]];
    assert_eq!([first[0], last[0]], [0.1, 2.5]);
    let grazing: f64 = grazing.parse().unwrap();
    for [force, frequency_hz, displacement] in rows {
        assert!((frequency_hz / grazing - 1.0).abs() < 1e-8, "{force} N: {frequency_hz} Hz, {grazing} Hz");
        assert!(
            (displacement / force * first[0] / first[2] - 1.0).abs() < 1e-8,
            "{force} N: {displacement} m"
        );
    }
}

/// A Neimark-Sacker point 2e-5 Hz from a grazing, behind which multipliers go like the root of the distance:
/// its curve over the damping reaches the end of the range of frequency on one side and that of the damping
/// on the other, in steps of its own bend and not of that distance (18 000 rows once).
#[test]
fn a_curve_beside_a_grazing_goes_on_in_long_steps() {
    let study = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.0 }, { name = "b", mass_kg = 0.5 }, { name = "c", mass_kg = 0.25 }]
spring = [
    { between = ["a", "ground"], stiffness_n_m = 2000.0 },
    { between = ["a", "b"], stiffness_n_m = 1500.0 },
    { between = ["b", "c"], stiffness_n_m = 800.0 },
]
[damping]
modal_ratio = 0.02
[excitation]
kind = "force"
at = "a"
amplitude_n = 6.0
frequency_hz = [3.6, 4.6]
[[stop]]
name = "floor"
at = "c"
law = "linear"
stiffness_n_m = 2.0e4
side = "below"
gap_m = 0.004
[response]
point = "c"
period_multiples = [1]
[search]
frequencies = 12
trials = 0
[[curve]]
of = "neimark-sacker"
near_hz = 4.504
parameter = "damping.modal_ratio"
range = [0.005, 0.1]
"#;
    let workshop = Workshop::with(study);
    let found = workshop.compute(&[]);
    assert_success(&found);
    let text = stdout(&found);
    let curve = text.split("neimark-sacker curve").nth(1).unwrap_or_else(|| panic!("no curve: {text}"));
    let rows: u64 = curve.split(" solutions").next().unwrap().rsplit(' ').next().unwrap().parse().unwrap();
    assert!(rows < 1000, "{curve}");
    assert!(curve.contains("end of the frequency range"), "{curve}");
    assert!(curve.contains("end of the range of the parameter"), "{curve}");
}

/// A curve of flips of two masses comes to a corner at which a contact changes. It is seen in the equations
/// only within a millionth of the ranges, so that the last row knows nothing of a grazing yet.
#[test]
fn a_curve_that_turns_at_a_change_of_contacts_ends_at_a_grazing() {
    let study = r#"
[structure]
kind = "lumped"
mass = [{ name = "a", mass_kg = 1.045 }, { name = "b", mass_kg = 1.445 }]
[[structure.spring]]
between = ["a", "ground"]
stiffness_n_m = 2.325
[[structure.spring]]
between = ["b", "a"]
stiffness_n_m = 2.897
[[structure.damper]]
between = ["a", "ground"]
damping_n_s_m = 0.05
[[structure.damper]]
between = ["b", "a"]
damping_n_s_m = 0.2
[excitation]
kind = "force"
at = "a"
amplitude_n = 1.764
frequency_hz = [0.06, 0.08]
[[stop]]
name = "stop"
at = "b"
law = "linear"
stiffness_n_m = 40.98
gap_m = 0.3
side = "below"
[response]
point = "b"
[search]
frequencies = 0
trials = 0
"#;
    let flip = curve("flip", 0.06660628681240088, "structure.spring.1.stiffness_n_m", [1.0, 2.4]);
    let workshop = Workshop::exported(&format!("{study}{flip}"));
    let ends = columns(&workshop, "curve_ends.csv", ["side", "message"]);
    let [down] = ends.iter().filter(|[side, _]| side == "down").collect::<Vec<_>>()[..] else {
        panic!("{ends:?}")
    };
    assert!(down[1].contains("met a grazing at structure.spring.1.stiffness_n_m = 1.506"), "{down:?}");
}

/// The impact oscillator of the studies, with these curves.
fn impact_oscillator(curves: &str) -> Workshop {
    let study = include_str!("../../../studies/impact-oscillator.toml");
    Workshop::exported(&format!("{study}[search]\nfrequencies = 0\n{curves}"))
}

/// The amplitude of the mass on its spring is the gap where it grazes: `0.4/sqrt((1 - w^2)^2 + (0.04 w)^2)`,
/// at 0.08 Hz too.
#[test]
fn a_curve_is_cut_exactly_at_the_end_of_the_frequency_range() {
    let workshop = impact_oscillator(&curve("grazing", 0.1234, "stop.stop.gap_m", [0.3, 3.0]));
    let ends = columns(&workshop, "curve_ends.csv", ["side", "parameter", "frequency_hz", "message"]);
    let [_, gap, frequency_hz, message] = ends.iter().find(|end| end[0] == "down").unwrap();
    assert_eq!((&frequency_hz[..], &message[..]), ("0.08", "end of the frequency range"));
    let w = std::f64::consts::TAU * 0.08;
    let expected = 0.4 / (1.0 - w * w).hypot(0.04 * w);
    assert!((gap.parse::<f64>().unwrap() / expected - 1.0).abs() < 1e-9, "{gap}, not {expected}");
    let rows = columns(&workshop, "curves.csv", ["frequency_hz"]);
    assert!(rows.iter().all(|[hz]| (0.08..=0.5).contains(&hz.parse::<f64>().unwrap())));
}

/// At a rigid stop the multipliers of an orbit with a slow impact go like `sin(w_d T)` over its speed, so
/// curves of flips meet that of grazings where `w_d T = k pi` with an odd k, at two thirds of the damped
/// eigenfrequency, and curves of folds where it is even, at the eigenfrequency.
#[test]
fn a_resonant_grazing_at_which_a_curve_ends_is_named() {
    let flip = ("flip", 0.15755, [0.3, 3.0], ("down", 2.0 / 3.0));
    let fold = ("fold", 0.2527, [0.3, 15.0], ("up", 1.0));
    for (of, near_hz, range, (to, part)) in [flip, fold] {
        let workshop = impact_oscillator(&curve(of, near_hz, "stop.stop.gap_m", range));
        let ends = columns(&workshop, "curve_ends.csv", ["side", "parameter", "frequency_hz", "message"]);
        let [_, gap, frequency_hz, message] = ends.iter().find(|end| end[0] == to).unwrap();
        let name = format!("grazing-{of}");
        assert!(message.contains(&format!("a resonant grazing ({name})")), "{message}");
        let damped_hz = (1.0_f64 - 0.02 * 0.02).sqrt() / std::f64::consts::TAU;
        let [found, gap] = [frequency_hz, gap].map(|text| text.parse::<f64>().unwrap());
        // The curve ends where the speed of the impact is one that its points no longer tell.
        assert!((found / (part * damped_hz) - 1.0).abs() < 3e-5, "{of}: {found}, not {part} of {damped_hz}");
        let w = std::f64::consts::TAU * found;
        let amplitude = 0.4 / (1.0 - w * w).hypot(0.04 * w);
        assert!((gap / amplitude - 1.0).abs() < 1e-6, "{of}: {gap}, not {amplitude}");
        let rows = columns(&workshop, "curves.csv", ["frequency_hz", "event"]);
        let marked: Vec<_> = rows.iter().filter(|[_, event]| event.contains(&name)).collect();
        assert_eq!(marked.len(), 1, "{marked:?}");
        assert_eq!(marked[0][0], *frequency_hz);
    }
}
