use std::{fs, path::Path};

use hammerbeam_orbit::{BranchEventKind, EventSet, OrbitMaxima, PeriodicSolution, Side};
use hammerbeam_study::file::StudyFile;
use rusqlite::{Connection, functions::FunctionFlags};
use tempfile::tempdir;

use super::*;
use crate::{end::BranchEnd, row::SolvedRow};

pub(crate) const STUDY: &str = include_str!("../../../../studies/duffing.toml");

pub(crate) fn study(text: &str) -> StudyFile {
    StudyFile::parse("study.toml", text.to_owned()).unwrap()
}

pub(super) fn solution(frequency_hz: f64) -> PeriodicSolution {
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
    let events = EventSet::default().with(BranchEventKind::Fold).with(BranchEventKind::Grazing);
    let row = SolvedRow { solution: solution(0.3), parameter: 0.3, events, located: None };
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
    let sentence = "solution 0 on the up side of branch 1 is missing from results.db; \
        a run of the study into a new folder computes it again";
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

/// A kill while a transaction is being written leaves its journal behind: the copy of both files is what the
/// next run finds.
#[test]
fn a_journal_left_by_a_kill_is_rolled_back_by_whoever_comes_next() {
    for reads in [true, false] {
        let (folder, killed) = (tempdir().unwrap(), tempdir().unwrap());
        let mut store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
        begin(&mut store);
        store.finish().unwrap();
        let database = folder.path().join(DATABASE);
        let writing = Connection::open(&database).unwrap();
        add_checksums(&writing).unwrap();
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

/// All that a folder gives: rows with their nodes, multipliers and events, or the error.
fn everything(folder: &Path) -> Result<String, StoreError> {
    let store = Store::open(folder)?;
    let mut all = format!("{:?} {:?} {:?}", store.branches()?, store.jobs()?, store.starts()?);
    all += &format!("{:?} {}", store.requests()?, store.about("title")?);
    for branch in store.branches()? {
        for side in [Side::Up, Side::Down] {
            let rows = store.walked(branch.start, side)?;
            all += &format!("{rows:?} {:?}", store.checkpoint(branch.start, side)?);
            for number in 0..rows.len() as u32 {
                let key = solution_key(branch.start, side, number);
                all += &format!("{:?} {:?}", store.solution_of_key(key)?, store.event(key)?);
            }
        }
    }
    Ok(all)
}

/// A finished folder with some of everything that a walk leaves.
pub(crate) fn walked_folder(folder: &Path) {
    let mut store = Store::open_for_run(folder, &study(STUDY)).unwrap();
    let key = begin(&mut store);
    let located = hammerbeam_orbit::LocatedEvent {
        status: hammerbeam_orbit::EventStatus::Located,
        uncertainty: 1e-9,
        multiplier: Some([1.0, 0.0]),
        direction: vec![0.5, -0.5],
        contacts: Vec::new(),
        breaks_symmetry: false,
    };
    let row = |number: u32| {
        let fold = number % 10 == 3;
        SolvedRow {
            solution: solution(0.3 + 0.001 * f64::from(number)),
            parameter: 0.5,
            events: EventSet::of([(fold, BranchEventKind::Fold)]),
            located: fold.then(|| located.clone()),
        }
    };
    let rows: Vec<SolvedRow> = (0..60).map(row).collect();
    let memory = Memory { checkpoint: b"checkpoint", journal: &[3; 9000] };
    store.append(key, Side::Up, &rows, Continuation::GoesOn(memory)).unwrap();
    store.finish().unwrap();
}

/// More solutions of the first branch of a folder.
pub(crate) fn append(run: &mut Store, side: Side, frequencies_hz: &[f64]) {
    let start = run.branches().unwrap()[0].start;
    let row = |frequency_hz: &f64| SolvedRow {
        solution: solution(*frequency_hz),
        parameter: 0.7,
        events: EventSet::default(),
        located: None,
    };
    let rows: Vec<SolvedRow> = frequencies_hz.iter().map(row).collect();
    let memory = Memory { checkpoint: b"there", journal: b"" };
    run.append(start, side, &rows, Continuation::GoesOn(memory)).unwrap();
}

/// Every bit of a page is looked at sooner or later: one of each tenth byte or so, and whole stretches.
#[test]
fn a_damaged_file_gives_an_error_or_what_was_stored() {
    let (whole, damaged) = (tempdir().unwrap(), tempdir().unwrap());
    walked_folder(whole.path());
    let expected = everything(whole.path()).unwrap();
    let bytes = fs::read(whole.path().join(DATABASE)).unwrap();
    let (mut found, mut state) = (0, 30_u64);
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    const DAMAGES: usize = 600;
    for number in 0..DAMAGES {
        let mut other = bytes.clone();
        let place = random(bytes.len());
        match number % 6 {
            0..4 => other[place] ^= 1 << random(8),
            4 => other[place..].iter_mut().take(random(600)).for_each(|byte| *byte = 0),
            _ => other.truncate(place),
        }
        fs::write(damaged.path().join(DATABASE), other).unwrap();
        match everything(damaged.path()) {
            Ok(all) => assert!(all == expected, "damage {number} at byte {place} changes something"),
            Err(_) => found += 1,
        }
        let _ = fs::remove_file(damaged.path().join(format!("{DATABASE}-journal")));
    }
    // The rest fell into room that no row uses.
    assert!(found > DAMAGES / 4, "only {found}");
}

/// The number of a peak, one bit of it changed: what needs the row is refused, and a run does not go on
/// behind it.
#[test]
fn a_changed_bit_of_a_number_is_found_and_named_by_its_place() {
    let folder = tempdir().unwrap();
    walked_folder(folder.path());
    let path = folder.path().join(DATABASE);
    let mut bytes = fs::read(&path).unwrap();
    let number = 0.321_f64.to_be_bytes();
    // Pages that were split keep copies in room that no row uses.
    let places: Vec<usize> = (0..bytes.len() - 8).filter(|at| bytes[*at..*at + 8] == number).collect();
    assert!(!places.is_empty());
    places.iter().for_each(|place| bytes[place + 1] ^= 8);
    fs::write(&path, bytes).unwrap();
    let sentence = "solution 22 on the up side of branch 1 is damaged: it is not as it was stored";
    let store = Store::open(folder.path()).unwrap();
    let Err(error) = store.walked(store.branches().unwrap()[0].start, Side::Up) else { panic!("not found") };
    assert!(error.to_string().starts_with(sentence) && error.is_of_solutions(), "{error}");
    let error = Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err();
    assert!(error.to_string().starts_with(sentence) && !error.is_bad_input(), "{error}");
}

/// A run writes the title, the text and its number again, and would give a damaged row a checksum that fits.
#[test]
fn a_run_refuses_a_damaged_note_on_the_study_and_writes_nothing() {
    let folder = tempdir().unwrap();
    walked_folder(folder.path());
    let path = folder.path().join(DATABASE);
    let connection = Connection::open(&path).unwrap();
    let constant = |_: &rusqlite::functions::Context<'_>| Ok(7_i64);
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    connection.create_scalar_function("row_checksum", -1, flags, constant).unwrap();
    connection.execute("UPDATE about SET value = 'x' WHERE key = 'title'", []).unwrap();
    connection.close().unwrap();
    let before = fs::read(&path).unwrap();
    let error = Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err();
    assert!(matches!(error, StoreError::DamagedFile { .. }), "{error}");
    assert!(fs::read(&path).unwrap() == before, "something was written");
}

/// A database with a trigger would change rows as they are written, with checksums that fit.
#[test]
fn a_folder_with_more_than_tables_is_refused() {
    let added = [
        "CREATE TRIGGER t AFTER UPDATE ON walk BEGIN UPDATE solution SET max_abs_displacement_m = 42.0; END",
        "CREATE VIEW v AS SELECT * FROM walk",
        "CREATE INDEX i ON walk (solutions)",
        "CREATE TABLE further (a)",
    ];
    for statement in added {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        let connection = Connection::open(folder.path().join(DATABASE)).unwrap();
        add_checksums(&connection).unwrap();
        connection.execute_batch(statement).unwrap();
        connection.close().unwrap();
        let error = Store::open(folder.path()).unwrap_err();
        assert!(matches!(error, StoreError::DamagedFile { .. }), "{statement}: {error}");
        let error = Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err();
        assert!(matches!(error, StoreError::DamagedFile { .. }), "{statement}: {error}");
    }
}

/// A pipe without a writer would be waited for.
#[cfg(unix)]
#[test]
fn a_pipe_is_no_database() {
    let folder = tempdir().unwrap();
    let made = std::process::Command::new("mkfifo").arg(folder.path().join(DATABASE)).status();
    assert!(made.is_ok_and(|status| status.success()));
    assert!(matches!(Store::open(folder.path()), Err(StoreError::NoResults { .. })));
    let error = Store::open_for_run(folder.path(), &study(STUDY)).unwrap_err();
    assert!(error.to_string().contains("it is no file"), "{error}");
}

/// Numbers that nothing has, in rows whose checksums fit: someone else has written them.
#[test]
fn impossible_numbers_are_refused_where_they_are_read() {
    for (change, what) in [
        ("UPDATE solution SET phase_cycles = 9e999", "phase is inf"),
        ("UPDATE start SET period_multiple = 2147483648", "multiple of the period is 2147483648"),
        ("UPDATE start SET period_multiple = 0", "multiple of the period is 0"),
        ("UPDATE solution SET segments = 4294967295, state_length = 4294967295", "nodes"),
    ] {
        let folder = tempdir().unwrap();
        walked_folder(folder.path());
        let connection = Connection::open(folder.path().join(DATABASE)).unwrap();
        add_checksums(&connection).unwrap();
        connection.execute_batch(change).unwrap();
        connection.close().unwrap();
        let store = Store::open(folder.path()).unwrap();
        let error =
            store.branches().and_then(|branches| store.solution(branches[0].start, Side::Up, 0)).unwrap_err();
        assert!(error.to_string().contains(what) && !error.is_bad_input(), "{change}: {error}");
    }
}

#[test]
fn values_that_databases_convert_keep_their_checksums() {
    let folder = tempdir().unwrap();
    let mut store = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    let key = begin(&mut store);
    let row = |frequency_hz: f64, residual: f64| SolvedRow {
        solution: PeriodicSolution { residual, ..solution(frequency_hz) },
        parameter: 0.5,
        events: EventSet::default(),
        located: None,
    };
    let rows = [row(3.0, -0.0), row(1e300, f64::MIN_POSITIVE / 8.0), row(4e18, f64::INFINITY)];
    let reason = BranchEnd::NotStarted { message: "\u{0}\u{e9}\u{10ffff}".to_owned() };
    store.append(key, Side::Up, &rows, Continuation::Ended(&reason)).unwrap();
    store.finish().unwrap();
    assert_eq!(everything(folder.path()).unwrap().matches("frequency_hz: 3.0").count(), 2);
}

/// The lock is a file, and someone may remove it.
#[test]
fn of_two_runs_that_hold_a_lock_the_first_adds_nothing_more() {
    let folder = tempdir().unwrap();
    let mut first = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    let key = begin(&mut first);
    fs::remove_file(folder.path().join("run.lock")).unwrap();
    let mut second = Store::open_for_run(folder.path(), &study(STUDY)).unwrap();
    let reason = BranchEnd::NotStarted { message: "no".to_owned() };
    let error = first.append(key, Side::Up, &[], Continuation::Ended(&reason)).unwrap_err();
    assert!(matches!(error, StoreError::TakenOver { .. }) && !error.is_bad_input(), "{error}");
    assert!(first.add_jobs(&[(JobKind::Survey, 0.3, None, 0)]).is_err());
    assert!(first.finish_job(0, JobOutcome::Nothing).is_err() && first.accept_start(key).is_err());
    assert!(first.request(RequestKind::Sweep, "from = 1", 3).is_err());
    second.append(key, Side::Up, &[], Continuation::Ended(&reason)).unwrap();
    assert_eq!(second.jobs().unwrap().len(), 1);
}

#[test]
fn a_database_that_was_removed_is_noticed_at_the_next_write() {
    let folder = tempdir().unwrap();
    let results = folder.path().join("results");
    for put_back in [false, true] {
        let mut store = Store::open_for_run(&results, &study(STUDY)).unwrap();
        begin(&mut store);
        fs::remove_dir_all(&results).unwrap();
        if put_back {
            fs::create_dir(&results).unwrap();
            fs::write(results.join(DATABASE), "").unwrap();
        }
        let error = store.add_jobs(&[(JobKind::Survey, 0.3, None, 0)]).unwrap_err();
        assert!(matches!(error, StoreError::Gone { .. }) && !error.is_bad_input(), "{error}");
        assert!(matches!(store.finish(), Err(StoreError::Gone { .. })));
    }
}

#[test]
fn a_folder_may_have_the_name_of_an_address() {
    let folder = tempdir().unwrap();
    let place = folder.path().join("file:x?mode=memory");
    let mut store = Store::open_for_run(&place, &study(STUDY)).unwrap();
    begin(&mut store);
    store.finish().unwrap();
    assert!(place.join(DATABASE).is_file());
    assert_eq!(Store::open(&place).unwrap().branches().unwrap().len(), 1);
}
