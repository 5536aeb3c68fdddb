//! A free bar of two bricks with incompatible modes (C3D8I), by CalculiX 2.20 from `fixtures/bricks.inp`: the
//! amplitudes of these modes are rows of nodes 13 to 18, labelled 1 to 3, which are no displacements.

use std::path::{Path, PathBuf};

use hammerbeam_matrices::{ComponentFiles, MatrixFile, Nodes, read_component, read_nodes};
use hammerbeam_structure::{
    Damping, Matrices, MatrixReport, MatrixSupport, Reduced, Reduction, RowSet, StructureError, SupportRows,
};

/// Density times volume [kg].
const MASS: f64 = 2700.0 * 0.04 * 0.02 * 0.01;
/// Nodes at one end of the bar.
const FOOT: [i64; 4] = [1, 4, 7, 10];

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

fn places(name: &str) -> Nodes {
    read_nodes(&fixture(name)).unwrap()
}

fn structure(name: &str, nodes: Nodes) -> Matrices {
    let file = |end: &str| MatrixFile { path: fixture(&format!("{name}.{end}")), matrix: None, factor: 1.0 };
    let files = ComponentFiles {
        name: String::new(),
        format: None,
        stiffness: file("sti"),
        mass: file("mas"),
        damping: None,
        labels: Some(fixture(&format!("{name}.dof"))),
    };
    Matrices { nodes, ..Matrices::new(vec![read_component(&files).unwrap()], 1 << 30) }
}

fn supported(nodes: Nodes, rows: SupportRows) -> Matrices {
    let support = MatrixSupport { name: "table".into(), rows, along: [0.0, 0.0, 1.0] };
    Matrices { supports: vec![support], ..structure("bricks", nodes) }
}

/// All modes, the table moving.
fn reduced(matrices: &Matrices) -> Result<(Reduced, MatrixReport), StructureError> {
    let reduction = Reduction::Truncation { cut_off_hz: 1e9 };
    matrices.reduce(&[&["table"]], &reduction, &Damping::none(), &[])
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found} instead of {expected}");
}

#[test]
fn mass_and_centre_are_those_of_the_bar() {
    let report = structure("bricks", places("bricks.inp")).survey(12).unwrap().report;
    assert_eq!((report.rows, report.internal_rows, report.unplaced_rows), (54, 18, 0));
    assert!(report.is_free());
    report.mass.unwrap().iter().for_each(|mass| assert_near(*mass, MASS, 1e-9));
    for (found, expected) in report.centre.unwrap().into_iter().zip([0.02, 0.01, 0.005]) {
        assert_near(found, expected, 1e-9);
    }
}

/// With all modes of the free bar the squares of their shares in a translation add up to the mass,
/// `sum_i (phi_i^T M t)^2 = t^T M t`, since t is one of their sums: of a base and of gravity.
#[test]
fn base_and_gravity_move_the_mass_of_the_bar() {
    let mut matrices = supported(places("bricks.inp"), SupportRows::Base);
    matrices.acceleration = Some([1.0, 0.0, 0.0]);
    let (reduced, _) = reduced(&matrices).unwrap();
    for shares in [&reduced.model.supports[0].inertia, &reduced.model.uniform_acceleration] {
        assert_near(shares.iter().map(|share| share * share).sum(), MASS, 1e-9);
    }
}

/// A support of nodes finds the motion of the other rows by statics and knows nothing of places: the shares
/// of the modes in its motion are `Phi^T M Gamma`. Those of a base without the rows of these nodes are
/// `Phi^T M t` but for the mass between both; here that is added by holding the foot as a support as well.
#[test]
fn the_base_does_as_a_support_that_holds_nodes() {
    let foot = RowSet { nodes: FOOT.to_vec(), ..RowSet::default() };
    let of_nodes = supported(places("bricks.inp"), SupportRows::Of(foot.clone()));
    let (by_nodes, _) = reduced(&of_nodes).unwrap();
    let mut of_base = supported(places("bricks.inp"), SupportRows::Of(foot));
    of_base.supports.push(MatrixSupport {
        name: "everything".into(),
        rows: SupportRows::Base,
        along: [0.0, 0.0, 1.0],
    });
    let reduction = Reduction::Truncation { cut_off_hz: 1e9 };
    let groups: [&[&str]; 1] = [&["table", "everything"]];
    let (by_base, _) = of_base.reduce(&groups, &reduction, &Damping::none(), &[]).unwrap();
    let [own, other] = [&by_nodes, &by_base].map(|reduced| &reduced.model.supports[0].inertia);
    let largest = own.iter().fold(0.0_f64, |largest, share| largest.max(share.abs()));
    assert_eq!(own.len(), other.len());
    for (own, other) in own.iter().zip(other) {
        assert!((own.abs() - other.abs()).abs() < 1e-9 * largest, "{own} {other}");
    }
}

/// Without places there is no telling which rows are no displacements, but the free bar shows that some are.
#[test]
fn without_places_it_is_refused_where_a_translation_is_needed() {
    let strains = |matrices: &Matrices| {
        let error = reduced(matrices).unwrap_err();
        assert!(matches!(error, StructureError::TranslationStrains { .. }), "{error}");
        assert!(error.to_string().contains("C3D8I"), "{error}");
    };
    let mut matrices = supported(Nodes::new(), SupportRows::Base);
    strains(&matrices);
    // Held by the study alone.
    matrices.fixed = vec![RowSet { nodes: FOOT.to_vec(), ..RowSet::default() }];
    strains(&matrices);
    let report = structure("bricks", Nodes::new()).survey(12).unwrap().report;
    assert!((report.mass, report.centre) == (None, None) && report.translation_strain.unwrap() > 1e-3);
    // Modes, and supports of nodes, need no translation.
    let foot = RowSet { nodes: FOOT.to_vec(), ..RowSet::default() };
    let [(with, _), (without, _)] = [places("bricks.inp"), Nodes::new()]
        .map(|nodes| reduced(&supported(nodes, SupportRows::Of(foot.clone()))).unwrap());
    assert_eq!(with.tables.clamped_hz, without.tables.clamped_hz);
}

/// A node of the mesh that is only missing on the list moves as the others: at rest it would strain them.
#[test]
fn a_node_of_the_mesh_without_a_place_moves() {
    let mut nodes = places("bar.inp");
    let whole = structure("bar", nodes.clone()).survey(3).unwrap().report;
    nodes.remove(&19).unwrap();
    let report = structure("bar", nodes).survey(3).unwrap().report;
    assert_eq!((report.internal_rows, report.unplaced_rows), (0, 3));
    assert_eq!(report.mass, whole.mass);
}
