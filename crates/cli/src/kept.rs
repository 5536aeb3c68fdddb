//! What becomes of the results of a command that does not come to its end, in words.

use std::path::Path;

use hammerbeam_jobs::JobError;

use crate::failure::Failure;

/// What becomes of so many results of an interrupted command.
pub fn what_is_kept(number: u64, out: Option<&Path>) -> String {
    let be = if number == 1 { "is" } else { "are" };
    match out {
        Some(_) => format!("{}, the same command goes on from there", place(number, out)),
        None => format!("{be} lost without --out"),
    }
}

/// Where so many results are, of a command that cannot go on.
pub fn place(number: u64, out: Option<&Path>) -> String {
    let [be, have_been] = if number == 1 { ["is", "was"] } else { ["are", "were"] };
    match out {
        Some(folder) => format!("{be} kept in {}", folder.display()),
        None => format!("{have_been} computed"),
    }
}

/// A job that was stopped or cannot go on, with what becomes of what it has done.
///
/// * `what_is_kept`: of so many pieces, in words.
pub fn unfinished(error: JobError, what_is_kept: impl Fn(u64) -> String) -> Failure {
    match error {
        JobError::Interrupted { done, part_s } => {
            let part = part_s.map(|seconds| {
                format!("; the tables have what was averaged over {seconds:.6} s of one more")
            });
            Failure::Interrupted(format!("interrupted; {}{}", what_is_kept(done), part.unwrap_or_default()))
        }
        JobError::Stopped { source, done } => Failure::from(*source).and(&what_is_kept(done)),
        other => other.into(),
    }
}
