//! The whole study and its file.

use std::{
    collections::BTreeMap,
    io,
    ops::Range,
    path::{Path, PathBuf},
};

use hammerbeam_signal::limits::{self, LARGEST_TEXT};
use serde::Serialize;
use toml::de::DeTable;

use crate::{
    document::{FaultReport, Problem, Reading, TomlTable, place},
    setting::{Setting, SettingError},
};

use super::{
    ContinuationTable, Curve, DampingTable, Excitation, Figures, HarmonicExcitation, LoadTable, OutputEntry,
    ReductionTable, ResponseTable, Rig, Search, Stop, StructureTable, VariedParameter, Vary, continuation,
    damping, excitation, figures, load, names::Names, output, parameter::Variable, reduction, response, rig,
    search, stop, structure, vary,
};

/// Everything a study says.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Study {
    /// Title for reports and figures; no part of the identity.
    #[serde(skip)]
    pub title: String,
    /// The linear structure.
    pub structure: StructureTable,
    /// How it is reduced.
    pub reduction: ReductionTable,
    /// Damping of its modes.
    pub damping: DampingTable,
    /// The excitation.
    pub excitation: Excitation,
    /// Further loads.
    pub loads: Vec<LoadTable>,
    /// Local elements.
    pub stops: Vec<Stop>,
    /// What is asked for.
    pub response: ResponseTable,
    /// How thoroughly branches are looked for.
    pub search: Search,
    /// How branches are followed.
    pub continuation: ContinuationTable,
    /// Branches in other parameters; no part of the identity, since they stand beside the branches.
    #[serde(skip)]
    pub varies: Vec<Vary>,
    /// Curves of bifurcations; no part of the identity.
    #[serde(skip)]
    pub curves: Vec<Curve>,
    /// What is read off the orbits besides; no part of the identity, since it is computed from them.
    #[serde(skip)]
    pub outputs: Vec<OutputEntry>,
    /// What the figures show besides; no part of the identity.
    #[serde(skip)]
    pub figures: Figures,
    /// A virtual rig; no part of the identity.
    #[serde(skip)]
    pub rig: Option<Rig>,
}

impl Study {
    /// Every parameter that varies, with the key of what asks for it: `vary[0]` and so on, then `curve[0]`.
    pub(crate) fn varied(&self) -> impl Iterator<Item = (String, &VariedParameter)> {
        let varies = self.varies.iter().enumerate().map(|(k, vary)| (format!("vary[{k}]"), &vary.parameter));
        let curves =
            self.curves.iter().enumerate().map(|(k, curve)| (format!("curve[{k}]"), &curve.parameter));
        varies.chain(curves)
    }

    /// Points at which forces of the excitation and of the loads act.
    pub fn force_points(&self) -> impl Iterator<Item = &str> {
        let of_loads = self.loads.iter().flat_map(LoadTable::force_points).map(String::as_str);
        self.excitation.force_points().into_iter().chain(of_loads)
    }
}

/// A study with the text it was read from, so that faults found later can still point into it.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyFile {
    /// Name of the file.
    pub name: String,
    /// Its text.
    pub text: String,
    /// What it says.
    pub study: Study,
    places: BTreeMap<String, Range<usize>>,
}

/// Why there is no study.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The file could not be read.
    #[error("cannot read the study {}: {source}", path.display())]
    #[expect(missing_docs, reason = "the message names its fields")]
    Unreadable { path: PathBuf, source: io::Error },
    /// The file says something that is not allowed.
    #[error("{0}")]
    Invalid(FaultReport),
    /// A key cannot be given another value.
    #[error("{0}")]
    Setting(SettingError),
    /// Nothing shakes the structure, so that there is no frequency and no period.
    #[error(
        "{name} has no [excitation]: without a frequency there are no periodic responses to look for; \
         `simulate`, `check`, `modes` and `update` from eigenfrequencies take a study without one"
    )]
    #[expect(missing_docs, reason = "the message names its fields")]
    Unforced { name: String },
}

impl StudyFile {
    /// Reads a study file.
    ///
    /// # Errors
    /// [`StudyError`]: the file cannot be read, or something in it is not allowed.
    pub fn read(path: &Path) -> Result<Self, StudyError> {
        Self::read_with(path, &[])
    }

    /// Reads a study file in which keys have other values; its text then says so.
    ///
    /// # Errors
    /// [`StudyError`]; faults stand where the text with these values has them.
    pub fn read_with(path: &Path, settings: &[Setting]) -> Result<Self, StudyError> {
        let name = path.display().to_string();
        let text = limits::read_text(path, LARGEST_TEXT)
            .map_err(|source| StudyError::Unreadable { path: path.to_owned(), source })?;
        match Setting::written_into(settings, &text) {
            // What is not TOML is reported as that.
            Err(SettingError::NotToml { .. }) => Self::parse(&name, text),
            Err(source) => Err(StudyError::Setting(source)),
            Ok(text) => Self::parse(&name, text),
        }
    }

    /// Reads a study from its text.
    ///
    /// # Errors
    /// [`StudyError::Invalid`] with everything that is not allowed.
    pub fn parse(name: &str, text: String) -> Result<Self, StudyError> {
        Self::parse_with(name, text, true)
    }

