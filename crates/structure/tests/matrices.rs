//! Structures given as matrices: against beams and masses that are assembled here, and closed forms.

use std::f64::consts::TAU;

use hammerbeam_structure::{
    Along, Connection, Damping, Direction, Entry, GROUND, Lumped, LumpedMass, Matrices, MatrixComponent,
    MatrixPoint, MatrixSupport, PointPlace, Reduced, ReducedModel, Reduction, RowLabel, RowSet, Structure,
    StructureError, SupportRows, SymmetricMatrix,
};

fn matrix(size: usize, entries: &[(usize, usize, f64)]) -> SymmetricMatrix {
    let entry =
        |&(row, column, value): &(usize, usize, f64)| Entry { row: row as u32, column: column as u32, value };
    SymmetricMatrix::from_entries(size, &entries.iter().map(entry).collect::<Vec<_>>())
}

fn of_matrices(stiffness: SymmetricMatrix, mass: SymmetricMatrix) -> Matrices {
    let component = MatrixComponent {
        name: String::new(),
        stiffness,
        mass,
        damping: None,
        labels: Vec::new(),
        precision: 1.2e-16,
    };
    Matrices::new(vec![component], 1 << 30)
}

fn at_row(name: &str, row: usize) -> MatrixPoint {
    MatrixPoint { name: name.into(), place: PointPlace::Row { component: 0, row } }
}

fn frequencies(matrices: &Matrices, cut_off_hz: f64) -> Result<Vec<f64>, StructureError> {
    let reduction = Reduction::Truncation { cut_off_hz };
    matrices.reduce(&[], &reduction, &Damping::none(), &[]).map(|(reduced, _)| reduced.tables.clamped_hz)
}

/// Matrices of a structure, its points by row, a name of it moving in its first direction.
fn exported(structure: &Structure, support: &str) -> Matrices {
    let exported = structure.exported();
    let row_of = |name: &str| exported.points.iter().find(|(known, _)| known == name).unwrap().1;
    let moving = row_of(support);
    let along = if exported.labels[moving].direction == Direction::Translation(1) { 1 } else { 0 };
    let mut direction = [0.0; 3];
    direction[along] = 1.0;
    let held = exported.held.iter().copied().filter(|row| *row != moving).collect();
    let is_free = |row: &usize| *row != moving && !exported.held.contains(row);
    let mut matrices = of_matrices(exported.stiffness.clone(), exported.mass.clone());
    matrices.components[0].damping = exported.damping.clone();
    matrices.components[0].labels = exported.labels.clone();
    matrices.points = exported
        .points
        .iter()
        .filter(|(_, row)| is_free(row))
        .map(|(name, row)| at_row(name, *row))
        .collect();
    matrices.supports = vec![MatrixSupport {
        name: support.into(),
        rows: SupportRows::Of(RowSet { rows: vec![moving], ..RowSet::default() }),
        along: direction,
    }];
    matrices.fixed = vec![RowSet { rows: held, ..RowSet::default() }];
    matrices
}

#[track_caller]
fn assert_alike(found: &ReducedModel, expected: &ReducedModel, tolerance: f64) {
    let close = |what: &str, a: f64, b: f64, size: f64| {
        assert!((a - b).abs() <= tolerance * size, "{what}: {a} instead of {b}, size {size}");
    };
    assert_eq!(found.dof(), expected.dof());
    for mode in 0..expected.dof() {
        let (a, b) = (found.natural_frequencies[mode], expected.natural_frequencies[mode]);
        close("frequency", a, b, b);
        for point in &found.points {
            let other = expected.point(&point.name).unwrap();
            let size = other.shape.iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
            close("shape", point.shape[mode], other.shape[mode], size);
        }
        for (support, other) in found.supports.iter().zip(&expected.supports) {
            let size = |values: &[f64]| values.iter().fold(1e-12_f64, |size, entry| size.max(entry.abs()));
            close("inertia", support.inertia[mode], other.inertia[mode], size(&other.inertia));
            close("damping", support.damping[mode], other.damping[mode], size(&other.damping));
        }
    }
    for point in &found.points {
        let other = expected.point(&point.name).unwrap();
        for (a, b) in point.support_ratios.iter().zip(&other.support_ratios) {
            close("support ratio", *a, *b, 1.0);
        }
    }
}

fn paper_beam() -> Structure {
    let mut beam = crate::common::paper_beam();
    beam.points[0].damper = 0.3;
    beam.structure().unwrap()
}

