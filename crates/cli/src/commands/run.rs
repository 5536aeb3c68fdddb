//! `hammerbeam run`: everything a study asks for, into one results folder.

use std::{
    collections::HashMap,
    path::Path,
    time::{Duration, Instant},
};

use hammerbeam_figure::FrequencyUnit;
use hammerbeam_jobs::{
    MirrorImage, OrbitSolver, StoredBranches,
    run::{Plan, RunOutcome},
    settled::settled_states,
    varied::{self, VariedOutcome},
};
use hammerbeam_orbit::Stability;
use hammerbeam_results::{
    Store,
    store::{JobRecord, PieceRecord, StoredReason, WalkRecord},
    summary::{BranchSummary, Peak, summarise},
};
use hammerbeam_study::{Model, Study, StudyFile, UndampedInContact, UndampedMode};
use serde_json::{Value, json};

use crate::{
    args::RunOptions,
    commands::check::{UNDAMPED_ADVICE, in_contact_document, undamped_document},
    drift,
    failure::Failure,
    figures::{self, Drawn, Wishes},
    interrupt::Interrupt,
    output::Output,
    progress::Terminal,
};

pub fn run(options: &RunOptions, output: Output) -> Result<(), Failure> {
    let file = StudyFile::read(&options.study)?;
    file.forced()?;
    let model = Model::build(&file)?;
    drift::heed(&model)?;
    drift::heed_range(&model, &file.study)?;
    let mut settled = Vec::new();
    for folder in &options.from {
        settled.extend(settled_states(&Store::open(folder)?)?);
    }
    let mut store = Store::open_for_run(&options.out, &file)?;
    let solver = OrbitSolver::new(&model, &file.study);
    let interrupt = Interrupt::listen(output)?;
    let pieces = file.study.varies.len() + file.study.curves.len();
    let mut terminal = Terminal::new(interrupt.clone(), pieces);
    let begun = Instant::now();
    let threads = threads(options.jobs);
    let plan = Plan { met: solver.settled(&settled), ..Plan::of(&file.study) };
    let outcome = hammerbeam_jobs::run::run(&mut store, &solver, &plan, threads, &mut terminal);
    let varied = match outcome {
        Ok(RunOutcome::Done) => varied::run(&mut store, &model, &file.study, threads, &mut terminal),
        _ => Ok(VariedOutcome::Done),
    };
    terminal.clear();
    interrupt.is_in_order();
    let mut outcome = outcome?;
    if varied? == VariedOutcome::Interrupted {
        outcome = RunOutcome::Interrupted;
    }
    let images = mirror_images(&options.out, &file, &model)?;
    let branches = summarise(&store)?;
    let pieces = store.pieces()?;
    let jobs = store.jobs()?;
    let summary = Summary {
        unit: output.frequency_unit,
        study: &file.study,
        folder: options.out.display().to_string(),
        branches,
        images,
        pieces,
        jobs,
        undamped: model.undamped_modes(),
        undamped_in_contact: model.undamped_in_contact(),
    };
    let result = match outcome {
        RunOutcome::Interrupted => Err(Failure::Interrupted(summary.interrupted())),
        RunOutcome::Done | RunOutcome::OutOfTime { .. } => {
            let mut drawn = Drawn::into(&options.out)?.on(threads, interrupt);
            drawn.frequency_unit = output.frequency_unit;
            figures::draw(&store, (&file, &model), &Wishes::of_run(&file), &mut drawn)?;
            match drawn.finish() {
                Err(Failure::Interrupted(_)) => Err(Failure::Interrupted(summary.interrupted_drawing())),
                Err(other) => Err(other),
                Ok(_) if summary.branches.is_empty() => Err(Failure::NoResult(summary.nothing())),
                Ok(figures) => {
                    let figures = figures.names;
                    output.give(&summary.document(&figures), || summary.text(&figures, begun.elapsed()))?;
                    Ok(())
                }
            }
        }
    };
    store.finish()?;
    result
}

