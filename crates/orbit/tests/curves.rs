//! Curves of bifurcations in two parameters: against closed forms, and against branches in the frequency at
//! fixed values of the second parameter.
#![allow(clippy::unwrap_used, reason = "tests")]

use crate::common::{beam, duffing};
use faer::Mat;
use hammerbeam_motion::{Harmonic, HarmonicForce, Law, Load, LocalElement, Parameter, System, law};
use hammerbeam_orbit::{
    BranchRow, BranchWalk, CurveEnd, CurveKind, CurveRow, CurveSettings, CurveWalk, EventStatus, Events,
    OrbitSettings, Response, Segments, Side, find_start, reach_orbit,
};
use hammerbeam_structure::{PointOutput, ReducedModel};
use hammerbeam_testkit::extensive;

type Case = (System, Response);

/// One degree of freedom: `x'' + c x' + x + f = F cos(2 pi f t)` with local laws of `x` or, of the shape -1,
/// of `-x`.
fn oscillator(damping: f64, force: f64, laws: &[(f64, Law)]) -> Case {
    let model = ReducedModel {
        natural_frequencies: vec![1.0],
        damping: Mat::from_fn(1, 1, |_, _| damping),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: force, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0], harmonic }] };
    let local = |(k, (shape, law)): (usize, &(f64, Law))| LocalElement {
        name: format!("local {k}"),
        shape: vec![*shape],
        support_ratios: vec![0.0],
        law: law.clone(),
    };
    let elements = laws.iter().enumerate().map(local).collect();
    (System::new(model, &load, elements).unwrap(), Response { shape: vec![1.0], support_ratios: vec![0.0] })
}

/// Rows of a branch in the frequency with an event, sharply located.
fn events(case: &Case, start_hz: f64, range_hz: (f64, f64), wanted: fn(&Events) -> bool) -> Vec<BranchRow> {
    let sharp = |row: &BranchRow| row.located.as_ref().is_some_and(|l| l.status == EventStatus::Located);
    branch(case, start_hz, range_hz).into_iter().filter(|row| wanted(&row.events) && sharp(row)).collect()
}

/// Rows of a branch in the frequency.
fn branch(case: &Case, start_hz: f64, range_hz: (f64, f64)) -> Vec<BranchRow> {
    branch_in(Segments::Automatic, case, start_hz, range_hz)
}

fn branch_in(segments: Segments, case: &Case, start_hz: f64, range_hz: (f64, f64)) -> Vec<BranchRow> {
    let settings = OrbitSettings { segments, ..OrbitSettings::for_range(range_hz) };
    let orbit = (start_hz, 1);
    let start = find_start(&case.0, &case.1, start_hz, 1, &settings)
        .or_else(|_| reach_orbit(&case.0, &case.1, orbit, &OrbitSettings::default(), &mut || false))
        .unwrap();
    let mut rows = Vec::new();
    for side in [Side::Down, Side::Up] {
        let mut walk = BranchWalk::new(&case.0, &case.1, &start, side, range_hz, &settings).unwrap();
        while walk.step(&mut rows).unwrap().is_none() {}
    }
    rows
}

fn settings(parameter: Parameter, range: (f64, f64), range_hz: (f64, f64)) -> CurveSettings {
    CurveSettings { parameter, range, range_hz, max_step: 0.5, max_rows: 5000 }
}

fn curve(
    (system, response): &Case,
    start: &BranchRow,
    (kind, side): (CurveKind, Side),
    settings: &CurveSettings,
) -> (Vec<CurveRow>, CurveEnd) {
    let orbits = OrbitSettings::default();
    let mut walk =
        CurveWalk::new(system, response, &start.solution, (kind, side), settings, &orbits).unwrap();
    let mut rows = vec![walk.start_row().unwrap()];
    loop {
        match walk.step().unwrap() {
            Ok(row) => rows.push(row),
            Err(end) => return (rows, end),
        }
    }
}

/// The fold of a curve at the end of its range is the fold of the branch of that system.
fn assert_meets_branch(
    case: &Case,
    row: &CurveRow,
    parameter: Parameter,
    (start_hz, range_hz): (f64, (f64, f64)),
    wanted: fn(&Events) -> bool,
) {
    let system = case.0.clone().with_parameter(parameter, row.parameter).unwrap();
    let found = events(&(system, case.1.clone()), start_hz, range_hz, wanted);
    let hz = row.solution.frequency_hz;
    let errors = found.iter().map(|other| (other.solution.frequency_hz / hz - 1.0).abs());
    let error = errors.fold(f64::INFINITY, f64::min);
    assert!(error < 1e-8, "at {}: {hz} Hz, off by {error:e}", row.parameter);
}

