//! Periodic solutions.

use std::sync::Arc;

use hammerbeam::{
    Error, Observer, Quiet, Study,
    chosen_orbits::{ChosenOrbit, orbit_table, orbit_tables},
    results::arrays::ArrayTable,
};
use pyo3::{exceptions::PyIndexError, prelude::*};

use crate::{
    asked::Callback,
    failure::exception,
    observer::PythonObserver,
    records::{PackedTable, all_packed, packed},
};

/// Periodic solutions of a study.
#[pyclass(frozen, module = "hammerbeam._native")]
pub struct NativeOrbits {
    study: Arc<Study>,
    orbits: Vec<ChosenOrbit>,
}

impl NativeOrbits {
    /// Solutions of a study.
    pub fn new(study: Arc<Study>, orbits: Vec<ChosenOrbit>) -> Self {
        Self { study, orbits }
    }

    /// All of them as tables.
    pub fn tables(&self, samples: usize, observer: &mut dyn Observer) -> Result<[ArrayTable; 2], Error> {
        orbit_tables(&self.study.model, &self.orbits, samples, observer)
    }
}

#[pymethods]
impl NativeOrbits {
    fn __len__(&self) -> usize {
        self.orbits.len()
    }

    /// Name of the response point.
    #[getter]
    fn response_point(&self) -> &str {
        &self.study.file.study.response.point
    }

    /// One row for each.
    fn table(&self, py: Python<'_>) -> PyResult<PackedTable> {
        packed(py, &orbit_table(&self.orbits))
    }

    /// All of them with their motions.
    fn tables_of_all<'py>(
        &self,
        py: Python<'py>,
        samples: usize,
        callbacks: (Callback, Callback),
    ) -> PyResult<Vec<PackedTable>> {
        let tables = PythonObserver::run(py, callbacks, |observer| self.tables(samples, observer))?;
        all_packed(py, &tables.map_err(|error| exception(py, error))?)
    }

    /// Some of them, in the order that is given.
    fn chosen(&self, indices: Vec<usize>) -> PyResult<Self> {
        let one = |index: usize| self.orbits.get(index).cloned().ok_or_else(no_such_orbit);
        let orbits = indices.into_iter().map(one).collect::<PyResult<_>>()?;
        Ok(Self { study: self.study.clone(), orbits })
    }

    /// The motion of one of them over its period.
    fn waveform(&self, py: Python<'_>, index: usize, samples: usize) -> PyResult<PackedTable> {
        let orbit = self.orbits.get(index).ok_or_else(no_such_orbit)?;
        let one = std::slice::from_ref(orbit);
        let tables = py.detach(|| orbit_tables(&self.study.model, one, samples, &mut Quiet));
        let [_, waveform] = tables.map_err(|error| exception(py, error))?;
        packed(py, &waveform)
    }

    /// Shooting nodes of one of them.
    fn nodes(&self, index: usize) -> PyResult<Vec<Vec<f64>>> {
        let orbit = self.orbits.get(index).ok_or_else(no_such_orbit)?;
        Ok(orbit.solution.nodes.clone())
    }
}

fn no_such_orbit() -> PyErr {
    PyIndexError::new_err("no such orbit")
}
