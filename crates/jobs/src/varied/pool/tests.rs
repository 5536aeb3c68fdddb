use std::{sync::atomic::AtomicUsize, thread};

use hammerbeam_orbit::{EventSet, OrbitMaxima, PeriodicSolution, Side, StopReason};
use hammerbeam_results::{
    end::BranchEnd,
    row::SolvedRow,
    store::{Piece, PieceKind, StoredMemory},
};
use hammerbeam_study::StudyFile;
use tempfile::{TempDir, tempdir};

use super::*;
use crate::{
    Quiet,
    varied::solver::{Failed, FoundStarts},
    walk::Walk,
};

const ROWS: u32 = 4;

fn orbit(parameter: f64) -> PeriodicSolution {
    PeriodicSolution {
        frequency_hz: 0.25,
        period_multiple: 1,
        phase: 0.0,
        nodes: vec![vec![parameter, -parameter]],
        floquet_multipliers: vec![[0.5, 0.0]],
        on_circle: Vec::new(),
        residual: 0.0,
        error_estimate: 0.0,
        maxima: OrbitMaxima::default(),
    }
}

/// A piece whose branches are [`ROWS`] rows to each side.
#[derive(Default)]
struct FakePiece {
    starts: usize,
    /// The search ends with this message.
    fails: bool,
    /// The search goes on until it is interrupted.
    waits: bool,
    /// Walks are left after so many rows of all of them, as if the thread was stopped.
    resumed: AtomicUsize,
}

struct FakeWalk {
    number: u32,
    side: Side,
}

impl PieceSolver for FakePiece {
    fn search(&self, interrupted: &dyn Fn() -> bool) -> Result<FoundStarts, Failed> {
        while self.waits && !interrupted() {
            thread::yield_now();
        }
        match (self.waits, self.fails) {
            (true, _) => Err(Failed::Interrupted),
            (_, true) => Err(Failed::Message("none".to_owned())),
            _ => {
                let starts = vec![orbit(0.0); self.starts];
                Ok(FoundStarts { starts, parameter: 0.0, message: None })
            }
        }
    }

    fn begin<'a>(&'a self, _: &PeriodicSolution, side: Side) -> Result<Box<dyn Walk + 'a>, Failed> {
        Ok(Box::new(FakeWalk { number: u32::from(side == Side::Down), side }))
    }

    fn resume<'a>(&'a self, memory: &StoredMemory) -> Result<Box<dyn Walk + 'a>, Failed> {
        self.resumed.fetch_add(1, Ordering::Relaxed);
        let side = if memory.checkpoint[1] == 1 { Side::Down } else { Side::Up };
        Ok(Box::new(FakeWalk { number: u32::from(memory.checkpoint[0]), side }))
    }

    fn way(&self) -> ([f64; 2], f64) {
        ([-4.0, 4.0], 0.0)
    }

    fn is_near(&self, _: &PeriodicSolution, _: &[(f64, Vec<f64>)]) -> Result<bool, Failed> {
        Ok(false)
    }
}

impl Walk for FakeWalk {
    fn step(&mut self, rows: &mut Vec<SolvedRow>) -> Result<Option<BranchEnd>, String> {
        let value = f64::from(self.number) * if self.side == Side::Down { -1.0 } else { 1.0 };
        rows.push(SolvedRow {
            parameter: value,
            solution: orbit(value),
            events: EventSet::default(),
            located: None,
        });
        self.number += 1;
        let is_end = self.number > ROWS;
        Ok(is_end.then(|| StopReason::RangeEnd { place: value }.into()))
    }

    fn checkpoint(&self) -> Option<Vec<u8>> {
        Some(vec![self.number as u8, u8::from(self.side == Side::Down)])
    }

    fn take_journal(&mut self) -> Vec<u8> {
        Vec::new()
    }
}

/// A store with a piece for each of them.
fn store_for(pieces: &[FakePiece]) -> (TempDir, Store) {
    let text = include_str!("../../../../../studies/duffing.toml");
    let study = StudyFile::parse("study.toml", text.to_owned()).expect("a study");
    let folder = tempdir().expect("a folder");
    let mut store = Store::open_for_run(folder.path(), &study).expect("a store");
    let piece = |number: usize| Piece {
        definition: number.to_string(),
        kind: PieceKind::Vary,
        parameter: format!("parameter {number}"),
    };
    store.keep_pieces(&(0..pieces.len()).map(piece).collect::<Vec<_>>()).expect("no refusal");
    (folder, store)
}

fn compute(store: &mut Store, pieces: &[FakePiece], threads: usize, observer: &mut dyn Observer) -> bool {
    let records = store.all_pieces().expect("no refusal");
    let count = records.len();
    let work = |record: hammerbeam_results::store::PieceRecord| {
        let solver: &dyn PieceSolver = &pieces[record.place as usize - 1];
        PieceWork { record, solver: Ok(solver), is_running: false }
    };
    let mut works: Vec<PieceWork<'_>> =
        records.into_iter().filter(|record| !record.finished).map(work).collect();
    let finished = count - works.len();
    compute_all(store, (&mut works, finished), threads, observer).expect("no refusal")
}

