//! Parameters of a study in words and in names of files.

use hammerbeam_figure::ParameterAxis;
use hammerbeam_study::document::unit::stem_and_unit;

use crate::structure::raised;

/// A parameter as part of a file name.
pub fn file_name(parameter: &str) -> String {
    parameter.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
}

/// A parameter in words, with the SI unit that its key ends in.
pub fn parameter_axis(parameter: &str) -> ParameterAxis {
    let (owner, key) = parameter.rsplit_once('.').unwrap_or(("", parameter));
    // Constants of a formula have names of their own, which end in no unit.
    let is_constant = owner.ends_with(".constants");
    let (stem, unit) = stem_and_unit(key).filter(|_| !is_constant).unwrap_or((key, ""));
    let title = match (owner, owner.strip_prefix("stop."), stem) {
        ("excitation", _, _) => format!("Excitation {}", stem.replace('_', " ")),
        ("damping", _, "modal_ratio") => "Modal damping ratio".to_owned(),
        (_, Some(stop), "restitution") => format!("Coefficient of restitution of stop {stop}"),
        // A number without unit may be anything: its key path says what.
        _ if unit.is_empty() || owner.is_empty() => parameter.to_owned(),
        (_, Some(stop), _) => format!("{} of stop {stop}", sentence_case(stem)),
        _ => format!("{} of {owner}", sentence_case(stem)),
    };
    ParameterAxis { title, unit: raised(unit) }
}

/// A key as the start of a sentence.
fn sentence_case(key: &str) -> String {
    let words = key.replace('_', " ");
    let mut letters = words.chars();
    letters.next().map_or(String::new(), |first| format!("{}{}", first.to_uppercase(), letters.as_str()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_have_their_title_and_their_unit_apart() {
        let cases = [
            ("excitation.amplitude_n", "Excitation amplitude", "N"),
            ("stop.1.gap_m", "Gap of stop 1", "m"),
            ("stop.tip stop.second_stiffness_n_m", "Second stiffness of stop tip stop", "N/m"),
            ("stop.1.stiffness_n_m3", "Stiffness of stop 1", "N/m³"),
            ("stop.1.restitution", "Coefficient of restitution of stop 1", ""),
            ("damping.modal_ratio", "Modal damping ratio", ""),
            ("damping.modal_ratio.2", "damping.modal_ratio.2", ""),
            ("structure.mass.tip.mass_kg", "Mass of structure.mass.tip", "kg"),
            ("structure.length_m", "Length of structure", "m"),
            ("stop.1.constants.mu", "stop.1.constants.mu", ""),
            ("stop.1.constants.mu_s", "stop.1.constants.mu_s", ""),
        ];
        for (parameter, title, unit) in cases {
            let expected = ParameterAxis { title: title.to_owned(), unit: unit.to_owned() };
            assert_eq!(parameter_axis(parameter), expected);
        }
    }
}
