//! `[structure]` of kind "matrices": stiffness and mass of a finite element program, from files.

mod descriptor;
mod direction;
mod entries;
mod files;
mod points;
mod rows;

use crate::document::{Reading, TomlTable};

use super::names::Names;

pub(crate) use descriptor::MatrixProblem;
pub use entries::{
    DirectionEntry, InputFile, MatricesTable, MatrixEntry, MatrixFiles, MatrixPointEntry, MatrixSupportEntry,
    PointPlaceEntry, RowSetEntry,
};

use direction::read_vector;
use files::{optional_file, read_components, read_factor};
use points::{read_point, read_rows, read_support};
use rows::MEMORY;
pub(super) use rows::{rows, rows_of_component, rows_of_fixed, rows_of_point, rows_of_support};

pub(super) fn read(table: &TomlTable<'_>, reading: &Reading, names: &mut Names) -> Option<MatricesTable> {
    let before = reading.count();
    names.add_supports();
    let components = read_components(table, reading);
    let known: Vec<String> = components.iter().flatten().map(|component| component.name.clone()).collect();
    let nodes = optional_file(table, "nodes", reading);
    let lines = optional_file(table, "lines", reading);
    if let (Some(Some(_)), Some(None)) = (&lines, &nodes) {
        let help = vec!["allowed: with `nodes`, which says where the nodes are".to_owned()];
        table.problem("lines", "`lines` is given without `nodes`".to_owned(), help);
    }
    let length_factor = read_factor(table, "length_factor");
    let points: Vec<Option<MatrixPointEntry>> =
        table.tables("point").into_iter().map(|point| read_point(point, &known, names)).collect();
    let supports: Vec<Option<MatrixSupportEntry>> =
        table.tables("support").into_iter().map(|support| read_support(support, names)).collect();
    let fixed: Vec<Option<RowSetEntry>> = table
        .tables("fixed")
        .into_iter()
        .map(|fixed| {
            let set = read_rows(&fixed, true);
            fixed.finish();
            set
        })
        .collect();
    let acceleration = table.optional("acceleration_direction").map(|value| read_vector(&value));
    let memory_gb = MEMORY.read(table);
    let points: Option<Vec<MatrixPointEntry>> = points.into_iter().collect();
    let mut points = points?;
    if points.is_empty() && reading.count() == before {
        // Something has to be observed: the first row, unless the study names points.
        names.add_point("row 1");
        points.push(MatrixPointEntry {
            name: "row 1".into(),
            place: PointPlaceEntry::Row { component: 0, row: 1 },
        });
    }
    let matrices = MatricesTable {
        components: components?,
        nodes: nodes?,
        lines: lines?.map(Box::new),
        length_factor: length_factor?,
        points,
        supports: supports.into_iter().collect::<Option<_>>()?,
        fixed: fixed.into_iter().collect::<Option<_>>()?,
        acceleration_direction: match acceleration {
            None => None,
            Some(given) => Some(given?),
        },
        memory_gb: memory_gb?,
    };
    (reading.count() == before).then_some(matrices)
}
