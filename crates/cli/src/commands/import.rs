//! `hammerbeam import`: files of a finite element program, or the structure of a study, as a bundle.

use std::{
    io::Write,
    path::{Path, PathBuf},
};

use hammerbeam_jobs::matrix_document;
use hammerbeam_matrices::{
    ComponentFiles, MatrixFile, MatrixFormat, Nodes, read_component, read_lines, read_matrices, read_nodes,
    write_dofs, write_lines, write_matrix_market, write_nodes,
};
use hammerbeam_results::whole_file::WholeFile;
use hammerbeam_structure::{Matrices, MatrixSurvey, RowLabel, SymmetricMatrix};
use hammerbeam_study::{Setting, StudyFile, matrix_study};
use serde_json::json;

use crate::{
    args::ImportOptions,
    failure::Failure,
    matrix_report,
    output::{Output, decimals},
};

/// Frequencies that are reported.
const FREQUENCIES: usize = 12;

/// What a bundle holds.
struct Bundle<'a> {
    stiffness: &'a SymmetricMatrix,
    mass: &'a SymmetricMatrix,
    damping: Option<&'a SymmetricMatrix>,
    labels: &'a [RowLabel],
    nodes: &'a Nodes,
    lines: &'a [[i64; 2]],
}

pub fn run(options: &ImportOptions, output: Output) -> Result<(), Failure> {
    let is_study = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
    match options.files.as_slice() {
        [study] if is_study(study) => export_study((study, &options.set), &options.out, output),
        _ if !options.set.is_empty() => Err(Failure::BadInput(
            "--set gives keys of a study other values, and no study is given".to_owned(),
        )),
        _ => import_files(options, output),
    }
}

/// The structure of a study, with a study that reads it back.
fn export_study((study, set): (&Path, &[Setting]), out: &Path, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read_with(study, set)?;
    let (exported, text) = matrix_study(&file)?;
    let bundle = Bundle {
        stiffness: &exported.stiffness,
        mass: &exported.mass,
        damping: exported.damping.as_ref(),
        labels: &exported.labels,
        nodes: &exported.nodes,
        lines: &exported.lines,
    };
    let mut written = write_bundle(out, &bundle)?;
    written.push(write(out, "study.toml", |file| file.write_all(text.as_bytes()))?);
    let rows = exported.stiffness.size();
    let document = json!({ "rows": rows, "files": written });
    output.give(&document, || format!("{rows} rows\nwritten      {}", written.join(", ")))
}

fn import_files(options: &ImportOptions, output: Output) -> Result<(), Failure> {
    let parts = Parts::of(options)?;
    let mut component = read_component(&parts.component(options)?).map_err(bad)?;
    if component.labels.is_empty() {
        component.labels = parts.labels_by_nodes(component.stiffness.size())?;
    }
    let mut nodes = Nodes::new();
    if let Some(path) = &parts.nodes {
        let factor = options.length_factor;
        let scaled = read_nodes(path).map_err(bad)?.into_iter();
        nodes = scaled.map(|(node, place)| (node, place.map(|part| factor * part))).collect();
    }
    let lines = parts.lines.as_ref().map_or(Ok(Vec::new()), |path| read_lines(path).map_err(bad))?;
    let memory_limit_bytes = (1e9 * options.memory_gb) as u64;
    let matrices = Matrices { nodes, ..Matrices::new(vec![component], memory_limit_bytes) };
    let survey = matrices.survey(FREQUENCIES).map_err(|error| Failure::BadInput(error.to_string()))?;
    let bundle = Bundle {
        stiffness: &survey.stiffness,
        mass: &survey.mass,
        damping: survey.damping.as_ref(),
        labels: &survey.labels,
        nodes: &matrices.nodes,
        lines: &lines,
    };
    let written = write_bundle(&options.out, &bundle)?;
    let document = json!({
        "matrices": matrix_document(&survey.report),
        "mass_rank": survey.mass_rank,
        "frequencies_hz": survey.frequencies_hz,
        "files": written,
    });
    output.give(&document, || text(&survey, &written))
}

