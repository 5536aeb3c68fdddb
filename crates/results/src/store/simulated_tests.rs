//! Motions in time in the store, whole and damaged.

use hammerbeam_attractor::{ContactRecord, SimulationCheckpoint};
use hammerbeam_motion::exact::{Jump, Touchdown};
use tempfile::TempDir;

use super::{
    motion_tests::{new_store, reopened},
    *,
};

/// Of the chunks below: one sample in a period.
fn layout(transient_periods: u64) -> SimulationLayout {
    SimulationLayout {
        transient_periods,
        periods: 3,
        frequency_hz: 1.0 / 3.0,
        samples_per_period: 1,
        section_phase: 0.25,
        dof: 1,
        elements: ["a", "b", "c", "d", "e"].map(str::to_owned).to_vec(),
    }
}

fn read(store: &Store, request: i64, transient_periods: u64) -> Result<Vec<SimulatedChunk>, StoreError> {
    let mut found = Vec::new();
    let take = |chunk| {
        found.push(chunk);
        Ok(())
    };
    store.each_simulated::<StoreError>(request, &layout(transient_periods), take)?;
    Ok(found)
}

/// Periods with numbers that are not whole, with contacts open on both sides; the last ones are of a motion
/// that ends within an impact.
fn chunks() -> [SimulatedChunk; 3] {
    let touch = SimulatedTouch { time_s: 0.1, phase: 1.0 / 3.0, speed: 1e-310, response: [-0.0, 1.0 / 7.0] };
    let contact = |touch, end_s| SimulatedContact {
        element: 3,
        touch,
        end_s,
        impulse: 0.3,
        peak_force: 1e300,
        energy_lost: -0.1,
    };
    let open = |element, begin, jump| ContactRecord {
        element,
        contact: 1,
        begin,
        jump,
        end: None,
        impulse: 0.7,
        peak_force: 1.0 / 3.0,
        energy_lost: -1e-310,
    };
    let state = vec![0.1, -0.0];
    let begin = Touchdown { time: 0.3, velocity: -0.2, state: vec![1.0 / 7.0, 0.9] };
    let jump = Jump { impulse: 0.6, state: vec![0.4, f64::MIN_POSITIVE] };
    let transient = SimulatedChunk {
        periods: 5,
        checkpoint: SimulationCheckpoint { state: state.clone(), ..SimulationCheckpoint::default() },
        ..SimulatedChunk::default()
    };
    let first = SimulatedChunk {
        periods: 2,
        samples: [0.1, -0.0, 1e-310, 1.0 / 3.0].into_iter().cycle().take(26).collect(),
        section: [1.0 / 7.0, 2.0, -0.0, 0.1].repeat(2),
        contacts: vec![contact(None, Some(0.2)), contact(Some(touch.clone()), Some(0.3))],
        unfinished: vec![contact(None, None), contact(Some(touch), None)],
        checkpoint: SimulationCheckpoint {
            state,
            periods: 2,
            open: vec![
                open(0, None, None),
                open(1, Some(begin.clone()), None),
                open(4, Some(begin), Some(jump)),
            ],
            impact_speeds: vec![f64::INFINITY, 1.0 / 3.0, 0.1, 0.2, 1e-310],
        },
    };
    let mut last = SimulatedChunk { periods: 1, unfinished: vec![], ..first.clone() };
    last.samples.truncate(13);
    last.section.truncate(4);
    last.checkpoint.periods = 3;
    [transient, first, last]
}

#[test]
fn simulated_periods_come_back_bit_by_bit_and_apart_from_other_requests() {
    let (folder, mut store) = new_store();
    let request = store.request(RequestKind::Simulation, "periods = 3", 8).unwrap().id;
    let other = store.request(RequestKind::Simulation, "periods = 9", 9).unwrap().id;
    let [transient, first, last] = chunks();
    store.append_simulated(request, 0, &transient).unwrap();
    store.append_simulated(other, 0, &first).unwrap();
    store.append_simulated(request, 5, &first).unwrap();
    // Somebody else has gone on; nothing of it is stored.
    let again = store.append_simulated(request, 5, &last);
    assert!(matches!(again, Err(StoreError::OutOfOrder { found: 7, expected: 5, .. })), "{again:?}");
    store.append_simulated(request, 7, &last).unwrap();
    let store = reopened(&folder, store);
    let of = |request, transient_periods| read(&store, request, transient_periods).unwrap();
    // Texts differ for zeros of both signs.
    assert_eq!(format!("{:?}", of(request, 5)), format!("{:?}", [transient, first.clone(), last]));
    assert_eq!(of(other, 0), [first]);
    assert_eq!(store.requests().unwrap().iter().map(|request| request.done).collect::<Vec<_>>(), [8, 2]);
}