    /// The same without branches in other parameters and curves, whatever the text says of them.
    pub(crate) fn parse_model(name: &str, text: String) -> Result<Self, StudyError> {
        Self::parse_with(name, text, false)
    }

    fn parse_with(name: &str, text: String, pieces: bool) -> Result<Self, StudyError> {
        let reading = reading_beside(name);
        let study = read_text(&text, &reading, pieces);
        let (problems, left_out, places) = reading.into_parts();
        match study {
            Some(study) if problems.is_empty() => Ok(Self { name: name.to_owned(), text, study, places }),
            _ => Err(StudyError::Invalid(FaultReport::new(name, &text, problems).and(left_out))),
        }
    }

    /// What a text says of the structure and of what moves it, whatever else it says: a study without stops,
    /// for faults that only the assembled structure shows. `None` if that part has faults itself.
    pub(crate) fn parse_structure(name: &str, text: &str) -> Option<Self> {
        let reading = reading_beside(name);
        let document = DeTable::parse(text).ok()?;
        let nothing = DeTable::new();
        let root = TomlTable::new(&reading, String::new(), 0..0, document.get_ref());
        let rest = TomlTable::new(&reading, String::new(), 0..0, &nothing);
        let study = read_tables((&root, &rest), &reading, (text, false))?;
        let (problems, _, places) = reading.into_parts();
        let file = Self { name: name.to_owned(), text: text.to_owned(), study, places };
        problems.is_empty().then_some(file)
    }

    /// The excitation, for what needs its frequency.
    ///
    /// # Errors
    /// [`StudyError::Unforced`].
    pub fn forced(&self) -> Result<&HarmonicExcitation, StudyError> {
        self.study.excitation.harmonic().ok_or_else(|| StudyError::Unforced { name: self.name.clone() })
    }

    /// The text, in which the files of a structure are named from the root, so that it can be read from
    /// elsewhere.
    #[must_use]
    pub fn text_with_whole_paths(&self) -> String {
        let StructureTable::Matrices(matrices) = &self.study.structure else { return self.text.clone() };
        let mut text = self.text.clone();
        for file in matrices.files() {
            let path = std::path::absolute(&file.path).unwrap_or_else(|_| file.path.clone());
            // A literal string takes any path but one with a quote.
            let whole = format!("'{}'", path.display());
            text = text.replace(&format!("\"{}\"", file.written), &whole);
            text = text.replace(&format!("'{}'", file.written), &whole);
        }
        text
    }

    /// A fault of a key that was found after reading.
    #[must_use]
    pub fn fault(&self, key: &str, message: String, help: Vec<String>) -> StudyError {
        let problem = Problem { key: key.to_owned(), span: place(&self.places, key), message, help };
        StudyError::Invalid(FaultReport::new(&self.name, &self.text, vec![problem]))
    }
}

fn read_text(text: &str, reading: &Reading, pieces: bool) -> Option<Study> {
    let (document, errors) = DeTable::parse_recoverable(text);
    for error in &errors {
        reading.problem("", error.span(), format!("not TOML: {}", error.message()), Vec::new());
    }
    if !errors.is_empty() {
        return None;
    }
    let root = TomlTable::new(reading, String::new(), 0..0, document.get_ref());
    let study = read_tables((&root, &root), reading, (text, pieces));
    root.finish();
    study
}

/// A reading of a document whose files lie beside it.
fn reading_beside(name: &str) -> Reading {
    Reading::in_folder(Path::new(name).parent().unwrap_or(Path::new("")))
}

/// The study: its structure and what moves it from one document, all else from another, which is the same or
/// empty.
fn read_tables(
    (linear, root): (&TomlTable<'_>, &TomlTable<'_>),
    reading: &Reading,
    (text, pieces): (&str, bool),
) -> Option<Study> {
    let mut names = Names::default();
    let title = root.optional("title").map_or(Some(""), |value| value.text());
    let (kind, structure) = structure::read(linear, reading, &mut names);
    let reduction = reduction::read(linear, kind);
    let damping = damping::read(linear);
    let excitation = excitation::read(linear, &names, structure.as_ref());
    let loads = load::read(root, reading, &names, excitation.as_ref());
    let stops = stop::read(root, reading, &names, excitation.as_ref());
    let response = response::read(root, &names, stops.as_deref());
    let search = search::read(root);
    let continuation = continuation::read(root, excitation.as_ref());
    let variable = Variable {
        text,
        structure: structure.as_ref(),
        excitation: excitation.as_ref(),
        damping: damping.as_ref(),
        loads: loads.as_deref(),
        stops: stops.as_deref(),
    };
    let varied = if pieces { vary::read(root, reading, variable) } else { Some(vary::passed_over(root)) };
    let referred =
        output::Referred { names: &names, excitation: excitation.as_ref(), stops: stops.as_deref() };
    let outputs = output::read(root, reading, &referred);
    let figures = figures::read(root, reading);
    let rig = rig::read(root, excitation.as_ref());
    let varied = varied?;
    Some(Study {
        title: title?.to_owned(),
        structure: structure?,
        reduction: reduction?,
        damping: damping?,
        excitation: excitation?,
        loads: loads?,
        stops: stops?,
        response: response?,
        search: search?,
        continuation: continuation?,
        varies: varied.0,
        curves: varied.1,
        outputs: outputs?,
        figures: figures?,
        rig: rig?,
    })
}