fn text(survey: &MatrixSurvey, written: &[String]) -> String {
    let mut lines = matrix_report::lines(&survey.report);
    lines.push(format!(
        "stiffness    symmetric, positive semi-definite, {} entries of one triangle",
        survey.stiffness.stored()
    ));
    let rank = survey.mass_rank.map_or("not found".to_owned(), |rank| rank.to_string());
    let entries = survey.mass.stored();
    lines.push(format!("mass matrix  symmetric, positive semi-definite, rank {rank}, {entries} entries"));
    let frequencies: Vec<String> = survey.frequencies_hz.iter().map(|f| decimals(*f, 6)).collect();
    lines.push(format!("frequencies  {} Hz", frequencies.join(", ")));
    lines.push(format!("written      {}", written.join(", ")));
    lines.join("\n")
}

/// Which file is what.
#[derive(Default)]
struct Parts {
    stiffness: Option<PathBuf>,
    mass: Option<PathBuf>,
    damping: Option<PathBuf>,
    labels: Option<PathBuf>,
    nodes: Option<PathBuf>,
    lines: Option<PathBuf>,
    /// An input deck, whose nodes may be what the rows are.
    deck: Option<PathBuf>,
}

/// What a file is by its name.
#[derive(Clone, Copy, PartialEq)]
enum FileRole {
    Stiffness,
    Mass,
    Damping,
    Labels,
    Nodes,
    Lines,
    Deck,
    /// Matrices of several names, or cards.
    Several,
}

impl Parts {
    fn of(options: &ImportOptions) -> Result<Self, Failure> {
        let mut parts = Self {
            stiffness: options.stiffness.clone(),
            mass: options.mass.clone(),
            damping: options.damping.clone(),
            labels: options.dofs.clone(),
            nodes: options.nodes.clone(),
            ..Self::default()
        };
        for path in &options.files {
            parts.take(path, options)?;
        }
        Ok(parts)
    }

    fn take(&mut self, path: &Path, options: &ImportOptions) -> Result<(), Failure> {
        let place = match role(path) {
            FileRole::Stiffness => &mut self.stiffness,
            FileRole::Mass => &mut self.mass,
            FileRole::Damping => &mut self.damping,
            FileRole::Labels => &mut self.labels,
            FileRole::Nodes => &mut self.nodes,
            FileRole::Lines => &mut self.lines,
            FileRole::Deck => {
                self.deck = Some(path.to_owned());
                &mut self.nodes
            }
            FileRole::Several => return self.take_several(path, options),
        };
        give_once(place, path)
    }

    /// Matrices by the names in the file, or the order of rows.
    fn take_several(&mut self, path: &Path, options: &ImportOptions) -> Result<(), Failure> {
        let format = options.format.as_deref().and_then(MatrixFormat::named);
        match read_matrices(path, format) {
            Ok(matrices) if matrices.len() > 1 => {
                give_once(&mut self.stiffness, path)?;
                give_once(&mut self.mass, path)
            }
            Ok(_) => {
                let place = if self.stiffness.is_none() { &mut self.stiffness } else { &mut self.mass };
                give_once(place, path)
            }
            Err(_) if hammerbeam_matrices::read_labels(path).is_ok() => give_once(&mut self.labels, path),
            Err(error) => Err(bad(error)),
        }
    }

    fn component(&self, options: &ImportOptions) -> Result<ComponentFiles, Failure> {
        let file = |path: &Option<PathBuf>, what: &str, matrix: &Option<String>, factor: f64| {
            let path = path.clone().ok_or_else(|| {
                Failure::BadInput(format!(
                    "none of the files is known as the {what}; name it with --{what} FILE"
                ))
            })?;
            Ok::<MatrixFile, Failure>(MatrixFile { path, matrix: matrix.clone(), factor })
        };
        let damping = self.damping.as_ref().map(|path| MatrixFile {
            path: path.clone(),
            matrix: None,
            factor: options.damping_factor,
        });
        Ok(ComponentFiles {
            name: String::new(),
            format: options.format.as_deref().and_then(MatrixFormat::named),
            stiffness: file(
                &self.stiffness,
                "stiffness",
                &options.stiffness_matrix,
                options.stiffness_factor,
            )?,
            mass: file(&self.mass, "mass", &options.mass_matrix, options.mass_factor)?,
            damping,
            labels: self.labels.clone(),
        })
    }

