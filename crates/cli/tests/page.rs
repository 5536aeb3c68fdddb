//! The page: written by the command, always the same bytes, with clear sentences about what is missing, and
//! opened in a real browser.
//!
//! The browser is driven by a script of the page (`crates/figure/page/test`). It needs Node; its packages, a
//! browser among them, are installed from the lock file where they are missing. Where that cannot be had the
//! test says so and passes, unless `HAMMERBEAM_REQUIRE_BROWSER=1`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "it has to say that it was skipped")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use crate::common::{Workshop, assert_success, stderr, stdout};
use hammerbeam_attractor::{Sample, Simulation};
use hammerbeam_figure::{
    MeasuredMotion, MotionKind, MultiplierRecords, OrbitRecords, Page, PageBranch, PageImpulse, PageLink,
    PageMeasured, PageMeasuredPoint, PageMesh, PageMotion, PageOrbit, PageParameter, PagePlace, PageSection,
    PageSolution, PageStop, PageStructure, ParameterAxis, ResponseQuantity, SectionPlane,
};
use hammerbeam_motion::exact::{ExactIntegrator, ExactSettings};
use hammerbeam_orbit::{Side, states_at_phase};
use hammerbeam_results::Store;
use hammerbeam_study::{Model, StudyFile};
use serde_json::{Value, json};

/// Above most motions of twice the period at 34 Hz, off whose orbits it takes long to read outputs.
const RANGE: &str = "frequency_hz = [34.5, 39.2]";

/// The beam between 34.5 and 39.2 Hz, computed, with the number of its branches: the harmonic one with folds,
/// flips and a grazing, and those of twice the period that leave it, which are found without a search.
fn results() -> (Workshop, Value) {
    let search = "frequencies = 0\ntrials = 0\n[continuation]\nmax_step_hz = 0.02\n";
    let beam = crate::common::BEAM.replace("trials = 0", search);
    let output = "\n[[output]]\nname = \"push\"\nstop = \"stop 1\"\nfigures = [\"maximum\", \"mean\"]\n";
    let study = beam.replacen("frequency_hz = [19.0, 110.0]", RANGE, 1) + output;
    let workshop = Workshop::with(&study);
    let run = workshop.hammerbeam(&["run", "study.toml", "--out", "results", "--json"]);
    assert_success(&run);
    let document: Value = serde_json::from_str(&stdout(&run)).unwrap();
    assert!(document["figures"].as_array().unwrap().contains(&json!("page.html")), "{document}");
    (workshop, document)
}

#[test]
fn the_page_of_a_run_is_the_same_again_opens_in_a_browser_and_says_what_is_missing() {
    let (workshop, document) = results();
    let first = fs::read(workshop.path("results/page.html")).unwrap();
    for jobs in ["1", "3"] {
        let arguments = ["figure", "results", "--kind", "page", "--out", "again", "--jobs", jobs];
        assert_success(&workshop.hammerbeam(&arguments));
        assert!(
            first == fs::read(workshop.path("again/page.html")).unwrap(),
            "other bytes on {jobs} threads"
        );
    }

    let branches = document["branches"].as_array().unwrap();
    assert!(branches.len() > 2, "several branches are drawn");
    let run = json!({
        "path": workshop.path("results/page.html"),
        "branches": branches.len(),
        "first_branch": branches[0]["branch"],
        "range": [34.5, 39.2],
        "multipliers": multipliers(&workshop),
        "courses": histories(&workshop),
    });
    let odd = odd_pages(&workshop);
    in_a_browser(&json!({ "run": run, "odd": odd }));
    while_a_run_writes(&workshop);
    without_anything(&workshop);
}

