//! Motions in time are kept as what they are: killed, taken up again, asked twice, exported.

use std::{fs, thread::sleep, time::Duration};

use hammerbeam_results::{
    Store,
    store::{SimulatedChunk, SimulationLayout, StoreError},
};

use super::{DUFFING, IMPACT_OSCILLATOR, remembering};
use crate::common::{
    BEAM, DRIVEN_MASS, Workshop, assert_bad_input, assert_success, interrupted, stderr, stdout,
};

const TABLES: [&str; 3] = ["samples", "contacts", "stroboscopic"];

/// Periods that are done.
fn done(workshop: &Workshop) -> u64 {
    let read = || Store::open(&workshop.path("out"))?.requests();
    read().ok().and_then(|requests| requests.first().map(|request| request.done)).unwrap_or(0)
}

/// The last chunk of what is stored.
fn last_chunk(workshop: &Workshop) -> SimulatedChunk {
    let mut last = None;
    let take = |chunk| {
        last = Some(chunk);
        Ok(())
    };
    let store = Store::open(&workshop.path("out")).unwrap();
    let layout = SimulationLayout::of(&store.requests().unwrap()[0]).unwrap();
    store.each_simulated::<StoreError>(1, &layout, take).unwrap();
    last.unwrap()
}

/// Kills the command as soon as it has stored more.
///
/// # Returns
/// The last chunk of what was stored; nothing if the command has come to its end before, as it does where the
/// test gets no time of the machine.
fn kill_after_progress(workshop: &Workshop, arguments: &[&str]) -> Option<SimulatedChunk> {
    let before = done(workshop);
    let mut child = workshop.spawn(arguments);
    while done(workshop) == before && child.try_wait().unwrap().is_none() {
        sleep(Duration::from_millis(5));
    }
    // A command that has ended cannot be killed any more.
    child.kill().ok();
    child.wait().unwrap();
    let store = Store::open(&workshop.path("out")).unwrap();
    let request = store.requests().unwrap().remove(0);
    (before < request.done && request.done < request.pieces).then(|| last_chunk(workshop))
}

/// Kills the command three times in between, each time after it has stored more.
///
/// # Returns
/// The last chunks before the kills.
#[track_caller]
fn kill_three_times(workshop: &Workshop, arguments: &[&str]) -> Vec<SimulatedChunk> {
    for _ in 0..10 {
        let chunks: Option<Vec<_>> = (0..3).map(|_| kill_after_progress(workshop, arguments)).collect();
        if let Some(chunks) = chunks {
            return chunks;
        }
        fs::remove_dir_all(workshop.path("out")).unwrap();
    }
    panic!("{arguments:?} ended before it could be killed, ten times");
}

/// Runs the command without a break and with three kills, and compares tables and documents.
///
/// # Returns
/// The last chunks before the kills.
#[track_caller]
fn assert_same_bytes(study: &str, arguments: &[&str]) -> Vec<SimulatedChunk> {
    let arguments = [&["simulate", "study.toml", "--out", "out", "--json"], arguments].concat();
    let (whole, workshop) = (Workshop::with(study), Workshop::with(study));
    let expected = whole.hammerbeam(&arguments);
    assert_success(&expected);
    let chunks = kill_three_times(&workshop, &arguments);
    let found = workshop.hammerbeam(&arguments);
    assert_success(&found);
    assert!(found.stdout == expected.stdout, "{}\n{}", stdout(&found), stdout(&expected));
    let of = |workshop: &Workshop, name: &str| fs::read(workshop.path("out").join(name)).unwrap();
    for name in TABLES.map(|name| format!("{name}.csv")) {
        assert!(of(&whole, &name) == of(&workshop, &name), "{name}");
    }
    // What is finished has its tables written once more, from the store alone.
    for name in TABLES {
        fs::remove_file(workshop.path("out").join(format!("{name}.csv"))).unwrap();
    }
    assert!(workshop.hammerbeam(&arguments).stdout == expected.stdout);
    assert_success(&workshop.hammerbeam(&["export", "out", "--format", "csv"]));
    for name in TABLES {
        let expected = of(&whole, &format!("{name}.csv"));
        assert!(of(&workshop, &format!("{name}.csv")) == expected, "{name}");
        assert!(of(&workshop, &format!("export/{name}-1.csv")) == expected, "{name}-1");
    }
    chunks
}

/// The beam with its Hertzian stop in chaos, killed in the transient and after it.
#[test]
fn a_chaotic_beam_goes_on_after_kills_with_the_same_bytes() {
    let transient = ["--frequency", "53", "--transient-periods", "1500", "--periods", "3000"];
    let more = ["--samples-per-period", "50", "--section-phase", "0.33"];
    assert_same_bytes(BEAM, &[&transient[..], &more].concat());
}

