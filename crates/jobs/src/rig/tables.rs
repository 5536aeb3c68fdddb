//! Tables of a rig: figures 2 and 6 to 14 of the paper in numbers, and the filter's part.

use std::path::Path;

use hammerbeam_results::export::{ExportError, Table, header, number};
use hammerbeam_signal::{MeasuredQuantity, points::MeasuredKind};
use hammerbeam_study::file::{ExcitationKind, HarmonicExcitation};

use super::{FilteredBranch, RigReport, SignalPair};
use crate::comparison::write_points;

/// Writes the tables of a rig.
///
/// * `files`: takes their names.
///
/// # Errors
/// A table cannot be written.
pub fn write_rig_tables(
    folder: &Path,
    found: &RigReport,
    files: &mut Vec<String>,
) -> Result<(), ExportError> {
    points(folder, found)?;
    figure_2(folder, found)?;
    branches(folder, found)?;
    files.extend(["measured.csv", "figure_02.csv", "figure_06_branches.csv"].map(str::to_owned));
    for (name, _, comparison) in &found.comparisons {
        let file = if *name == "acceleration" {
            "figure_06_points.csv".to_owned()
        } else {
            format!("points_{name}.csv")
        };
        write_points(folder, &file, (comparison, found.low_pass_hz(name)))?;
        files.push(file);
    }
    for (index, signal) in found.signals.iter().enumerate() {
        let file = figure_name(index);
        write_signal(folder, &file, signal)?;
        files.push(file);
    }
    Ok(())
}

/// Name of the table of a signal: the figures of the paper begin with number 7.
#[must_use]
pub fn figure_name(index: usize) -> String {
    format!("figure_{:02}.csv", index + 7)
}

/// The measurement, as `hammerbeam compare` reads it.
fn points(folder: &Path, found: &RigReport) -> Result<(), ExportError> {
    let titles = [
        "frequency_hz",
        "max_acceleration_m_s2",
        "max_displacement_m",
        "table_acceleration_m_s2",
        "kind",
        "period",
        "sweep",
        "period_of_states",
        "unfiltered",
        "begun_anew",
        "largest_exponent_per_s",
        "exponent_scatter_per_s",
        "exponent_of_the_motion_per_s",
    ];
    let mut table = Table::begin(folder, "measured.csv", &header(&titles))?;
    for point in &found.points {
        let measured = &point.point;
        let period = |period: Option<u32>| period.map_or_else(String::new, |period| period.to_string());
        table.row(&[
            number(measured.frequency_hz),
            number(measured.maxima.acceleration),
            number(measured.maxima.displacement),
            number(measured.excitation.map(|(_, amplitude)| amplitude)),
            measured.kind.word().to_owned(),
            period(measured.kind.period_multiple()),
            point.direction.word().to_owned(),
            period(point.period_of_states),
            number(point.unfiltered),
            point.begun_anew.to_string(),
            number(point.exponents.and_then(|of| Some(of.of_record?.value))),
            number(point.exponents.and_then(|of| Some(of.of_record?.scatter))),
            number(point.exponents.and_then(|of| Some(of.of_motion?.0))),
        ])?;
    }
    table.finish()?;
    Ok(())
}

/// Amplitude of the table's acceleration: that of the study, and as measured.
fn figure_2(folder: &Path, found: &RigReport) -> Result<(), ExportError> {
    let titles = ["sweep", "frequency_hz", "computed_m_s2", "measured_m_s2", "measured_over_computed"];
    let mut table = Table::begin(folder, "figure_02.csv", &header(&titles))?;
    for point in &found.points {
        let frequency_hz = point.point.frequency_hz;
        let computed = found.table_acceleration(frequency_hz);
        let measured = point.point.excitation.map(|(_, amplitude)| amplitude);
        table.row(&[
            point.direction.word().to_owned(),
            number(frequency_hz),
            number(computed),
            number(measured),
            number(measured.map(|measured| measured / computed)),
        ])?;
    }
    table.finish()?;
    Ok(())
}

/// Branches with and without filters.
fn branches(folder: &Path, found: &RigReport) -> Result<(), ExportError> {
    let mut titles = header(&[
        "branch",
        "period_multiple",
        "row",
        "frequency_hz",
        "stable",
        "max_abs_acceleration_m_s2",
        "max_abs_displacement_m",
    ]);
    for filter in &found.filters {
        let hz = filter.cut_off_hz;
        titles
            .extend([format!("acceleration_behind_{hz}_hz_m_s2"), format!("displacement_behind_{hz}_hz_m")]);
    }
    let mut table = Table::begin(folder, "figure_06_branches.csv", &titles)?;
    for branch in &found.filtered.branches {
        for row in branch_rows(branch) {
            table.row(&row)?;
        }
    }
    table.finish()?;
    Ok(())
}

