//! A results folder.

use std::{
    path::PathBuf,
    sync::{Arc, Mutex, MutexGuard},
};

use hammerbeam::{
    BranchEventKind, Store, Study,
    chosen_orbits::{OrbitChoice, chosen_orbits},
    drawing::{DrawSettings, DrawingError, FigureFormat, FigureKind, FigureSelection, draw, draw_into},
    results::{
        arrays::{
            ArrayTable, TableFormat, branch_array, export_all, motion_tables, piece_arrays, request_tables,
            write_tables,
        },
        export::TableLines,
        store::StoreError,
    },
};
use pyo3::prelude::*;
use serde_json::json;

use crate::{
    asked::Callback,
    failure::{bad_input, drawing_exception, exception, store_exception, unknown},
    observer::PythonObserver,
    orbits::NativeOrbits,
    records::{NotPacked, PackedTable, all_packed, packed_rows},
    study::NativeStudy,
};

/// A results folder that is open for reading.
#[pyclass(frozen, module = "hammerbeam._native")]
pub struct NativeResults {
    folder: PathBuf,
    study: Arc<Study>,
    /// `None` when it was closed.
    store: Mutex<Option<Store>>,
}

/// Name of the table of rows, of which there may be millions: they are packed as they are read.
const ROWS: &str = "branches";
/// Names of tables.
const TABLES: [&str; 7] = [ROWS, "events", "ends", "states", "outputs", "varied", "motions"];

/// Which tables are meant, but for [`ROWS`].
fn tables(store: &Store, name: &str, branches: &[u32]) -> Result<Option<Vec<ArrayTable>>, StoreError> {
    let tables = match name {
        "events" => branch_array(store, TableLines::Events, branches)?,
        "ends" => branch_array(store, TableLines::Ends, branches)?,
        "states" => branch_array(store, TableLines::States, branches)?,
        "outputs" => branch_array(store, TableLines::Outputs, branches)?,
        "varied" => piece_arrays(store, &[TableLines::Rows])?,
        "motions" => motion_tables(store)?,
        _ => return Ok(None),
    };
    Ok(Some(tables))
}

impl NativeResults {
    fn store(&self) -> MutexGuard<'_, Option<Store>> {
        self.store.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Asks the store without the interpreter's lock.
    fn ask<T: Send, E: Into<NotPacked> + Send>(
        &self,
        py: Python<'_>,
        ask: impl FnOnce(&Store) -> Result<T, E> + Send,
    ) -> PyResult<T> {
        let answer = py.detach(|| self.store().as_ref().map(ask)).ok_or_else(|| self.closed(py))?;
        answer.map_err(|error| match error.into() {
            NotPacked::Store(error) => store_exception(py, error),
            NotPacked::Python(error) => error,
        })
    }

    /// Refuses what was closed. The interpreter's lock is let go meanwhile: whoever has the store may wait
    /// for it.
    fn check_open(&self, py: Python<'_>) -> PyResult<()> {
        if py.detach(|| self.store().is_none()) { Err(self.closed(py)) } else { Ok(()) }
    }

    fn closed(&self, py: Python<'_>) -> PyErr {
        let message = format!("the results of {} are closed", self.folder.display());
        let folder = self.folder.display().to_string();
        bad_input(py, "ClosedResults", message, json!({ "folder": folder }))
    }
}

#[pymethods]
impl NativeResults {
    /// Opens a results folder.
    #[staticmethod]
    fn open(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        let opened = py.detach(|| {
            let store = Store::open_with_rows(&folder)?;
            let study = Study::of_store(&store)?;
            Ok((store, study))
        });
        let (store, study) = opened.map_err(|error| exception(py, error))?;
        Ok(Self { folder, study: Arc::new(study), store: Mutex::new(Some(store)) })
    }

    #[getter]
    fn folder(&self) -> PathBuf {
        self.folder.clone()
    }

    /// The study whose results these are.
    #[getter]
    fn study(&self) -> NativeStudy {
        NativeStudy { study: self.study.clone() }
    }

