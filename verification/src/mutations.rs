//! Damaged input: every reader of the program on files that someone, or something, has changed.
//!
//! A reader may refuse a file or take it; it may not panic, take more than [`PATIENCE`], or run out of
//! memory. Files that are there anyway (studies, fixtures of the signal readers, a results database) are the
//! corpus, besides those in `verification/corpus/`, which once made a reader fail or are odd by hand. The
//! same seed makes the same mutations.

use std::{
    fs,
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    time::{Duration, Instant},
};

use hammerbeam_jobs::{PreparedStudy, Quiet, check::check, update::UpdateData};
use hammerbeam_matrices::{parse_matrices, read_labels, read_lines, read_nodes};
use hammerbeam_results::{Store, StoreError, export_csv, summary::summarise};
use hammerbeam_signal::{RecordOptions, points, read};
use hammerbeam_study::{StudyFile, file::StructureTable};

use crate::attractors::Random;

/// Most memory that reading may take, of all inputs together [bytes].
pub const MOST_MEMORY: u64 = 1 << 30;
/// Longest time that a reader may take.
pub const PATIENCE: Duration = Duration::from_secs(2);
/// Finite elements of a beam whose model is built at once.
pub const MOST_ELEMENTS: u32 = 100;
/// Files beyond that are no use: they are read slowly for their length alone.
const LARGEST: usize = 1 << 20;

/// What reads files of others.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reader {
    /// A study file.
    Study,
    /// A study file and what `check` computes of it, if its beam has no more than [`MOST_ELEMENTS`].
    Model,
    /// A time series, in any format.
    Signal,
    /// A table of measured points.
    Points,
    /// Matrices of a finite element program, in any format.
    Matrices,
    /// Labels of rows, places of nodes and lines of a mesh, in any format.
    Tables,
    /// Measurements to which a model is fitted.
    Update,
    /// A results database.
    Results,
}

impl Reader {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Study,
        Self::Model,
        Self::Signal,
        Self::Points,
        Self::Matrices,
        Self::Tables,
        Self::Update,
        Self::Results,
    ];

    /// Name, also of its folder in the corpus.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Study => "study",
            Self::Model => "model",
            Self::Signal => "signal",
            Self::Points => "points",
            Self::Matrices => "matrices",
            Self::Tables => "tables",
            Self::Update => "update",
            Self::Results => "results",
        }
    }

    /// Reads the file `input` of a folder as far as a command would, and says whether it was taken.
    fn read(self, folder: &Path, bytes: &[u8]) -> bool {
        match self {
            Self::Study => {
                String::from_utf8(bytes.to_vec()).is_ok_and(|text| StudyFile::parse("input", text).is_ok())
            }
            Self::Model => String::from_utf8(bytes.to_vec()).is_ok_and(checked),
            Self::Signal => {
                read::parse(bytes).is_ok_and(|raw| raw.validate(&RecordOptions::default()).is_ok())
            }
            Self::Points => points::parse(bytes).is_ok(),
            Self::Matrices => parse_matrices(bytes, None).is_ok(),
            Self::Tables => tables(folder, bytes).is_ok_and(|taken| taken),
            Self::Update => {
                let study = StudyFile::parse("study", FITTED.to_owned());
                let text = String::from_utf8(bytes.to_vec());
                study.is_ok_and(|study| {
                    text.is_ok_and(|text| UpdateData::parse("input", text, &study).is_ok())
                })
            }
            Self::Results => everything_stored(folder, bytes).is_ok(),
        }
    }
}

/// The study whose model is fitted.
const FITTED: &str = include_str!("../../studies/beam-with-stop.toml");

/// Whether a study is taken by everything that `check` does.
fn checked(text: String) -> bool {
    let Ok(file) = StudyFile::parse("input", text) else { return false };
    // More of them are work that was asked for.
    if matches!(&file.study.structure, StructureTable::Beam(beam) if beam.elements > MOST_ELEMENTS) {
        return true;
    }
    PreparedStudy::new(file).is_ok_and(|study| check(&study, &mut Quiet).is_ok())
}

