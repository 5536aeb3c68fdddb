//! Beams that bend in two planes: closed forms in each, and solutions that turn with their loads.

use std::f64::consts::{PI, TAU};

use approx::assert_relative_eq;
use hammerbeam_motion::{
    Stretch,
    exact::{ExactIntegrator, ExactSettings},
};
use hammerbeam_study::{Model, StudyFile};

/// A tube of 1 m, clamped, and free at its tip.
const LENGTH: f64 = 1.0;
const OUTER: f64 = 0.02;
const WALL: f64 = 0.002;
const MODULUS: f64 = 2.1e11;
const DENSITY: f64 = 7800.0;

fn tube(planes: u32, rest: &str) -> String {
    format!(
        "[structure]\nkind = \"beam\"\nplanes = {planes}\nlength_m = {LENGTH:?}\nelements = 40\n\
         section = {{ outer_diameter_m = {OUTER:?}, wall_m = {WALL:?} }}\nyoungs_modulus_pa = {MODULUS:e}\n\
         density_kg_m3 = {DENSITY:?}\nleft = \"clamped\"\nright = \"free\"\n\
         [[structure.point]]\nname = \"tip\"\nat_m = 1.0\nmass_kg = 0.3\ndamper_n_s_m = 2.0\n\
         [reduction]\nmethod = \"free-interface\"\ncut_off_hz = 500.0\n[damping]\nmodal_ratio = 0.01\n{rest}"
    )
}

fn built(text: String) -> Model {
    Model::build(&StudyFile::parse("study", text).unwrap_or_else(|error| panic!("{error}"))).unwrap()
}

/// Complex displacement of points in the steady motion: at the phases 0 and 3/4, where `cos` and `-sin` are
/// one.
fn steady(model: &Model, points: &[&str]) -> Vec<[f64; 2]> {
    let mut exact = ExactIntegrator::new(model.system.clone(), ExactSettings::default()).unwrap();
    let at = |exact: &mut ExactIntegrator, start: f64| {
        exact.steady_state(&Stretch { frequency_hz: 31.0, start, end: start + 1.0 })
    };
    let states = [at(&mut exact, 0.0), at(&mut exact, 0.75)];
    let of_point = |name: &&str| {
        let shape = &model.system.model().point(name).unwrap().shape;
        states.each_ref().map(|state| shape.iter().zip(state).map(|(phi, q)| phi * q).sum())
    };
    points.iter().map(of_point).collect()
}

/// `(beta l)^2/(2 pi l^2) sqrt(E I/(rho A))` with the roots of `1 + cos cosh`; the elements of cubic shape
/// are at most 2e-6 above, `(beta l/n)^4/1440` of the third mode.
#[test]
fn each_frequency_of_a_cantilever_occurs_in_both_planes() {
    let text = tube(2, "[response]\npoint = \"tip.z\"\n");
    let model = built(text.replace("mass_kg = 0.3\ndamper_n_s_m = 2.0\n", ""));
    let inner = OUTER - 2.0 * WALL;
    let radius_squared = (OUTER * OUTER + inner * inner) / 16.0;
    let found = &model.tables.clamped_hz;
    for (pair, root) in
        found.chunks_exact(2).zip([1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438])
    {
        let exact = root * root / (TAU * LENGTH * LENGTH) * (MODULUS / DENSITY * radius_squared).sqrt();
        assert_eq!(pair[0], pair[1]);
        assert_relative_eq!(pair[0], exact, max_relative = 2e-6);
    }
    let modes = &model.system.model().natural_frequencies;
    assert!(modes.chunks_exact(2).all(|pair| pair[0] == pair[1]));
}

/// A force along the direction `a` in the cross-section moves the tip along `a`, as the same force does in
/// one plane.
#[test]
fn a_turned_load_gives_the_turned_motion() {
    let one = built(tube(
        1,
        "[excitation]\nkind = \"force\"\nat = \"tip\"\namplitude_n = 5.0\nfrequency_hz = [20.0, 40.0]\n",
    ));
    let straight = steady(&one, &["tip"])[0];
    for angle in [0.0, 0.7, PI / 2.0, 2.5] {
        let (sin, cos): (f64, f64) = f64::sin_cos(angle);
        let force = |at: &str, amplitude: f64| {
            let (size, phase) = (amplitude.abs(), if amplitude < 0.0 { PI } else { 0.0 });
            let entry = format!("{{ at = \"{at}\", amplitude_n = {size:?}, phase_rad = {phase:?} }},\n");
            if size > 0.0 { entry } else { String::new() }
        };
        let forces = force("tip.y", 5.0 * cos) + &force("tip.z", 5.0 * sin);
        let two = built(tube(
            2,
            &format!(
                "[excitation]\nkind = \"force\"\nfrequency_hz = [20.0, 40.0]\nforce = [\n{forces}]\n\
                 [response]\npoint = \"tip.y\"\n"
            ),
        ));
        let turned = steady(&two, &["tip.y", "tip.z"]);
        let size = straight[0].hypot(straight[1]);
        for (own, straight) in [0, 1].map(|k| ([turned[0][k], turned[1][k]], straight[k])) {
            assert!((own[0] - cos * straight).abs() < 1e-13 * size, "{angle}: {own:?}, {straight}");
            assert!((own[1] - sin * straight).abs() < 1e-13 * size, "{angle}: {own:?}, {straight}");
        }
    }
}

/// Both ends of a pinned tube move in the plane y: the plane z is at rest, and y moves as a tube with one
/// plane does.
#[test]
fn supports_move_the_plane_that_is_named() {
    let text = |planes: u32, ends: &str, point: &str| {
        tube(
            planes,
            &format!(
                "[excitation]\nkind = \"support-motion\"\nat = {ends}\namplitude_m = 1e-3\n\
                 frequency_hz = [20.0, 40.0]\n[response]\npoint = \"{point}\"\n"
            ),
        )
        .replace("right = \"free\"", "right = \"pinned\"")
        .replace("at_m = 1.0\n", "at_m = 0.6\n")
    };
    let two = built(text(2, "[\"left.y\", \"right.y\"]", "tip.y"));
    let one = built(text(1, "[\"left\", \"right\"]", "tip"));
    let (moved, expected) = (steady(&two, &["tip.y", "tip.z"]), steady(&one, &["tip"]));
    assert_eq!(moved[1], [0.0, 0.0]);
    for (own, expected) in moved[0].iter().zip(expected[0]) {
        assert_relative_eq!(*own, expected, max_relative = 1e-9);
    }
    assert_eq!(two.system.model().point("tip.z").unwrap().support_ratios, [0.0]);
}

/// What has no plane, or does not bend alike in both, is refused with a sentence.
#[test]
fn names_without_a_plane_and_oblong_sections_are_refused() {
    let refused = |text: String| StudyFile::parse("study", text).unwrap_err().to_string();
    let message = refused(tube(2, "[response]\npoint = \"tip\"\n"));
    assert!(message.contains("tip.y") && message.contains("tip.z"), "{message}");
    let section = format!("{{ outer_diameter_m = {OUTER:?}, wall_m = {WALL:?} }}");
    let oblong =
        tube(2, "[response]\npoint = \"tip.y\"\n").replace(&section, "{ width_m = 0.03, height_m = 0.02 }");
    assert!(refused(oblong.clone()).contains("not in both alike"));
    let square = oblong.replace("width_m = 0.03", "width_m = 0.02");
    StudyFile::parse("study", square).unwrap();
}