/// Displacement and velocity of the response point over the first excitation period of the solutions at the
/// beginning and at the end of all branches, whose orbits every page carries, as a simulation from their
/// stored states has them, three times as finely as the page.
fn histories(workshop: &Workshop) -> Value {
    let store = Store::open(&workshop.path("results")).unwrap();
    let file = StudyFile::parse("study.toml", store.about("study").unwrap()).unwrap();
    let model = Model::build(&file).unwrap();
    let motion = ExactSettings::default();
    let branches = store.branches().unwrap();
    let (first, last) = (&branches[0], &branches[branches.len() - 1]);
    let count: u64 = branches.iter().map(|branch| branch.down.solutions + branch.up.solutions).sum();
    let ends = [
        (0, first.start, Side::Down, first.down.solutions),
        (count - 1, last.start, Side::Up, last.up.solutions),
    ];
    let history = |(solution, start, side, of_side): (u64, u32, Side, u64)| {
        let orbit = store.solution(start, side, of_side as u32 - 1).unwrap();
        let mut integrator = ExactIntegrator::new(model.system.clone(), motion).unwrap();
        let states = states_at_phase(&mut integrator, &orbit, 0.0).unwrap();
        let mut simulation =
            Simulation::new(model.system.clone(), orbit.frequency_hz, &states[0], motion).unwrap();
        let (samples, _) = simulation.period(576).unwrap();
        let response = model.response_motion(orbit.frequency_hz);
        let at = |sample: &Sample| {
            let [displacement, velocity, _] = response.at(sample.phase, &sample.state, &sample.forces);
            [displacement, velocity]
        };
        json!({ "solution": solution, "course": samples.iter().map(at).collect::<Vec<_>>() })
    };
    ends.into_iter().filter(|(_, _, _, of_side)| *of_side > 0).map(history).collect()
}

/// The stored multipliers of solutions spread over all branches, with their numbers over all branches end to
/// end.
fn multipliers(workshop: &Workshop) -> Value {
    let store = Store::open(&workshop.path("results")).unwrap();
    let mut keys = Vec::new();
    for branch in store.branches().unwrap() {
        let places = |side: Side, count: u64| (0..count as u32).map(move |number| (side, number));
        let down = places(Side::Down, branch.down.solutions).rev();
        let all = down.chain(places(Side::Up, branch.up.solutions));
        keys.extend(all.map(|(side, number)| (branch.start, side, number)));
    }
    let of = |(number, &(start, side, place)): (usize, &(u32, Side, u32))| {
        json!({
            "solution": number,
            "stored": store.solution(start, side, place).unwrap().floquet_multipliers,
        })
    };
    // An odd stride: where one solution in four has its orbit carried, most of these have not.
    keys.iter().enumerate().step_by((keys.len() / 60) | 1).map(of).collect()
}

/// A walk that has not ended is reported on the page.
fn while_a_run_writes(workshop: &Workshop) {
    let database = crate::common::database(workshop.path("results/results.db"));
    database.execute("UPDATE walk SET end_kind = NULL WHERE id = (SELECT min(id) FROM walk)", []).unwrap();
    database.close().unwrap();
    assert_success(&workshop.hammerbeam(&["figure", "results", "--kind", "page", "--out", "unfinished"]));
    let html = fs::read_to_string(workshop.path("unfinished/page.html")).unwrap();
    let notice = "The run was not finished when this page was drawn; sides of branches under way: 1; ";
    assert!(html.contains(notice));
}

/// Nothing is left to show.
fn without_anything(workshop: &Workshop) {
    let database = crate::common::database(workshop.path("results/results.db"));
    database.execute_batch("DELETE FROM solution; DELETE FROM walk; DELETE FROM start;").unwrap();
    database.close().unwrap();
    let drawn = workshop.hammerbeam(&["figure", "results", "--kind", "page", "--out", "drawn"]);
    assert_eq!(drawn.status.code(), Some(1));
    let message = stderr(&drawn);
    assert!(message.contains("results holds nothing of what was asked for to draw"), "{message}");
}