/// The stiffness is assembled and rounded, so low modes agree to the rounding of stiff elements and not to
/// the last digit: `eps |phi|^T |K| |phi| / w^2` is 1e-8 at worst for the first, and much less in fact.
#[test]
fn the_beam_of_the_paper_is_the_same_as_matrices() {
    let structure = paper_beam();
    let (reduction, damping) = (Reduction::FreeInterface { cut_off_hz: 1000.0 }, Damping::modal(0.015));
    let expected = structure.clone().with_support_motion(&["left"]).unwrap();
    let expected = expected.reduce(&reduction, &damping, &["contact"]).unwrap();
    let (found, report) =
        exported(&structure, "left").reduce(&[&["left"]], &reduction, &damping, &["contact"]).unwrap();
    assert_alike(&found.model, &expected.model, 1e-9);
    assert_eq!(report.rigid_modes, 0);
    let flexibility = |reduced: &Reduced| reduced.tables.flexibility_errors[0].clone();
    assert!((flexibility(&found).full / flexibility(&expected).full - 1.0).abs() < 1e-9);
}

#[test]
fn masses_between_springs_are_the_same_as_matrices() {
    let link = |a: &str, b: &str, constant: f64| Connection { between: [a.into(), b.into()], constant };
    let mass = |name: &str, mass: f64| LumpedMass { name: name.into(), mass };
    let lumped = Lumped {
        masses: vec![mass("a", 1.0), mass("b", 0.5), mass("c", 2.0)],
        springs: vec![link("a", GROUND, 1000.0), link("a", "b", 500.0), link("b", "c", 300.0)],
        dampers: vec![link("b", "c", 0.2), link("a", GROUND, 0.1)],
    };
    let structure = lumped.structure().unwrap();
    let expected = structure.clone().with_support_motion(&[GROUND]).unwrap();
    let expected = expected.reduce(&Reduction::None, &Damping::none(), &["a"]).unwrap();
    let matrices = exported(&structure, GROUND);
    let (found, _) = matrices.reduce(&[&[GROUND]], &Reduction::None, &Damping::none(), &["a"]).unwrap();
    assert_alike(&found.model, &expected.model, 1e-12);
    // The same with the ground left out of the matrices, and everything following it.
    let exported = structure.exported();
    let keep = |matrix: &SymmetricMatrix| {
        let entries: Vec<_> = matrix.entries().filter(|(row, column, _)| *row < 3 && *column < 3).collect();
        self::matrix(3, &entries)
    };
    let mut base = of_matrices(keep(&exported.stiffness), keep(&exported.mass));
    base.components[0].labels = exported.labels[..3].to_vec();
    base.points = matrices.points.clone();
    base.supports =
        vec![MatrixSupport { name: "base".into(), rows: SupportRows::Base, along: [1.0, 0.0, 0.0] }];
    let undamped = Lumped { dampers: Vec::new(), ..lumped }.structure().unwrap();
    let expected = undamped.with_support_motion(&[GROUND]).unwrap();
    let expected = expected.reduce(&Reduction::None, &Damping::none(), &["a"]).unwrap();
    let (found, _) = base.reduce(&[&["base"]], &Reduction::None, &Damping::none(), &["a"]).unwrap();
    assert_alike(&found.model, &expected.model, 1e-12);
}