/// Whether any reader of tables takes the bytes: the ending of a name says which one it is.
fn tables(folder: &Path, bytes: &[u8]) -> std::io::Result<bool> {
    let mut taken = false;
    for ending in ["csv", "dof", "inp", "pch"] {
        let path = folder.join(format!("table.{ending}"));
        fs::write(&path, bytes)?;
        taken |= read_labels(&path).is_ok() | read_nodes(&path).is_ok() | read_lines(&path).is_ok();
    }
    Ok(taken)
}

/// Everything that a results database has to say.
fn everything_stored(folder: &Path, bytes: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
    fs::write(folder.join("results.db"), bytes)?;
    let store = Store::open(folder)?;
    summarise(&store)?;
    for branch in store.branches()? {
        store.each_row::<StoreError>(&branch, |_| Ok(()))?;
    }
    export_csv(&store, &folder.join("export"))?;
    Ok(())
}

/// What became of an input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It was read.
    Taken,
    /// There was a message.
    Refused,
    /// The reader panicked.
    Panicked,
    /// It took more than [`PATIENCE`].
    Slow,
}

impl Outcome {
    /// Whether the reader did what it may.
    #[must_use]
    pub fn is_allowed(self) -> bool {
        matches!(self, Self::Taken | Self::Refused)
    }
}

/// Gives a reader an input, in a folder of its own.
///
/// # Returns
/// What became of it, and its processor time.
#[must_use]
pub fn outcome(reader: Reader, folder: &Path, bytes: &[u8]) -> (Outcome, Duration) {
    let begun = Clock::now();
    let read = catch_unwind(AssertUnwindSafe(|| reader.read(folder, bytes)));
    let time = begun.elapsed();
    let outcome = match read {
        Err(_) => Outcome::Panicked,
        Ok(_) if time > PATIENCE => Outcome::Slow,
        Ok(true) => Outcome::Taken,
        Ok(false) => Outcome::Refused,
    };
    (outcome, time)
}

/// Processor time of this thread where Linux reports it: a busy machine makes no reader slow. Elsewhere the
/// time of day.
#[derive(Debug)]
struct Clock {
    started: Instant,
    busy: Option<Duration>,
}

impl Clock {
    fn now() -> Self {
        Self { started: Instant::now(), busy: Self::busy() }
    }

    /// Time since the start.
    fn elapsed(&self) -> Duration {
        let busy = self.busy.zip(Self::busy()).map(|(before, now)| now.saturating_sub(before));
        busy.unwrap_or_else(|| self.started.elapsed())
    }

    /// The first number of the scheduler's statistics: nanoseconds on a processor.
    fn busy() -> Option<Duration> {
        let text = fs::read_to_string("/proc/thread-self/schedstat").ok()?;
        let nanoseconds = text.split_whitespace().next()?.parse().ok()?;
        // Without statistics all are 0.
        (nanoseconds > 0).then(|| Duration::from_nanos(nanoseconds))
    }
}

/// The most memory that this program has had so far [bytes], where Linux reports it.
#[must_use]
pub fn peak_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches("kB").trim().parse::<u64>().ok().map(|kilobytes| 1024 * kilobytes)
}

/// The files that a reader's mutations begin with, in the order of their names.
///
/// * `root`: of the repository.
///
/// # Errors
/// A folder or a file cannot be read.
pub fn corpus(reader: Reader, root: &Path) -> std::io::Result<Vec<Vec<u8>>> {
    let own = format!("verification/corpus/{}", reader.name());
    let folders: &[&str] = match reader {
        Reader::Study => &["studies", "verification/studies", &own],
        Reader::Model => &["studies", "verification/studies", "verification/corpus/study", &own],
        Reader::Signal => &["crates/signal/tests/fixtures", &own],
        Reader::Matrices => &["crates/matrices/tests/fixtures", "crates/matrices/tests/data", &own],
        Reader::Tables => &["crates/matrices/tests/fixtures", &own],
        Reader::Update => &["studies/measurements", &own],
        Reader::Points | Reader::Results => &[&own],
    };
    let mut paths: Vec<PathBuf> = Vec::new();
    for folder in folders.iter().map(|folder| root.join(folder)).filter(|folder| folder.exists()) {
        for entry in fs::read_dir(folder)? {
            paths.push(entry?.path());
        }
    }
    paths.retain(|path| path.is_file());
    paths.sort();
    paths.iter().map(fs::read).collect()
}

