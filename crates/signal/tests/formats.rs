//! Files of other programs are read correctly, and unreadable ones are refused with a reason.
//!
//! All files hold the same series; `fixtures/make_fixtures.py` says which, and made them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use hammerbeam_signal::{MeasuredQuantity, Record, RecordFinding, RecordFormat, RecordOptions, read::read};

pub const SAMPLES: usize = 64;
pub const RATE: f64 = 1024.0;

/// Accelerations [m/s²].
pub fn a(k: usize) -> f64 {
    ((37 * k) % 101) as f64 / 8.0 - 6.25
}

/// Displacements [m]; millimetres in the files.
fn b(k: usize) -> f64 {
    (k as f64 / 4.0 - 3.0) * 1e-3
}

pub fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

#[track_caller]
fn open(name: &str, format: RecordFormat) -> Record {
    let (record, found) = read(&path(name), &RecordOptions::default()).unwrap();
    assert_eq!(found, format, "{name}");
    assert_eq!(record.len(), SAMPLES, "{name}");
    // Times printed with six digits say the rate to 1e-6.
    assert!((record.sampling_rate_hz / RATE - 1.0).abs() < 2e-6, "{name}: {} Hz", record.sampling_rate_hz);
    record
}

#[track_caller]
fn assert_channel(
    record: &Record,
    index: usize,
    (name, quantity): (&str, MeasuredQuantity),
    value: fn(usize) -> f64,
    tolerance: f64,
) {
    let channel = &record.channels[index];
    assert_eq!((channel.name.as_str(), channel.quantity), (name, quantity));
    for (k, found) in channel.samples.iter().enumerate() {
        assert!((found - value(k)).abs() <= tolerance, "{name}, sample {k}: {found}, not {}", value(k));
    }
}

/// Both channels, exact except for the factor of the unit.
#[track_caller]
fn assert_both(name: &str, format: RecordFormat, first: &str, second: &str) -> Vec<RecordFinding> {
    let record = open(name, format);
    assert_channel(&record, 0, (first, MeasuredQuantity::Acceleration), a, 0.0);
    assert_channel(&record, 1, (second, MeasuredQuantity::Displacement), b, 1e-17);
    record.findings
}

#[test]
fn csv_of_spreadsheets_and_loggers() {
    assert_eq!(assert_both("excel.csv", RecordFormat::Csv, "acc, tip", "b"), []);
    assert_eq!(assert_both("german.csv", RecordFormat::Csv, "a", "b"), [RecordFinding::Latin1]);
    assert_eq!(assert_both("unicode.txt", RecordFormat::Csv, "a", "b"), []);
    assert_eq!(assert_both("unix.csv", RecordFormat::Csv, "a", "b"), []);
    assert_eq!(assert_both("savetxt.txt", RecordFormat::Csv, "a", "b"), []);
}

#[test]
fn universal_files_of_pyuff() {
    let findings = assert_both("double.uff", RecordFormat::Universal, "a", "b");
    let reason = "its abscissa is frequency, not time".to_owned();
    assert_eq!(findings, [RecordFinding::LeftOut { name: "H".to_owned(), reason }]);
    for name in ["single.uff", "uneven.uff", "binary.uff", "binary_uneven.uff"] {
        assert_eq!(assert_both(name, RecordFormat::Universal, "a", "b"), [], "{name}");
    }
    let record = open("uneven_single.uff", RecordFormat::Universal);
    assert_channel(&record, 0, ("a", MeasuredQuantity::Acceleration), a, 0.0);
}

#[test]
fn complex_functions_of_universal_files_are_two_channels() {
    for name in ["complex.uff", "complex_uneven.uff"] {
        let record = open(name, RecordFormat::Universal);
        assert_channel(&record, 0, ("z (real)", MeasuredQuantity::Acceleration), a, 0.0);
        assert_channel(&record, 1, ("z (imaginary)", MeasuredQuantity::Acceleration), |k| 1e3 * b(k), 1e-14);
    }
}