/// A base that was left out of the matrices cannot be let go: the basis is that of the structure on it. It
/// is exact in its kept modes `phi_k = sin((2 k - 1) i pi/(2 n + 1))`, in what drives them, `phi_k^T M 1`,
/// and in the static answer of the last mass, `n` springs in series.
#[test]
fn free_interface_modes_on_a_base_that_was_left_out_are_those_of_the_structure_on_it() {
    let n = 8;
    let stiff: Vec<_> = (0..n)
        .flat_map(|row| {
            let own = (row, row, if row + 1 < n { 2.0 } else { 1.0 });
            [Some(own), (row > 0).then(|| (row, row - 1, -1.0))]
        })
        .flatten()
        .collect();
    let heavy: Vec<_> = (0..n).map(|row| (row, row, 1.0)).collect();
    let mut chain = of_matrices(matrix(n, &stiff), matrix(n, &heavy));
    let label = |node: usize| RowLabel::physical(node as i64 + 1, Direction::Translation(2));
    chain.components[0].labels = (0..n).map(label).collect();
    chain.points = vec![at_row("end", n - 1)];
    chain.supports =
        vec![MatrixSupport { name: "base".into(), rows: SupportRows::Base, along: [0.0, 0.0, 1.0] }];
    let angle = |mode: usize| (2.0 * mode as f64 - 1.0) * std::f64::consts::PI / (2.0 * n as f64 + 1.0);
    let w = |mode: usize| 2.0 * (0.5 * angle(mode)).sin();
    let cut_off_hz = 0.5 * (w(3) + w(4)) / TAU;
    for reduction in [Reduction::FreeInterface { cut_off_hz }, Reduction::MacNeal { cut_off_hz }] {
        let (found, _) = chain.reduce(&[&["base"]], &reduction, &Damping::none(), &["end"]).unwrap();
        let model = found.model;
        assert_eq!(model.dof(), 4);
        let end = &model.point("end").unwrap().shape;
        for mode in 1..=3 {
            assert!((model.natural_frequencies[mode - 1] / w(mode) - 1.0).abs() < 1e-12);
            let shape = |mass: usize| (mass as f64 * angle(mode)).sin();
            let norm = (0.25 * (2.0 * n as f64 + 1.0)).sqrt();
            let driven = (1..=n).map(shape).sum::<f64>() / norm;
            assert!((end[mode - 1].abs() - (shape(n) / norm).abs()).abs() < 1e-12);
            assert!((model.supports[0].inertia[mode - 1].abs() - driven.abs()).abs() < 1e-12);
        }
        let flexibility = &found.tables.flexibility_errors[0];
        assert!((flexibility.full - n as f64).abs() < 1e-12 * n as f64);
        assert!(flexibility.relative.abs() < 1e-12);
    }
}

/// A chain of `n` unit masses on unit springs, both ends held: `w_k = 2 sin(k pi / (2 n + 2))`. Two chains
/// that nothing joins have every mode twice, and are too long to be solved whole.
#[test]
fn modes_by_lanczos_are_those_of_the_closed_form_and_doubled_ones_are_found() {
    let n = 500;
    let (mut stiff, mut heavy) = (Vec::new(), Vec::new());
    for row in 0..2 * n {
        stiff.push((row, row, 2.0));
        heavy.push((row, row, 1.0));
        if row % n > 0 {
            stiff.push((row, row - 1, -1.0));
        }
    }
    let w = |k: usize| 2.0 * (k as f64 * std::f64::consts::PI / (2.0 * n as f64 + 2.0)).sin();
    let cut_off = 0.5 * (w(20) + w(21)) / TAU;
    let found = frequencies(&of_matrices(matrix(2 * n, &stiff), matrix(2 * n, &heavy)), cut_off).unwrap();
    assert_eq!(found.len(), 40);
    for (place, found) in found.iter().enumerate() {
        let expected = w(place / 2 + 1) / TAU;
        assert!((found / expected - 1.0).abs() < 1e-9, "{place}: {found} {expected}");
    }
}

/// A bar of `n` springs in a row, a mass at every second joint: the massless ones double the compliance, so
/// it is a free chain of half as many masses on half as stiff springs. One mode is a rigid-body one.
#[test]
fn rigid_bodies_and_massless_coordinates_are_no_trouble_to_lanczos() {
    let (masses, size) = (451, 901);
    let (mut stiff, mut heavy) = (Vec::new(), Vec::new());
    for row in 1..size {
        stiff.extend([(row, row, 1.0), (row - 1, row - 1, 1.0), (row, row - 1, -1.0)]);
    }
    for mass in 0..masses {
        heavy.push((2 * mass, 2 * mass, 1.0));
    }
    // Free chain: w_k = 2 sqrt(k/m) sin(j pi / (2 n)), j = 0, ...
    let w = |j: usize| 2.0 * 0.5_f64.sqrt() * (j as f64 * std::f64::consts::PI / (2.0 * masses as f64)).sin();
    let matrices = of_matrices(matrix(size, &stiff), matrix(size, &heavy));
    let found = frequencies(&matrices, 0.5 * (w(9) + w(10)) / TAU).unwrap();
    assert_eq!((found.len(), found[0]), (10, 0.0));
    for (j, found) in found.iter().enumerate().skip(1) {
        assert!((found * TAU / w(j) - 1.0).abs() < 1e-9, "{j}: {found}");
    }
}

