//! The parameter over which a stored piece runs.

use hammerbeam_results::store::PieceRecord;
use hammerbeam_study::StudyParameter;

use crate::PreparedStudy;

/// The parameter of a piece of a folder.
///
/// # Errors
/// Why the study does not have it, in words.
pub(crate) fn piece_parameter(record: &PieceRecord, study: &PreparedStudy) -> Result<StudyParameter, String> {
    let asked = &study.file.study;
    let varied = asked.varies.iter().map(|vary| &vary.parameter);
    let mut varied = varied.chain(asked.curves.iter().map(|curve| &curve.parameter));
    match varied.find(|varied| varied.name == record.parameter) {
        Some(varied) => study.model.parameter(asked, varied),
        None => Err(format!("the study does not vary {} any more", record.parameter)),
    }
}
