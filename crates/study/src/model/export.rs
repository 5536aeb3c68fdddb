//! The structure of a study as matrices, and the same study with them.

use std::fmt::Write;

use hammerbeam_structure::{ExportedMatrices, RowLabel};

use super::structure::linear_structure;
use crate::file::{StructureTable, StudyError, StudyFile};

/// The matrices of a study's beam or masses, and the text of the study that reads them from the files
/// `K.mtx`, `M.mtx`, `C.mtx` and `dofs.csv` beside it.
///
/// # Errors
/// [`StudyError::Invalid`]: the study has matrices already, or its structure is refused.
pub fn matrix_study(file: &StudyFile) -> Result<(ExportedMatrices, String), StudyError> {
    let structure = match &file.study.structure {
        StructureTable::Matrices(_) => {
            return Err(file.fault(
                "structure.kind",
                "the structure is given as matrices already".into(),
                Vec::new(),
            ));
        }
        StructureTable::Beam(beam) if !beam.planes.is_one() => {
            let message = "the matrices of a beam that bends in two planes are not written".to_owned();
            let help = vec!["allowed: planes = 1, for the matrices of one plane".to_owned()];
            return Err(file.fault("structure.planes", message, help));
        }
        _ => linear_structure(&file.study)
            .map_err(|error| file.fault("structure", error.to_string(), Vec::new()))?,
    };
    let exported = structure.exported();
    let text = replaced(file, &exported);
    Ok((exported, text))
}

/// The text with other tables of the structure.
fn replaced(file: &StudyFile, exported: &ExportedMatrices) -> String {
    let (mut text, mut within, mut done) = (String::new(), false, false);
    for line in file.text.lines() {
        let header = line.trim_start();
        if header.starts_with('[') {
            let name = header.trim_start_matches('[').trim_start();
            within = name.starts_with("structure]") || name.starts_with("structure.");
            if within && !done {
                text.push_str(&tables(file, exported));
                done = true;
            }
        }
        if !within {
            text.push_str(line);
            text.push('\n');
        }
    }
    text
}

/// `[structure]` of kind "matrices".
fn tables(file: &StudyFile, exported: &ExportedMatrices) -> String {
    let mut text = String::from(
        "[structure]\nkind = \"matrices\"\nstiffness = \"K.mtx\"\nmass = \"M.mtx\"\ndofs = \"dofs.csv\"\n",
    );
    if exported.damping.is_some() {
        text.push_str("damping = \"C.mtx\"\n");
    }
    let moving: Vec<&String> = file.study.excitation.supports().into_iter().flatten().collect();
    let row_of = |name: &str| exported.points.iter().find(|(known, _)| known == name).map(|(_, row)| *row);
    let along = |label: &RowLabel| if label.direction.to_string() == "y" { "y" } else { "x" };
    let mut write = |line: String| writeln!(text, "{line}").expect("a text takes all that is written");
    for (name, row) in &exported.points {
        // Ends have no names of their own among the points of matrices.
        let is_end = matches!(name.as_str(), "left" | "right");
        if !is_end && !moving.contains(&name) && !exported.held.contains(row) {
            write(format!("\n[[structure.point]]\nname = \"{name}\"\nrow = {}", row + 1));
        }
    }
    for name in &moving {
        if let Some(row) = row_of(name) {
            let direction = along(&exported.labels[row]);
            write(format!(
                "\n[[structure.support]]\nname = \"{name}\"\nrows = [{}]\ndirection = \"{direction}\"",
                row + 1
            ));
        }
    }
    let held = exported.held.iter().filter(|row| !moving.iter().any(|name| row_of(name) == Some(**row)));
    let held: Vec<String> = held.map(|row| (row + 1).to_string()).collect();
    if !held.is_empty() {
        write(format!("\n[[structure.fixed]]\nrows = [{}]", held.join(", ")));
    }
    text.push('\n');
    text
}