const DUFFING_HZ: (f64, f64) = (0.1, 0.6);

#[test]
fn fold_curves_of_the_duffing_oscillator_meet_its_branches() {
    let case = duffing();
    let folds = events(&case, 0.1, DUFFING_HZ, |events| events.fold);
    assert_eq!(folds.len(), 2);
    for fold in &folds {
        for (side, range) in [(Side::Up, (0.5, 1.6)), (Side::Down, (0.6, 1.6))] {
            let settings = settings(Parameter::ExcitationScale, range, DUFFING_HZ);
            let (rows, end) = curve(&case, fold, (CurveKind::Fold, side), &settings);
            assert_eq!(end, CurveEnd::RangeEnd);
            let last = rows.last().unwrap();
            assert_meets_branch(&case, last, Parameter::ExcitationScale, (0.1, DUFFING_HZ), |e| e.fold);
            for row in &rows {
                let nearest = row.solution.floquet_multipliers.iter().map(|[re, im]| (re - 1.0).hypot(*im));
                assert!(nearest.fold(f64::INFINITY, f64::min) < 1e-6);
            }
        }
    }
}

/// Of one harmonic, with `c = d W`: `W^2 = 1 + 3^1/2 c` and `F^2 = 32 c^3 / (9 3^1/2 a)`; what it leaves out,
/// the third harmonic, is of relative order `a x^2`, thus proportional to the damping d.
#[test]
fn the_cusp_of_the_duffing_oscillator_is_that_of_harmonic_balance() {
    let errors: Vec<[f64; 2]> = [0.1, 0.05]
        .iter()
        .map(|damping| {
            let root = 3.0_f64.sqrt();
            let w = 0.5 * (root * damping + (3.0 * damping * damping + 4.0).sqrt());
            let force = (32.0 * (damping * w).powi(3) / (9.0 * root)).sqrt();
            // Twice the force of the cusp, so that there are folds to start at.
            let cubic = Law::Power(law::PowerSpring::cubic(1.0).unwrap());
            let case = oscillator(*damping, 2.0 * force, &[(1.0, cubic)]);
            let range_hz = (0.12, 0.3);
            let folds = events(&case, 0.12, range_hz, |events| events.fold);
            let settings = settings(Parameter::ExcitationScale, (0.3, 1.5), range_hz);
            let (rows, end) = curve(&case, &folds[0], (CurveKind::Fold, Side::Down), &settings);
            // Round the cusp and back on the other folds.
            assert_eq!(end, CurveEnd::RangeEnd);
            let cusps: Vec<&CurveRow> = rows.iter().filter(|row| row.events.cusp).collect();
            assert_eq!(
                cusps.len(),
                1,
                "{:?}",
                cusps
                    .iter()
                    .map(|c| (c.parameter, c.solution.frequency_hz, c.solution.error_estimate))
                    .collect::<Vec<_>>()
            );
            let hz = w / std::f64::consts::TAU;
            [cusps[0].parameter / 0.5 - 1.0, cusps[0].solution.frequency_hz / hz - 1.0]
        })
        .collect();
    for k in 0..2 {
        assert!(errors[0][k].abs() < 0.01);
        let ratio = errors[0][k] / errors[1][k];
        assert!((1.6..4.6).contains(&ratio), "entry {k}: {errors:?}");
    }
}

const FLIPS_HZ: (f64, f64) = (54.5, 62.0);

/// The flips of the paper's beam at 55.0147 and 58.9989 Hz.
#[test]
fn flip_curves_of_the_beam_meet_its_branches() {
    let case = beam();
    let flips = events(&case, 57.0, FLIPS_HZ, |events| events.flip);
    for hz in [55.0147, 58.9989] {
        let flip = flips.iter().find(|row| (row.solution.frequency_hz - hz).abs() < 2e-4).unwrap();
        let settings = settings(Parameter::ExcitationScale, (0.5, 1.05), FLIPS_HZ);
        let (rows, end) = curve(&case, flip, (CurveKind::Flip, Side::Up), &settings);
        assert_eq!(end, CurveEnd::RangeEnd, "{hz}");
        let last = rows.last().unwrap();
        assert_meets_branch(&case, last, Parameter::ExcitationScale, (57.0, FLIPS_HZ), |e| e.flip);
    }
}

