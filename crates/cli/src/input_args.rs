//! What several commands take: a study with settings, and numbers with their limits.

use std::path::PathBuf;

use clap::Args;
use hammerbeam_study::{Setting, StudyError, StudyFile, with_structure_fault};

/// A study file, and keys of it that get other values.
#[derive(Debug, Args)]
pub struct StudyInput {
    /// Study file
    #[arg(value_name = "STUDY")]
    pub path: PathBuf,

    /// Give a key of the study another value, as in stop.1.gap_m=0.2e-3 or structure.length="258 mm";
    /// elements of lists go by name, or by number from 1. May be given several times; results keep the
    /// study as it was run
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<Setting>,
}

impl StudyInput {
    /// Reads the study.
    pub fn read(&self) -> Result<StudyFile, StudyError> {
        StudyFile::read_with(&self.path, &self.set).map_err(with_structure_fault)
    }
}

/// A number of hertz, or a frequency with its unit.
pub fn hertz(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| hammerbeam_study::hertz(text))
}

/// A frequency of the excitation: a time of its period is a number, and so is what follows from it.
pub fn excitation_frequency(text: &str) -> Result<f64, String> {
    match hertz(text) {
        Some(number) if (1e-10..=1e10).contains(&number) => Ok(number),
        _ => {
            Err("must be a number of hertz from 1e-10 to 1e10, or one with its unit: \"31.4 rad/s\""
                .to_owned())
        }
    }
}

pub fn positive(text: &str) -> Result<f64, String> {
    match hertz(text) {
        Some(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("must be a finite number of hertz, more than 0, or one with its unit".to_owned()),
    }
}
