//! Comparisons that a results folder holds, read back from their tables.

use std::{fs, path::Path};

use anyhow::{Context, anyhow};
use hammerbeam_signal::Quantity;

/// Tables of `compare` in its own folder, and of `rig`, with what they are called: of what `rig` compares, that over branches without a filter.
const TABLES: [(&str, &str, Quantity); 5] = [
    ("compare/points_displacement.csv", "compare", Quantity::Displacement),
    ("compare/points_acceleration.csv", "compare", Quantity::Acceleration),
    ("compare/points_force.csv", "compare", Quantity::Force),
    ("points_displacement.csv", "virtual rig", Quantity::Displacement),
    ("figure_06_points.csv", "virtual rig", Quantity::Acceleration),
];

/// A comparison of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredComparison {
    /// What compared.
    pub name: &'static str,
    /// What was compared.
    pub quantity: Quantity,
    /// Cut-off of the filter that the branches were behind (Hz), if there was one.
    pub low_pass_hz: Option<f64>,
    pub points: Vec<StoredPoint>,
}

/// A measured point.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredPoint {
    pub origin: String,
    /// `periodic`, `aperiodic`, `doubtful` or `unknown`.
    pub kind: String,
    pub period_multiple: Option<u32>,
    /// Frequency (Hz) and value (SI), as measured.
    pub measured: (f64, f64),
    /// The same, shifted.
    pub shifted: (f64, f64),
    pub verdict: String,
}

/// All comparisons in a folder, each with the reason if its table cannot be read.
pub fn stored(folder: &Path) -> Vec<anyhow::Result<StoredComparison>> {
    let is_there = |(file, ..): &(&str, &str, Quantity)| folder.join(file).is_file();
    let tables = TABLES.into_iter().filter(is_there);
    tables.map(|(file, name, quantity)| read(&folder.join(file), name, quantity)).collect()
}

fn read(path: &Path, name: &'static str, quantity: Quantity) -> anyhow::Result<StoredComparison> {
    let shown = path.display();
    let text = fs::read_to_string(path).with_context(|| format!("cannot read {shown}"))?;
    let mut lines = text.lines();
    let titles: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |title: &str| titles.iter().position(|found| *found == title);
    let wanted = |title: String| column(&title).ok_or_else(|| anyhow!("{shown} has no column {title}"));
    let value = |what: &str| wanted(format!("{what}_{}_{}", quantity.word(), quantity.key()));
    let columns = [
        wanted("frequency_hz".to_owned())?,
        value("measured")?,
        wanted("shifted_frequency_hz".to_owned())?,
        value("shifted")?,
    ];
    let words = ["origin", "kind", "verdict"].map(|title| wanted(title.to_owned()));
    let [origin, kind, verdict] = words;
    let (origin, kind, verdict) = (origin?, kind?, verdict?);
    let (period, low_pass) = (column("period_multiple"), column("low_pass_hz"));
    let mut comparison = StoredComparison { name, quantity, low_pass_hz: None, points: Vec::new() };
    for (number, line) in lines.enumerate() {
        let fields: Vec<&str> = line.split(',').collect();
        let field = |place: usize| fields.get(place).copied().unwrap_or_default();
        let number = |place: usize| {
            let text = field(place);
            text.parse::<f64>().map_err(|_| anyhow!("{shown}, line {}: \"{text}\" is no number", number + 2))
        };
        let [frequency_hz, measured, shifted_hz, shifted] = columns.map(number);
        comparison.low_pass_hz = low_pass.and_then(|place| field(place).parse().ok());
        comparison.points.push(StoredPoint {
            origin: field(origin).to_owned(),
            kind: field(kind).to_owned(),
            period_multiple: period.and_then(|place| field(place).parse().ok()),
            measured: (frequency_hz?, measured?),
            shifted: (shifted_hz?, shifted?),
            verdict: field(verdict).to_owned(),
        });
    }
    Ok(comparison)
}