/// A store with the chunks, damaged by a statement.
fn damaged(statement: &str) -> (TempDir, Store) {
    let (folder, mut store) = new_store();
    let request = store.request(RequestKind::Simulation, "periods = 3", 8).unwrap().id;
    for (first, chunk) in [0, 5, 7].into_iter().zip(chunks()) {
        store.append_simulated(request, first, &chunk).unwrap();
    }
    assert!(read(&store, request, 5).is_ok());
    assert_eq!(store.connection.execute(statement, []).unwrap(), 1, "{statement}");
    (folder, store)
}

#[track_caller]
fn assert_damaged(statement: &str, message: &str) {
    let (_folder, store) = damaged(statement);
    let error = read(&store, 1, 5).unwrap_err();
    assert!(!error.is_bad_input() && error.to_string().contains(message), "{statement}: {error}");
}

#[test]
fn a_chunk_that_is_gone_is_told() {
    for (first, found) in [(0, 0), (5, 5), (7, 7)] {
        let message = format!("8 periods are done, in results.db {found} follow one another");
        assert_damaged(&format!("DELETE FROM simulated WHERE first = {first}"), &message);
    }
    assert_damaged("UPDATE request SET done = 7", "7 periods are done, in results.db 8 follow");
    assert_damaged("UPDATE simulated SET periods = 3 WHERE first = 7", "has 104 bytes, 312 are expected");
    assert_damaged("UPDATE simulated SET first = 6 WHERE first = 7", "in results.db 7 follow");
    assert_damaged("UPDATE simulated SET periods = -1 WHERE first = 7", "number of periods -1 is unknown");
}

/// Cut by a period, which is a whole number of rows.
#[test]
fn a_chunk_that_is_cut_is_told() {
    let cut = |what: &str, bytes: u32| {
        format!("UPDATE simulated SET {what} = substr({what}, 1, {bytes}) WHERE first = 5")
    };
    assert_damaged(&cut("samples", 104), "the stored samples of a motion has 104 bytes, 208 are expected");
    assert_damaged(&cut("section", 32), "the stored section of a motion has 32 bytes, 64 are expected");
    assert_damaged(&cut("samples", 100), "the stored samples of a motion has 100 bytes");
    assert_damaged(&cut("contacts", 100), "the stored contacts of a motion has 100 bytes");
    assert_damaged(&cut("state", 8), "bytes");
    assert_damaged(&cut("impact_speeds", 8), "the stored remembered impacts of a motion has 8 bytes, 40");
    assert_damaged("UPDATE simulated SET observed = 9 WHERE first = 5", "of a checkpoint 9 is unknown");
}

/// Elements that the motion does not have, and numbers that are none of any.
#[test]
fn contacts_of_no_element_are_told() {
    for place in ["contacts", "unfinished", "open"] {
        for number in [5.0_f64, -1.0, 0.5, 1e300, f64::NAN, f64::INFINITY] {
            let bytes: String = number.to_le_bytes().iter().map(|byte| format!("{byte:02x}")).collect();
            let set = format!("CAST(x'{bytes}' || substr({place}, 9) AS BLOB)");
            let statement = format!("UPDATE simulated SET {place} = {set} WHERE first = 5");
            assert_damaged(&statement, "is unknown");
        }
    }
}

/// What a request asks for is read with its limits.
#[test]
fn layouts_that_nobody_can_ask_for_are_refused() {
    let (_folder, mut store) = new_store();
    let words = layout(5).words().join("\n");
    let mut of =
        |words: &str| SimulationLayout::of(&store.request(RequestKind::Simulation, words, 8).unwrap());
    assert_eq!(of(&words).unwrap(), layout(5));
    for (key, value) in [
        ("samples_per_period = 1", "samples_per_period = 0"),
        ("samples_per_period = 1", "samples_per_period = 4000000000"),
        ("dof = 1", "dof = 0"),
        ("dof = 1", "dof = 18446744073709551615"),
        ("section_phase = 2.5e-1", "section_phase = NaN"),
        ("frequency_hz = ", "frequency_hz = -"),
        ("transient_periods = 5", "transient_periods = 18446744073709551615"),
        ("dof = 1\n", ""),
    ] {
        assert!(words.contains(key));
        let refused = of(&words.replacen(key, value, 1));
        assert!(matches!(refused, Err(StoreError::Unknown { .. })), "{value}: {refused:?}");
    }
}