/// Threads to work with: those asked for, else one for each core.
pub fn threads(asked: Option<u16>) -> usize {
    asked.map_or_else(|| std::thread::available_parallelism().map_or(1, usize::from), usize::from)
}

/// What came of a run.
struct Summary<'a> {
    unit: FrequencyUnit,
    study: &'a Study,
    folder: String,
    branches: Vec<BranchSummary>,
    /// Where the mirror image of each branch is.
    images: HashMap<u32, MirrorImage>,
    pieces: Vec<PieceRecord>,
    jobs: Vec<JobRecord>,
    undamped: Vec<UndampedMode>,
    undamped_in_contact: Vec<UndampedInContact>,
}

impl Summary<'_> {
    fn solutions(&self) -> u64 {
        self.branches.iter().map(|branch| branch.solutions).sum()
    }

    fn interrupted(&self) -> String {
        format!(
            "interrupted; {} solutions are kept in {}, the same command goes on from there",
            self.solutions(),
            self.folder
        )
    }

    fn interrupted_drawing(&self) -> String {
        format!(
            "interrupted while drawing; all {} solutions are kept in {}, the same command draws them",
            self.solutions(),
            self.folder
        )
    }

    fn nothing(&self) -> String {
        let [low, high] = self.study.excitation.range_hz();
        let (low, high) = (self.unit.words(low), self.unit.words(high));
        let mut lines = vec![format!("no periodic solution was found between {low} and {high}")];
        lines.extend(self.failed_text());
        if self.left() > 0 {
            lines.push(format!("the search is not complete: {}", self.out_of_time()));
        }
        lines.join("\n")
    }

    fn out_of_time(&self) -> String {
        format!(
            "out of time: {} searches, flips and branch points are left; the same command goes on with them",
            self.left()
        )
    }

    /// Searches, flips and branch points that were not come to.
    fn left(&self) -> usize {
        self.jobs.iter().filter(|job| job.outcome.is_none()).count()
    }

    /// Those of which nothing came or that were not complete, with the reason.
    fn failed(&self) -> impl Iterator<Item = (&JobRecord, &str)> {
        let ended = self.jobs.iter().filter(|job| job.outcome.is_some());
        ended.filter_map(|job| Some((job, job.message.as_deref()?)))
    }

    fn failed_text(&self) -> Vec<String> {
        const SHOWN: usize = 5;
        let failed: Vec<_> = self.failed().collect();
        if failed.is_empty() {
            return Vec::new();
        }
        let mut lines = vec![format!(
            "\n{} of {} searches, flips and branch points led to nothing or were not complete:",
            failed.len(),
            self.jobs.len()
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
        let marginal: u64 = self.branches.iter().map(|branch| branch.marginal).sum();
        let open = self.undamped.iter().map(ToString::to_string);
        let in_contact = self.undamped_in_contact.iter().map(ToString::to_string);
        let mut modes = open.chain(in_contact);
        let first = modes.next().filter(|_| marginal > 0)?;
        let others = match modes.count() {
            0 => String::new(),
            1 => " (nor has another one)".to_owned(),
            others => format!(" (nor have {others} others)"),
        };
        Some(format!(
            "\n{first}{others}: {marginal} solution(s), those at bifurcations included, \
             have multipliers on the unit circle as well as these are known; \
             {UNDAMPED_ADVICE}"
        ))
    }

    fn document(&self, figures: &[String]) -> Value {
        let failed = self
            .failed()
            .map(|(job, message)| json!({ "frequency_hz": job.frequency_hz, "message": message }));
        let in_contact = self.undamped_in_contact.iter().map(in_contact_document);
        json!({
            "unfinished": self.left(),
            "failed": failed.collect::<Vec<_>>(),
            "results": self.folder,
            "title": self.study.title,
            "solutions": self.solutions(),
            "branches": self.branches.iter().map(|branch| self.branch_document(branch)).collect::<Vec<_>>(),
            "varied": self.pieces.iter().map(piece_document).collect::<Vec<_>>(),
            "undamped_in_contact": in_contact.collect::<Vec<_>>(),
            "undamped_modes": self.undamped.iter().map(undamped_document).collect::<Vec<_>>(),
            "figures": figures,
        })
    }

    fn branch_document(&self, branch: &BranchSummary) -> Value {
        let mut document = branch_document(branch);
        document["mirror_image"] = match self.images.get(&branch.record.id) {
            None => Value::Null,
            Some(MirrorImage::Itself) => json!(branch.record.id),
            Some(MirrorImage::Branch(other)) => json!(other),
            Some(MirrorImage::Given) => json!("not stored"),
        };
        document
    }

    fn branch_text(&self, branch: &BranchSummary) -> String {
        let image = self.images.get(&branch.record.id).copied().and_then(image_text);
        [Some(branch_text(branch, self.unit)), image].into_iter().flatten().collect::<Vec<_>>().join("\n")
    }

    fn text(&self, figures: &[String], elapsed: Duration) -> String {
        let mut lines = vec![format!(
            "{} solutions on {} branch(es) in {}, after {:.1} s",
            self.solutions(),
            self.branches.len(),
            self.folder,
            elapsed.as_secs_f64()
        )];
        lines.extend(self.branches.iter().map(|branch| self.branch_text(branch)));
        lines.extend(self.pieces.iter().map(piece_text));
        lines.extend(self.marginal_text());
        lines.extend(self.failed_text());
        if self.left() > 0 {
            lines.push(format!("\n{}", self.out_of_time()));
        }
        lines.push(format!("{} files with figures in {}", figures.len(), self.folder));
        lines.join("\n")
    }
}

/// Where the mirror images of the branches of a symmetric system are.
fn mirror_images(
    folder: &Path,
    file: &StudyFile,
    model: &Model,
) -> Result<HashMap<u32, MirrorImage>, Failure> {
    let mut images = HashMap::new();
    if !model.system.is_symmetric() {
        return Ok(images);
    }
    let stored = StoredBranches::open(folder, file)?;
    for branch in stored.branches() {
        images.extend(stored.mirror_image_of(model, branch)?.map(|image| (branch.record.id, image)));
    }
    Ok(images)
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

fn branch_document(branch: &BranchSummary) -> Value {
    let walk = |walk: &WalkRecord| {
        json!({
            "solutions": walk.solutions,
            "stop_reason": walk.reason.as_ref().map(|reason| reason.kind.as_str()),
            "stop_frequency_hz": walk.reason.as_ref().and_then(|reason| reason.frequency_hz),
            "stop_message": walk.reason.as_ref().map(|reason| reason.message.as_str()),
        })
    };
    let peak = |peak: &Peak| {
        json!({
            "frequency_hz": peak.frequency_hz,
            "equal_hz": peak.equal_hz,
            "equal_solutions": peak.equal,
            "max_abs_displacement_m": peak.max_abs_displacement_m,
            "stable": peak.stability == Some(Stability::Stable),
            "stability": peak_stability(peak),
        })
    };
    json!({
        "branch": branch.record.id,
        "period_multiple": branch.record.period_multiple,
        "solutions": branch.solutions,
        "stable_solutions": branch.stable,
        "marginal_solutions": branch.marginal,
        "frequency_hz": branch.range_hz,
        "folds": branch.folds,
        "flips": branch.flips,
        "flips_not_followed": branch.flips_not_followed,
        "neimark_sacker_points": branch.neimark_sackers,
        "branch_points": branch.branch_points,
        "grazings": branch.grazings,
        "peaks": branch.peaks.iter().map(peak).collect::<Vec<_>>(),
        "up": walk(&branch.record.up),
        "down": walk(&branch.record.down),
    })
}

fn branch_text(branch: &BranchSummary, unit: FrequencyUnit) -> String {
    let [low, high] = branch.range_hz.map(|end| unit.factor() * end);
    let mut lines = vec![
        format!(
            "\nbranch {} (period {}): {} solutions, {low:.6} to {high:.6} {}, {} of them stable{}",
            branch.record.id,
            branch.record.period_multiple,
            branch.solutions,
            unit.symbol(),
            branch.stable,
            marginal_words(branch.marginal)
        ),
        format!(
            "  folds {}, flips {}, Neimark-Sacker points {}, branch points {}, grazings {}",
            branch.folds, branch.flips, branch.neimark_sackers, branch.branch_points, branch.grazings
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
        lines.push(format!("  {side} side: {}", stop_text(walk.reason.as_ref())));
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
        group.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
        let more =
            if group.len() > SHOWN { format!(", and {} more", group.len() - SHOWN) } else { String::new() };
        let height = group[0].max_abs_displacement_m;
        let place = |peak: &&Peak| format!("{}, {}", peak_place(peak, unit), peak_stability(peak));
        let places: Vec<String> = group.iter().take(SHOWN).map(place).collect();
        match group[..] {
            [one] => {
                format!("  peak at {}, {height:.4e} m, {}", peak_place(one, unit), peak_stability(one))
            }
            _ => format!("  {} equal peaks of {height:.4e} m: {}{more}", group.len(), places.join("; ")),
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
    format!("{low:.4} to {high} ({} solutions of equal height)", peak.equal)
}

/// A frequency with so many decimals.
fn shown(unit: FrequencyUnit, frequency_hz: f64, decimals: usize) -> String {
    format!("{:.decimals$} {}", unit.factor() * frequency_hz, unit.symbol())
}

fn peak_stability(peak: &Peak) -> &'static str {
    peak.stability.map_or("in part stable", Stability::word)
}

/// How many solutions are marginal, behind the number of those that are stable; nothing if none is.
fn marginal_words(marginal: u64) -> String {
    if marginal > 0 { format!(", {marginal} marginal") } else { String::new() }
}

fn piece_document(piece: &PieceRecord) -> Value {
    let branches = piece.branches.iter().map(|branch| {
        json!({
            "branch": branch.branch,
            "of": branch.kind,
            "period_multiple": branch.period_multiple,
            "solutions": branch.rows,
            "stable_solutions": branch.stable,
            "marginal_solutions": branch.marginal,
            "events": branch.events,
            "parameter": branch.range,
            "up": branch.up,
            "down": branch.down,
        })
    });
    json!({
        "piece": piece.id,
        "kind": if piece.is_curve { "curve" } else { "vary" },
        "parameter_name": piece.parameter,
        "message": piece.message,
        "branches": branches.collect::<Vec<_>>(),
    })
}

fn piece_text(piece: &PieceRecord) -> String {
    let mut lines = Vec::new();
    for branch in &piece.branches {
        let what = if piece.is_curve { format!("{} curve", branch.kind) } else { "branch".to_owned() };
        let [low, high] = branch.range;
        lines.push(format!(
            "\n{what} over {} (period {}): {} solutions, {low} to {high}, {} of them stable{}",
            piece.parameter,
            branch.period_multiple,
            branch.rows,
            branch.stable,
            marginal_words(u64::from(branch.marginal))
        ));
        let events = branch.events.iter().filter(|(word, _)| !matches!(word.as_str(), "start" | "end"));
        let events: Vec<String> = events.map(|(word, count)| format!("{word} {count}")).collect();
        if !events.is_empty() {
            lines.push(format!("  events: {}", events.join(", ")));
        }
        lines.push(format!("  up side: {}\n  down side: {}", branch.up, branch.down));
    }
    if let Some(message) = &piece.message {
        let what = if piece.is_curve { "curve" } else { "branches" };
        lines.push(format!("\n{what} over {}: {message}", piece.parameter));
    }
    lines.join("\n")
}

fn stop_text(reason: Option<&StoredReason>) -> String {
    match reason {
        None => "not finished".to_owned(),
        Some(reason) if reason.is_complete() => reason.message.clone(),
        Some(reason) => format!("stopped early: {}", reason.message),
    }
}
