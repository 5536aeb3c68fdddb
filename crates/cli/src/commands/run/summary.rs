//! A run of one study into a results folder, and what came of it in words.

use std::{
    path::Path,
    time::{Duration, Instant},
};

use hammerbeam_drawing::{DrawSettings, FigureSelection, draw, draw_into};
use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    MirrorImage, PreparedStudy, counted,
    outputs::OutputPass,
    pool::threads,
    run::{
        BranchReport, RunOutcome, RunReport, RunRequest, WholeRun, end_of_side, peak_stability, run_study,
    },
};
use hammerbeam_orbit::{BranchEventKind, Side};
use hammerbeam_results::{
    Store,
    end::BranchEnd,
    store::JobRecord,
    summary::{BranchSummary, Peak, PieceSummary},
};
use hammerbeam_study::{document::unit::stem_and_unit, readable, readable_to};

use crate::{
    args::RunOptions,
    commands::check::UNDAMPED_ADVICE,
    failure::Failure,
    interrupt::Interrupt,
    output::{Output, decimals},
    progress::Terminal,
    watch::Watch,
};

/// Runs a study into a folder, and draws what was found.
pub(super) fn run_into(
    out: &Path,
    study: &PreparedStudy,
    options: &RunOptions,
    (output, interrupt): (Output, &Interrupt),
) -> Result<Summary, Failure> {
    let asked = &study.file.study;
    let mut terminal = Terminal::new(interrupt.clone(), asked.varies.len() + asked.curves.len());
    let started = Instant::now();
    let threads = threads(options.jobs);
    let request = RunRequest { out, from: &options.from, threads };
    let run = run_study(study, request, &mut terminal);
    terminal.clear();
    let WholeRun { store, report } = run?;
    let (unit, range_hz) = (output.frequency_unit, asked.excitation.range_hz());
    let mut summary = Summary { unit, range_hz, report, elapsed: Duration::ZERO };
    let result = match summary.report.outcome {
        RunOutcome::Interrupted => Err(Failure::Interrupted(summary.interrupted())),
        RunOutcome::Done | RunOutcome::OutOfTime { .. } => {
            let drawn = if options.no_figures {
                Ok(Vec::new())
            } else {
                drawn_into(out, &store, study, (threads, output.frequency_unit), interrupt)
            };
            match drawn {
                Err(Failure::Interrupted(_)) => Err(Failure::Interrupted(summary.interrupted_drawing())),
                Err(other) => Err(other),
                Ok(_) if summary.report.branches.is_empty() => Err(Failure::NoResult(summary.nothing())),
                Ok(figures) => {
                    summary.report.figures = figures;
                    summary.elapsed = started.elapsed();
                    Ok(summary)
                }
            }
        }
    };
    store.finish()?;
    result
}

/// Draws what a run has found.
///
/// # Returns
/// The names of the files.
fn drawn_into(
    out: &Path,
    store: &Store,
    study: &PreparedStudy,
    (threads, frequency_unit): (usize, FrequencyUnit),
    interrupt: &Interrupt,
) -> Result<Vec<String>, Failure> {
    let settings = DrawSettings { threads, frequency_unit, ..DrawSettings::default() };
    let selection = FigureSelection::of_run(&study.file);
    let drawn = draw_into(out, settings, &mut Watch::new(interrupt.clone()), |drawn| {
        draw(store, (&study.file, &study.model), &selection, drawn)
    });
    Ok(drawn?.names)
}

/// What came of a run, in words.
pub(super) struct Summary {
    unit: FrequencyUnit,
    range_hz: [f64; 2],
    pub report: RunReport,
    elapsed: Duration,
}

impl Summary {
    fn folder(&self) -> String {
        self.report.results.display().to_string()
    }

    fn interrupted(&self) -> String {
        format!(
            "interrupted; {} solutions are kept in {}, the same command goes on from there",
            self.report.solutions(),
            self.folder()
        )
    }

    fn interrupted_drawing(&self) -> String {
        format!(
            "interrupted while drawing; all {} solutions are kept in {}, the same command draws them",
            self.report.solutions(),
            self.folder()
        )
    }

    fn nothing(&self) -> String {
        let [low, high] = self.range_hz;
        let (low, high) = (self.unit.words(low), self.unit.words(high));
        let mut lines = vec![format!("no periodic solution was found between {low} and {high}")];
        lines.extend(self.failed_text());
        if self.report.left() > 0 {
            lines.push(format!("the search is not complete: {}", self.out_of_time()));
        }
        lines.join("\n")
    }