/// Words that readers look for, and numbers at the borders of what can be computed with.
const WORDS: [&str; 24] = [
    "nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "5e-324",
    "0",
    "-0.0",
    "-1",
    "18446744073709551616",
    "1e400",
    "\0",
    "\u{1b}[2J",
    "\r\n",
    "\u{202e}",
    "[[stop]]\n",
    "[[",
    "\"",
    "{",
    "}",
    ",",
    ";",
    "=",
    "\u{feff}",
];

/// One to eight changes of an input.
#[must_use]
pub fn mutated(input: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = input.to_vec();
    for _ in 0..=below(random, 8) {
        change(&mut bytes, other, random);
        bytes.truncate(LARGEST);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    let at = below(random, bytes.len() + 1);
    let end = (at + below(random, 64)).min(bytes.len());
    match below(random, 9) {
        0 if at < bytes.len() => bytes[at] ^= 1 << below(random, 8),
        1 if at < bytes.len() => bytes[at] = below(random, 256) as u8,
        2 => drop(bytes.drain(at..end)),
        3 => bytes.truncate(at),
        4 => {
            let copy = bytes[at..end].to_vec();
            let times = 1 + below(random, 20);
            (0..times).for_each(|_| drop(bytes.splice(at..at, copy.iter().copied())));
        }
        5 => {
            let from = below(random, other.len() + 1);
            let piece = &other[from..(from + below(random, 200)).min(other.len())];
            drop(bytes.splice(at..end, piece.iter().copied()));
        }
        6 => drop(bytes.splice(at..at, WORDS[below(random, WORDS.len())].bytes())),
        7 => replace_number(bytes, at, random),
        _ => {
            // A number of four or eight bytes, as headers have them.
            let value = [0, 1, u64::MAX, 1 << 31, 1 << 40, 255][below(random, 6)].to_le_bytes();
            for (place, byte) in bytes[at..].iter_mut().take(4 + 4 * below(random, 2)).zip(value) {
                *place = byte;
            }
        }
    }
}

/// Puts a word in the place of the next number of a text.
fn replace_number(bytes: &mut Vec<u8>, from: usize, random: &mut Random) {
    let digit = |byte: &u8| byte.is_ascii_digit();
    let Some(begin) = bytes[from..].iter().position(digit).map(|place| from + place) else { return };
    let of_number = |byte: &u8| byte.is_ascii_digit() || b".eE+-_".contains(byte);
    let length = bytes[begin..].iter().take_while(|byte| of_number(byte)).count();
    drop(bytes.splice(begin..begin + length, WORDS[below(random, 11)].bytes()));
}

fn below(random: &mut Random, most: usize) -> usize {
    ((random.part() * most as f64) as usize).min(most.saturating_sub(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_makes_the_same_mutations_and_no_two_in_a_row() {
        let all = |seed| {
            let mut random = Random::new(seed);
            (0..200).map(|_| mutated(b"length_m = 0.25\n", b"other", &mut random)).collect::<Vec<_>>()
        };
        assert_eq!(all(7), all(7));
        assert_ne!(all(7), all(8));
        let changed = all(7).iter().filter(|bytes| bytes.as_slice() != b"length_m = 0.25\n").count();
        assert!(changed > 180, "{changed} of 200");
    }

    #[test]
    fn a_panic_is_an_outcome() {
        let folder = Path::new(".");
        let panics = catch_unwind(AssertUnwindSafe(|| -> bool { panic!("as a reader may not") }));
        assert!(panics.is_err());
        assert_eq!(outcome(Reader::Study, folder, b"title = 1").0, Outcome::Refused);
        assert_eq!(outcome(Reader::Study, folder, &[0xff]).0, Outcome::Refused);
        assert!(!Outcome::Panicked.is_allowed() && !Outcome::Slow.is_allowed());
    }
}
