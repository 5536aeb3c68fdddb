//! Stiffness, mass and damping of one component, from its files.

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

use hammerbeam_structure::{MatrixComponent, RowLabel, SymmetricMatrix};

use crate::{
    error::{FilePlace, MatrixError, MatrixFault},
    format::MatrixFormat,
    matrix::FileMatrix,
    read::{named, read_labels, read_matrices, read_nodes},
};

/// A matrix of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct MatrixFile {
    /// The file.
    pub path: PathBuf,
    /// Name of the matrix in the file; found out if `None`.
    pub matrix: Option<String>,
    /// Factor that brings its entries to SI units.
    pub factor: f64,
}

/// The files of a component.
#[derive(Debug, Clone, PartialEq)]
pub struct ComponentFiles {
    /// Name for messages.
    pub name: String,
    /// Format of the matrices; found out if `None`.
    pub format: Option<MatrixFormat>,
    /// Stiffness.
    pub stiffness: MatrixFile,
    /// Mass.
    pub mass: MatrixFile,
    /// Damping, if there is any.
    pub damping: Option<MatrixFile>,
    /// What rows are; else what the files of matrices say.
    pub labels: Option<PathBuf>,
}

/// What a matrix is to be, and by which names it is known.
#[derive(Clone, Copy)]
struct Wanted {
    what: &'static str,
    names: &'static [&'static str],
}

const STIFFNESS: Wanted = Wanted {
    what: "stiffness",
    names: &["K", "KXX", "KAA", "KGG", "KAAX", "K2GG", "KJJ", "KHH", "STIFFNESS"],
};
const MASS: Wanted =
    Wanted { what: "mass", names: &["M", "MXX", "MAA", "MGG", "MAAX", "M2GG", "MJJ", "MHH", "MASS"] };
const DAMPING: Wanted = Wanted {
    what: "damping",
    names: &["B", "BXX", "BAA", "BGG", "BAAX", "B2GG", "BXX1", "C", "VISCOUSDAMPING", "DAMPING"],
};

/// Reads a component.
///
/// # Errors
/// [`MatrixError`] with file and place: what cannot be read, matrices that are not symmetric or differ in
/// their number of rows.
pub fn read_component(files: &ComponentFiles) -> Result<MatrixComponent, MatrixError> {
    let mut source = Source { format: files.format, last: None };
    let stiffness = source.matrix(&files.stiffness, STIFFNESS)?;
    let stiff = symmetric(&files.stiffness, &stiffness)?;
    let (precision, mut labels) = (stiffness.precision, stiffness.labels);
    let mass = source.matrix(&files.mass, MASS)?;
    let heavy = symmetric(&files.mass, &mass)?;
    let heavy = fitted(heavy, &mass, &labels, stiff.size());
    let damping = match &files.damping {
        None => None,
        Some(file) => {
            let matrix = source.matrix(file, DAMPING)?;
            Some(fitted(symmetric(file, &matrix)?, &matrix, &labels, stiff.size()))
        }
    };
    drop(source);
    for (what, file, found) in [
        ("the mass", Some(&files.mass), Some(heavy.size())),
        ("the damping", files.damping.as_ref(), damping.as_ref().map(SymmetricMatrix::size)),
    ] {
        if let (Some(file), Some(found)) = (file, found.filter(|found| *found != stiff.size())) {
            let (found, expected) = (found as u64, stiff.size() as u64);
            return Err(whole(&file.path, MatrixFault::RowCount { what, found, expected }));
        }
    }
    if let Some(path) = &files.labels {
        labels = labels_of(path, stiff.size())?;
        if labels.len() != stiff.size() {
            let (found, expected) = (labels.len() as u64, stiff.size() as u64);
            return Err(whole(path, MatrixFault::RowCount { what: "the list of labels", found, expected }));
        }
    }
    Ok(MatrixComponent {
        name: files.name.clone(),
        stiffness: stiff,
        mass: heavy,
        damping,
        labels,
        precision,
    })
}