    fn out_of_time(&self) -> String {
        format!(
            "out of time: {} searches, flips and branch points are left; the same command goes on with them",
            self.report.left()
        )
    }

    fn failed_text(&self) -> Vec<String> {
        const SHOWN: usize = 5;
        let failed: Vec<_> = self.report.failed().collect();
        if failed.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![format!(
            "\n{} of {} searches, flips and branch points led to nothing or were not complete:",
            failed.len(),
            self.report.searches.len()
        )];
        let line = |(job, message): &(&JobRecord, &str)| {
            format!("  {}: {message}", shown(self.unit, job.frequency_hz, 6))
        };
        lines.extend(failed.iter().take(SHOWN).map(line));
        if failed.len() > SHOWN {
            lines.push("  ...".to_owned());
        }
        lines
    }

    /// Why solutions are marginal all along branches: a bifurcation makes one or two.
    fn marginal_text(&self) -> Option<String> {
        let marginal: u64 = self.report.branches.iter().map(|branch| branch.summary.marginal).sum();
        let RunReport { undamped_modes: open, undamped_in_contact: in_contact, .. } = &self.report;
        // Stops may be open all the time, or closed.
        let first = open.first().map(ToString::to_string);
        let named: Vec<String> =
            first.into_iter().chain(in_contact.first().map(ToString::to_string)).collect();
        if named.is_empty() || marginal == 0 {
            return None;
        }
        let others = match open.len() + in_contact.len() - named.len() {
            0 => String::new(),
            1 => " (nor has another one)".to_owned(),
            others => format!(" (nor have {others} others)"),
        };
        let named = named.join("; ");
        Some(format!(
            "\n{named}{others}: of {}, those at bifurcations included, \
             multipliers lie on the unit circle as well as these are known; \
             {UNDAMPED_ADVICE}",
            counted(marginal, "solution")
        ))
    }

    fn branch_text(&self, branch: &BranchReport) -> String {
        let image = branch.mirror_image.and_then(image_text);
        [Some(branch_text(&branch.summary, self.unit)), image]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join("\n")
    }

    /// What was read off stored orbits, if something was.
    fn outputs_text(&self) -> Option<String> {
        let OutputPass { solutions, failed, .. } = self.report.outputs;
        let lost = match failed {
            0 => String::new(),
            _ => format!("; the motion of {failed} could not be computed again, they have none"),
        };
        (solutions > 0).then(|| format!("\noutputs read off {} solutions{lost}", solutions - failed))
    }

    pub fn text(&self) -> String {
        let mut lines = vec![format!(
            "{} solutions on {} in {}, after {:.1} s",
            self.report.solutions(),
            counted(self.report.branches.len() as u64, "branch"),
            self.folder(),
            self.elapsed.as_secs_f64()
        )];
        lines.extend(self.report.branches.iter().map(|branch| self.branch_text(branch)));
        lines.extend(self.report.varied.iter().map(piece_text));
        lines.extend(self.outputs_text());
        lines.extend(self.marginal_text());
        lines.extend(self.failed_text());
        if self.report.left() > 0 {
            lines.push(format!("\n{}", self.out_of_time()));
        }
        lines.push(match self.report.figures.len() {
            0 => format!("results in {}", self.folder()),
            count => format!("{count} files with figures in {}", self.folder()),
        });
        lines.join("\n")
    }
}

fn image_text(image: MirrorImage) -> Option<String> {
    match image {
        MirrorImage::Itself => None,
        MirrorImage::Branch(other) => Some(format!("  its mirror image -q(t + T/2) is branch {other}")),
        MirrorImage::Given => Some(
            "  its mirror image -q(t + T/2) is another branch, with the same frequencies, maxima and \
             multipliers"
                .to_owned(),
        ),
    }
}

fn branch_text(branch: &BranchSummary, unit: FrequencyUnit) -> String {
    let [low, high] = branch.range.map(|end| unit.factor() * end);
    let count = |kind| branch.events.of(kind);
    let mut lines = vec![
        format!(
            "\nbranch {} (period {}): {} solutions, {} to {} {}, {} of them stable{}",
            branch.record.id,
            branch.record.period_multiple,
            branch.solutions,
            decimals(low, 6),
            decimals(high, 6),
            unit.symbol(),
            branch.stable,
            marginal_words(branch.marginal)
        ),
        format!(
            "  folds {}, flips {}, Neimark-Sacker points {}, branch points {}, grazings {}",
            count(BranchEventKind::Fold),
            count(BranchEventKind::Flip),
            count(BranchEventKind::NeimarkSacker),
            count(BranchEventKind::BranchPoint),
            count(BranchEventKind::Grazing)
        ),
    ];
    if branch.flips_not_followed > 0 {
        lines.push(format!(
            "  at {} of the flips the branch of {} periods is not followed: the study does not ask for it",
            branch.flips_not_followed,
            2 * branch.record.period_multiple
        ));
    }
    lines.extend(peaks_text(&branch.peaks, unit));
    for (side, walk) in [("up", &branch.record.up), ("down", &branch.record.down)] {
        lines.push(format!("  {side} side: {}", stop_text(walk.end.as_ref())));
    }
    lines.join("\n")
}

