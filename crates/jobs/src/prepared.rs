//! A study with its model, ready for every job.

use std::{
    fmt::{self, Display, Formatter},
    path::Path,
};

use hammerbeam_results::Store;
use hammerbeam_study::{Model, StudyError, StudyFile, file::StructureTable};

use crate::{JobError, Observer};

/// More modes than these make a run of some thousand solutions last for hours.
const MANY_MODES: usize = 100;

/// More modes than a run can follow in minutes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ManyModes {
    /// Their number.
    pub modes: usize,
    /// Whether the structure is lumped, and so keeps all of them.
    pub is_lumped: bool,
}

impl Display for ManyModes {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let advice = if self.is_lumped {
            "a lumped structure keeps all of its modes; given as matrices ([structure] kind = \
            \"matrices\") it can be reduced"
        } else {
            "a cut_off_hz ([reduction]) of some times the highest frequency of the excitation keeps fewer"
        };
        write!(
            formatter,
            "{} modes are followed; the work of each solution grows like the cube of their number, and with \
            more than {MANY_MODES} a run takes hours: {advice}",
            self.modes
        )
    }
}

/// A study and the model that it describes.
#[derive(Debug, Clone)]
pub struct PreparedStudy {
    /// What the file says, with its text.
    pub file: StudyFile,
    /// The equations of motion, and what is observed.
    pub model: Model,
}

impl PreparedStudy {
    /// Builds the model of a study.
    ///
    /// # Errors
    /// [`StudyError::Invalid`]: something of the study does not fit its structure.
    pub fn new(file: StudyFile) -> Result<Self, StudyError> {
        let model = Model::build(&file)?;
        Ok(Self { file, model })
    }

    /// Reads a study file.
    ///
    /// # Errors
    /// [`StudyError`]: the file cannot be read, or its faults, all at once with their places.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, StudyError> {
        Self::new(StudyFile::read(path.as_ref())?)
    }

    /// Reads a study from a text in the form of a study file.
    ///
    /// * `name`: names it in messages.
    ///
    /// # Errors
    /// [`StudyError`]: its faults, all at once with their places.
    pub fn parse(name: &str, text: impl Into<String>) -> Result<Self, StudyError> {
        Self::new(StudyFile::parse(name, text.into())?)
    }

    /// The study whose results a store holds.
    ///
    /// # Errors
    /// [`JobError::Store`], [`JobError::Study`].
    pub fn of_store(store: &Store) -> Result<Self, JobError> {
        Ok(Self::new(StudyFile::parse("study.toml", store.about("study")?)?)?)
    }

    /// Number of modes n; a state has 2n entries.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.model.system.dof()
    }

    /// Reports directions in which only stops hold the structure.
    ///
    /// # Errors
    /// [`JobError::Drifts`]: nothing holds a direction, and then no periodic solution is isolated.
    pub fn check_held(&self, observer: &mut dyn Observer) -> Result<(), JobError> {
        let drifts = self.model.drifts();
        if let Some(drift) = drifts.iter().find(|drift| !drift.held_by_stops) {
            return Err(JobError::Drifts(drift.clone()));
        }
        drifts.iter().for_each(|drift| observer.notice(&format_args!("warning: {drift}")));
        Ok(())
    }

    /// So many modes, if there are more than a run walks in minutes (a hundred).
    #[must_use]
    pub fn many_modes(&self) -> Option<ManyModes> {
        let (modes, structure) = (self.dof(), &self.file.study.structure);
        let is_lumped = matches!(structure, StructureTable::Lumped(_));
        (modes > MANY_MODES).then_some(ManyModes { modes, is_lumped })
    }

    /// Advises to reduce a structure of many modes.
    pub(crate) fn warn_of_many_modes(&self, observer: &mut dyn Observer) {
        if let Some(many) = self.many_modes() {
            observer.notice(&format_args!("warning: {many}"));
        }
    }

    /// Refuses a range that reaches so far above all eigenfrequencies that rounding hides what it asks for.
    ///
    /// # Errors
    /// [`JobError::FrequencyNotResolved`] with the highest frequency that may be asked for.
    pub fn check_range(&self) -> Result<(), JobError> {
        let [_, high_hz] = self.file.study.excitation.range_hz();
        match self.model.resolved_hz().filter(|resolved| high_hz > *resolved) {
            Some(resolved_hz) => Err(JobError::FrequencyNotResolved { high_hz, resolved_hz }),
            None => Ok(()),
        }
    }
}
