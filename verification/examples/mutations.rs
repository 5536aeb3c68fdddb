//! Mutates inputs of every reader, or of one, for so many seconds, and counts:
//! `mutations [SECONDS] [SEED] [READER]`.
//!
//! An input that makes a reader fail is written to `mutation-READER-NUMBER`, and the program ends with exit
//! code 1; so it does if reading has taken more than 1 GiB of memory. Ended by the system (memory, a signal),
//! the last input is in the folder named at the beginning.
#![allow(clippy::print_stdout, reason = "the counts are what it is for")]

use std::{
    env, fs,
    path::Path,
    process::ExitCode,
    sync::mpsc::{self, RecvTimeoutError},
    thread,
    time::{Duration, Instant},
};

use hammerbeam_verification::{
    attractors::Random,
    mutations::{MOST_MEMORY, Outcome, PATIENCE, Reader, corpus, mutated, outcome, peak_memory},
    results::{BoxedError, Results},
};

/// A linear study: its results database has every table and few rows.
const SMALL: &str = r#"
[structure]
kind = "lumped"
mass = [{ name = "m", mass_kg = 1.0 }]
spring = [{ between = ["m", "ground"], stiffness_n_m = 1.0 }]
damper = [{ between = ["m", "ground"], damping_n_s_m = 0.2 }]
[excitation]
kind = "force"
at = "m"
amplitude_n = 1.0
frequency_hz = [0.1, 0.12]
[search]
frequencies = 1
[continuation]
max_step_hz = 0.002
"#;

fn main() -> Result<ExitCode, BoxedError> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let number = |index: usize| arguments.get(index).map(|text| text.parse::<u64>()).transpose();
    let (time, seed) = (Duration::from_secs(number(0)?.unwrap_or(60)), number(1)?.unwrap_or(1));
    let mut readers = Reader::ALL.to_vec();
    if let Some(name) = arguments.get(2) {
        readers.retain(|reader| reader.name() == name);
    }
    let folder = env::temp_dir().join(format!("hammerbeam-mutations-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    println!("seed {seed}, {} s, last inputs in {}", time.as_secs(), folder.display());
    // A panic is counted here; its message would be one of many.
    std::panic::set_hook(Box::new(|_| {}));
    let mut failed = 0;
    for &reader in &readers {
        failed += work(reader, &folder, time / readers.len() as u32, seed)?;
    }
    fs::remove_dir_all(&folder)?;
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Mutates for a reader, and says how many inputs made it fail.
fn work(reader: Reader, folder: &Path, time: Duration, seed: u64) -> Result<usize, BoxedError> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut inputs = corpus(reader, &root)?;
    if reader == Reader::Results {
        let small = tempfile::tempdir()?;
        Results::of_run(SMALL, small.path(), 1)?;
        inputs.push(fs::read(small.path().join("results.db"))?);
    }
    let (begun, mut random) = (Instant::now(), Random::new(seed));
    let (mut taken, mut refused, mut failed) = (0_u64, 0_u64, 0);
    let mut slowest = Duration::ZERO;
    while begun.elapsed() < time {
        let pick = |random: &mut Random| (random.part() * inputs.len() as f64) as usize % inputs.len();
        let (input, other) = (pick(&mut random), pick(&mut random));
        let bytes = mutated(&inputs[input], &inputs[other], &mut random);
        let (outcome, took) = watched(reader, folder, bytes.clone())?;
        slowest = slowest.max(took);
        match outcome {
            Outcome::Taken => taken += 1,
            Outcome::Refused => refused += 1,
            outcome => {
                failed += 1;
                let name = format!("mutation-{}-{failed}", reader.name());
                fs::write(&name, &bytes)?;
                println!("{}: {outcome:?}, input in {name}", reader.name());
            }
        }
    }
    let slowest = slowest.as_secs_f64();
    let counts = format!("{taken} taken, {refused} refused, {failed} failed, slowest {slowest:.2} s");
    let Some(peak) = peak_memory() else {
        println!("{}: {counts}", reader.name());
        return Ok(failed);
    };
    println!("{}: {counts}, at most {} MiB so far", reader.name(), peak >> 20);
    Ok(failed + usize::from(peak > MOST_MEMORY))
}

/// The outcome of an input, on a thread of its own: one that never ends is slow, too, and ends the program.
fn watched(reader: Reader, folder: &Path, bytes: Vec<u8>) -> Result<(Outcome, Duration), BoxedError> {
    fs::write(folder.join("input"), &bytes)?;
    let (sender, receiver) = mpsc::channel();
    let folder = folder.to_owned();
    thread::spawn(move || sender.send(outcome(reader, &folder, &bytes)));
    match receiver.recv_timeout(60 * PATIENCE) {
        Ok(outcome) => Ok(outcome),
        Err(RecvTimeoutError::Disconnected) => Ok((Outcome::Panicked, Duration::ZERO)),
        Err(RecvTimeoutError::Timeout) => Err(format!("{} does not end", reader.name()).into()),
    }
}
