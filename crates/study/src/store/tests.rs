use tempfile::tempdir;

use hammerbeam_orbit::{BranchRow, Events, OrbitMaxima, PeriodicSolution};

use super::*;
use crate::store::{Continuation, Memory};

const STUDY: &str = include_str!("../../../../studies/duffing.toml");

fn study(text: &str) -> StudyFile {
    StudyFile::parse("study.toml", text.to_owned()).unwrap()
}

fn solution(frequency_hz: f64) -> PeriodicSolution {
    PeriodicSolution {
        phase: 0.375,
        frequency_hz,
        period_multiple: 1,
        nodes: vec![vec![0.1, 1.0 / 3.0], vec![-0.0, 1e-300], vec![f64::MAX, 5.0]],
        floquet_multipliers: vec![[0.5, 0.1], [0.5, -0.1]],
        on_circle: Vec::new(),
        residual: 1e-13,
        error_estimate: 2e-10,
        maxima: OrbitMaxima { displacement: 1e-3, contacts: 3, ..OrbitMaxima::default() },
    }
}

/// A branch with its start.
fn begin(store: &mut Store) -> u32 {
    store.add_jobs(&[(JobKind::Survey, 0.2, None, 0)]).unwrap();
    let job = store.jobs().unwrap().remove(0);
    store.note_starts(&job, &[solution(0.2)], None).unwrap();
    let key = store.starts().unwrap()[0].key;
    store.accept_start(key).unwrap();
    key
}

fn listing(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .map(|path| (path.display().to_string(), fs::read(&path).unwrap()))
        .collect();
    files.sort();
    files
}

#[test]
fn a_solution_comes_back_with_every_bit() {
    let folder = tempdir().unwrap();
    let mut store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    let branch = begin(&mut store);
    let events = Events { fold: true, grazing: true, ..Events::default() };
    let row = BranchRow { solution: solution(0.3), parameter: None, events, located: None };
    let memory = |checkpoint, journal| Continuation::GoesOn(Memory { checkpoint, journal });
    store.append(branch, Side::Up, &[row], memory(b"there", b"fi")).unwrap();
    store.append(branch, Side::Up, &[], memory(b"here", b"rst")).unwrap();
    assert_eq!(store.solution(branch, Side::Up, 0).unwrap(), solution(0.2));
    assert_eq!(store.solution(branch, Side::Up, 1).unwrap(), solution(0.3));
    let memory = store.checkpoint(branch, Side::Up).unwrap().unwrap();
    assert_eq!((&memory.checkpoint[..], &memory.journal[..]), (&b"here"[..], &b"first"[..]));
    let mut labels = Vec::new();
    store
        .each_row::<StoreError>(&store.branches().unwrap()[0], |row| {
            labels.push(row.events.label());
            Ok(())
        })
        .unwrap();
    assert_eq!(labels, ["start", "fold+grazing+end"]);
}

/// No other solution takes the number of one that is gone.
#[test]
fn a_solution_that_is_gone_is_told_by_its_place() {
    let folder = tempdir().unwrap();
    let mut store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    let key = begin(&mut store);
    assert_eq!(store.walked(key, Side::Up).unwrap().len(), 1);
    store.connection.execute("DELETE FROM solution", []).unwrap();
    let sentence = "solution 0 on the up side of branch 1 is missing from results.db; a run of the study into a new folder computes it again";
    for error in [store.walked(key, Side::Up).unwrap_err(), store.solution(key, Side::Up, 0).unwrap_err()] {
        assert_eq!(error.to_string(), sentence);
        assert!(error.is_of_solutions() && !error.is_bad_input());
    }
}

#[test]
fn a_folder_of_another_study_is_refused_with_the_difference_and_left_alone() {
    let folder = tempdir().unwrap();
    Store::open_for_run(folder.path(), &study(STUDY)).unwrap().finish().unwrap();
    let before = listing(folder.path());
    let other = study(&STUDY.replace("amplitude_n = 0.3", "amplitude_n = 0.4"));
    let error = Store::open_for_run(folder.path(), &other).unwrap_err();
    let message = error.to_string();
    assert!(message.contains("another study"), "{message}");
    assert!(message.contains("excitation.kind.force.amplitude_n: 0.3 there, 0.4 here"), "{message}");
    assert!(error.is_bad_input());
    assert_eq!(listing(folder.path()), before);
}