/// Values of the parameter along the branches of each piece, and its message.
fn stored(store: &Store) -> Vec<(Vec<Vec<f64>>, Option<String>)> {
    let of_piece = |piece: hammerbeam_results::store::PieceRecord| {
        let values = |branch| -> Vec<f64> {
            let rows = store.placed_rows(branch).expect("no refusal");
            rows.iter().map(|placed| placed.row.parameter).collect()
        };
        (piece.branches.iter().map(values).collect(), piece.message)
    };
    store.all_pieces().expect("no refusal").into_iter().map(of_piece).collect()
}

#[test]
fn pieces_are_stored_however_they_end_for_any_number_of_threads() {
    let piece = |starts, fails| FakePiece { starts, fails, ..FakePiece::default() };
    let pieces = [piece(1, false), piece(2, false), piece(1, true), piece(0, false)];
    let branch: Vec<f64> = (-4..=4).map(f64::from).collect();
    for threads in [1, 2, 7] {
        let (_folder, mut store) = store_for(&pieces);
        assert!(compute(&mut store, &pieces, threads, &mut Quiet));
        let expected = [
            (vec![branch.clone()], None),
            (vec![branch.clone(); 2], None),
            (Vec::new(), Some("none".to_owned())),
            (Vec::new(), None),
        ];
        assert_eq!(stored(&store), expected, "{threads} threads");
    }
}

#[derive(Default)]
struct RecordingObserver {
    seen: Vec<(f64, u64)>,
    /// Asks to stop at this row.
    stops_at: Option<usize>,
    stops: bool,
}

impl Observer for RecordingObserver {
    fn varied(&mut self, progress: &VariedProgress<'_>) {
        assert!((0.0..=1.0).contains(&progress.fraction), "{progress:?}");
        self.seen.push((progress.fraction, progress.new_solutions));
        self.stops |= self.stops_at.is_some_and(|most| self.seen.len() >= most);
    }

    fn interrupted(&mut self) -> bool {
        self.stops
    }
}

/// Of two pieces one is finished: half is done before the first row of the other one.
#[test]
fn pieces_of_an_earlier_run_count_as_done() {
    let pieces = [0, 1].map(|_| FakePiece { starts: 1, ..FakePiece::default() });
    let (_folder, mut store) = store_for(&pieces);
    let rows = 2 * ROWS as usize + 1;
    let mut first = RecordingObserver { stops_at: Some(rows + 1), ..RecordingObserver::default() };
    assert!(!compute(&mut store, &pieces, 1, &mut first));
    let mut second = RecordingObserver::default();
    assert!(compute(&mut store, &pieces, 1, &mut second));
    assert!(second.seen.iter().all(|(fraction, _)| *fraction >= 0.5), "{:?}", second.seen);
}

#[test]
fn progress_grows_with_every_row() {
    let pieces = [0, 1].map(|_| FakePiece { starts: 1, ..FakePiece::default() });
    let (_folder, mut store) = store_for(&pieces);
    let mut recorder = RecordingObserver::default();
    assert!(compute(&mut store, &pieces, 2, &mut recorder));
    assert_eq!(recorder.seen.len(), 2 * (2 * ROWS as usize + 1));
    assert!(recorder.seen.windows(2).all(|pair| pair[0].0 <= pair[1].0 && pair[0].1 < pair[1].1));
}

/// A piece whose search is interrupted is searched again by the next run.
#[test]
fn an_interruption_reaches_every_thread() {
    let pieces = [0, 1].map(|_| FakePiece { waits: true, ..FakePiece::default() });
    let (_folder, mut store) = store_for(&pieces);
    let mut recorder = RecordingObserver { stops: true, ..RecordingObserver::default() };
    assert!(!compute(&mut store, &pieces, 2, &mut recorder));
    assert!(store.pieces().expect("no refusal").is_empty());
}

/// What is stored of a walk is not walked again; all of it is as if nothing had happened.
#[test]
fn a_branch_goes_on_in_its_middle() {
    let pieces = [FakePiece { starts: 2, ..FakePiece::default() }];
    let (_folder, mut store) = store_for(&pieces);
    assert!(compute(&mut store, &pieces, 1, &mut Quiet));
    let expected = stored(&store);
    let key = store.all_pieces().expect("no refusal")[0].key;
    let (_folder, mut store) = store_for(&pieces);
    let start = orbit(0.0);
    store.note_piece_starts(key, 0.0, &[start.clone(), start], None).expect("no refusal");
    let first = store.starts_of_piece(key).expect("no refusal")[0].key;
    store.accept_start(first).expect("no refusal");
    let mut walk = FakeWalk { number: 1, side: Side::Down };
    let mut rows = Vec::new();
    for _ in 0..2 {
        walk.step(&mut rows).expect("no failure");
    }
    let checkpoint = walk.checkpoint().expect("it has one");
    let memory = hammerbeam_results::store::Memory { checkpoint: &checkpoint, journal: &[] };
    let goes_on = hammerbeam_results::store::Continuation::GoesOn(memory);
    store.append(first, Side::Down, &rows, goes_on).expect("no refusal");
    let mut recorder = RecordingObserver::default();
    assert!(compute(&mut store, &pieces, 1, &mut recorder));
    assert_eq!(stored(&store), expected);
    assert_eq!(pieces[0].resumed.load(Ordering::Relaxed), 1);
    assert_eq!(recorder.seen.len(), 2 * (2 * ROWS as usize + 1) - 2, "two rows were there");
}