/// Grazing of the linear oscillator: the linear amplitude equals the gap, `a F / |1 - w^2 + i c w| = g`,
/// whatever the contact does once it is reached; the multipliers belong to the linear oscillator, with the
/// modulus `exp(-c/(2 f))`.
#[test]
fn grazing_curves_of_the_linear_oscillator_meet_the_closed_form() {
    let amplitude = |hz: f64| {
        let w = std::f64::consts::TAU * hz;
        1.0 / (1.0 - w * w).hypot(0.2 * w)
    };
    let gap = 2.0;
    let linear = law::LinearStop::with_gap(3.0, gap).unwrap();
    let hertz = law::HertzStop::with_gap(30.0, gap).unwrap();
    let laws = [
        Law::Linear(linear),
        Law::Linear(linear.with_damping(0.5).unwrap()),
        Law::Hertz(hertz),
        Law::HuntCrossley(law::HuntCrossleyStop::new(hertz, 0.4).unwrap()),
        Law::Rigid(law::RigidStop::with_gap(0.8, gap).unwrap()),
    ];
    for law in laws {
        let case = oscillator(0.2, 1.0, &[(1.0, law.clone())]);
        let range_hz = (0.05, 0.4);
        // At the grazing of a rigid stop the multipliers jump: it counts as bracketed.
        let rows = branch_in(Segments::Fixed(4), &case, 0.06, range_hz);
        let first = rows.iter().find(|row| row.events.grazing).unwrap();
        for (parameter, range) in [(Parameter::ExcitationScale, (0.3, 3.0)), (Parameter::gap(0), (0.5, 6.0))]
        {
            for side in [Side::Up, Side::Down] {
                let settings = settings(parameter, range, range_hz);
                let (rows, end) =
                    curve(&case, first, (CurveKind::Grazing { contact: None }, side), &settings);
                assert!(rows.len() > 20, "{law:?}");
                assert!(matches!(end, CurveEnd::RangeEnd | CurveEnd::FrequencyRangeEnd), "{law:?}: {end:?}");
                for row in &rows {
                    let hz = row.solution.frequency_hz;
                    let linear = amplitude(hz);
                    let (ratio, force) = match parameter {
                        Parameter::ExcitationScale => (row.parameter * linear / gap, row.parameter),
                        _ => (linear / row.parameter, 1.0),
                    };
                    assert!(
                        (ratio - 1.0).abs() < 1e-8,
                        "{law:?} {parameter:?} at {}: {ratio}",
                        row.parameter
                    );
                    let w = std::f64::consts::TAU * hz;
                    assert_eq!(row.solution.nodes.len(), 4);
                    for node in &row.solution.nodes {
                        let off = node[0].hypot(node[1] / w) / (linear * force) - 1.0;
                        assert!(off.abs() < 1e-8, "{law:?} at {hz} Hz: {off}");
                    }
                    let reached = row.solution.maxima.displacement / (linear * force);
                    assert!((reached - 1.0).abs() < 1e-8, "{law:?}: {reached}");
                    let modulus = (-0.1 / hz).exp();
                    for [re, im] in &row.solution.floquet_multipliers {
                        assert!(
                            (re.hypot(*im) / modulus - 1.0).abs() < 1e-8,
                            "{law:?} at {hz} Hz: {re} {im}"
                        );
                    }
                }
            }
        }
    }
}

