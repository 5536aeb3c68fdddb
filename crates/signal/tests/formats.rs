//! Files as other programs write them are read right, and what cannot be read is refused with a reason.
//!
//! All files hold the same series; `fixtures/make_fixtures.py` says which, and made them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use hammerbeam_signal::{
    Finding, Format, Quantity, ReadError, Record, SignalError, Terms,
    read::{parse, read},
};

const SAMPLES: usize = 64;
const RATE: f64 = 1024.0;

/// Accelerations [m/s²].
fn a(k: usize) -> f64 {
    ((37 * k) % 101) as f64 / 8.0 - 6.25
}

/// Displacements [m]; millimetres in the files.
fn b(k: usize) -> f64 {
    (k as f64 / 4.0 - 3.0) * 1e-3
}

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures").join(name)
}

#[track_caller]
fn open(name: &str, format: Format) -> Record {
    let (record, found) = read(&path(name), &Terms::default()).unwrap();
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
    (name, quantity): (&str, Quantity),
    value: fn(usize) -> f64,
    tolerance: f64,
) {
    let channel = &record.channels[index];
    assert_eq!((channel.name.as_str(), channel.quantity), (name, quantity));
    for (k, found) in channel.samples.iter().enumerate() {
        assert!((found - value(k)).abs() <= tolerance, "{name}, sample {k}: {found}, not {}", value(k));
    }
}

/// Both channels, exact but for the factor of the unit.
#[track_caller]
fn assert_both(name: &str, format: Format, first: &str, second: &str) -> Vec<Finding> {
    let record = open(name, format);
    assert_channel(&record, 0, (first, Quantity::Acceleration), a, 0.0);
    assert_channel(&record, 1, (second, Quantity::Displacement), b, 1e-17);
    record.findings
}

#[test]
fn csv_of_spreadsheets_and_loggers() {
    assert_eq!(assert_both("excel.csv", Format::Csv, "acc, tip", "b"), []);
    assert_eq!(assert_both("german.csv", Format::Csv, "a", "b"), [Finding::Latin1]);
    assert_eq!(assert_both("unicode.txt", Format::Csv, "a", "b"), []);
    assert_eq!(assert_both("unix.csv", Format::Csv, "a", "b"), []);
    assert_eq!(assert_both("savetxt.txt", Format::Csv, "a", "b"), []);
}

#[test]
fn universal_files_of_pyuff() {
    let findings = assert_both("double.uff", Format::Universal, "a", "b");
    let reason = "its abscissa is frequency, not time".to_owned();
    assert_eq!(findings, [Finding::LeftOut { name: "H".to_owned(), reason }]);
    for name in ["single.uff", "uneven.uff", "binary.uff", "binary_uneven.uff"] {
        assert_eq!(assert_both(name, Format::Universal, "a", "b"), [], "{name}");
    }
    let record = open("uneven_single.uff", Format::Universal);
    assert_channel(&record, 0, ("a", Quantity::Acceleration), a, 0.0);
}

#[test]
fn complex_functions_of_universal_files_are_two_channels() {
    for name in ["complex.uff", "complex_uneven.uff"] {
        let record = open(name, Format::Universal);
        assert_channel(&record, 0, ("z (real)", Quantity::Acceleration), a, 0.0);
        assert_channel(&record, 1, ("z (imaginary)", Quantity::Acceleration), |k| 1e3 * b(k), 1e-14);
    }
}

#[test]
fn function_without_name_is_called_by_its_point_and_its_unit_assumed() {
    let record = open("unnamed.uff", Format::Universal);
    assert_channel(&record, 0, ("tip:4+Z", Quantity::Acceleration), a, 0.0);
    assert!(matches!(&record.findings[..], [Finding::UnitAssumed { unit, .. }] if unit == "m/s^2"));
}

#[test]
fn wav_of_every_width() {
    let ramp = |k: usize| k as f64 / 32.0 - 1.0;
    let whole = [("int16.wav", 0.5), ("int24.wav", 0.5), ("int32.wav", 0.5)];
    for (name, scale) in whole.into_iter().chain([("float32.wav", 1.0), ("float64.wav", 1.0)]) {
        let record = open(name, Format::Wav);
        for k in 0..SAMPLES {
            assert_eq!(record.channels[0].samples[k], scale * ramp(k), "{name}");
            assert_eq!(record.channels[1].samples[k], -scale * ramp(k), "{name}");
        }
        assert_eq!(
            (record.channels[1].name.as_str(), record.channels[1].quantity),
            ("channel 2", Quantity::Other)
        );
    }
}

