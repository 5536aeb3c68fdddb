//! The study of the rig: that of the model with changes put over it.

use hammerbeam_study::file::StudyFile;

use super::RigError;

/// Puts `[rig.changes]` over the study: tables are merged key by key, everything else, lists of tables
/// included, is replaced.
///
/// # Errors
/// [`RigError`]: there is no rig, or the result is no study. Faults name the merged text, which is not the
/// file.
pub fn changed_study(file: &StudyFile) -> Result<StudyFile, RigError> {
    let broken = |message: String| RigError::Changes { message };
    let mut study: toml::Table = toml::from_str(&file.text).map_err(|error| broken(error.to_string()))?;
    let rig = study.remove("rig").and_then(|rig| rig.try_into::<toml::Table>().ok());
    let changes = rig.and_then(|mut rig| rig.remove("changes")).and_then(|c| c.try_into().ok());
    let Some(changes) = changes else { return Err(RigError::NoRig { name: file.name.clone() }) };
    for key in ["vary", "curve"] {
        study.remove(key);
    }
    merge(&mut study, changes);
    let text = toml::to_string(&study).map_err(|error| broken(error.to_string()))?;
    let changed = StudyFile::parse(&format!("{}, with [rig.changes]", file.name), text)?;
    if changed.study.excitation.supports_differ() {
        return Err(broken("a rig has one table, but the supports move differently".to_owned()));
    }
    Ok(changed)
}

fn merge(into: &mut toml::Table, changes: toml::Table) {
    for (key, change) in changes {
        match (into.get_mut(&key), change) {
            (Some(toml::Value::Table(inner)), toml::Value::Table(change)) => merge(inner, change),
            (_, change) => {
                into.insert(key, change);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: &str = include_str!("../../../../studies/beam-with-stop.toml");

    fn with(rig: &str) -> Result<StudyFile, RigError> {
        changed_study(&StudyFile::parse("study.toml", format!("{MODEL}\n{rig}")).unwrap())
    }

    #[test]
    fn changes_are_put_over_the_study() {
        let rig = "[rig]\nsweep_hz = [20.0, 70.0]\n[rig.changes.structure]\nyoungs_modulus_pa = \
        1.9e11\n[rig.changes.damping]\nmodal_ratio = 0.003\n[[rig.changes.stop]]\nat = \"contact\"\nlaw \
        = \"linear\"\nstiffness_n_m = 1e6\nside = \"below\"\nfixed_to = \"left\"\n";
        let changed = with(rig).unwrap().study;
        let model = StudyFile::parse("study.toml", MODEL.to_owned()).unwrap().study;
        let hammerbeam_study::file::StructureTable::Beam(beam) = &changed.structure else {
            panic!(
                "not a \
        beam"
            )
        };
        assert_eq!(
            (beam.spans[0].profile.youngs_modulus_pa, beam.spans[0].profile.density_kg_m3),
            (1.9e11, 7800.0)
        );
        assert_eq!(changed.stops.len(), 1);
        assert_ne!(changed.stops, model.stops);
        assert_eq!(changed.excitation, model.excitation);
        assert!(changed.rig.is_none());
    }

    /// Of a study that nothing shakes, whose rig does.
    #[test]
    fn supports_that_differ_are_no_change_for_a_rig() {
        let free = r#"
            [structure]
            kind = "lumped"
            mass = [
                { name = "a", mass_kg = 1.0 },
                { name = "m", mass_kg = 1.0 },
                { name = "b", mass_kg = 1.0 },
            ]
            spring = [
                { between = ["a", "m"], stiffness_n_m = 100.0 },
                { between = ["m", "b"], stiffness_n_m = 100.0 },
            ]
            [response]
            point = "m"
            [rig]
            sweep_hz = [1.0, 3.0]
            [rig.changes.excitation]
            kind = "support-motion"
            frequency_hz = [1.0, 3.0]
            support = [{ at = "a", amplitude_m = 1e-3 }, { at = "b", amplitude_m = 2e-3 }]
        "#;
        let error = changed_study(&StudyFile::parse("free.toml", free.to_owned()).unwrap()).unwrap_err();
        assert!(error.to_string().contains("the supports move differently"), "{error}");
    }

    #[test]
    fn the_rig_is_no_part_of_what_the_study_is() {
        let plain = StudyFile::parse("study.toml", MODEL.to_owned()).unwrap().study;
        let rig = "[rig]\nsweep_hz = [20.0, 70.0]\nchanges = {}\n";
        let with = StudyFile::parse("study.toml", format!("{MODEL}\n{rig}")).unwrap().study;
        assert_eq!(plain.identity(), with.identity());
        assert_eq!(with.rig.unwrap().signals.len(), 8);
    }

    #[test]
    fn what_is_wrong_is_told() {
        assert!(matches!(with("").unwrap_err(), RigError::NoRig { .. }));
        let wrong = "[rig]\nsweep_hz = [20.0, 70.0]\n[rig.changes.damping]\nmodal_ratio = -1.0\n";
        let message = with(wrong).unwrap_err().to_string();
        assert!(message.contains("[rig.changes]") && message.contains("modal_ratio"), "{message}");
        for (rig, part) in [
            ("[rig]\nsweep_hz = [70.0, 20.0]\nchanges = {}\n", "sweep_hz"),
            ("[rig]\nchanges = {}\n", "`sweep_hz` is missing"),
            ("[rig]\nsweep_hz = [20.0, 70.0]\n", "`changes` is missing"),
            ("[rig]\nsweep_hz = [20.0, 70.0]\nchanges = {}\nnoise = 1\n", "unknown key `noise`"),
            ("[rig]\nsweep_hz = [20.0, 70.0]\nchanges = {}\nsignals = [[30.0]]\n", "a signal has 1 entries"),
        ] {
            let refused = StudyFile::parse("study.toml", format!("{MODEL}\n{rig}")).unwrap_err().to_string();
            assert!(refused.contains(part), "{rig}: {refused}");
        }
    }
}