/// Between two walls, each with columns of its own in the table of samples.
#[test]
fn a_motion_with_two_stops_goes_on_after_kills_with_the_same_bytes() {
    let wall = |name: &str, side: &str| {
        format!(
            "[[stop]]\nname = \"{name}\"\nat = \"m\"\nside = \"{side}\"\ngap_m = 0.5\nlaw \
            = \"linear\"\nstiffness_n_m = 30.0\n"
        )
    };
    let walls = format!("frequency_hz = [0.1, 0.2]\n{}{}", wall("right", "above"), wall("left", "below"));
    let study = format!("{DRIVEN_MASS}{walls}");
    let motion = ["--frequency", "0.15", "--periods", "8000", "--samples-per-period", "20"];
    for chunk in assert_same_bytes(&study, &motion) {
        let elements: Vec<usize> = chunk.contacts.iter().map(|contact| contact.element).collect();
        assert!(elements.contains(&0) && elements.contains(&1), "{elements:?}");
    }
}

/// At the ends of periods the mass is in a contact of an impact-speed-dependent law.
#[test]
fn a_contact_that_remembers_goes_on_over_a_kill() {
    let study = remembering().replace("law = \"flores\"", "law = \"lankarani-nikravesh\"");
    let motion =
        ["--frequency", "0.2", "--initial", "-0.1,0", "--periods", "20000", "--samples-per-period", "2"];
    let chunks = assert_same_bytes(&study, &motion);
    for chunk in chunks {
        assert_eq!(chunk.unfinished.len(), 1, "a contact is open where it was killed");
        assert!(chunk.unfinished[0].impulse > 0.0 && chunk.checkpoint.impact_speeds[0].is_finite());
    }
}

/// Below its resonance the mass is pressed on a stop without a gap for half of each period, phase 0 in its
/// middle: after some bounces it sticks.
#[test]
fn a_mass_that_sticks_goes_on_over_a_kill() {
    let study = IMPACT_OSCILLATOR.replace("restitution = 0.8\ngap_m = 1.0", "restitution = 0.3\ngap_m = 0.0");
    let motion =
        ["--frequency", "0.08", "--initial", "-0.3,0", "--periods", "8000", "--samples-per-period", "2"];
    for chunk in assert_same_bytes(&study, &motion) {
        let held = &chunk.unfinished[0];
        assert!(held.peak_force > 0.0 && held.end_s.is_none(), "it is held where it was killed");
    }
}

/// Every combination of options is a request of its own; the tables of the folder are those of the last one.
#[test]
fn requests_are_told_apart_and_exported_by_number() {
    let workshop = Workshop::with(BEAM);
    let of = |periods: &str| {
        let motion = ["simulate", "study.toml", "--frequency", "36", "--periods", periods, "--out", "out"];
        assert_success(&workshop.hammerbeam(&motion));
        fs::read_to_string(workshop.path("out/stroboscopic.csv")).unwrap()
    };
    let tables = [of("3"), of("5"), of("3")];
    assert_eq!(tables[0], tables[2]);
    assert!(tables[1].starts_with(&tables[0]) && tables[1].lines().count() == 6);
    let sweep = ["sweep", "study.toml", "--from", "36", "--to", "36", "--out", "out"];
    assert_success(&workshop.hammerbeam(&sweep));
    let export = workshop.hammerbeam(&["export", "out", "--format", "csv", "--out", "tables"]);
    assert_success(&export);
    for (number, table) in [("1", &tables[0]), ("2", &tables[1])] {
        let name = format!("stroboscopic-{number}.csv");
        assert_eq!(&fs::read_to_string(workshop.path("tables").join(&name)).unwrap(), table);
        assert!(stdout(&export).contains(&name));
    }
    assert!(workshop.path("tables/sweep-3.csv").exists() && !workshop.path("tables/samples-3.csv").exists());
}

/// Ctrl-C in the transient keeps its periods and writes no tables.
#[cfg(unix)]
#[test]
fn a_transient_is_kept_too() {
    let workshop = Workshop::with(BEAM);
    let motion =
        ["simulate", "study.toml", "--frequency", "53", "--transient-periods", "10000000", "--out", "out"];
    let child = workshop.spawn(&motion);
    while done(&workshop) == 0 {
        sleep(Duration::from_millis(5));
    }
    let output = interrupted(child);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    let done = done(&workshop);
    let message =
        format!("{done} periods of the transient are kept in out, the same command goes on from there");
    assert!(stderr(&output).contains(&message), "{}", stderr(&output));
    assert!(!workshop.path("out/samples.csv").exists());
}

