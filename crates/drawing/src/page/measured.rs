//! Measured points of the comparisons that a results folder holds, read back from their tables.

use std::path::Path;

use hammerbeam_figure::{
    MeasuredMotion, PageMeasured, PageMeasuredPoint, ResponseQuantity as Drawing, plain_number,
};
use hammerbeam_signal::{
    MeasuredQuantity,
    limits::{self, LARGEST_FILE},
};

use super::Drawn;

/// Tables of `compare` in its own folder, and of `rig`, with what they are called: of what `rig` compares,
/// that over branches without a filter.
const TABLES: [(&str, &str, MeasuredQuantity, Drawing); 5] = [
    ("compare/points_displacement.csv", "compare", MeasuredQuantity::Displacement, Drawing::Displacement),
    ("compare/points_acceleration.csv", "compare", MeasuredQuantity::Acceleration, Drawing::Acceleration),
    ("compare/points_force.csv", "compare", MeasuredQuantity::Force, Drawing::ContactForce),
    ("points_displacement.csv", "virtual rig", MeasuredQuantity::Displacement, Drawing::Displacement),
    ("figure_06_points.csv", "virtual rig", MeasuredQuantity::Acceleration, Drawing::Acceleration),
];

/// The points of every comparison; one whose table cannot be read is named with the reason.
pub fn series(folder: &Path, drawn: &mut Drawn<'_>) -> Vec<PageMeasured> {
    let mut all = Vec::new();
    for (file, name, quantity, drawing) in TABLES {
        let path = folder.join(file);
        if !path.is_file() {
            continue;
        }
        match read(&path, quantity) {
            Ok((points, low_pass_hz)) => {
                let note = low_pass_hz.map_or_else(String::new, note);
                all.push(PageMeasured { name: name.to_owned(), quantity: drawing, note, points });
            }
            Err(error) => drawn.refuse("measured points on the page", error),
        }
    }
    all
}

fn note(cut_off_hz: f64) -> String {
    let cut_off = plain_number(cut_off_hz);
    format!(
        "They were compared with branches behind a low-pass filter of {cut_off} Hz; those drawn here are not."
    )
}

/// Points of a table, and the cut-off of the filter that the branches were behind (Hz), if there was one.
fn read(path: &Path, quantity: MeasuredQuantity) -> Result<(Vec<PageMeasuredPoint>, Option<f64>), String> {
    let shown = path.display();
    let text =
        limits::read_text(path, LARGEST_FILE).map_err(|error| format!("cannot read {shown}: {error}"))?;
    let mut lines = text.lines();
    let titles: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |title: &str| titles.iter().position(|found| *found == title);
    let wanted = |title: &str| column(title).ok_or_else(|| format!("{shown} has no column {title}"));
    let value = |what: &str| wanted(&format!("{what}_{}_{}", quantity.word(), quantity.key()));
    let measured = (wanted("frequency_hz")?, value("measured")?);
    let shifted = (wanted("shifted_frequency_hz")?, value("shifted")?);
    let (origin, kind, verdict) = (wanted("origin")?, wanted("kind")?, wanted("verdict")?);
    let (period, low_pass) = (column("period_multiple"), column("low_pass_hz"));
    let (mut points, mut low_pass_hz) = (Vec::new(), None);
    for (number, line) in lines.enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        let field = |place: usize| fields.get(place).copied().unwrap_or_default();
        let number = |place: usize| {
            let text = field(place);
            text.parse::<f64>().map_err(|_| format!("{shown}, line {}: \"{text}\" is no number", number + 2))
        };
        low_pass_hz = low_pass.and_then(|place| field(place).parse().ok());
        points.push(PageMeasuredPoint {
            origin: field(origin).to_owned(),
            motion: match field(kind) {
                "periodic" => MeasuredMotion::Periodic,
                "aperiodic" => MeasuredMotion::Aperiodic,
                _ => MeasuredMotion::Unknown,
            },
            period_multiple: period.and_then(|place| field(place).parse().ok()),
            measured: (number(measured.0)?, number(measured.1)?),
            shifted: (number(shifted.0)?, number(shifted.1)?),
            verdict: field(verdict).to_owned(),
        });
    }
    Ok((points, low_pass_hz))
}