#[test]
fn a_new_title_keeps_the_folder_valid() {
    let folder = tempdir().unwrap();
    Store::open_for_run(folder.path(), &study(STUDY)).unwrap().finish().unwrap();
    let renamed = study(&STUDY.replace("Hardening", "Stiffening"));
    let store = Store::open_for_run(folder.path(), &renamed).unwrap();
    assert_eq!(store.about("title").unwrap(), "Stiffening Duffing oscillator");
}

#[test]
fn a_folder_of_another_version_is_refused() {
    for (key, what) in [("schema_version", "storage version 0"), ("data_version", "data version 0")] {
        let folder = tempdir().unwrap();
        let store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        store.connection.execute("UPDATE about SET value = '0' WHERE key = ?1", [key]).unwrap();
        store.finish().unwrap();
        let before = listing(folder.path());
        for error in [
            Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err(),
            Store::open(folder.path()).unwrap_err(),
        ] {
            assert!(error.to_string().contains(what), "{error}");
            assert!(error.is_bad_input());
        }
        assert_eq!(listing(folder.path()), before);
    }
}

#[test]
fn a_file_of_someone_else_is_refused_and_left_alone() {
    for content in [&b"this is not a database, but it is long enough to be looked at"[..], &[7; 5000]] {
        let folder = tempdir().unwrap();
        fs::write(folder.path().join(DATABASE), content).unwrap();
        let error = Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err();
        assert!(matches!(error, StoreError::NotResults { .. }), "{error}");
        assert_eq!(listing(folder.path()).len(), 1);
    }
}

#[test]
fn a_database_that_was_killed_before_its_tables_is_begun_anew() {
    let folder = tempdir().unwrap();
    fs::write(folder.path().join(DATABASE), b"").unwrap();
    let store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    assert_eq!(store.branches().unwrap(), []);
}

#[test]
fn two_runs_do_not_share_a_folder() {
    let folder = tempdir().unwrap();
    let first = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    assert!(matches!(Store::open_for_run(folder.path(), &study(STUDY)), Err(StoreError::Locked { .. })));
    first.finish().unwrap();
    Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
}

#[test]
fn results_can_be_read_while_a_run_writes() {
    let folder = tempdir().unwrap();
    let mut writing = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    begin(&mut writing);
    let reading = Store::open(folder.path()).unwrap();
    assert_eq!(reading.branches().unwrap().len(), 1);
}

#[test]
fn reading_where_nothing_is_writes_nothing() {
    let folder = tempdir().unwrap();
    assert!(matches!(Store::open(folder.path()), Err(StoreError::NoResults { .. })));
    assert_eq!(listing(folder.path()), []);
}

/// A kill while a transaction is being written leaves its journal behind: the copy of both files is what the next run finds.
#[test]
fn a_journal_left_by_a_kill_is_rolled_back_by_whoever_comes_next() {
    for reads in [true, false] {
        let (folder, killed) = (tempdir().unwrap(), tempdir().unwrap());
        let mut store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        begin(&mut store);
        store.finish().unwrap();
        let database = folder.path().join(DATABASE);
        let writing = Connection::open(&database).unwrap();
        writing.execute_batch("PRAGMA cache_size = 1; BEGIN; UPDATE about SET value = 'half';").unwrap();
        let long = "x".repeat(100_000);
        for number in 0..20 {
            let insert = "INSERT INTO about (key, value) VALUES (?1, ?2)";
            writing.execute(insert, rusqlite::params![format!("key {number}"), long]).unwrap();
        }
        for name in [DATABASE.to_owned(), format!("{DATABASE}-journal")] {
            fs::copy(folder.path().join(&name), killed.path().join(&name)).unwrap();
        }
        assert!(
            fs::metadata(killed.path().join(DATABASE)).unwrap().len() > 500_000,
            "the transaction has spilled"
        );
        let store = match reads {
            true => Store::open(killed.path()).unwrap(),
            false => Store::open_for_run(killed.path(), &study(STUDY)).unwrap(),
        };
        assert_eq!(store.branches().unwrap().len(), 1);
        assert_ne!(store.about("title").unwrap(), "half");
    }
}