/// An orbit that strikes a stop with an impact-speed-dependent law, and grazes another one on the other side.
/// By default one way.
#[test]
fn grazing_curves_beside_a_contact_that_remembers_its_impact_meet_the_branches() {
    let elastic = law::HertzStop::with_gap(20.0, 0.5).unwrap();
    let struck = law::RestitutionStop::new(elastic, law::RestitutionModel::Flores, 0.7).unwrap();
    let grazed = law::LinearStop::with_gap(5.0, 0.8).unwrap();
    let never_open = law::LinearStop::with_preload(1e-3, 5e-3).unwrap();
    let laws = [Law::Restitution(struck), Law::Linear(grazed), Law::Linear(never_open)];
    let case =
        oscillator(0.2, 1.0, &[(1.0, laws[0].clone()), (-1.0, laws[1].clone()), (1.0, laws[2].clone())]);
    let range_hz = (0.25, 0.3);
    let rows = branch(&case, 0.29, range_hz);
    let grazes = |row: &&BranchRow| row.located.iter().flat_map(|l| &l.contacts).any(|c| c.contact == 1);
    let start = rows.iter().find(grazes).unwrap();
    let gap = Parameter::gap(1);
    let ways = [(Side::Up, (0.75, 0.82)), (Side::Down, (0.75, 0.82))];
    for (side, range) in ways.into_iter().take(if extensive() { 2 } else { 1 }) {
        let (rows, end) = curve(
            &case,
            start,
            (CurveKind::Grazing { contact: Some(1) }, side),
            &settings(gap, range, range_hz),
        );
        assert_eq!(end, CurveEnd::RangeEnd);
        // The one that is struck and the one that never opens.
        assert!(rows.iter().all(|row| row.solution.maxima.contacts == 2));
        assert_meets_branch(&case, rows.last().unwrap(), gap, (0.29, range_hz), |events| events.grazing);
    }
}

/// Two modes with two cubic springs, `q_2'' + ... + w_2^2 q_2`, driven so hard that modes interact.
fn two_modes(second: f64, force: f64) -> Case {
    let model = ReducedModel {
        natural_frequencies: vec![1.0, second],
        damping: Mat::from_fn(2, 2, |i, j| if i == j { 0.05 } else { 0.0 }),
        points: vec![PointOutput { name: "mass".into(), shape: vec![1.0, 1.0], support_ratios: vec![0.0] }],
        supports: vec![],
        uniform_acceleration: vec![1.0, 0.0],
    };
    let harmonic = Harmonic { order: 1, amplitude: force, phase: 0.0 };
    let load = Load { support: vec![], forces: vec![HarmonicForce { shape: vec![1.0, 0.3], harmonic }] };
    let spring = |shape: [f64; 2], k| LocalElement {
        name: "spring".into(),
        shape: shape.to_vec(),
        support_ratios: vec![0.0],
        law: Law::Power(law::PowerSpring::cubic(k).unwrap()),
    };
    let springs = vec![spring([1.0, 1.0], 1.0), spring([1.0, -1.0], 0.5)];
    (
        System::new(model, &load, springs).unwrap(),
        Response { shape: vec![1.0, 1.0], support_ratios: vec![0.0] },
    )
}

const TWO_MODES_HZ: (f64, f64) = (0.1, 0.6);

/// The Neimark-Sacker points of the two modes at the force 1.5.
fn first_of(case: &Case, hz: f64) -> BranchRow {
    let found = events(case, 0.11, TWO_MODES_HZ, |events| events.neimark_sacker);
    let places: Vec<f64> = found.iter().map(|row| row.solution.frequency_hz).collect();
    let first = found.into_iter().find(|row| (row.solution.frequency_hz - hz).abs() < 1e-4);
    first.unwrap_or_else(|| panic!("{hz}: {places:?}"))
}

/// By default one way.
#[test]
fn neimark_sacker_curves_meet_branches() {
    let parameter = Parameter::ExcitationScale;
    let case = two_modes(1.5, 1.5);
    let first = first_of(&case, 0.14912);
    let ways = [(Side::Up, (0.7, 1.3)), (Side::Down, (0.8, 1.3))];
    for (side, range) in ways.into_iter().take(if extensive() { 2 } else { 1 }) {
        let settings = settings(parameter, range, TWO_MODES_HZ);
        let (rows, end) = curve(&case, &first, (CurveKind::NeimarkSacker, side), &settings);
        assert_eq!(end, CurveEnd::RangeEnd);
        for row in &rows {
            let off = row.solution.floquet_multipliers.iter().map(|[re, im]| (re.hypot(*im) - 1.0).abs());
            assert!(off.fold(f64::INFINITY, f64::min) < 1e-6);
        }
        let last = rows.last().unwrap();
        assert_meets_branch(&case, last, parameter, (0.11, TWO_MODES_HZ), |e| e.neimark_sacker);
    }
}