#[test]
fn numpy_arrays_and_archives() {
    let given = Terms { sampling_rate_hz: Some(RATE), ..Terms::default() };
    let vector = read(&path("vector.npy"), &given).unwrap().0;
    assert_channel(&vector, 0, ("x", Quantity::Other), a, 0.0);
    let rows = read(&path("rows.npy"), &given).unwrap().0;
    assert_channel(&rows, 0, ("x[1]", Quantity::Other), a, 0.0);
    assert_channel(&rows, 1, ("x[2]", Quantity::Other), |k| 1e3 * b(k), 1e-14);
    let columns = open("columns.npy", Format::Npy);
    assert_eq!(columns.findings, [Finding::TimeAssumed]);
    assert_channel(&columns, 0, ("x[2]", Quantity::Other), a, 0.0);
    let table = open("table.npy", Format::Npy);
    assert_channel(&table, 0, ("a", Quantity::Acceleration), a, 0.0);
    assert_channel(&table, 1, ("b", Quantity::Displacement), |k| 1e-3 * k as f64, 1e-17);
    let findings = assert_both("stored.npz", Format::Npz, "a", "b");
    assert!(matches!(&findings[..], [Finding::LeftOut { name, .. }] if name == "note"), "{findings:?}");
    let compressed = open("compressed.npz", Format::Npz);
    assert_channel(&compressed, 0, ("a (real)", Quantity::Other), a, 0.0);
    assert_channel(&compressed, 1, ("a (imaginary)", Quantity::Other), |k| 1e3 * b(k), 1e-14);
}

#[test]
fn matlab_variables_and_structures() {
    let plain = open("plain.mat", Format::Matlab);
    assert_channel(&plain, 0, ("a", Quantity::Acceleration), a, 0.0);
    assert_channel(&plain, 1, ("b", Quantity::Other), |k| 1e3 * b(k), 1e-14);
    let compressed = open("compressed.mat", Format::Matlab);
    assert_channel(&compressed, 0, ("a", Quantity::Other), a, 0.0);
    assert_channel(&compressed, 1, ("both[1]", Quantity::Other), a, 0.0);
    assert_channel(&compressed, 2, ("both[2]", Quantity::Other), |k| 1e3 * b(k), 1e-14);
    let structure = open("structure.mat", Format::Matlab);
    assert_channel(&structure, 0, ("data.acc", Quantity::Other), a, 0.0);
    let left_out = |name: &str| {
        structure.findings.iter().any(|f| matches!(f, Finding::LeftOut { name: n, .. } if n == name))
    };
    assert!(left_out("data.comment") && left_out("cells"), "{:?}", structure.findings);
}

#[track_caller]
fn refusal(bytes: &[u8]) -> ReadError {
    parse(bytes).unwrap_err()
}

fn fixture(name: &str) -> Vec<u8> {
    std::fs::read(path(name)).unwrap()
}

#[test]
fn what_is_not_read_is_refused_with_what_to_do_instead() {
    for (name, parts) in [
        ("version73.mat", ["MATLAB 7.3 (HDF5)", "-v7"]),
        ("level4.mat", ["MATLAB level 4", "-v7"]),
        ("text.npy", ["array of type U", "astype(float)"]),
    ] {
        let message = refusal(&fixture(name)).to_string();
        assert!(parts.iter().all(|part| message.contains(part)), "{name}: {message}");
    }
}

#[test]
fn files_that_end_early_are_refused() {
    for name in [
        "double.uff",
        "binary.uff",
        "vector.npy",
        "stored.npz",
        "compressed.npz",
        "plain.mat",
        "compressed.mat",
        "int16.wav",
        "float64.wav",
    ] {
        let bytes = fixture(name);
        let error = refusal(&bytes[..bytes.len() * 2 / 3]);
        assert!(
            matches!(error, ReadError::Truncated { .. } | ReadError::Malformed { .. }),
            "{name}: {error}"
        );
    }
}

#[test]
fn damaged_archive_is_refused() {
    let mut bytes = fixture("stored.npz");
    // In the middle of the first array.
    bytes[400] ^= 1;
    let message = refusal(&bytes).to_string();
    assert!(message.contains("checksum"), "{message}");
}

#[test]
fn universal_file_whose_values_contradict_its_header_is_refused() {
    let text = String::from_utf8(fixture("double.uff")).unwrap();
    let more = text.replacen("        64         1", "        63         1", 1);
    assert!(matches!(refusal(more.as_bytes()), ReadError::Malformed { .. }), "more values than points");
    let fewer = text.replacen("        64         1", "        70         1", 1);
    assert!(matches!(refusal(fewer.as_bytes()), ReadError::Truncated { .. }), "fewer values than points");
    let other = text.replacen("         4        64", "         3        64", 1);
    assert!(matches!(refusal(other.as_bytes()), ReadError::Malformed { .. }), "an unknown type of values");
    let binary =
        String::from_utf8_lossy(&fixture("binary.uff")).replacen("58b     1     2", "58b     1     1", 1);
    assert!(
        matches!(refusal(binary.as_bytes()), ReadError::Unsupported { .. }),
        "another floating-point format"
    );
}

