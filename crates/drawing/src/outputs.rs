//! Numbers of outputs that figures and the page show, over the branches.

use hammerbeam_figure::{
    Figure, FigureError, OutputAxis, ResponseCurve, ResponseDiagram, ResponseQuantity, ResponseSettings,
};
use hammerbeam_orbit::SignalStatistics;
use hammerbeam_results::{
    Store, StoreError,
    store::{BranchRecord, StoredOutputs, solution_key},
};
use hammerbeam_study::{
    StudyFile,
    file::{OutputEntry, OutputValue},
};

use crate::parameter::file_name;

/// A number of an output that is shown.
#[derive(Debug, Clone, PartialEq)]
pub struct ShownOutput {
    /// Number of the output among the stored ones, from 0.
    place: usize,
    output: OutputEntry,
    value: OutputValue,
}

/// What a study shows of the outputs that a folder holds.
pub fn shown_outputs(store: &Store, file: &StudyFile) -> Result<Vec<ShownOutput>, StoreError> {
    let stored = StoredOutputs::of(store)?;
    let mut shown = Vec::new();
    for (place, output) in stored.outputs().iter().enumerate() {
        let own = file.study.outputs.iter().find(|own| own.name == output.name);
        let values = own.map_or(OutputValue::USUAL.to_vec(), |own| own.figures.clone());
        shown.extend(values.into_iter().map(|value| ShownOutput { place, output: output.clone(), value }));
    }
    Ok(shown)
}

impl ShownOutput {
    /// What it is, in words.
    pub fn title(&self) -> String {
        match (self.value, self.output.name.as_str()) {
            (OutputValue::Phase | OutputValue::Amplitude, name) => format!("{name}, {}", self.value.title()),
            (value, name) => format!("{name}, {} {}", value.title(), self.output.quantity.word()),
        }
    }

    /// Its SI unit.
    pub fn unit(&self) -> &'static str {
        match (self.value, self.output.quantity.unit()) {
            (OutputValue::Phase, _) => "rad",
            (_, "m/s^2") => "m/s²",
            (_, unit) => unit,
        }
    }

    /// It as part of the name of a file.
    pub fn file_name(&self) -> String {
        format!("{}_{}_{}", self.place + 1, file_name(&self.output.name), file_name(self.value.word()))
    }

    /// Whether it is the same number of the same output, in other results.
    pub fn shows_as(&self, other: &Self) -> bool {
        self.output == other.output && self.value == other.value
    }

    /// Gives the points of curves its values along these branches.
    pub fn fill(
        &self,
        store: &Store,
        branches: &[BranchRecord],
        curves: &mut [ResponseCurve],
    ) -> Result<(), StoreError> {
        for (curve, branch) in curves.iter_mut().zip(branches) {
            for (point, value) in curve.points.iter_mut().zip(self.along(store, branch)?) {
                point.output = value;
            }
        }
        Ok(())
    }

    /// The diagram of it over these branches, which are those of a diagram with other quantities.
    pub fn draw(
        &self,
        store: &Store,
        branches: &[BranchRecord],
        diagram: &ResponseDiagram,
        settings: &ResponseSettings,
    ) -> Result<Result<Figure, FigureError>, StoreError> {
        let mut diagram = diagram.clone();
        diagram.output = OutputAxis { title: self.title(), unit: self.unit().to_owned() };
        self.fill(store, branches, &mut diagram.curves)?;
        Ok(diagram.draw_with(&[ResponseQuantity::Output], settings))
    }

    /// Its values along a branch; NaN where there is none.
    pub fn along(&self, store: &Store, branch: &BranchRecord) -> Result<Vec<f64>, StoreError> {
        let stored = StoredOutputs::of(store)?;
        let multiple = branch.period_multiple;
        let value = |(side, number)| {
            let values = stored.values(solution_key(branch.start, side, number), multiple)?;
            let found = values.as_ref().and_then(|values| values.get(self.place));
            Ok(found.map_or(f64::NAN, |statistics| self.value_of(statistics, multiple)))
        };
        branch.places().map(value).collect()
    }

    fn value_of(&self, statistics: &SignalStatistics, multiple: u32) -> f64 {
        // The order of the excitation frequency.
        let harmonic = statistics.harmonics.get(multiple as usize - 1).copied();
        let [re, im] = harmonic.unwrap_or([f64::NAN; 2]);
        match self.value {
            OutputValue::Maximum => statistics.maximum,
            OutputValue::Minimum => statistics.minimum,
            OutputValue::Largest => statistics.largest(),
            OutputValue::PeakToPeak => statistics.peak_to_peak(),
            OutputValue::Mean => statistics.mean,
            OutputValue::RootMeanSquare => statistics.root_mean_square,
            OutputValue::Amplitude => re.hypot(im),
            OutputValue::Phase => im.atan2(re),
        }
    }
}
