//! Parameters of a study in words and in names of files.

/// A parameter as part of a file name.
pub fn file_name(parameter: &str) -> String {
    parameter.replace(|c: char| !c.is_ascii_alphanumeric(), "_")
}

/// A parameter in words, with its unit.
pub fn axis_label(parameter: &str) -> String {
    let (owner, key) = parameter.rsplit_once('.').unwrap_or(("", parameter));
    let stop = owner.strip_prefix("stop.").map_or(String::new(), |stop| format!(" of stop {stop}"));
    match key {
        "amplitude_m" => "Excitation amplitude (m)".to_owned(),
        "amplitude_n" => "Excitation amplitude (N)".to_owned(),
        "gap_m" => format!("Gap{stop} (m)"),
        "stiffness_n_m" => format!("Stiffness{stop} (N/m)"),
        "stiffness_n_m15" => format!("Stiffness{stop} (N/m^1.5)"),
        "stiffness_n_m3" => format!("Stiffness{stop} (N/m³)"),
        "modal_ratio" => "Modal damping ratio (–)".to_owned(),
        _ => parameter.to_owned(),
    }
}
