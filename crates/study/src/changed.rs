//! A study with other numbers in their places, and which numbers the study file allows there.

use crate::{
    StudyError, StudyFile,
    number::{Number, replaced},
};

/// Part of a number that stands for next to nothing.
const SMALL: f64 = 1e-6;

/// The study with other numbers in their places; the rest of its text stays as it is.
///
/// # Errors
/// [`StudyError::Invalid`]: a value is out of the range that the study file allows.
pub fn with_numbers(file: &StudyFile, numbers: &[Number], values: &[f64]) -> Result<StudyFile, StudyError> {
    StudyFile::parse(&file.name, replaced(&file.text, numbers, values))
}

/// The model alone of the study with other numbers, without branches in other parameters and curves: their
/// ranges hold the values of the study as it is.
///
/// # Errors
/// [`StudyError::Invalid`]: a value is out of the range that the study file allows.
pub fn model_with(file: &StudyFile, numbers: &[Number], values: &[f64]) -> Result<StudyFile, StudyError> {
    StudyFile::parse_model(&file.name, replaced(&file.text, numbers, values))
}

/// Values that the study file allows for a number, as far as they do not hang on others: whether it may be
/// negative or zero, and whether it may exceed one.
pub fn limits(file: &StudyFile, number: &Number) -> (f64, f64) {
    let size = if number.value == 0.0 { 1.0 } else { number.value.abs() };
    let allowed = |value: f64| with_numbers(file, std::slice::from_ref(number), &[value]).is_ok();
    let low = match (allowed(-SMALL * size), allowed(0.0)) {
        (true, _) => f64::NEG_INFINITY,
        (false, true) => 0.0,
        (false, false) => SMALL * size,
    };
    let high = if (0.0..=1.0).contains(&number.value) && allowed(1.0) && !allowed(1.0 + SMALL) {
        1.0
    } else {
        f64::INFINITY
    };
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::numbers;

    const STUDY: &str = include_str!("../../../studies/beam-with-stop.toml");

    fn limits_of(key: &str) -> (f64, f64) {
        let file = StudyFile::parse("beam.toml", STUDY.to_owned()).unwrap();
        let all = numbers(STUDY);
        limits(&file, all.iter().find(|number| number.keys.iter().any(|known| known == key)).unwrap())
    }

    #[test]
    fn limits_are_those_of_the_study_file() {
        assert_eq!(limits_of("structure.point.contact.rotary_inertia_kg_m2"), (0.0, f64::INFINITY));
        assert_eq!(limits_of("damping.modal_ratio"), (0.0, 1.0));
        let (low, high) = limits_of("structure.youngs_modulus_pa");
        assert!(low > 0.0 && high.is_infinite());
        // The end of the beam is no limit: it may move, too.
        assert_eq!(limits_of("structure.point.contact.at_m").1, f64::INFINITY);
    }
}
