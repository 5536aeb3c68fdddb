//! Commands that write are killed at random instants, each started again once: the files are those of an
//! undisturbed command, to the byte.
//!
//! By default one instant a command; `HAMMERBEAM_EXTENSIVE=1` kills a thousand times, `HAMMERBEAM_KILLS=N`
//! so many times. Sent too late a kill meets nobody and does not count.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]
#![allow(clippy::print_stderr, reason = "it has to say how many kills there were")]

use std::{
    fs,
    process::{Command, Stdio},
    thread::sleep,
    time::Instant,
};

use crate::common::{
    SeededNumbers, extensive,
    writers::{Cost, Writer, small_writers, writers},
};

/// Of so many kills of a command one is that of a command that takes long.
const LARGE: usize = 20;

#[test]
fn killed_at_random_instants_and_begun_again_every_command_leaves_the_same_files() {
    let asked = std::env::var("HAMMERBEAM_KILLS").ok().map(|count| count.parse::<usize>().unwrap());
    let all = if extensive() { writers(Cost::Large) } else { Vec::new() };
    let writers = if extensive() { &all[..] } else { small_writers() };
    let small = writers.iter().filter(|writer| writer.cost == Cost::Small).count();
    let wanted = asked.unwrap_or(if extensive() { 1000 } else { small });
    let (mut random, mut killed, mut round) = (SeededNumbers(20), vec![0_usize; writers.len()], 0_usize);
    while killed.iter().sum::<usize>() < wanted {
        for (writer, killed) in writers.iter().zip(&mut killed) {
            if writer.cost == Cost::Small || round % LARGE == 0 {
                *killed += usize::from(kill_once(writer, random.number()));
            }
        }
        round += 1;
        assert!(round < 10 * wanted, "the commands end before they can be killed: {killed:?}");
    }
    for (writer, killed) in writers.iter().zip(&killed) {
        eprintln!("{killed:5} kills of {}", writer.arguments.join(" "));
    }
    eprintln!("{:5} kills", killed.iter().sum::<usize>());
}

/// Kills the command at that part of its time, and does it again.
///
/// # Returns
/// Whether it was still at work.
fn kill_once(writer: &Writer, part: f64) -> bool {
    let workshop = writer.begin();
    let mut child = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"))
        .args(&writer.arguments)
        .current_dir(workshop.path(""))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    sleep(writer.duration.mul_f64(part));
    let at_work = child.try_wait().unwrap().is_none();
    child.kill().unwrap();
    child.wait().unwrap();
    writer.assert_ends_the_same(&workshop, &format!("a kill at {part:.4} of {:?}", writer.duration));
    at_work
}

/// A starter study that was cut off is not a starter study: it is there whole, or not at all.
#[test]
fn a_starter_study_is_there_whole_or_not_at_all() {
    let start = |folder: &std::path::Path| {
        let mut command = Command::new(assert_cmd::cargo::cargo_bin!("hammerbeam"));
        command.args(["new", "starter"]).current_dir(folder).stdout(Stdio::null()).spawn().unwrap()
    };
    let (undisturbed, begun) = (tempfile::tempdir().unwrap(), Instant::now());
    assert!(start(undisturbed.path()).wait().unwrap().success());
    let duration = begun.elapsed();
    for twentieth in 1..=20 {
        let folder = tempfile::tempdir().unwrap();
        let mut child = start(folder.path());
        sleep(duration.mul_f64(f64::from(twentieth) / 16.0));
        child.kill().unwrap();
        child.wait().unwrap();
        let study = fs::read_to_string(folder.path().join("starter/study.toml"));
        assert!(study.is_err() || study.is_ok_and(|text| text.len() > 1000));
    }
}