/// Two masses with a spring each to the ground, held together by a multiplier, are one mass on both springs.
#[test]
fn lagrange_rows_and_empty_rows_are_left_out() {
    let stiff = [(0, 0, 3.0), (1, 1, 5.0), (3, 0, 1.0), (3, 1, -1.0)];
    let heavy = [(0, 0, 1.0), (1, 1, 1.0)];
    let mut matrices = of_matrices(matrix(4, &stiff), matrix(4, &heavy));
    matrices.points = vec![at_row("first", 0), at_row("second", 1)];
    let (reduced, report) = matrices.reduce(&[], &Reduction::None, &Damping::none(), &["first"]).unwrap();
    assert_eq!((report.empty_rows, report.lagrange_rows, report.coordinates), (1, 1, 1));
    assert!((reduced.model.natural_frequencies[0] - 2.0).abs() < 1e-12);
    let shapes: Vec<f64> = reduced.model.points.iter().map(|point| point.shape[0]).collect();
    assert!(shapes.iter().all(|shape| (shape - 0.5_f64.sqrt()).abs() < 1e-12), "{shapes:?}");
}

/// A massless end on a spring of 1 N/m before a mass on a spring of 4 N/m: flexibility 1 + 1/4 m/N.
#[test]
fn a_massless_interface_keeps_its_flexibility() {
    let stiff = [(0, 0, 5.0), (1, 0, -1.0), (1, 1, 1.0)];
    let mut matrices = of_matrices(matrix(2, &stiff), matrix(2, &[(0, 0, 1.0)]));
    matrices.points = vec![at_row("end", 1)];
    for reduction in [Reduction::None, Reduction::FreeInterface { cut_off_hz: 10.0 }] {
        let (reduced, _) = matrices.reduce(&[], &reduction, &Damping::none(), &["end"]).unwrap();
        let flexibility = &reduced.tables.flexibility_errors[0];
        assert!((flexibility.full - 1.25).abs() < 1e-12, "{flexibility:?}");
        assert!(flexibility.relative.abs() < 1e-9, "{flexibility:?}");
        assert!((reduced.model.natural_frequencies[0] - 2.0).abs() < 1e-9);
    }
}

/// Two components that share a node are the chain of both.
#[test]
fn components_are_joined_at_common_nodes() {
    let component = |name: &str, nodes: [i64; 2], stiffness: f64| MatrixComponent {
        name: name.into(),
        stiffness: matrix(2, &[(0, 0, stiffness), (1, 0, -stiffness), (1, 1, stiffness)]),
        mass: matrix(2, &[(0, 0, 1.0), (1, 1, 1.0)]),
        damping: None,
        labels: nodes.map(|node| RowLabel::physical(node, Direction::Translation(0))).to_vec(),
        precision: 1.2e-16,
    };
    let mut matrices = of_matrices(matrix(0, &[]), matrix(0, &[]));
    matrices.components = vec![component("one", [1, 2], 3.0), component("two", [2, 5], 3.0)];
    let end = PointPlace::Node { node: 5, along: Along::Vector([2.0, 0.0, 0.0]) };
    matrices.points = vec![MatrixPoint { name: "end".into(), place: end }];
    let (reduced, report) = matrices.reduce(&[], &Reduction::None, &Damping::none(), &["end"]).unwrap();
    assert_eq!((report.rows, report.joined, report.rigid_modes), (4, 1, 1));
    // Masses 1, 2, 1 on springs of 3 N/m: w^2 = 0, 3, 6.
    let squares: Vec<f64> = reduced.model.natural_frequencies.iter().map(|w| w * w).collect();
    assert!((squares[1] - 3.0).abs() < 1e-12 && (squares[2] - 6.0).abs() < 1e-12, "{squares:?}");
}

#[track_caller]
fn refused(matrices: &Matrices, part: &str) {
    let error = frequencies(matrices, 100.0).unwrap_err().to_string();
    assert!(error.contains(part), "\"{part}\" is missing in: {error}");
}

