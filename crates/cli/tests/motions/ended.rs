//! Commands that are killed or interrupted: what was finished is kept, and what goes on ends with the same
//! bytes.

use std::{
    fs,
    process::Child,
    thread::sleep,
    time::{Duration, Instant},
};

use rusqlite::{Connection, OpenFlags};

use super::{DUFFING, basins::BASINS, column, remembering, table};
use crate::common::{Workshop, assert_success, interrupted, stderr};

/// Basins that were killed three times have the bytes of those that were not, on another number of threads.
#[test]
fn basins_go_on_after_a_kill_with_the_same_bytes() {
    let whole = Workshop::with(DUFFING);
    let basins = [&BASINS[..], &["out", "--jobs", "1"]].concat();
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&basins));
    let workshop = Workshop::with(DUFFING);
    kill_three_times(&workshop, &basins, begun.elapsed());
    assert_success(&workshop.hammerbeam(&[&BASINS[..], &["out", "--jobs", "3"]].concat()));
    for name in ["out/basins.csv", "out/attractors.csv"] {
        assert!(fs::read(whole.path(name)).unwrap() == fs::read(workshop.path(name)).unwrap(), "{name}");
    }
    // What tells two attractors on one branch apart.
    let table = fs::read_to_string(whole.path("out/attractors.csv")).unwrap();
    let mut lines = table.lines();
    assert!(lines.next().unwrap().ends_with(",branch,q1,v1"), "{table}");
    let states: Vec<&str> = lines.map(|line| line.rsplit(',').next().unwrap()).collect();
    assert!(states.len() > 1 && states.iter().all(|velocity| velocity.parse::<f64>().is_ok()), "{table}");
}

/// Pieces of the only request in `out` that are stored, and all that it has; none as long as there is no
/// request.
fn stored(workshop: &Workshop) -> (i64, i64) {
    let database = workshop.path("out/results.db");
    let connection = Connection::open_with_flags(database, OpenFlags::SQLITE_OPEN_READ_ONLY);
    let read = connection.and_then(|connection| {
        connection.query_row("SELECT done, pieces FROM request", [], |row| Ok((row.get(0)?, row.get(1)?)))
    });
    read.unwrap_or((0, 0))
}

/// Waits until more than so many pieces are stored; the command must not come to its end before.
fn wait_for_more(workshop: &Workshop, child: &mut Child, before: i64) {
    while stored(workshop).0 <= before {
        assert!(child.try_wait().unwrap().is_none(), "it ended with no more than {before} pieces stored");
        sleep(Duration::from_millis(2));
    }
}

/// Each time it has stored more than the time before, and not all; somewhere within the work on a piece,
/// which is lost.
///
/// * `duration`: of the whole command, about.
fn kill_three_times(workshop: &Workshop, arguments: &[&str], duration: Duration) {
    let mut before = 0;
    for _ in 0..3 {
        let mut child = workshop.spawn(arguments);
        wait_for_more(workshop, &mut child, before);
        sleep(duration.mul_f64(0.03));
        child.kill().unwrap();
        child.wait().unwrap();
        let (done, all) = stored(workshop);
        assert!(before < done && done < all, "{arguments:?}: {done} of {all} after {before}");
        before = done;
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_keeps_finished_cells_and_exits_with_130() {
    let workshop = Workshop::with(DUFFING);
    let mut child = workshop.spawn(&[&BASINS[..], &["out", "--jobs", "1"]].concat());
    wait_for_more(&workshop, &mut child, 0);
    let output = interrupted(child);
    assert_eq!(output.status.code(), Some(130), "{}", stderr(&output));
    let (done, all) = stored(&workshop);
    assert!(0 < done && done < all, "{done} of {all}");
    let verb = if done == 1 { "is" } else { "are" };
    let reported = format!("interrupted; {done} of {all} cells {verb} kept in out");
    assert!(stderr(&output).contains(&reported), "{}", stderr(&output));
}

/// A long motion of any kind ends with what is finished, too.
#[cfg(unix)]
#[test]
fn ctrl_c_ends_every_command_with_130() {
    for (arguments, table) in [
        (&["simulate", "study.toml", "--frequency", "0.2", "--periods", "9000000"][..], Some("samples.csv")),
        (&["lyapunov", "study.toml", "--frequency", "0.2", "--periods", "10000000"], None),
        (&["sweep", "study.toml", "--step", "0.00001"], Some("sweep.csv")),
        (&["sweep", "study.toml", "--step", "0.0001", "--starts", "5"], Some("sweep.csv")),
    ] {
        let workshop = Workshop::with(DUFFING);
        let child = workshop.spawn(&[arguments, &["--out", "out"]].concat());
        // Long enough for the command to listen; the work takes hours.
        sleep(Duration::from_millis(1500));
        let output = interrupted(child);
        assert_eq!(output.status.code(), Some(130), "{arguments:?} {}", stderr(&output));
        assert!(stderr(&output).contains("interrupted"), "{}", stderr(&output));
        if let Some(name) = table {
            let rows = fs::read_to_string(workshop.path("out").join(name)).unwrap();
            assert!(rows.lines().count() > 1, "{arguments:?}");
        }
    }
}

/// Sweeps, diagrams and series of exponents that were killed have the bytes of those that were not.
#[test]
fn sweeps_and_exponents_go_on_after_a_kill_with_the_same_bytes() {
    let sweep = ["sweep", "study.toml", "--step", "0.001", "--down", "--out", "out"];
    let starts = ["sweep", "study.toml", "--step", "0.005", "--starts", "3", "--out", "out"];
    let series =
        ["lyapunov", "study.toml", "--frequency", "0.1", "--to", "0.4", "--step", "0.05", "--out", "out"];
    for (arguments, names) in [
        (&sweep[..], &["sweep.csv", "sweep_samples.csv"][..]),
        (&starts, &["sweep.csv", "sweep_samples.csv"]),
        (&series, &["spectra.csv", "exponents.csv", "convergence.csv", "section.csv"]),
    ] {
        let whole = Workshop::with(DUFFING);
        let begun = Instant::now();
        assert_success(&whole.hammerbeam(arguments));
        let duration = begun.elapsed();
        let workshop = Workshop::with(DUFFING);
        kill_three_times(&workshop, arguments, duration);
        assert_success(&workshop.hammerbeam(arguments));
        for name in names {
            let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
            assert!(of(&whole) == of(&workshop), "{arguments:?} {name}");
        }
    }
}

/// A sweep whose motions are in contact at phase 0, which their states do not determine: killed and taken
/// up again it has the same bytes.
#[test]
fn a_sweep_within_contacts_that_remember_goes_on_with_the_same_bytes() {
    let study = remembering();
    let whole = Workshop::with(&study);
    let sweep =
        ["sweep", "study.toml", "--from", "0.3", "--to", "0.5", "--step", "0.004", "--initial", "-0.1,0"];
    let sweep = [&sweep[..], &["--down", "--out", "out"]].concat();
    let begun = Instant::now();
    assert_success(&whole.hammerbeam(&sweep));
    let duration = begun.elapsed();
    let samples = column(&table(&whole, "out/sweep_samples.csv"), "displacement_m");
    assert!(samples.iter().filter(|displacement| **displacement > 0.0).count() > 10, "some are in contact");
    let workshop = Workshop::with(&study);
    kill_three_times(&workshop, &sweep, duration);
    assert_success(&workshop.hammerbeam(&sweep));
    for name in ["sweep.csv", "sweep_samples.csv"] {
        let of = |workshop: &Workshop| fs::read(workshop.path("out").join(name)).unwrap();
        assert!(of(&whole) == of(&workshop), "{name}");
    }
}
