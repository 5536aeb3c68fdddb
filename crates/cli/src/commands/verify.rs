//! `hammerbeam verify`: stored solutions, computed again by the independent integrator.

use std::time::{Duration, Instant};

use hammerbeam_jobs::{
    Observer, PreparedStudy,
    verify::{
        Disagreement, Verification, VerifiedPlace, VerifiedQuantity, VerifyReport, VerifySettings, Worst,
        verify,
    },
};
use hammerbeam_results::Store;

use crate::{args::VerifyOptions, failure::Failure, interrupt::Interrupt, output::Output, watch::Watch};

/// Disagreements shown as text; all of them are in the document.
const SHOWN: usize = 50;

pub fn run(options: &VerifyOptions, output: Output) -> Result<(), Failure> {
    let store = Store::open(&options.results)?;
    let study = PreparedStudy::of_store(&store)?;
    let settings = VerifySettings {
        sample: (!options.all).then_some(options.sample),
        seed: options.seed,
        tolerance: options.tolerance,
        jobs: usize::from(options.jobs),
    };
    let mut watch = Watch::new(Interrupt::listen(output)?);
    let started = Instant::now();
    let verified = verify(&store, &study, &settings, &mut watch);
    watch.finishing();
    let Some(verification) = verified? else {
        return Err(Failure::Interrupted("interrupted; nothing was changed".to_owned()));
    };
    let folder = options.results.display().to_string();
    if verification.stored == 0 {
        return Err(Failure::NoResult(format!("no solutions are stored in {folder}")));
    }
    let report = VerifyReport { verification, settings };
    output.give(&report, || text(&report.verification, &folder, started.elapsed()))?;
    let verification = report.verification;
    if verification.disagreements.is_empty() {
        return Ok(());
    }
    let (disagree, sampled) = (verification.disagreeing(), verification.sampled);
    Err(Failure::Disagreement(format!("{disagree} of {sampled} solutions disagree")))
}

fn text(verification: &Verification, folder: &str, elapsed: Duration) -> String {
    let mut lines = vec![format!(
        "{} of {} solutions in {folder} computed again, in {:.1} s\n",
        verification.sampled,
        verification.stored,
        elapsed.as_secs_f64()
    )];
    let [quantity, worst, bound, place, compared, disagree] =
        ["quantity", "worst", "bound", "where", "compared", "disagree"];
    lines.push(format!("{quantity:<26} {worst:>9} {bound:>9}  {place:<28} {compared:>8} {disagree:>8}"));
    lines.extend(verification.worst.iter().filter(|worst| worst.compared > 0).map(row));
    lines.push(String::new());
    lines.extend(verification.disagreements.iter().take(SHOWN).map(line));
    if verification.disagreements.len() > SHOWN {
        let more = verification.disagreements.len() - SHOWN;
        lines.push(format!("  and {more} more, with --json"));
    }
    if verification.grazing > 0 {
        lines.push(format!("{} solutions are allowed for: a contact grazes there", verification.grazing));
    }
    if verification.disagreements.is_empty() {
        lines.push("all agree".to_owned());
    }
    lines.join("\n")
}

fn row(worst: &Worst) -> String {
    let place = worst.place.map_or(String::new(), |place| place_text(place, 6));
    format!(
        "{:<26} {:>9.1e} {:>9.1e}  {place:<28} {:>8} {:>8}",
        worst.quantity.name(),
        worst.difference,
        worst.bound,
        worst.compared,
        worst.disagree
    )
}

/// Where a solution is, with so many decimals of its frequency.
fn place_text(place: VerifiedPlace, decimals: usize) -> String {
    let VerifiedPlace { piece, branch, frequency_hz } = place;
    let (of_piece, at) = piece.map_or((String::new(), String::new()), |(piece, parameter)| {
        (format!(" of piece {piece}"), format!(", {parameter}"))
    });
    format!("branch {branch}{of_piece}, {frequency_hz:.decimals$} Hz{at}")
}

fn line(found: &Disagreement) -> String {
    let place = format!("{}: {}", place_text(found.place, 9), found.quantity.name());
    match (&found.message, found.quantity) {
        (Some(message), _) => format!("{place}: {message}"),
        (None, VerifiedQuantity::Residual | VerifiedQuantity::Events) => {
            format!("{place} {:.2e}, at most {:.1e} is allowed", found.difference, found.bound)
        }
        (None, _) => format!(
            "{place} stored {:.10e}, recomputed {:.10e}, difference {:.2e}, at most {:.1e} is allowed",
            found.stored, found.recomputed, found.difference, found.bound
        ),
    }
}