/// A mass that escapes over the barrier of its softening spring: the whole periods before are kept, and asked
/// again the motion ends at the same place.
#[test]
fn a_motion_that_ends_early_keeps_its_periods() {
    let workshop = Workshop::changed(DUFFING, "stiffness_n_m3 = 1.0", "stiffness_n_m3 = -0.2");
    let motion = ["simulate", "study.toml", "--frequency", "0.13", "--out", "out"];
    let ended = || {
        let output = workshop.hammerbeam(&motion);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        (stderr(&output), TABLES.map(|name| fs::read(workshop.path(&format!("out/{name}.csv"))).unwrap()))
    };
    let first = ended();
    let periods = done(&workshop);
    assert!(periods > 1, "{}", first.0);
    let ends = (format!("period {}: ", periods + 1), format!("; {periods} periods are kept in out\n"));
    assert!(first.0.contains(&ends.0) && first.0.ends_with(&ends.1), "{}", first.0);
    assert_eq!(first.1[2].split(|byte| *byte == b'\n').count() as u64, 1 + periods + 1);
    assert!(ended() == first);
}

/// The same mass escapes within the transient, or a period behind it.
#[test]
fn a_motion_that_ends_in_the_transient_tells_what_is_kept() {
    let workshop = Workshop::changed(DUFFING, "stiffness_n_m3 = 1.0", "stiffness_n_m3 = -0.2");
    let ended = |transient: u64| {
        let transient = transient.to_string();
        let motion = ["simulate", "study.toml", "--frequency", "0.13", "--transient-periods", &transient];
        let output = workshop.hammerbeam(&[&motion[..], &["--out", "out"]].concat());
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        stderr(&output)
    };
    let message = ended(1000);
    let periods = done(&workshop);
    let ends = format!("; {periods} periods of the transient are kept in out\n");
    assert!(message.contains(&format!("period {} of the transient: ", periods + 1)), "{message}");
    assert!(message.ends_with(&ends), "{message}");
    assert!(!workshop.path("out/samples.csv").exists());
    // Neither does an export write tables of it, nor the command when it is asked again.
    assert!(ended(1000) == message);
    assert_success(&workshop.hammerbeam(&["export", "out", "--format", "csv"]));
    assert!(!workshop.path("out/export/samples-1.csv").exists());
    let one = ended(periods - 1);
    assert!(one.contains("period 2: ") && one.ends_with("; 1 period is kept in out\n"), "{one}");
}

/// A disk without room is not the user's mistake, and what is stored goes on from there.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_with_what_is_kept() {
    let workshop = Workshop::with(BEAM);
    let motion = ["simulate", "study.toml", "--frequency", "36", "--out", "out"];
    // Files of this process may have 140 kB: less than the results of ten periods.
    let script = "trap '' XFSZ; ulimit -f 280; exec \"$@\"";
    let program = assert_cmd::cargo::cargo_bin!("hammerbeam");
    let mut limited = std::process::Command::new("sh");
    limited.args(["-c", script, "sh"]).arg(program).args(motion).current_dir(workshop.path(""));
    let output = limited.output().unwrap();
    let message = stderr(&output);
    assert_eq!(output.status.code(), Some(1), "{message}");
    assert!(message.contains("results database: "), "{message}");
    let ends = " periods are kept in out, the same command goes on from there\n";
    assert!(message.ends_with(ends), "{message}");
    assert_success(&workshop.hammerbeam(&motion));
    let parts =
        workshop.listing().into_iter().filter(|(path, _)| path.extension().is_some_and(|e| e == "part"));
    assert_eq!(parts.count(), 0);
}

#[test]
fn folders_of_others_and_branches_that_are_not_there_are_refused() {
    let workshop = Workshop::with(BEAM);
    let motion = ["simulate", "study.toml", "--frequency", "36", "--periods", "1"];
    assert_success(&workshop.hammerbeam(&[&motion[..], &["--out", "out"]].concat()));
    let branch = [&motion[..], &["--initial", "branch:7", "--results", "out"]].concat();
    assert_bad_input(
        &workshop.hammerbeam(&branch),
        &["--initial: there is no branch \"7\"; the folder of --results has no branches"],
    );
    fs::write(workshop.path("study.toml"), IMPACT_OSCILLATOR).unwrap();
    let other = ["simulate", "study.toml", "--frequency", "0.3", "--out", "out"];
    assert_bad_input(&workshop.hammerbeam(&other), &["holds the results of another study"]);
}

/// A motion that cannot begin leaves nothing behind.
#[test]
fn a_motion_that_cannot_begin_makes_no_folder() {
    let workshop = Workshop::with(&remembering());
    let before = workshop.listing();
    let motion = ["simulate", "study.toml", "--frequency", "0.3", "--out", "out"];
    assert_eq!(workshop.hammerbeam(&motion).status.code(), Some(1));
    assert_eq!(workshop.listing(), before, "something was written");
}