fn branch_rows(branch: &FilteredBranch) -> impl Iterator<Item = Vec<String>> {
    branch.points.iter().map(|point| {
        let mut row = vec![
            branch.branch.to_string(),
            branch.period_multiple.to_string(),
            point.row.to_string(),
            number(point.frequency_hz),
            point.stable.to_string(),
            number(point.acceleration),
            number(point.displacement),
        ];
        for (acceleration, displacement) in
            point.filtered_acceleration.iter().zip(&point.filtered_displacement)
        {
            row.extend([number(*acceleration), number(*displacement)]);
        }
        row
    })
}

fn write_signal(folder: &Path, name: &str, signal: &SignalPair) -> Result<(), ExportError> {
    let titles = [
        "phase_cycles",
        "measured_acceleration_m_s2",
        "computed_filtered_acceleration_m_s2",
        "computed_acceleration_m_s2",
        "computed_displacement_m",
        "support_displacement_m",
    ];
    let mut table = Table::begin(folder, name, &header(&titles))?;
    let computed = signal.laid().ok();
    for (k, measured) in signal.measured.samples.iter().enumerate() {
        table.row(&[
            number(k as f64 / signal.measured.per_period as f64),
            number(*measured),
            number(computed.map(|orbit| orbit.filtered[k])),
            number(computed.map(|orbit| orbit.unfiltered[k])),
            number(computed.map(|orbit| orbit.displacement[k])),
            number(computed.map(|orbit| orbit.supports.first().map_or(0.0, |series| series[k]))),
        ])?;
    }
    table.finish()?;
    Ok(())
}

/// What exponents say of the aperiodic points.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RigChaos {
    /// Aperiodic points.
    pub aperiodic: usize,
    /// Those with a positive exponent from the record.
    pub by_record: usize,
    /// Those with one from the motion (its interval above zero).
    pub by_motion: usize,
    /// With both.
    pub by_both: usize,
    /// Median of the exponent from the record over that of the motion, where both are positive.
    pub median_ratio: Option<f64>,
}

impl RigReport {
    /// Amplitude of the acceleration of the support that the study has [m/s²].
    #[must_use]
    pub fn table_acceleration(&self, frequency_hz: f64) -> f64 {
        let of = |excitation: &HarmonicExcitation| {
            let rate = std::f64::consts::TAU * frequency_hz * f64::from(excitation.order);
            let per_amplitude = match excitation.kind {
                ExcitationKind::SupportAcceleration { .. } => 1.0,
                _ => rate * rate,
            };
            excitation.amplitude().map_or(0.0, |amplitude| amplitude.at(frequency_hz)) * per_amplitude
        };
        self.file.study.excitation.harmonic().map_or(0.0, of)
    }

    /// How often the record shows what the states do: right, wrong, doubtful.
    #[must_use]
    pub fn agreement(&self) -> [usize; 3] {
        let mut counts = [0; 3];
        for point in &self.points {
            let right = match point.point.kind {
                MeasuredKind::Periodic { period_multiple } => point.period_of_states == period_multiple,
                MeasuredKind::Aperiodic => point.period_of_states.is_none(),
                MeasuredKind::Doubtful | MeasuredKind::Unknown => {
                    counts[2] += 1;
                    continue;
                }
            };
            counts[usize::from(!right)] += 1;
        }
        counts
    }

    /// Largest displacement that was measured [m].
    #[must_use]
    pub fn largest_displacement(&self) -> f64 {
        let values =
            self.points.iter().filter_map(|point| point.point.maxima.of(MeasuredQuantity::Displacement));
        values.fold(0.0, f64::max)
    }

    /// Counts chaotic motions.
    #[must_use]
    pub fn chaos(&self) -> RigChaos {
        let mut chaos = RigChaos::default();
        let mut ratios = Vec::new();
        for exponents in self.points.iter().filter_map(|point| point.exponents) {
            let of_record = exponents.of_record.map(|of| of.value).filter(|value| *value > 0.0);
            let of_motion =
                exponents.of_motion.filter(|(value, half)| value - half > 0.0).map(|(value, _)| value);
            chaos.aperiodic += 1;
            chaos.by_record += usize::from(of_record.is_some());
            chaos.by_motion += usize::from(of_motion.is_some());
            ratios.extend(of_record.zip(of_motion).map(|(record, motion)| record / motion));
        }
        ratios.sort_by(f64::total_cmp);
        chaos.by_both = ratios.len();
        chaos.median_ratio = ratios.get(ratios.len() / 2).copied();
        chaos
    }
}
