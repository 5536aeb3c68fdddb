//! Matrices of a study in the terms of the structure crate.

use std::{collections::BTreeSet, path::Path};

use hammerbeam_matrices::{
    ComponentFiles, MatrixError, MatrixFile, MatrixFormat, Nodes, read_component, read_lines, read_nodes,
};
use hammerbeam_structure::{
    self as linear, Along, Direction, MatrixComponent, MatrixPart, MatrixPoint, MatrixSupport, PointPlace,
    RowSet, SupportRows,
};

use super::entries::{
    DirectionEntry, InputFile, MatricesTable, MatrixEntry, MatrixFiles, MatrixPointEntry, MatrixSupportEntry,
    PointPlaceEntry, RowSetEntry,
};

/// Why the files of a study make no structure: the key to blame, and what is wrong.
#[derive(Debug)]
pub(crate) struct MatrixProblem {
    /// Key path.
    pub key: String,
    /// What is wrong, with file and place.
    pub message: String,
}

impl MatricesTable {
    /// All files, each as often as it is named.
    pub(crate) fn files(&self) -> impl Iterator<Item = &InputFile> {
        let entries = self.components.iter().flat_map(|files| {
            [Some(&files.stiffness), Some(&files.mass), files.damping.as_ref()]
                .into_iter()
                .flatten()
                .map(|entry| &entry.file)
                .chain(&files.dofs)
        });
        entries.chain(&self.nodes).chain(self.lines.as_deref())
    }

    /// The matrices in the terms of the structure crate.
    ///
    /// # Errors
    /// What a file has wrong, with its place.
    pub(crate) fn descriptor(&self) -> Result<linear::Matrices, MatrixProblem> {
        let components: Result<Vec<MatrixComponent>, MatrixProblem> =
            (0..self.components.len()).map(|number| self.read(number)).collect();
        let nodes = match &self.nodes {
            None => Nodes::new(),
            Some(file) => {
                let nodes = read_nodes(&file.path);
                nodes.map_err(|error| MatrixProblem {
                    key: "structure.nodes".into(),
                    message: error.to_string(),
                })?
            }
        };
        let lines = self.lines.as_ref().map_or(Ok(Vec::new()), |file| {
            let lines = read_lines(&file.path);
            lines.map_err(|error| MatrixProblem { key: "structure.lines".into(), message: error.to_string() })
        });
        let factor = self.length_factor;
        Ok(linear::Matrices {
            components: components?,
            nodes: nodes.into_iter().map(|(node, place)| (node, place.map(|part| factor * part))).collect(),
            lines: lines?,
            points: self.points.iter().map(MatrixPointEntry::descriptor).collect(),
            supports: self.supports.iter().map(MatrixSupportEntry::descriptor).collect(),
            fixed: self.fixed.iter().map(RowSetEntry::descriptor).collect(),
            acceleration: self.acceleration_direction,
            memory_limit_bytes: (1e9 * self.memory_gb) as u64,
        })
    }

    fn read(&self, number: usize) -> Result<MatrixComponent, MatrixProblem> {
        let files = &self.components[number];
        files.read().map_err(|error| {
            let key = files.key_of(&error.path);
            MatrixProblem { key: self.key_of_component(number, key), message: error.to_string() }
        })
    }

    /// Path of a key of a component, which may be `[structure]` itself.
    fn key_of_component(&self, number: usize, key: &str) -> String {
        match self.components.len() == 1 && self.components[0].name.is_empty() {
            true => format!("structure.{key}"),
            false => format!("structure.component[{number}].{key}"),
        }
    }

