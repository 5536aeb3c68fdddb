//! Component mode synthesis: superelements and a beam, each given as matrices, joined in one study, against
//! the whole beam.
//!
//! A clamped beam is cut into three pieces. The outer ones become superelements as finite element programs
//! write them, here by a computation of its own: physical rows where they are joined, held or hit, and
//! amplitudes of modes,
//!
//! `[x_b; x_i] = [1 0; Psi Phi] [x_b; q]`, `Psi = -K_ii^-1 K_ib`, `K_ii Phi = M_ii Phi diag(w^2)`
//!
//! (Craig and Bampton, AIAA J. 6 (1968), 1313-1319). With all modes these are other coordinates of the same
//! structure. With some of them it is held in the shapes that are left, so its frequencies are higher, and
//! fall with each mode (Rayleigh and Ritz).
#![allow(clippy::unwrap_used, reason = "a test ends where its study is wrong")]

use std::{fs, path::Path};

use faer::{Mat, Side};
use hammerbeam_matrices::{write_dofs, write_matrix_market};
use hammerbeam_structure::{Entry, RowLabel, SymmetricMatrix};
use hammerbeam_study::{Model, StudyFile, matrix_study};

use crate::common::settled::{difference, settled};

/// Elements of a piece, each 50 mm long.
const ELEMENTS: usize = 6;
/// Rows of the end nodes of a piece, displacement and rotation.
const ENDS: [usize; 4] = [0, 1, 2 * ELEMENTS, 2 * ELEMENTS + 1];
/// Rows of a piece between its ends: so many modes.
const INTERIOR: usize = 2 * (ELEMENTS - 1);
/// The fifth eigenfrequency is 353 Hz, the sixth 527 Hz.
const DRIVEN: &str = r#"
    [reduction]
    method = "free-interface"
    cut_off_hz = 400.0
    [damping]
    rayleigh = { mass_per_s = 6.0, stiffness_s = 2e-5 }
    [excitation]
    kind = "support-motion"
    at = "left"
    amplitude_m = 0.5e-3
    frequency_hz = [5.0, 25.0]
    [[stop]]
    at = "tip"
    law = "linear"
    stiffness_n_m = 2.0e3
    side = "above"
    gap_m = 1.0e-3
    [response]
    point = "tip"
"#;