    /// Lets the folder go.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let closed = py.detach(|| self.store().take().map_or(Ok(()), Store::finish));
        closed.map_err(|error| store_exception(py, error))
    }

    #[getter]
    fn closed_already(&self, py: Python<'_>) -> bool {
        py.detach(|| self.store().is_none())
    }

    /// Tables by their names.
    fn tables(&self, py: Python<'_>, name: &str, branches: Vec<u32>) -> PyResult<Vec<PackedTable>> {
        if name == ROWS {
            return Ok(vec![self.ask(py, |store| packed_rows(store, &branches))?]);
        }
        let found = self.ask(py, |store| tables(store, name, &branches))?;
        match found {
            Some(tables) => all_packed(py, &tables),
            None => Err(unknown(py, "table", name, &TABLES.map(String::from))),
        }
    }

    /// Tables of one request.
    fn request_tables(&self, py: Python<'_>, request: i64) -> PyResult<Vec<PackedTable>> {
        let found = self.ask(py, |store| -> Result<_, StoreError> {
            let requests = store.requests()?;
            let record = requests.iter().find(|record| record.id == request);
            record.map_or_else(|| Ok(Vec::new()), |record| request_tables(store, record))
        })?;
        all_packed(py, &found)
    }

    /// Number of rows of each branch.
    fn branch_rows(&self, py: Python<'_>) -> PyResult<Vec<(u32, u32, u64)>> {
        let branches = self.ask(py, Store::branches)?;
        let rows =
            |branch: &hammerbeam::results::store::BranchRecord| branch.up.solutions + branch.down.solutions;
        Ok(branches.iter().map(|branch| (branch.id, branch.period_multiple, rows(branch))).collect())
    }

    /// Stored orbits by branch, frequency and event.
    fn orbits(
        &self,
        py: Python<'_>,
        branches: Vec<u32>,
        frequencies_hz: Vec<f64>,
        events: Vec<String>,
    ) -> PyResult<NativeOrbits> {
        self.check_open(py)?;
        let kind = |name: &String| {
            BranchEventKind::of_branches(name).ok_or_else(|| {
                let known = BranchEventKind::OF_BRANCHES.map(|kind| kind.name().to_owned());
                unknown(py, "event", name, &known)
            })
        };
        let events = events.iter().map(kind).collect::<PyResult<_>>()?;
        let choice = OrbitChoice { branches, frequencies_hz, events };
        let found = py.detach(|| chosen_orbits(&self.study, &self.folder, &choice));
        Ok(NativeOrbits::new(self.study.clone(), found.map_err(|error| exception(py, error))?))
    }

    /// Writes what is stored as `csv`, `json` or `npz`: the files.
    fn export(&self, py: Python<'_>, format: &str, folder: PathBuf, states: bool) -> PyResult<Vec<PathBuf>> {
        let format = table_format(py, format)?;
        let written =
            py.detach(|| self.store().as_ref().map(|store| export_all(store, &folder, format, states)));
        let files = written.ok_or_else(|| self.closed(py))?;
        files.map_err(|error| exception(py, error.into()))
    }

    /// Draws figures into a folder: their names.
    fn draw(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        asked: (Vec<String>, Vec<String>, Option<f64>),
        callbacks: (Callback, Callback),
    ) -> PyResult<Vec<String>> {
        let (kinds, formats, resolution) = asked;
        let mut selection = FigureSelection::of(&self.study.file);
        let named = |kind: &FigureKind| format!("{kind:?}").to_lowercase();
        if let Some(kind) =
            kinds.iter().find(|kind| !FigureKind::ALL.iter().any(|known| named(known) == **kind))
        {
            let known: Vec<String> = FigureKind::ALL.iter().map(named).collect();
            return Err(unknown(py, "figure", kind, &known));
        }
        if !kinds.is_empty() {
            selection.kinds.retain(|kind| kinds.contains(&named(kind)));
        }
        let mut settings = DrawSettings::default();
        if !formats.is_empty() {
            settings.formats = formats.iter().map(|name| figure_format(py, name)).collect::<PyResult<_>>()?;
        }
        settings.resolution = resolution.unwrap_or(settings.resolution);
        self.check_open(py)?;
        // A store of its own: what is called meanwhile may ask these results for something.
        let drawn = PythonObserver::run(py, callbacks, |observer| {
            let (store, study) = (Store::open(&self.folder)?, &self.study);
            draw_into::<DrawingError>(&folder, settings, observer, |files| {
                draw(&store, (&study.file, &study.model), &selection, files)
            })
        })?;
        Ok(drawn.map_err(|error| drawing_exception(py, error))?.names)
    }

    /// Writes orbits and their motions as `csv`, `json` or `npz`: the files.
    #[staticmethod]
    fn export_orbits(
        py: Python<'_>,
        orbits: &NativeOrbits,
        format: &str,
        folder: PathBuf,
        samples: usize,
        callbacks: (Callback, Callback),
    ) -> PyResult<Vec<PathBuf>> {
        let format = table_format(py, format)?;
        let written = PythonObserver::run(py, callbacks, |observer| -> Result<_, hammerbeam::Error> {
            Ok(write_tables(&orbits.tables(samples, observer)?, &folder, ("orbits", format))?)
        })?;
        written.map_err(|error| exception(py, error))
    }
}

/// A format by its name.
fn table_format(py: Python<'_>, name: &str) -> PyResult<TableFormat> {
    let found = TableFormat::ALL.into_iter().find(|format| format.name() == name);
    let known = || TableFormat::ALL.map(|format| format.name().to_owned());
    found.ok_or_else(|| unknown(py, "format", name, &known()))
}

/// A format of figures by its name.
fn figure_format(py: Python<'_>, name: &str) -> PyResult<FigureFormat> {
    let found = FigureFormat::ALL.into_iter().find(|format| format.suffix() == name);
    let known = || FigureFormat::ALL.map(|format| format.suffix().to_owned());
    found.ok_or_else(|| unknown(py, "format", name, &known()))
}