    /// Path of the key by which a part of the structure asks for rows, by the node or one by one.
    pub(crate) fn key_of(&self, part: &MatrixPart, by_node: bool) -> String {
        let of_set = |list: &str, number: Option<usize>| {
            let key = if by_node { "nodes" } else { "rows" };
            number.map(|number| format!("structure.{list}[{number}].{key}"))
        };
        let key = match part {
            MatrixPart::Point(name) => {
                let number = self.points.iter().position(|point| point.name == *name);
                number.map(|number| {
                    let key = match (&self.points[number].place, by_node) {
                        (PointPlaceEntry::Label(_), _) => "label",
                        (PointPlaceEntry::Row { .. }, _) => "row",
                        (PointPlaceEntry::Node { .. }, true) => "node",
                        (PointPlaceEntry::Node { .. }, false) => "direction",
                    };
                    format!("structure.point[{number}].{key}")
                })
            }
            MatrixPart::Support(name) => {
                of_set("support", self.supports.iter().position(|support| support.name == *name))
            }
            MatrixPart::Fixed(number) => of_set("fixed", Some(*number)),
            MatrixPart::Component(number, _) => Some(self.key_of_component(*number, "dofs")),
            MatrixPart::Lines => Some("structure.lines".to_owned()),
        };
        key.unwrap_or_else(|| "structure".to_owned())
    }

    /// The files that say what rows are: of a component, or of all where any can be meant.
    pub(crate) fn label_files(&self, part: &MatrixPart) -> BTreeSet<&str> {
        let is_meant = |number: usize| !matches!(part, MatrixPart::Component(only, _) if *only != number);
        let files = self.components.iter().enumerate().filter(|(number, _)| is_meant(*number));
        files.flat_map(|(_, files)| &files.dofs).map(|file| file.written.as_str()).collect()
    }
}

impl MatrixFiles {
    fn read(&self) -> Result<MatrixComponent, MatrixError> {
        let file = |entry: &MatrixEntry| MatrixFile {
            path: entry.file.path.clone(),
            matrix: entry.matrix.clone(),
            factor: entry.factor,
        };
        let files = ComponentFiles {
            name: self.name.clone(),
            format: self.format.as_deref().and_then(MatrixFormat::named),
            stiffness: file(&self.stiffness),
            mass: file(&self.mass),
            damping: self.damping.as_ref().map(file),
            labels: self.dofs.as_ref().map(|dofs| dofs.path.clone()),
        };
        read_component(&files)
    }

    /// The key that names a file.
    fn key_of(&self, path: &Path) -> &'static str {
        if self.stiffness.file.path == path {
            "stiffness"
        } else if self.mass.file.path == path {
            "mass"
        } else if self.dofs.as_ref().is_some_and(|dofs| dofs.path == path) {
            "dofs"
        } else {
            "damping"
        }
    }
}

impl MatrixPointEntry {
    fn descriptor(&self) -> MatrixPoint {
        let place = match &self.place {
            PointPlaceEntry::Label(name) => PointPlace::Name(name.clone()),
            PointPlaceEntry::Row { component, row } => {
                PointPlace::Row { component: *component, row: *row as usize - 1 }
            }
            PointPlaceEntry::Node { node, direction } => PointPlace::Node {
                node: i64::from(*node),
                along: match direction {
                    DirectionEntry::Vector(vector) => Along::Vector(*vector),
                    DirectionEntry::Named(name) => Along::Row(direction_of(name)),
                },
            },
        };
        MatrixPoint { name: self.name.clone(), place }
    }
}

impl RowSetEntry {
    fn descriptor(&self) -> RowSet {
        RowSet {
            rows: self.rows.iter().map(|&row| row as usize - 1).collect(),
            nodes: self.nodes.iter().flat_map(|&[first, last]| i64::from(first)..=i64::from(last)).collect(),
            directions: self.directions.iter().map(|name| direction_of(name)).collect(),
        }
    }
}

impl MatrixSupportEntry {
    fn descriptor(&self) -> MatrixSupport {
        let rows = self.rows.as_ref().map_or(SupportRows::Base, |rows| SupportRows::Of(rows.descriptor()));
        MatrixSupport { name: self.name.clone(), rows, along: self.direction }
    }
}

fn direction_of(name: &str) -> Direction {
    Direction::named(name).expect("directions are checked on reading")
}
