//! Requests and what is stored for them.

use hammerbeam_attractor::{
    Attractor, Class, Convergence, Estimate, MotionDoubt, Round, Spectrum, SweepPoint,
};
use hammerbeam_study::file::StudyFile;
use tempfile::{TempDir, tempdir};

use super::*;

fn study() -> StudyFile {
    let text = include_str!("../../../../studies/duffing.toml");
    StudyFile::parse("study.toml", text.to_owned()).unwrap()
}

pub(super) fn new_store() -> (TempDir, Store) {
    let folder = tempdir().unwrap();
    let store = Store::open_for_run(folder.path(), &study()).unwrap();
    (folder, store)
}

/// What comes out of a folder that was closed and opened again.
pub(super) fn reopened(folder: &TempDir, store: Store) -> Store {
    store.finish().unwrap();
    Store::open_for_run(folder.path(), &study()).unwrap()
}

const ESTIMATE: Estimate = Estimate { value: 1.0 / 3.0, half_width: 1e-300 };

/// One of every class, with numbers that are not whole.
fn kinds() -> Vec<(Class, Option<Estimate>, Option<f64>)> {
    let mut kinds = vec![
        (Class::Periodic { period: 2 }, None, None),
        (Class::QuasiPeriodic, Some(ESTIMATE), Some(-0.01)),
        (Class::Chaotic, Some(ESTIMATE), Some(0.99)),
    ];
    kinds.extend(MotionDoubt::ALL.map(|doubt| (Class::Doubtful(doubt), Some(ESTIMATE), None)));
    kinds
}

fn attractors() -> Vec<Attractor> {
    let states = vec![vec![0.1, -0.0], vec![f64::MIN_POSITIVE, 1.0 / 7.0]];
    let of = |(class, largest_exponent, zero_one)| Attractor {
        class,
        states: states.clone(),
        largest_exponent,
        zero_one,
    };
    kinds().into_iter().map(of).collect()
}

fn motions() -> Vec<SettledMotion> {
    let of = |(class, largest_exponent, zero_one)| SettledMotion {
        origin: SettledOrigin::Up,
        point: SweepPoint {
            frequency_hz: 0.1,
            class,
            largest_exponent,
            zero_one,
            samples: vec![1.0 / 3.0, -0.0],
            max_abs_displacement: 1.0 / 7.0,
            contacts_per_period: 0.5,
            state: vec![0.3, 1e-310],
        },
    };
    kinds().into_iter().map(of).collect()
}

fn spectrum(section: Vec<[f64; 2]>, known: Option<f64>) -> ExponentRecord {
    ExponentRecord {
        frequency_hz: 0.2,
        sections_per_period: 3,
        spectrum: Spectrum {
            exponents: vec![ESTIMATE, Estimate { value: -1.0, half_width: 0.25 }],
            sum: -2.0 / 3.0,
            kaplan_yorke_dimension: 4.0 / 3.0,
            block_correlation: -0.1,
            convergence: vec![
                Convergence { time: 1.0, exponents: vec![0.5, -1.5] },
                Convergence { time: 2.0, exponents: vec![0.4, -1.1] },
            ],
            time: 1.0 / 0.3,
            expected_sum: known,
        },
        divergence: -0.7,
        zero_one: known,
        section,
    }
}

#[test]
fn a_request_is_found_again_by_its_kind_and_words() {
    let (folder, mut store) = new_store();
    let sweep = store.request(RequestKind::Sweep, "from = 1\nto = 2", 11).unwrap();
    let other = store.request(RequestKind::Starts, "from = 1\nto = 2", 11).unwrap();
    assert_eq!(
        (sweep.id, other.id, sweep.done, sweep.word("to"), sweep.word("step")),
        (1, 2, 0, Some("2"), None)
    );
    let mut store = reopened(&folder, store);
    assert_eq!(store.request(RequestKind::Sweep, "from = 1\nto = 2", 11).unwrap(), sweep);
    assert_eq!(store.requests().unwrap(), [sweep, other]);
}

#[test]
fn settled_motions_come_back_bit_by_bit() {
    let (folder, mut store) = new_store();
    let request = store.request(RequestKind::Starts, "starts = 7", 3).unwrap().id;
    store.append_settled(request, 0, &motions()[..5]).unwrap();
    // At the second frequency nothing could be computed.
    store.append_settled(request, 1, &[]).unwrap();
    store.append_settled(request, 2, &motions()[5..]).unwrap();
    let store = reopened(&folder, store);
    assert_eq!(store.settled(request).unwrap(), motions());
    assert_eq!(store.requests().unwrap()[0].done, 3);
}

#[test]
fn spectra_come_back_bit_by_bit() {
    let (folder, mut store) = new_store();
    let request = store.request(RequestKind::Exponents, "periods = 40", 2).unwrap().id;
    let records = [spectrum(vec![[0.1, -0.0], [1e-310, 2.0]], Some(1.0 / 7.0)), spectrum(vec![], None)];
    store.append_exponents(request, 0, &records[0]).unwrap();
    store.append_exponents(request, 1, &records[1]).unwrap();
    assert_eq!(reopened(&folder, store).exponents(request).unwrap(), records);
}

#[test]
fn rounds_of_cells_come_back_bit_by_bit_and_apart_from_other_requests() {
    let (folder, mut store) = new_store();
    let all = attractors();
    let request = store.request(RequestKind::Basins, "grid = 2", 4).unwrap().id;
    let other = store.request(RequestKind::Basins, "grid = 3", 9).unwrap().id;
    store.append_round(request, &Round { first: 0, cells: vec![1], found: all[..1].to_vec() }, 0).unwrap();
    store.append_round(other, &Round { first: 0, cells: vec![0, 0], found: vec![] }, 0).unwrap();
    store
        .append_round(request, &Round { first: 1, cells: vec![0, 7, 2], found: all[1..].to_vec() }, 1)
        .unwrap();
    let store = reopened(&folder, store);
    assert_eq!(store.basins(request).unwrap(), (vec![1, 0, 7, 2], all));
    assert_eq!(store.basins(other).unwrap(), (vec![0, 0], vec![]));
    assert_eq!(store.requests().unwrap().iter().map(|request| request.done).collect::<Vec<_>>(), [4, 2]);
}

#[test]
fn a_piece_that_does_not_follow_leaves_nothing_of_itself() {
    let (_folder, mut store) = new_store();
    let basins = store.request(RequestKind::Basins, "grid = 3", 9).unwrap().id;
    store
        .append_round(basins, &Round { first: 0, cells: vec![1, 1], found: attractors()[..1].to_vec() }, 0)
        .unwrap();
    // Its second cell is there already.
    let again = store.append_round(basins, &Round { first: 1, cells: vec![2], found: vec![] }, 1);
    assert!(matches!(again, Err(StoreError::OutOfOrder { found: 2, expected: 1, .. })), "{again:?}");
    assert_eq!(store.basins(basins).unwrap().0, [1, 1]);
    let sweep = store.request(RequestKind::Sweep, "from = 1", 2).unwrap().id;
    assert!(store.append_settled(sweep, 1, &motions()).is_err());
    assert_eq!(store.settled(sweep).unwrap(), []);
}