/// A steel beam of so many pieces.
fn beam(pieces: usize, left: &str, driven: &str) -> StudyFile {
    let (length, elements) = (0.3 * pieces as f64, ELEMENTS * pieces);
    let text = format!(
        "[structure]\nkind = \"beam\"\nlength_m = {length:?}\nelements = {elements}\n\
         section = {{ width_m = 0.02, height_m = 0.006 }}\nyoungs_modulus_pa = 2.1e11\n\
         density_kg_m3 = 7800.0\nleft = \"{left}\"\nright = \"free\"\n\
         [[structure.point]]\nname = \"tip\"\nat_m = {length:?}\n{driven}"
    );
    StudyFile::parse("beam.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

/// Matrices with what their rows are.
struct Piece {
    stiffness: Mat<f64>,
    mass: Mat<f64>,
    labels: Vec<RowLabel>,
}

impl Piece {
    /// Free pieces in a row, nodes numbered from one.
    fn of_beam(pieces: usize, first_node: i64) -> Self {
        let driven = "[reduction]\nmethod = \"truncation\"\ncut_off_hz = 400.0\n[excitation]\n\
                      kind = \"force\"\nat = \"tip\"\namplitude_n = 1.0\nfrequency_hz = [5.0, 25.0]\n\
                      [damping]\nmodal_ratio = 0.01\n[response]\npoint = \"tip\"\n";
        let (exported, _) = matrix_study(&beam(pieces, "free", driven)).unwrap();
        let label = |label: &RowLabel| RowLabel::physical(label.node - 1 + first_node, label.direction);
        Self {
            stiffness: exported.stiffness.dense(),
            mass: exported.mass.dense(),
            labels: exported.labels.iter().map(label).collect(),
        }
    }

    /// Its superelement with so many modes.
    fn reduced(&self, modes: usize) -> Self {
        let size = self.labels.len();
        let interior: Vec<usize> = (0..size).filter(|row| !ENDS.contains(row)).collect();
        let part = |of: &Mat<f64>, rows: &[usize], columns: &[usize]| {
            Mat::from_fn(rows.len(), columns.len(), |i, j| of[(rows[i], columns[j])])
        };
        let stiff = part(&self.stiffness, &interior, &interior).llt(Side::Lower).unwrap();
        let mut constraint = part(&self.stiffness, &interior, &ENDS);
        stiff.L().solve_lower_triangular_in_place(constraint.as_mut());
        stiff.L().transpose().solve_upper_triangular_in_place(constraint.as_mut());
        // `L^-1 M L^-T y = y / w^2`, the lowest modes last; their lengths do not matter.
        let mut inner = part(&self.mass, &interior, &interior);
        stiff.L().solve_lower_triangular_in_place(inner.as_mut());
        let mut inner = inner.transpose().to_owned();
        stiff.L().solve_lower_triangular_in_place(inner.as_mut());
        let eigen = inner.self_adjoint_eigen(Side::Lower).unwrap();
        let mut shapes = eigen.U().subcols(interior.len() - modes, modes).to_owned();
        stiff.L().transpose().solve_upper_triangular_in_place(shapes.as_mut());
        let basis = Mat::from_fn(size, ENDS.len() + modes, |row, column| {
            match (interior.iter().position(|other| *other == row), column.checked_sub(ENDS.len())) {
                (Some(place), None) => -constraint[(place, column)],
                (Some(place), Some(mode)) => shapes[(place, mode)],
                (None, _) => f64::from(ENDS.get(column) == Some(&row)),
            }
        });
        let physical = ENDS.iter().map(|row| self.labels[*row].clone());
        Self {
            stiffness: basis.transpose() * &self.stiffness * &basis,
            mass: basis.transpose() * &self.mass * &basis,
            labels: physical.chain((0..modes).map(|mode| RowLabel::modal(mode as i64 + 1))).collect(),
        }
    }

    /// Writes it, and says so in the words of a study.
    fn written(&self, folder: &Path, name: &str) -> String {
        let mut text = format!("[[structure.component]]\nname = \"{name}\"\n");
        for (key, matrix) in [("stiffness", &self.stiffness), ("mass", &self.mass)] {
            let entries = (0..matrix.ncols()).flat_map(|column| {
                (column..matrix.nrows()).map(move |row| (row, column, matrix[(row, column)]))
            });
            let entry = |(row, column, value)| Entry { row: row as u32, column: column as u32, value };
            let matrix = SymmetricMatrix::from_entries(
                matrix.nrows(),
                &entries
                    .map(|(row, column, value): (usize, usize, f64)| entry((row, column, value)))
                    .collect::<Vec<_>>(),
            );
            let file = folder.join(format!("{name}-{key}.mtx"));
            write_matrix_market(&matrix, &mut fs::File::create(&file).unwrap()).unwrap();
            text += &format!("{key} = '{}'\n", file.display());
        }
        let file = folder.join(format!("{name}.csv"));
        write_dofs(&self.labels, &mut fs::File::create(&file).unwrap()).unwrap();
        text + &format!("dofs = '{}'\n", file.display())
    }
}

/// A study of components that is driven as the beam is.
fn joined(folder: &Path, components: &[(&str, Piece)]) -> StudyFile {
    let mut text = "[structure]\nkind = \"matrices\"\n".to_owned();
    for (name, piece) in components {
        text += &piece.written(folder, name);
    }
    let last = 3 * ELEMENTS + 1;
    text += &format!(
        "[[structure.point]]\nname = \"tip\"\nnode = {last}\ndirection = \"y\"\n\
         [[structure.support]]\nname = \"left\"\nnodes = [1]\ndirection = \"y\"\n{DRIVEN}"
    );
    StudyFile::parse("joined.toml", text).unwrap_or_else(|error| panic!("{error}"))
}

/// Two superelements with so many modes each, and the beam between them.
fn synthesised(folder: &Path, modes: usize) -> StudyFile {
    let folder = folder.join(modes.to_string());
    fs::create_dir(&folder).unwrap();
    let piece = |number: usize| Piece::of_beam(1, (number * ELEMENTS) as i64 + 1);
    let pieces = [("root", piece(0).reduced(modes)), ("middle", piece(1)), ("end", piece(2).reduced(modes))];
    joined(&folder, &pieces)
}

fn frequencies(file: &StudyFile) -> Vec<f64> {
    Model::build(file).unwrap().tables.clamped_hz
}

/// Tip of the motion at 8 Hz, above the first eigenfrequency. Damping takes exp(-3 t) off: 120 periods leave
/// 1e-19.
fn orbit(file: &StudyFile) -> Vec<f64> {
    settled(file, "tip", 8.0, 120)
}

#[test]
fn superelements_with_all_their_modes_and_a_beam_are_the_whole_beam() {
    let folder = tempfile::tempdir().unwrap();
    let whole = beam(3, "clamped", DRIVEN);
    let all = synthesised(folder.path(), INTERIOR);
    let report = Model::build(&all).unwrap().matrices.unwrap();
    assert_eq!((report.rows, report.joined, report.coordinates), (42, 4, 36));
    let pair = joined(folder.path(), &[("whole", Piece::of_beam(3, 1))]);
    let (expected, motion) = (frequencies(&whole), orbit(&whole));
    assert!(motion.iter().any(|y| *y > 1.05e-3), "the tip meets its stop: {motion:?}");
    for study in [&all, &pair] {
        let found = frequencies(study);
        // Of a beam all are known.
        assert_eq!((found.len(), expected.len()), (5, 36));
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
        }
        let difference = difference(&orbit(study), &motion);
        assert!(difference < 1e-7, "{difference}");
    }
}

#[test]
fn superelements_with_some_modes_come_to_the_beam_from_above() {
    let folder = tempfile::tempdir().unwrap();
    let whole = beam(3, "clamped", DRIVEN);
    let (expected, motion) = (frequencies(&whole), orbit(&whole));
    let kept = [0, 1, 2, 4];
    let studies = kept.map(|modes| synthesised(folder.path(), modes));
    let found = studies.each_ref().map(frequencies);
    for (fewer, more) in found.iter().zip(&found[1..]) {
        for (fewer, more) in fewer.iter().zip(more) {
            assert!(*more <= fewer * (1.0 + 1e-9), "{found:?}");
        }
    }
    for found in &found {
        assert!(
            found.iter().zip(&expected).all(|(found, whole)| *found >= whole * (1.0 - 1e-9)),
            "{found:?}"
        );
    }
    let differences = studies.each_ref().map(|study| difference(&orbit(study), &motion));
    // A piece held at its ends has its first mode at 356 Hz: the fourth of the beam, 213 Hz, misses it.
    let error = |found: &Vec<f64>| found[3] / expected[3] - 1.0;
    assert!(error(&found[0]) > 1e-2 && error(&found[3]) < 1e-4, "{found:?} {expected:?}");
    assert!(differences.is_sorted_by(|fewer, more| fewer > more), "{differences:?}");
    assert!(differences[3] < 1e-5, "{differences:?}");
}