/// Pages that no run gives: each with what it has to say.
fn odd_pages(workshop: &Workshop) -> Value {
    let point = PageSolution {
        frequency_hz: 20.0,
        displacement_m: 1e-3,
        force_n: f64::INFINITY,
        leading_multiplier: [f64::INFINITY, 0.0],
        ..PageSolution::default()
    };
    let one = |id| PageBranch { id, period_multiple: id, solutions: vec![point], ..PageBranch::default() };
    let lone = Page {
        title: "A branch of one point & <nothing> else".to_owned(),
        frequency_range_hz: (10.0, 30.0),
        branches: vec![one(1), one(2), PageBranch { id: 3, period_multiple: 1, ..PageBranch::default() }],
        ..Page::default()
    };
    let empty = Page {
        notice: "The run was not finished when this page was drawn.".to_owned(),
        frequency_range_hz: (10.0, 30.0),
        ..Page::default()
    };
    let periods = Page {
        frequency_range_hz: (10.0, 30.0),
        branches: (1..10).map(straight).collect(),
        ..Page::default()
    };
    let (none, two) = (OrbitRecords::default(), two_orbits());
    let pages = [
        ("nine periods", (periods, &none), 9, vec!["1/9 subharmonic"], "No orbit of this branch"),
        (
            "a branch of one point",
            (lone, &none),
            2,
            vec!["& <nothing> else", "1/2 subharmonic"],
            "No orbit of this branch",
        ),
        (
            "an empty page",
            (empty, &none),
            0,
            vec!["No periodic solution is stored.", "The run was not finished"],
            "No periodic solution",
        ),
        (
            "everything at once",
            (everything(), &two),
            1,
            vec!["measured, periodic", "chaotic motion", "Poincaré section", "50 points at phase 0"],
            "the orbit of",
        ),
        (
            "a mesh",
            (of_a_mesh(), &two),
            1,
            vec!["Displacements are drawn", "larger than lengths"],
            "the orbit of",
        ),
    ];
    let write = |(name, (page, orbits), branches, says, orbit): (
        &str,
        (Page, &OrbitRecords),
        usize,
        Vec<&str>,
        &str,
    )| {
        let path = workshop.path(&format!("{}.html", name.replace(' ', "-")));
        fs::write(&path, page.pack().html(orbits)).unwrap();
        json!({ "name": name, "path": path, "branches": branches, "says": says, "orbit": orbit })
    };
    pages.into_iter().map(write).collect()
}

/// The page with everything, whose structure is a mesh: a square that two modes bend out of its plane.
fn of_a_mesh() -> Page {
    let still = || [vec![0.0; 2], vec![0.0; 2], vec![0.0; 2]];
    let moving = |first: f64, second: f64| [vec![0.0; 2], vec![0.0; 2], vec![first, second]];
    let mesh = PageMesh {
        nodes: vec![[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.1, 0.0], [0.0, 0.1, 0.0]],
        shapes: vec![still(), moving(1.0, 0.0), moving(0.0, 1.0), still()],
        support_ratios: (0..4).map(|_| [vec![0.0], vec![0.0], vec![1.0]]).collect(),
        lines: vec![[0, 1], [1, 2], [2, 3], [3, 0]],
        places: vec![Some(1), Some(2)],
    };
    let mut page = everything();
    page.structure.as_mut().unwrap().mesh = Some(mesh);
    page
}

/// A branch of that period, which runs straight over all frequencies at a height of its own.
fn straight(period_multiple: u32) -> PageBranch {
    let solution = |frequency_hz| PageSolution {
        frequency_hz,
        displacement_m: 1e-3 * f64::from(period_multiple + 20),
        stable: true,
        ..PageSolution::default()
    };
    let solutions = [10.0, 30.0].map(solution).to_vec();
    PageBranch { id: period_multiple, period_multiple, solutions, ..PageBranch::default() }
}

/// Orbits of the first two solutions of that page, the second one with impacts.
fn two_orbits() -> OrbitRecords {
    let wave = |count: u32, size: f64| -> Vec<f64> {
        (0..count).map(|k| size * (std::f64::consts::TAU * f64::from(k) / f64::from(count)).cos()).collect()
    };
    let pairs = |size: f64| wave(60, size).into_iter().map(|value| [value, value]).collect::<Vec<_>>();
    let impulse = PageImpulse {
        element: 1,
        cycles: 0.25,
        impulse_n_s: -0.125,
        displacement_m: 0.5e-3,
        velocity_m_s: [0.75, -0.5],
    };
    let orbit = PageOrbit {
        duration_s: 0.1,
        impulses: vec![impulse],
        displacement_m: wave(60, 1e-3),
        velocity_m_s: wave(60, 1.0),
        in_contacts: vec![(3, 1e-3, 0.5), (3, 1.1e-3, -0.5)],
        acceleration_m_s2: pairs(10.0),
        forces_n: vec![pairs(1.0), pairs(0.0)],
        support_m: wave(12, 2e-4),
        modes: vec![wave(30, 1e-3), wave(30, -5e-4)],
        spectrum_m_s2: vec![10.0, 0.0, f64::NAN],
    };
    let mut orbits = OrbitRecords::default();
    assert!(orbits.insert(0, orbit.record(), usize::MAX));
    let forces_n = vec![vec![[0.0; 2]; 60]; 2];
    let rigid = PageOrbit { impulses: vec![impulse; 5], forces_n, ..orbit };
    assert!(orbits.insert(1, rigid.record(), usize::MAX));
    orbits
}

