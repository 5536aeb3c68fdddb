//! `[structure]` of kind "matrices": stiffness and mass of a finite element program, from files.

use std::path::{Path, PathBuf};

use hammerbeam_matrices::{ComponentFiles, MatrixFile, MatrixFormat, Nodes, read_component, read_nodes};
use hammerbeam_structure::{
    self as linear, Along, Direction, MatrixComponent, MatrixPoint, MatrixSupport, PointPlace, RowSet,
    SupportRows,
};
use serde::Serialize;

use crate::document::{Quantity, Reading, Table, Value, quantity};

use super::{
    file_checksum::checksum,
    names::{Names, read_name},
};

/// Memory [GB] that the factors of the matrices may take, unless the study says so.
const MEMORY_GB: f64 = 4.0;
/// Most nodes of a set.
const MOST_NODES: u32 = 1_000_000;

/// A structure given as matrices.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Matrices {
    /// Its components; one without a name where the files stand in `[structure]` itself.
    pub components: Vec<MatrixFiles>,
    /// Where nodes are.
    pub nodes: Option<InputFile>,
    /// Factor that brings their places to metres.
    pub length_factor: f64,
    /// Named points.
    pub points: Vec<MatrixPointEntry>,
    /// Supports by name.
    pub supports: Vec<MatrixSupportEntry>,
    /// Rows that are held.
    pub fixed: Vec<RowSetEntry>,
    /// Direction of gravity in space.
    pub acceleration_direction: Option<[f64; 3]>,
    /// Memory for factors [GB]; no part of the identity.
    #[serde(skip)]
    pub memory_gb: f64,
}

/// A file with what it held when the study was read: results belong to that.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InputFile {
    /// The file; no part of the identity.
    #[serde(skip)]
    pub path: PathBuf,
    /// Its name as the study has it; no part of the identity.
    #[serde(skip)]
    pub written: String,
    /// Checksum of its bytes and their number.
    pub checksum: String,
}

/// The files of a component.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixFiles {
    /// Name.
    pub name: String,
    /// Format of the matrices; found out if `None`.
    pub format: Option<String>,
    /// Stiffness.
    pub stiffness: MatrixEntry,
    /// Mass.
    pub mass: MatrixEntry,
    /// Damping.
    pub damping: Option<MatrixEntry>,
    /// What rows are.
    pub dofs: Option<InputFile>,
}

/// A matrix of a file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixEntry {
    /// The file.
    pub file: InputFile,
    /// Name of the matrix in it; found out if `None`.
    pub matrix: Option<String>,
    /// Factor that brings it to SI units.
    pub factor: f64,
}

/// Which way a point looks or a support moves.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum DirectionEntry {
    /// `x`, `y`, `z`, `rx`, `ry`, `rz` or a number.
    Named(String),
    /// A vector in space.
    Vector([f64; 3]),
}

/// A named point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixPointEntry {
    /// Name.
    pub name: String,
    /// What it is.
    pub place: PointPlaceEntry,
}

/// What a point is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointPlaceEntry {
    /// A node in a direction.
    Node {
        /// Number of the node.
        node: u32,
        /// Direction.
        direction: DirectionEntry,
    },
    /// The row with a name in `dofs.csv`.
    Label(String),
    /// A row, from 1.
    Row {
        /// Number of the component, from 0.
        component: usize,
        /// Row.
        row: u32,
    },
}

/// Rows by nodes or one by one.
#[derive(Debug, Clone, PartialEq, Serialize, Default)]
pub struct RowSetEntry {
    /// Nodes, as runs from first to last.
    pub nodes: Vec<[u32; 2]>,
    /// Rows, from 1.
    pub rows: Vec<u32>,
    /// Directions of the nodes; all if empty.
    pub directions: Vec<String>,
}

/// A support.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MatrixSupportEntry {
    /// Name.
    pub name: String,
    /// What it holds; everything that holds the structure if `None`.
    pub rows: Option<RowSetEntry>,
    /// Direction in which it can move.
    pub direction: [f64; 3],
}

/// Factor of a unit.
const FACTOR: Quantity = quantity::FACTOR;

