//! A bar of four 20-node bricks, computed by CalculiX 2.20 from `fixtures/bar.inp`: its matrices, and the
//! frequencies that it printed for the same deck with plain `*FREQUENCY`.

use std::path::{Path, PathBuf};

use hammerbeam_matrices::{ComponentFiles, MatrixFile, read_component, read_nodes};
use hammerbeam_structure::{Along, Damping, Direction, Matrices, MatrixPoint, PointPlace, Reduction};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

fn bar() -> Matrices {
    let file = |name: &str| MatrixFile { path: fixture(name), matrix: None, factor: 1.0 };
    let files = ComponentFiles {
        name: String::new(),
        format: None,
        stiffness: file("bar.sti"),
        mass: file("bar.mas"),
        damping: None,
        labels: Some(fixture("bar.dof")),
    };
    let tip = PointPlace::Node { node: 3, along: Along::Row(Direction::Translation(1)) };
    Matrices {
        nodes: read_nodes(&fixture("bar.inp")).unwrap(),
        points: vec![MatrixPoint { name: "tip".into(), place: tip }],
        ..Matrices::new(vec![read_component(&files).unwrap()], 1 << 30)
    }
}

/// Printed with seven digits; the bar is square, so bending modes come in pairs. Its mass is singular.
#[test]
fn frequencies_are_those_that_calculix_prints() {
    let printed: [f64; 6] = [526.8666, 526.8666, 1967.433, 3267.506, 4124.436, 4124.436];
    let reduction = Reduction::FreeInterface { cut_off_hz: 5000.0 };
    let (reduced, report) = bar().reduce(&[], &reduction, &Damping::none(), &["tip"]).unwrap();
    assert_eq!(reduced.tables.clamped_hz.len(), printed.len());
    for (found, printed) in reduced.tables.clamped_hz.iter().zip(printed) {
        let half = 0.5 * 10.0_f64.powf(printed.log10().floor() - 6.0);
        assert!((found - printed).abs() <= half, "{found} {printed}");
    }
    assert_eq!((report.rows, report.rigid_modes, report.parts), (90, 0, 1));
    // Static answers of a free interface are exact, whatever is deleted.
    assert!(reduced.tables.flexibility_errors[0].relative.abs() < 1e-9, "{:?}", reduced.tables);
}

/// Density 7800 kg/m^3, 400 mm by 100 mm by 100 mm; the mass at the held nodes is not in the matrices.
#[test]
fn mass_is_that_of_the_bar_without_the_held_nodes() {
    let (_, report) =
        bar().reduce(&[], &Reduction::Truncation { cut_off_hz: 5000.0 }, &Damping::none(), &[]).unwrap();
    let mass = report.mass.unwrap();
    let whole = 7800.0 * 0.4 * 0.1 * 0.1;
    assert!(mass.iter().all(|mass| (0.5 * whole..whole).contains(mass)), "{mass:?} {whole}");
    assert!((mass[0] - mass[2]).abs() < 1e-9 * whole);
}