/// Masses with stops on both sides, solutions with multipliers that are not finite, a section, measured
/// points.
fn everything() -> Page {
    let solution = |k: u32| PageSolution {
        frequency_hz: 10.0 + f64::from(k),
        displacement_m: 1e-3 * f64::from(k + 1),
        leading_multiplier: [f64::NAN, 0.0],
        stable: k > 5,
        fold: k == 5,
        ..PageSolution::default()
    };
    let over_the_gap =
        |k: u32| PageSolution { frequency_hz: 20.0, parameter: 1e-8 * f64::from(k), ..solution(k) };
    let mut multipliers = MultiplierRecords::default();
    (0..20).for_each(|_| {
        multipliers.push(&[[f64::INFINITY, 0.0], [f64::NAN, 0.0], [-250.0, 0.0], [0.3, 0.4], [0.3, -0.4]]);
    });
    let place = |name: &str, at: f64, shape: [f64; 2]| PagePlace {
        name: name.to_owned(),
        at,
        shape: shape.to_vec(),
        support_ratios: vec![0.0],
    };
    let stop = |place: u32, other: Option<u32>, levels: Vec<(f64, bool)>| PageStop {
        name: format!("stop {place}"),
        element: place,
        place,
        other,
        rides: None,
        levels,
    };
    Page {
        title: "Two masses".to_owned(),
        point: "first".to_owned(),
        frequency_range_hz: (10.0, 30.0),
        parameters: vec![PageParameter {
            axis: ParameterAxis { title: "Gap of stop 1".to_owned(), unit: "m".to_owned() },
            frequency_hz: 20.0,
        }],
        branches: vec![
            PageBranch {
                id: 7,
                period_multiple: 1,
                over: 0,
                ends: ["one".to_owned(), "other".to_owned()],
                solutions: (0..20).map(solution).collect(),
            },
            PageBranch {
                id: 8,
                period_multiple: 2,
                over: 1,
                ends: ["one".to_owned(), "other".to_owned()],
                solutions: (0..5).map(over_the_gap).collect(),
            },
        ],
        multipliers,
        structure: Some(PageStructure {
            is_beam: false,
            places: vec![place("first", 0.0, [1.0, 0.0]), place("second", 1.0, [0.0, 1.0])],
            stops: vec![
                stop(0, Some(1), vec![(5e-4, true)]),
                stop(1, None, vec![(1e-3, true), (-1e-3, false)]),
            ],
            links: [[Some(0), None], [Some(0), Some(1)], [None, Some(1)], [Some(0), Some(1)]]
                .into_iter()
                .enumerate()
                .map(|(k, ends)| PageLink { ends, is_damper: k == 3 })
                .collect(),
            eigenfrequencies_hz: vec![12.0, 25.0],
            supports: vec!["ground".to_owned()],
            ground: Some(0),
            mesh: None,
        }),
        motions: vec![PageMotion { frequency_hz: 15.0, kind: MotionKind::Chaotic, displacement_m: 12e-3 }],
        chaotic_ranges_hz: vec![(14.0, 16.0), (28.0, 28.0)],
        sections: sections(),
        measured: vec![measured()],
        ..Page::default()
    }
}