pub(super) fn read(table: &Table<'_>, reading: &Reading, names: &mut Names) -> Option<Matrices> {
    let before = reading.count();
    names.add_supports();
    let components = read_components(table, reading);
    let known: Vec<String> = components.iter().flatten().map(|component| component.name.clone()).collect();
    let nodes = optional_file(table, "nodes", reading);
    let length_factor = factor(table, "length_factor");
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
    let memory_gb =
        table.optional("memory_gb").map_or(Some(MEMORY_GB), |value| value.number(&quantity::MEMORY_GB));
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
    let matrices = Matrices {
        components: components?,
        nodes: nodes?,
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

/// One component of `[structure]` itself, or those of `[[structure.component]]`.
fn read_components(table: &Table<'_>, reading: &Reading) -> Option<Vec<MatrixFiles>> {
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

fn read_files(table: &Table<'_>, name: String, reading: &Reading) -> Option<MatrixFiles> {
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
        let factor = factor(table, scale);
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

fn factor(table: &Table<'_>, key: &'static str) -> Option<f64> {
    table.optional(key).map_or(Some(1.0), |value| value.number(&FACTOR))
}

/// A file that need not be given.
fn optional_file(table: &Table<'_>, key: &'static str, reading: &Reading) -> Option<Option<InputFile>> {
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

fn read_point(table: Table<'_>, components: &[String], names: &mut Names) -> Option<MatrixPointEntry> {
    let name = read_name(&table, names);
    let component = table.optional("component").map_or(Some(0), |value| {
        let known: Vec<&str> = components.iter().map(String::as_str).collect();
        let name = value.text()?;
        let found = known.iter().position(|known| *known == name);
        if found.is_none() {
            value.unknown_word(name, "a component of this structure", &known);
        }
        found
    });
    let given = ["node", "label", "row"].into_iter().filter(|key| table.has(key)).count();
    let place = if given == 1 {
        read_place(&table, component)
    } else {
        for key in ["node", "direction", "label", "row"] {
            table.optional(key);
        }
        let help = vec!["allowed: `node` with `direction`, `label`, or `row`".to_owned()];
        table.problem("name", format!("{given} of `node`, `label` and `row` are given"), help);
        None
    };
    table.finish();
    Some(MatrixPointEntry { name: name?, place: place? })
}

fn read_place(table: &Table<'_>, component: Option<usize>) -> Option<PointPlaceEntry> {
    if table.has("node") {
        let node = table.required("node").and_then(|value| value.whole(0, u32::MAX));
        let direction = table.required("direction").and_then(|value| read_direction(&value));
        return Some(PointPlaceEntry::Node { node: node?, direction: direction? });
    }
    if table.has("label") {
        return table.required("label")?.text().map(|label| PointPlaceEntry::Label(label.to_owned()));
    }
    let row = table.required("row").and_then(|value| value.whole(1, u32::MAX));
    Some(PointPlaceEntry::Row { component: component?, row: row? })
}

fn read_support(table: Table<'_>, names: &mut Names) -> Option<MatrixSupportEntry> {
    let name = table.required("name").and_then(|value| {
        let name = value.text()?;
        names.add_support(&value, name).then(|| name.to_owned())
    });
    let everything = table.optional("everything").map_or(Some(false), |value| value.boolean());
    let direction = table.required("direction").and_then(|value| read_vector(&value));
    let rows = read_rows(&table, everything == Some(false));
    table.finish();
    let rows = rows?;
    let rows = (!everything?).then_some(rows);
    Some(MatrixSupportEntry { name: name?, rows, direction: direction? })
}

fn read_rows(table: &Table<'_>, required: bool) -> Option<RowSetEntry> {
    let nodes = table.optional("nodes").map_or(Some(Vec::new()), |value| read_nodes_list(&value));
    let rows = table.optional("rows").map_or(Some(Vec::new()), |value| {
        let rows = value.array_of("rows")?;
        rows.iter().map(|row| row.whole(1, u32::MAX)).collect()
    });
    let directions = table.optional("directions").map_or(Some(Vec::new()), |value| {
        let elements = value.array_of("directions")?;
        elements.iter().map(read_name_of_direction).collect()
    });
    let set = RowSetEntry { nodes: nodes?, rows: rows?, directions: directions? };
    if required && set.nodes.is_empty() && set.rows.is_empty() {
        let help = vec!["allowed: `nodes`, `rows`, or both".to_owned()];
        table.problem("nodes", "neither nodes nor rows are given".into(), help);
        return None;
    }
    Some(set)
}

/// Nodes one by one, or as runs in a text: `[3, "10-20"]`.
fn read_nodes_list(value: &Value<'_>) -> Option<Vec<[u32; 2]>> {
    let elements = value.array_of("nodes")?;
    let run = |element: &Value<'_>| {
        if !element.is_text() {
            return element.whole(0, u32::MAX).map(|node| [node, node]);
        }
        let text = element.text()?;
        let ends = text.split_once('-').and_then(|(first, last)| {
            Some([first.trim().parse::<u32>().ok()?, last.trim().parse::<u32>().ok()?])
        });
        let ends = ends.filter(|[first, last]| first <= last && last - first < MOST_NODES);
        if ends.is_none() {
            let help = vec![format!("allowed: \"first-last\", at most {MOST_NODES} nodes")];
            element.problem(format!("\"{text}\" is no run of nodes"), help);
        }
        ends
    };
    elements.iter().map(run).collect()
}

fn read_name_of_direction(value: &Value<'_>) -> Option<String> {
    let name = value.text()?;
    if Direction::named(name).is_none() {
        value.unknown_word(name, "a direction", &["x", "y", "z", "rx", "ry", "rz"]);
        return None;
    }
    Some(name.to_owned())
}

fn read_direction(value: &Value<'_>) -> Option<DirectionEntry> {
    if value.is_text() {
        return read_name_of_direction(value).map(DirectionEntry::Named);
    }
    read_vector(value).map(DirectionEntry::Vector)
}

/// A direction in space: `x`, `-y`, or three numbers.
fn read_vector(value: &Value<'_>) -> Option<[f64; 3]> {
    if !value.is_text() {
        let vector = value.numbers::<3>(&quantity::DIRECTION)?;
        if vector == [0.0; 3] {
            value.problem(
                "the direction has no length".into(),
                vec!["allowed: three numbers, not all 0".into()],
            );
            return None;
        }
        return Some(vector);
    }
    let name = value.text()?;
    let (sign, axis) = name.strip_prefix('-').map_or((1.0, name), |axis| (-1.0, axis));
    match axis {
        "x" => Some([sign, 0.0, 0.0]),
        "y" => Some([0.0, sign, 0.0]),
        "z" => Some([0.0, 0.0, sign]),
        _ => {
            value.unknown_word(name, "a direction in space", &["x", "y", "z", "-x", "-y", "-z"]);
            None
        }
    }
}

/// Why the files of a study make no structure: the key to blame, and what is wrong.
#[derive(Debug)]
pub(crate) struct MatrixProblem {
    /// Key path below `structure`.
    pub key: &'static str,
    /// What is wrong, with file and place.
    pub message: String,
}

impl Matrices {
    /// All files, each as often as it is named.
    pub(crate) fn files(&self) -> impl Iterator<Item = &InputFile> {
        let entries = self.components.iter().flat_map(|files| {
            [Some(&files.stiffness), Some(&files.mass), files.damping.as_ref()]
                .into_iter()
                .flatten()
                .map(|entry| &entry.file)
                .chain(&files.dofs)
        });
        entries.chain(&self.nodes)
    }

    /// The matrices in the terms of the structure crate.
    ///
    /// # Errors
    /// What a file has wrong, with its place.
    pub(crate) fn descriptor(&self) -> Result<linear::Matrices, MatrixProblem> {
        let components: Result<Vec<MatrixComponent>, MatrixProblem> =
            self.components.iter().map(MatrixFiles::read).collect();
        let nodes = match &self.nodes {
            None => Nodes::new(),
            Some(file) => {
                let nodes = read_nodes(&file.path);
                nodes.map_err(|error| MatrixProblem { key: "nodes", message: error.to_string() })?
            }
        };
        let factor = self.length_factor;
        Ok(linear::Matrices {
            components: components?,
            nodes: nodes.into_iter().map(|(node, place)| (node, place.map(|part| factor * part))).collect(),
            points: self.points.iter().map(MatrixPointEntry::descriptor).collect(),
            supports: self.supports.iter().map(MatrixSupportEntry::descriptor).collect(),
            fixed: self.fixed.iter().map(RowSetEntry::descriptor).collect(),
            acceleration: self.acceleration_direction,
            memory_limit_bytes: (1e9 * self.memory_gb) as u64,
        })
    }
}

impl MatrixFiles {
    fn read(&self) -> Result<MatrixComponent, MatrixProblem> {
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
        read_component(&files).map_err(|error| {
            let is = |path: &Path| error.path == path;
            let key = if is(&self.stiffness.file.path) {
                "stiffness"
            } else if is(&self.mass.file.path) {
                "mass"
            } else if self.dofs.as_ref().is_some_and(|dofs| is(&dofs.path)) {
                "dofs"
            } else {
                "damping"
            };
            MatrixProblem { key, message: error.to_string() }
        })
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