#[test]
fn what_makes_no_structure_is_refused_where_it_is() {
    let unit = |size: usize| matrix(size, &(0..size).map(|row| (row, row, 1.0)).collect::<Vec<_>>());
    refused(&of_matrices(unit(3), unit(2)), "the mass has 2 rows, the stiffness has 3");
    refused(&of_matrices(matrix(2, &[(0, 0, -5e6), (1, 1, 1.0)]), unit(2)), "not positive semi-definite");
    // One negative mass, on the diagonal and off it; a damper that drives.
    refused(
        &of_matrices(unit(2), matrix(2, &[(0, 0, 1.0), (1, 1, -2.0)])),
        "mass on the diagonal of row 2 is -2",
    );
    let coupled = matrix(2, &[(0, 0, 1.0), (1, 0, 2.0), (1, 1, 1.0)]);
    refused(&of_matrices(unit(2), coupled), "mass matrix has 1 negative eigenvalues");
    let mut driven = of_matrices(unit(2), unit(2));
    driven.components[0].damping = Some(matrix(2, &[(0, 0, -1.0), (1, 1, 1.0)]));
    refused(&driven, "damping on the diagonal of row 1 is -1");
    let loose = matrix(3, &[(0, 0, 1.0), (1, 1, 1.0), (2, 1, -1.0), (2, 2, 1.0)]);
    refused(&of_matrices(loose, matrix(3, &[(0, 0, 1.0)])), "can move without mass and without stiffness");
    let mut labelled = of_matrices(unit(2), unit(2));
    labelled.components[0].labels = vec![RowLabel::physical(4, Direction::Translation(0)); 2];
    let point = |along| PointPlace::Node { node: 4, along };
    labelled.points =
        vec![MatrixPoint { name: "p".into(), place: point(Along::Row(Direction::Translation(0))) }];
    refused(&labelled, "stands for several rows, 1, 2");
    labelled.points[0].place = point(Along::Row(Direction::Rotation(1)));
    refused(&labelled, "node 4 ry, which no row has");
    labelled.points[0].place = PointPlace::Node { node: 9, along: Along::Vector([1.0, 0.0, 0.0]) };
    refused(&labelled, "nodes that no row has: 9");
    labelled.points[0].place = PointPlace::Row { component: 0, row: 2 };
    refused(&labelled, "row 3, there are 2 rows");
    labelled.components[0].labels.pop();
    refused(&labelled, "list of labels has 1 rows");
    let cut_off = frequencies(&of_matrices(unit(2), unit(2)), 0.1).unwrap_err();
    assert!(matches!(cut_off, StructureError::CutOffBelowFirstMode { .. }), "{cut_off}");
}

/// Fixed-interface modes of matrices against those of the beam: the same basis.
#[test]
fn fixed_interface_modes_are_those_of_the_beam() {
    let structure = paper_beam();
    let (reduction, damping) = (Reduction::FixedInterface { cut_off_hz: 1000.0 }, Damping::modal(0.015));
    let expected = structure.clone().with_support_motion(&["left"]).unwrap();
    let expected = expected.reduce(&reduction, &damping, &["contact"]).unwrap();
    let (found, _) =
        exported(&structure, "left").reduce(&[&["left"]], &reduction, &damping, &["contact"]).unwrap();
    assert_alike(&found.model, &expected.model, 1e-9);
}

/// The other reductions of matrices against those of the beam: the same bases. What answers statically alone
/// stands at a hundred times the highest frequency.
#[test]
fn other_reductions_are_those_of_the_beam() {
    let structure = paper_beam();
    for reduction in [Reduction::MacNeal { cut_off_hz: 1000.0 }, Reduction::Guyan { cut_off_hz: 1000.0 }] {
        let damping = Damping::modal(0.015);
        let expected = structure.clone().with_support_motion(&["left"]).unwrap();
        let expected = expected.reduce(&reduction, &damping, &["contact"]).unwrap();
        let (found, _) =
            exported(&structure, "left").reduce(&[&["left"]], &reduction, &damping, &["contact"]).unwrap();
        assert_alike(&found.model, &expected.model, 1e-8);
    }
}

/// Nine chains that nothing joins: every mode nine times, more often than a block of the search holds.
#[test]
fn modes_of_a_higher_multiplicity_than_the_blocks_are_all_found() {
    let (n, chains) = (100, 9);
    let (mut stiff, mut heavy) = (Vec::new(), Vec::new());
    for row in 0..n * chains {
        stiff.push((row, row, 2.0));
        heavy.push((row, row, 1.0));
        if row % n > 0 {
            stiff.push((row, row - 1, -1.0));
        }
    }
    let w = |k: usize| 2.0 * (k as f64 * std::f64::consts::PI / (2.0 * n as f64 + 2.0)).sin();
    let matrices = of_matrices(matrix(n * chains, &stiff), matrix(n * chains, &heavy));
    let found = frequencies(&matrices, 0.5 * (w(2) + w(3)) / TAU).unwrap();
    assert_eq!(found.len(), 2 * chains);
    for (place, found) in found.iter().enumerate() {
        assert!((found * TAU / w(place / chains + 1) - 1.0).abs() < 1e-9, "{place}: {found}");
    }
}