/// Sections of all kinds, by their frequencies, in the first of them a coordinate without a range.
fn sections() -> Vec<PageSection> {
    let circle = |count: u32| {
        let angle = move |k: u32| std::f64::consts::TAU * f64::from(k) / f64::from(count);
        (0..count).map(move |k| (1e-3 * angle(k).cos(), 0.1 * angle(k).sin()))
    };
    let chaotic = PageSection { kind: Some(MotionKind::Chaotic), ..PageSection::default() };
    vec![
        PageSection {
            frequency_hz: 12.0,
            origin: "sweep 2, up".to_owned(),
            kind: Some(MotionKind::QuasiPeriodic),
            plane: SectionPlane::NextDisplacement,
            points: vec![(1e-3, 0.1), (1e-3, 0.2)],
            ..PageSection::default()
        },
        PageSection {
            frequency_hz: 15.0,
            origin: "exponents 1".to_owned(),
            exponent_per_s: Some((0.25, 0.01)),
            dimension: Some(f64::NAN),
            points: circle(200).chain([(f64::NAN, 0.0)]).collect(),
            ..chaotic.clone()
        },
        PageSection {
            frequency_hz: 15.0,
            origin: "sweep 2, up".to_owned(),
            plane: SectionPlane::NextDisplacement,
            points: circle(63).collect(),
            ..chaotic.clone()
        },
        PageSection { frequency_hz: 28.0, points: circle(50).collect(), ..chaotic },
    ]
}

/// Points of each kind off the branch, one of them without a place, and one beside a solution.
fn measured() -> PageMeasured {
    let point = |motion, measured, shifted| PageMeasuredPoint {
        origin: "points.csv__line_2".to_owned(),
        motion,
        period_multiple: (motion == MeasuredMotion::Periodic).then_some(2),
        measured,
        shifted,
        verdict: "too-far".to_owned(),
    };
    PageMeasured {
        name: "compare".to_owned(),
        quantity: ResponseQuantity::Displacement,
        note: "They were compared with branches behind a filter.".to_owned(),
        points: vec![
            point(MeasuredMotion::Periodic, (22.0, 3e-3), (24.0, 4e-3)),
            point(MeasuredMotion::Aperiodic, (25.0, 5e-3), (26.0, 6e-3)),
            point(MeasuredMotion::Periodic, (19.0, 10e-3), (20.2, 11e-3)),
            point(MeasuredMotion::Unknown, (13.0, 9e-3), (13.0, f64::INFINITY)),
        ],
    }
}

/// Runs the script of the page over these pages.
fn in_a_browser(pages: &Value) {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../figure/page");
    let skip = |reason: &str| {
        assert!(
            std::env::var("HAMMERBEAM_REQUIRE_BROWSER").as_deref() != Ok("1"),
            "no browser test: {reason}"
        );
        eprintln!("the page was not opened in a browser: {reason}");
    };
    let version = Command::new("node").arg("--version").output();
    let Ok(version) = version.map(|output| stdout(&output)) else { return skip("there is no Node") };
    let major = version.trim_start_matches('v').split('.').next().and_then(|major| major.parse::<u32>().ok());
    if major.is_none_or(|major| major < 20) {
        return skip(&format!("Node 20 is needed, this is {}", version.trim()));
    }
    if !source.join("node_modules/.package-lock.json").is_file() {
        let installed = Command::new("npm").args(["ci", "--ignore-scripts"]).current_dir(&source).output();
        match installed {
            Ok(output) if output.status.success() => {}
            Ok(output) => return skip(&format!("its packages cannot be installed: {}", stderr(&output))),
            Err(error) => return skip(&format!("npm cannot be started: {error}")),
        }
    }
    let run = |arguments: &[&str]| {
        let output = Command::new("node")
            .args(arguments)
            .current_dir(&source)
            .env("HAMMERBEAM_PAGES", pages.to_string())
            .env("HAMMERBEAM_PICTURES", pictures())
            .output()
            .unwrap();
        assert!(output.status.success(), "{arguments:?}\n{}\n{}", stdout(&output), stderr(&output));
        stdout(&output)
    };
    run(&["node_modules/typescript/bin/tsc", "--noEmit"]);
    run(&["build.mjs", "--compare"]);
    let plain = ["ticks", "plane", "masses", "first"].map(|name| format!("test/{name}.test.mjs"));
    run(&[&["--test"], &plain.each_ref().map(String::as_str)[..]].concat());
    // One browser for all of them.
    let report = run(&["--test", "--test-reporter=tap", "test/page/all.test.mjs"]);
    let skipped: Vec<&str> = report.lines().filter(|line| line.contains("# SKIP")).collect();
    if let Some(line) = skipped.first() {
        skip(line);
    }
}

/// Among the build products.
fn pictures() -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("page")
}