/// Where a pair crosses a resonance it is `exp(+-i angle)` of that resonance, and two ways round one curve
/// find the same places. By default round one of them.
#[test]
fn neimark_sacker_curves_pass_resonances() {
    let case = two_modes(1.5, 1.5);
    let settings = settings(Parameter::stiffness(1), (0.05, 3.0), TWO_MODES_HZ);
    let resonances = |hz: f64, side: Side| -> Vec<(u8, f64, f64)> {
        let (rows, _) = curve(&case, &first_of(&case, hz), (CurveKind::NeimarkSacker, side), &settings);
        let marked = rows.iter().filter_map(|row| row.events.resonance.map(|order| (order, row)));
        let check = |(order, row): (u8, &CurveRow)| {
            let expected = [1.0, -1.0, -0.5, 0.0][usize::from(order) - 1];
            let off = row
                .solution
                .floquet_multipliers
                .iter()
                .map(|[re, im]| (re - expected).hypot(im.abs() - (1.0_f64 - expected * expected).sqrt()));
            assert!(off.fold(f64::INFINITY, f64::min) < 1e-6, "{:?}", row.solution.floquet_multipliers);
            (order, row.parameter, row.solution.frequency_hz)
        };
        marked.map(check).collect()
    };
    let ways = [((0.14912, Side::Up), (0.15394, Side::Down)), ((0.14912, Side::Down), (0.15394, Side::Up))];
    for (there, back) in ways.into_iter().take(if extensive() { 2 } else { 1 }) {
        let (there, back) = (resonances(there.0, there.1), resonances(back.0, back.1));
        assert_eq!(there.len(), 2);
        for ((order, parameter, hz), other) in there.iter().zip(&back) {
            assert_eq!(*order, other.0);
            assert!((parameter - other.1).abs() < 1e-6 && (hz - other.2).abs() < 1e-6);
        }
    }
}

/// Where the pair meets at +1 there is no torus any more.
#[test]
fn a_neimark_sacker_curve_ends_at_the_strong_resonance() {
    let case = two_modes(1.5, 1.5);
    let settings = settings(Parameter::ExcitationScale, (0.1, 6.0), TWO_MODES_HZ);
    let first = first_of(&case, 0.14912);
    let (rows, end) = curve(&case, &first, (CurveKind::NeimarkSacker, Side::Down), &settings);
    assert_eq!(end, CurveEnd::Resonance);
    assert_eq!(rows.last().unwrap().events.resonance, Some(1));
}

/// `(1 - w^2)^2 + c^2 w^2 = F^2/g^2`, with impacts on both stops beside it. A start that is some 1e-6 off
/// both, as a corner is known in a wide range of the frequency, belongs to both as well.
#[test]
fn grazing_curves_at_two_rigid_stops_start_beside_the_grazing() {
    const DAMPING: f64 = 0.04;
    let rigid = Law::Rigid(law::RigidStop::with_gap(0.8, 1.0).unwrap());
    let case = oscillator(DAMPING, 0.4, &[(1.0, rigid.clone()), (-1.0, rigid)]);
    let half = 0.5 * DAMPING * DAMPING;
    let hz_of = |force: f64| {
        let root = (half * half - 2.0 * half + force * force).sqrt();
        (1.0 - half - root).sqrt() / std::f64::consts::TAU
    };
    let range_hz = (0.05, 0.15);
    for off in [1e-8, 1e-6, 1e-4] {
        let hz = hz_of(0.4) * (1.0 - off);
        let start = find_start(&case.0, &case.1, hz, 1, &OrbitSettings::for_range(range_hz)).unwrap();
        for side in [Side::Up, Side::Down] {
            let settings = settings(Parameter::ExcitationScale, (0.75, 1.25), range_hz);
            let kind = CurveKind::Grazing { contact: None };
            let orbits = OrbitSettings::default();
            let mut walk =
                CurveWalk::new(&case.0, &case.1, &start, (kind, side), &settings, &orbits).unwrap();
            let mut count = 0;
            let end = loop {
                match walk.step().unwrap() {
                    Ok(row) => {
                        let error = row.solution.frequency_hz / hz_of(0.4 * row.parameter) - 1.0;
                        assert!(error.abs() < 1e-8, "{off}: {error:e} at {}", row.parameter);
                        count += 1;
                    }
                    Err(end) => break end,
                }
            };
            assert_eq!(end, CurveEnd::RangeEnd);
            assert!(count > 20, "{off}: {count}");
        }
    }
}