/// Bytes changed one after the other: no file makes the readers fall over, whatever they say to it.
#[test]
fn no_damage_makes_a_reader_panic() {
    for name in [
        "excel.csv",
        "single.uff",
        "binary_uneven.uff",
        "int24.wav",
        "float64.wav",
        "level4.mat",
        "table.npy",
        "compressed.npz",
        "structure.mat",
        "compressed.mat",
    ] {
        let bytes = fixture(name);
        for at in (0..bytes.len().min(800)).chain((800..bytes.len()).step_by(37)) {
            for change in [0xff, 0x80, 0x01] {
                let mut damaged = bytes.clone();
                damaged[at] ^= change;
                if let Ok(raw) = parse(&damaged) {
                    let _ = raw.judge(&Terms::default());
                }
            }
        }
    }
}

#[test]
fn two_sampling_rates_in_one_file_are_refused() {
    // The rate of the archive, under another name, twice: 1024 Hz and 512 Hz.
    let header = |name: &str, value: f64| {
        let mut data =
            b"\x93NUMPY\x01\x00\x46\x00{'descr': '<f8', 'fortran_order': False, 'shape': (), }".to_vec();
        data.resize(10 + 0x46, b' ');
        data.extend(value.to_le_bytes());
        (name.to_owned(), data)
    };
    let bytes = archive(&[header("fs.npy", 1024.0), header("rate.npy", 512.0)]);
    assert_eq!(refusal(&bytes), ReadError::TwoRates { first: 1024.0, second: 512.0 });
}

/// Times at 1024 Hz beside a rate of 512 Hz: the times are taken, and that is told.
#[test]
fn rate_beside_other_times_is_told() {
    let times: Vec<f64> = (0..SAMPLES).map(|k| k as f64 / RATE).collect();
    let samples: Vec<f64> = (0..SAMPLES).map(a).collect();
    let arrays = [("fs.npy", npy(&[512.0])), ("t.npy", npy(&times)), ("a.npy", npy(&samples))];
    let record = parse(&archive(&arrays.map(|(name, data)| (name.to_owned(), data)))).unwrap();
    let record = record.judge(&Terms::default()).unwrap();
    let told = |finding: &Finding| match finding {
        Finding::NamedRateDisagrees { named_hz, found_hz } => {
            *named_hz == 512.0 && (found_hz - 1024.0).abs() < 1e-6
        }
        _ => false,
    };
    assert!(record.findings.iter().any(told), "{:?}", record.findings);
    assert!((record.sampling_rate_hz - 1024.0).abs() < 1e-6);
}

/// A vector of double precision.
fn npy(values: &[f64]) -> Vec<u8> {
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({},), }}", values.len());
    let mut data = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    data.extend(header.bytes());
    data.resize(128, b' ');
    data.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    data
}

/// A stored archive. Checksums by their definition, bit by bit.
fn archive(files: &[(String, Vec<u8>)]) -> Vec<u8> {
    let crc = |data: &[u8]| {
        !data.iter().fold(!0_u32, |crc, byte| {
            (0..8).fold(
                crc ^ u32::from(*byte),
                |crc, _| if crc & 1 == 1 { crc >> 1 ^ 0xedb8_8320 } else { crc >> 1 },
            )
        })
    };
    let (mut local, mut central) = (Vec::new(), Vec::new());
    for (name, data) in files {
        let offset = local.len() as u32;
        let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        common.extend(crc(data).to_le_bytes());
        common.extend((data.len() as u32).to_le_bytes());
        common.extend((data.len() as u32).to_le_bytes());
        common.extend((name.len() as u16).to_le_bytes());
        common.extend([0, 0]);
        local.extend(b"PK\x03\x04");
        local.extend(&common);
        local.extend(name.as_bytes());
        local.extend(data);
        central.extend(b"PK\x01\x02\x14\x00");
        central.extend(&common);
        central.extend([0; 10]);
        central.extend(offset.to_le_bytes());
        central.extend(name.as_bytes());
    }
    let start = local.len() as u32;
    let mut all = local;
    all.extend(&central);
    all.extend(b"PK\x05\x06\x00\x00\x00\x00");
    all.extend([(files.len() as u16).to_le_bytes(), (files.len() as u16).to_le_bytes()].concat());
    all.extend((central.len() as u32).to_le_bytes());
    all.extend(start.to_le_bytes());
    all.extend([0, 0]);
    all
}

#[test]
fn empty_and_unknown_files_are_refused() {
    assert_eq!(refusal(b" \n"), ReadError::Empty);
    assert_eq!(refusal(&[0, 1, 2, 3, 0, 200]), ReadError::UnknownFormat);
    assert!(refusal(b"    -1\n    15\n         1\n    -1\n").to_string().contains("0 functions"));
    let missing = read(Path::new("nowhere.csv"), &Terms::default()).unwrap_err();
    assert!(matches!(missing, SignalError::File { .. }) && missing.to_string().contains("nowhere.csv"));
}