/// Labels of rows: as the file gives them, or of an input deck three or six for each node in their order.
fn labels_of(path: &Path, rows: usize) -> Result<Vec<RowLabel>, MatrixError> {
    let is_deck = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("inp"));
    if !is_deck {
        return read_labels(path);
    }
    let nodes = read_nodes(path)?;
    let each = if rows == 6 * nodes.len() { 6 } else { 3 };
    let of = |&node: &i64| {
        (1..=each).map(move |n| RowLabel::physical(node, hammerbeam_structure::Direction::numbered(n)))
    };
    Ok(nodes.keys().flat_map(of).collect())
}

/// Reads matrices, a file that has several once.
struct Source {
    format: Option<MatrixFormat>,
    last: Option<(PathBuf, Vec<FileMatrix>)>,
}

impl Source {
    fn matrix(&mut self, file: &MatrixFile, wanted: Wanted) -> Result<FileMatrix, MatrixError> {
        if self.last.as_ref().is_none_or(|(path, _)| *path != file.path) {
            self.last = None;
            self.last = Some((file.path.clone(), read_matrices(&file.path, self.format)?));
        }
        let Some((_, matrices)) = &mut self.last else { unreachable!("a file was read just now") };
        let is_named = |matrix: &FileMatrix, name: &str| matrix.name.eq_ignore_ascii_case(name);
        let place = match &file.matrix {
            Some(name) => matrices.iter().position(|matrix| is_named(matrix, name)),
            None if matrices.len() == 1 => Some(0),
            None => wanted.names.iter().find_map(|name| {
                matrices.iter().position(|matrix| is_named(matrix, name) && matrix.rows > 1)
            }),
        };
        let known = || matrices.iter().map(|matrix| matrix.name.clone()).collect();
        let Some(place) = place else {
            let name = file.matrix.as_ref().map_or_else(
                || format!("that is known as a {} ({})", wanted.what, wanted.names.join(", ")),
                |name| format!("\"{name}\""),
            );
            return Err(whole(&file.path, MatrixFault::NoSuchMatrix { name, known: known() }));
        };
        if matrices.len() == 1 {
            // A matrix by itself is not needed twice.
            let matrix = matrices.swap_remove(place);
            self.last = None;
            return Ok(matrix);
        }
        Ok(matrices[place].clone())
    }
}

fn symmetric(file: &MatrixFile, matrix: &FileMatrix) -> Result<SymmetricMatrix, MatrixError> {
    let symmetric = matrix.symmetric().map_err(|fault| named(&file.path, fault))?;
    Ok(if file.factor == 1.0 { symmetric } else { symmetric.scaled(file.factor) })
}

/// A matrix brought to the rows of the stiffness: by its labels, or with empty rows at the end where a file
/// ends before them.
fn fitted(matrix: SymmetricMatrix, file: &FileMatrix, labels: &[RowLabel], rows: usize) -> SymmetricMatrix {
    let own = &file.labels;
    let relabelled = !own.is_empty() && own != labels;
    let place: Vec<Option<usize>> = if relabelled {
        // Of labels that stand there twice the first is meant.
        let places: BTreeMap<&RowLabel, usize> =
            (0..labels.len()).rev().map(|place| (&labels[place], place)).collect();
        own.iter().map(|label| places.get(label).copied()).collect()
    } else {
        (0..matrix.size()).map(|row| (row < rows).then_some(row)).collect()
    };
    let fits = !relabelled && (matrix.size() == rows || file.is_sized);
    if fits || place.iter().any(Option::is_none) {
        return matrix;
    }
    let entry = |(row, column, value): (usize, usize, f64)| {
        let at = |row: usize| place[row].map_or(0, |row| row as u32);
        hammerbeam_structure::Entry { row: at(row), column: at(column), value }
    };
    SymmetricMatrix::from_entries(rows, &matrix.entries().map(entry).collect::<Vec<_>>())
}

fn whole(path: &Path, fault: MatrixFault) -> MatrixError {
    MatrixError { path: path.to_owned(), place: FilePlace::Whole, fault }
}
