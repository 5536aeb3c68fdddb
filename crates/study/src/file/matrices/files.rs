//! The files of components.

use hammerbeam_matrices::MatrixFormat;

use crate::document::{Key, Quantity, Reading, TomlTable, Value, quantity};

use super::{
    super::file_checksum::checksum,
    entries::{InputFile, MatrixEntry, MatrixFiles},
};

/// Factor of a unit, for a matrix or a length.
pub(super) const fn factor(key: &'static str, meaning: &'static str) -> Key<Quantity> {
    Key::new(key, quantity::FACTOR, meaning).or(1.0)
}

/// One component of `[structure]` itself, or those of `[[structure.component]]`.
pub(super) fn read_components(table: &TomlTable<'_>, reading: &Reading) -> Option<Vec<MatrixFiles>> {
    if !table.has("component") {
        return read_files(table, String::new(), reading).map(|files| vec![files]);
    }
    let mut components = Vec::new();
    for component in table.tables("component") {
        let name = component.required("name").and_then(|value| value.text().map(str::to_owned));
        let files = read_files(&component, name.clone().unwrap_or_default(), reading);
        component.finish();
        let taken = components.iter().flatten().any(|other: &MatrixFiles| Some(&other.name) == name.as_ref());
        if taken {
            let message = "two entries of `component` have the same name";
            table.problem(
                "component",
                message.to_owned(),
                vec!["allowed: a name of its own for each".into()],
            );
        }
        components.push(name.and(files));
    }
    if components.is_empty() {
        table.problem(
            "component",
            "`component` is an empty list".into(),
            vec!["allowed: one or more".into()],
        );
    }
    components.into_iter().collect()
}

fn read_files(table: &TomlTable<'_>, name: String, reading: &Reading) -> Option<MatrixFiles> {
    let format = table.optional("format").map(|value| {
        let choices: Vec<(&str, &str)> = MatrixFormat::names().into_iter().map(|name| (name, name)).collect();
        value.choice(&choices).map(str::to_owned)
    });
    let stiffness = table.required("stiffness").map(|value| input_file(&value, reading));
    let mass = table.required("mass").map(|value| input_file(&value, reading));
    let damping = table.optional("damping").map(|value| input_file(&value, reading));
    let dofs = optional_file(table, "dofs", reading);
    let matrix = |file: Option<InputFile>, [name, scale]: [&'static str; 2]| {
        let matrix = table.optional(name).map(|value| value.text().map(str::to_owned));
        let factor = read_factor(table, scale);
        let matrix = match matrix {
            None => None,
            Some(given) => Some(given?),
        };
        Some(MatrixEntry { file: file?, matrix, factor: factor? })
    };
    let stiffness = matrix(stiffness.flatten(), ["stiffness_matrix", "stiffness_factor"]);
    let mass = matrix(mass.flatten(), ["mass_matrix", "mass_factor"]);
    let has_damping = damping.is_some();
    let damping = matrix(damping.flatten(), ["damping_matrix", "damping_factor"]);
    Some(MatrixFiles {
        name,
        format: match format {
            None => None,
            Some(given) => Some(given?),
        },
        stiffness: stiffness?,
        mass: mass?,
        damping: if has_damping { Some(damping?) } else { None },
        dofs: dofs?,
    })
}

pub(super) fn read_factor(table: &TomlTable<'_>, key: &'static str) -> Option<f64> {
    factor(key, "").read(table)
}

/// A file that need not be given.
pub(super) fn optional_file(
    table: &TomlTable<'_>,
    key: &'static str,
    reading: &Reading,
) -> Option<Option<InputFile>> {
    table.optional(key).map_or(Some(None), |value| input_file(&value, reading).map(Some))
}

/// A file, relative to the folder of the study.
fn input_file(value: &Value<'_>, reading: &Reading) -> Option<InputFile> {
    let written = value.text()?.to_owned();
    let path = reading.folder().join(&written);
    match checksum(&path) {
        Ok(checksum) => Some(InputFile { path, written, checksum }),
        Err(error) => {
            let help = "allowed: a file, relative to the folder of the study file";
            value.problem(format!("cannot read {}: {error}", path.display()), vec![help.into()]);
            None
        }
    }
}