/// The highest peaks, those that are as high as one another in one line.
fn peaks_text(peaks: &[Peak], unit: FrequencyUnit) -> Vec<String> {
    const SHOWN: usize = 6;
    let mut peaks: Vec<&Peak> = peaks.iter().collect();
    peaks.sort_by(|a, b| b.max_abs_displacement_m.total_cmp(&a.max_abs_displacement_m));
    let groups = peaks.chunk_by(|one, next| one.equals(next)).take(SHOWN);
    let line = |group: &[&Peak]| {
        let mut group = group.to_vec();
        let height = readable_to(group[0].max_abs_displacement_m, "m", 5);
        group.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        let more =
            if group.len() > SHOWN { format!(", and {} more", group.len() - SHOWN) } else { String::new() };
        let place = |peak: &&Peak| format!("{}, {}", peak_place(peak, unit), peak_stability(peak));
        let places: Vec<String> = group.iter().take(SHOWN).map(place).collect();
        match group[..] {
            [one] => {
                format!("  peak at {}, {height}, {}", peak_place(one, unit), peak_stability(one))
            }
            _ => format!("  {} equal peaks of {height}: {}{more}", group.len(), places.join("; ")),
        }
    };
    groups.map(line).collect()
}

/// Where a peak is: at one solution, or at several that are equal.
fn peak_place(peak: &Peak, unit: FrequencyUnit) -> String {
    if peak.equal == 1 {
        return shown(unit, peak.frequency_hz, 4);
    }
    let [low, high] = peak.equal_hz;
    let (low, high) = (unit.factor() * low, shown(unit, high, 4));
    format!("{} to {high} ({} solutions of equal height)", decimals(low, 4), peak.equal)
}

/// A frequency with so many decimals.
fn shown(unit: FrequencyUnit, frequency_hz: f64, count: usize) -> String {
    format!("{} {}", decimals(unit.factor() * frequency_hz, count), unit.symbol())
}

/// How many solutions are marginal, behind the number of those that are stable; nothing if none is.
fn marginal_words(marginal: u64) -> String {
    if marginal > 0 { format!(", {marginal} marginal") } else { String::new() }
}

fn piece_text(piece: &PieceSummary) -> String {
    let record = &piece.record;
    let (name, is_curve) = (&record.parameter, record.kind.is_curve());
    let unit = stem_and_unit(name).map_or("", |(_, unit)| unit);
    let mut lines = Vec::new();
    for branch in &piece.branches {
        let what = if is_curve { format!("{} curve", record.kind.name()) } else { "branch".to_owned() };
        let [low, high] = branch.range.map(|end| readable(end, unit).trim_end().to_owned());
        lines.push(format!(
            "\n{what} over {name} (period {}): {} solutions, {low} to {high}, {} of them stable{}",
            branch.record.period_multiple,
            branch.solutions,
            branch.stable,
            marginal_words(branch.marginal)
        ));
        let events = branch.events.by_name().into_iter();
        let events = events.filter(|(word, _)| *word != BranchEventKind::Start.name());
        let events: Vec<String> = events.map(|(word, count)| format!("{word} {count}")).collect();
        if !events.is_empty() {
            lines.push(format!("  events: {}", events.join(", ")));
        }
        for (side, word) in [(Side::Up, "up"), (Side::Down, "down")] {
            lines.push(format!("  {word} side: {}", end_of_side(record, branch, side)));
        }
    }
    if let Some(message) = &record.message {
        let what = if is_curve { "curve" } else { "branches" };
        lines.push(format!("\n{what} over {name}: {message}"));
    }
    lines.join("\n")
}

fn stop_text(end: Option<&BranchEnd>) -> String {
    match end {
        None => "not finished".to_owned(),
        Some(end) if end.is_complete() => end.to_string(),
        Some(end) => format!("stopped early: {end}"),
    }
}