#[test]
fn function_without_name_is_called_by_its_point_and_its_unit_assumed() {
    let record = open("unnamed.uff", RecordFormat::Universal);
    assert_channel(&record, 0, ("tip:4+Z", MeasuredQuantity::Acceleration), a, 0.0);
    assert!(matches!(&record.findings[..], [RecordFinding::UnitAssumed { unit, .. }] if unit == "m/s^2"));
}

#[test]
fn wav_of_every_width() {
    let ramp = |k: usize| k as f64 / 32.0 - 1.0;
    let whole = [("int16.wav", 0.5), ("int24.wav", 0.5), ("int32.wav", 0.5)];
    for (name, scale) in whole.into_iter().chain([("float32.wav", 1.0), ("float64.wav", 1.0)]) {
        let record = open(name, RecordFormat::Wav);
        for k in 0..SAMPLES {
            assert_eq!(record.channels[0].samples[k], scale * ramp(k), "{name}");
            assert_eq!(record.channels[1].samples[k], -scale * ramp(k), "{name}");
        }
        assert_eq!(
            (record.channels[1].name.as_str(), record.channels[1].quantity),
            ("channel 2", MeasuredQuantity::Other)
        );
    }
}

#[test]
fn numpy_arrays_and_archives() {
    let given = RecordOptions { sampling_rate_hz: Some(RATE), ..RecordOptions::default() };
    let vector = read(&path("vector.npy"), &given).unwrap().0;
    assert_channel(&vector, 0, ("x", MeasuredQuantity::Other), a, 0.0);
    let rows = read(&path("rows.npy"), &given).unwrap().0;
    assert_channel(&rows, 0, ("x[1]", MeasuredQuantity::Other), a, 0.0);
    assert_channel(&rows, 1, ("x[2]", MeasuredQuantity::Other), |k| 1e3 * b(k), 1e-14);
    let columns = open("columns.npy", RecordFormat::Npy);
    assert_eq!(columns.findings, [RecordFinding::TimeAssumed]);
    assert_channel(&columns, 0, ("x[2]", MeasuredQuantity::Other), a, 0.0);
    let table = open("table.npy", RecordFormat::Npy);
    assert_channel(&table, 0, ("a", MeasuredQuantity::Acceleration), a, 0.0);
    assert_channel(&table, 1, ("b", MeasuredQuantity::Displacement), |k| 1e-3 * k as f64, 1e-17);
    let findings = assert_both("stored.npz", RecordFormat::Npz, "a", "b");
    assert!(matches!(&findings[..], [RecordFinding::LeftOut { name, .. }] if name == "note"), "{findings:?}");
    let compressed = open("compressed.npz", RecordFormat::Npz);
    assert_channel(&compressed, 0, ("a (real)", MeasuredQuantity::Other), a, 0.0);
    assert_channel(&compressed, 1, ("a (imaginary)", MeasuredQuantity::Other), |k| 1e3 * b(k), 1e-14);
}

#[test]
fn matlab_variables_and_structures() {
    let plain = open("plain.mat", RecordFormat::Matlab);
    assert_channel(&plain, 0, ("a", MeasuredQuantity::Acceleration), a, 0.0);
    assert_channel(&plain, 1, ("b", MeasuredQuantity::Other), |k| 1e3 * b(k), 1e-14);
    let compressed = open("compressed.mat", RecordFormat::Matlab);
    assert_channel(&compressed, 0, ("a", MeasuredQuantity::Other), a, 0.0);
    assert_channel(&compressed, 1, ("both[1]", MeasuredQuantity::Other), a, 0.0);
    assert_channel(&compressed, 2, ("both[2]", MeasuredQuantity::Other), |k| 1e3 * b(k), 1e-14);
    let structure = open("structure.mat", RecordFormat::Matlab);
    assert_channel(&structure, 0, ("data.acc", MeasuredQuantity::Other), a, 0.0);
    let left_out = |name: &str| {
        structure.findings.iter().any(|f| matches!(f, RecordFinding::LeftOut { name: n, .. } if n == name))
    };
    assert!(left_out("data.comment") && left_out("cells"), "{:?}", structure.findings);
}