    /// Three or six rows for each node of an input deck, if there are so many.
    fn labels_by_nodes(&self, rows: usize) -> Result<Vec<RowLabel>, Failure> {
        let Some(deck) = &self.deck else { return Ok(Vec::new()) };
        let nodes = read_nodes(deck).map_err(bad)?;
        let each = match rows {
            _ if rows == 3 * nodes.len() => 3,
            _ if rows == 6 * nodes.len() => 6,
            _ => return Ok(Vec::new()),
        };
        let direction = hammerbeam_structure::Direction::numbered;
        let of = |&node: &i64| (1..=each).map(move |n| RowLabel::physical(node, direction(n)));
        Ok(nodes.keys().flat_map(of).collect())
    }
}

fn give_once(place: &mut Option<PathBuf>, path: &Path) -> Result<(), Failure> {
    match place {
        Some(other) if other != path => Err(Failure::BadInput(format!(
            "{} and {} seem to be the same part; name the parts with --stiffness, --mass, --damping, --dofs \
            and --nodes",
            other.display(),
            path.display()
        ))),
        _ => {
            *place = Some(path.to_owned());
            Ok(())
        }
    }
}

/// What a file is, by its name.
fn role(path: &Path) -> FileRole {
    let name = path.file_name().map(|name| name.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let extension =
        path.extension().map(|name| name.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    let stem = name.strip_suffix(&format!(".{extension}")).unwrap_or(&name);
    match extension.as_str() {
        "sti" => FileRole::Stiffness,
        "mas" => FileRole::Mass,
        "dam" => FileRole::Damping,
        "dof" => FileRole::Labels,
        "inp" => FileRole::Deck,
        "bdf" | "nas" => FileRole::Nodes,
        "csv" if name.contains("node") => FileRole::Nodes,
        "csv" if name.contains("line") => FileRole::Lines,
        "csv" => FileRole::Labels,
        _ if stem.contains("stif") || stem == "k" || stem.starts_with("k_") => FileRole::Stiffness,
        _ if stem.contains("mass") || stem == "m" || stem.starts_with("m_") => FileRole::Mass,
        _ if stem.contains("damp") || stem.contains("dmpv") || stem == "c" => FileRole::Damping,
        _ => FileRole::Several,
    }
}

fn write_bundle(out: &Path, bundle: &Bundle<'_>) -> Result<Vec<String>, Failure> {
    let mut written = vec![
        write(out, "K.mtx", |file| write_matrix_market(bundle.stiffness, file))?,
        write(out, "M.mtx", |file| write_matrix_market(bundle.mass, file))?,
    ];
    if let Some(damping) = bundle.damping {
        written.push(write(out, "C.mtx", |file| write_matrix_market(damping, file))?);
    }
    if !bundle.labels.is_empty() {
        written.push(write(out, "dofs.csv", |file| write_dofs(bundle.labels, file))?);
    }
    if !bundle.nodes.is_empty() {
        written.push(write(out, "nodes.csv", |file| write_nodes(bundle.nodes, file))?);
    }
    if !bundle.lines.is_empty() {
        written.push(write(out, "lines.csv", |file| write_lines(bundle.lines, file))?);
    }
    Ok(written)
}

/// Writes a file whole, and gives its name.
fn write(
    folder: &Path,
    name: &str,
    content: impl FnOnce(&mut WholeFile) -> std::io::Result<()>,
) -> Result<String, Failure> {
    let path = folder.join(name);
    let mut file = WholeFile::begin(&path)?;
    content(&mut file)
        .map_err(|error| Failure::NoResult(format!("cannot write {}: {error}", path.display())))?;
    file.finish()?;
    Ok(name.to_owned())
}

fn bad(error: hammerbeam_matrices::MatrixError) -> Failure {
    Failure::BadInput(error.to_string())
}
