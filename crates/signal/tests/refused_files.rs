//! Files that cannot be read are refused with a reason, and contradictions within a file are reported.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use hammerbeam_signal::{
    ReadError, RecordFinding, RecordOptions, SignalError,
    read::{parse, read},
};

use crate::formats::{RATE, SAMPLES, a, path};

#[track_caller]
fn refusal(bytes: &[u8]) -> ReadError {
    parse(bytes).unwrap_err()
}

fn fixture(name: &str) -> Vec<u8> {
    std::fs::read(path(name)).unwrap()
}

#[test]
fn unsupported_files_are_refused_with_an_alternative() {
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

/// Bytes are changed one by one: a reader may refuse the file, but never panics.
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
                    let _ = raw.validate(&RecordOptions::default());
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

/// Times at 1024 Hz with a named rate of 512 Hz: the times are used, with a finding.
#[test]
fn rate_that_contradicts_the_times_is_reported() {
    let times: Vec<f64> = (0..SAMPLES).map(|k| k as f64 / RATE).collect();
    let samples: Vec<f64> = (0..SAMPLES).map(a).collect();
    let arrays = [("fs.npy", npy(&[512.0])), ("t.npy", npy(&times)), ("a.npy", npy(&samples))];
    let record = parse(&archive(&arrays.map(|(name, data)| (name.to_owned(), data)))).unwrap();
    let record = record.validate(&RecordOptions::default()).unwrap();
    let disagrees = |finding: &RecordFinding| match finding {
        RecordFinding::NamedRateDisagrees { named_hz, found_hz } => {
            *named_hz == 512.0 && (found_hz - 1024.0).abs() < 1e-6
        }
        _ => false,
    };
    assert!(record.findings.iter().any(disagrees), "{:?}", record.findings);
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
    let missing = read(Path::new("nowhere.csv"), &RecordOptions::default()).unwrap_err();
    assert!(matches!(missing, SignalError::File { .. }) && missing.to_string().contains("nowhere.csv"));
}

/// A MATLAB element with its padding.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = [kind.to_le_bytes(), (data.len() as u32).to_le_bytes()].concat();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// A MATLAB file with a structure of one field.
fn structure(name: &[u8], field: &[u8], content: &[u8]) -> Vec<u8> {
    let words = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
    let length = words(&[field.len() as u32 + 1]);
    let names = [field, &[0]].concat();
    let parts =
        [element(6, &words(&[2, 0])), element(5, &words(&[1, 1])), element(1, name), element(5, &length)];
    element(14, &[parts.concat(), element(1, &names), content.to_vec()].concat())
}

fn matlab(content: &[u8]) -> Vec<u8> {
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\0\x01IM");
    bytes.extend(content);
    bytes
}

#[test]
fn deep_structures_and_long_names_are_refused() {
    let mut nested = Vec::new();
    for _ in 0..200 {
        nested = structure(b"", b"a", &nested);
    }
    assert_eq!(refusal(&matlab(&nested)), ReadError::TooDeep);
    let long = structure(&[b'n'; 1001], b"a", &element(14, &[]));
    assert_eq!(refusal(&matlab(&long)), ReadError::LongName { found: 1001 });
}

#[test]
fn more_numbers_or_columns_than_are_worked_with_are_refused() {
    let wide = format!("{0}1\n{0}2\n", "1,".repeat(10_000));
    assert_eq!(refusal(wide.as_bytes()), ReadError::TooManyColumns { found: 10_001 });
    let mut array = b"\x93NUMPY\x01\0\x46\0".to_vec();
    array.extend(
        format!("{:<70}", "{'descr': '|u1', 'fortran_order': False, 'shape': (33554433,), }").bytes(),
    );
    array.resize(array.len() + 33_554_433, 0);
    assert_eq!(refusal(&array), ReadError::TooManyNumbers);
}

/// Times whose differences are no numbers, and steps whose rate is none.
#[test]
fn times_that_cannot_be_counted_with_are_refused() {
    for (times, part) in [
        (["-1e308", "0", "1e308"], "a time is -1e308 s"),
        (["0", "5e-324", "1e-323"], "the step between samples is 5e-324 s"),
    ] {
        let rows: String = times.iter().map(|time| format!("{time},1.0\n")).collect();
        let raw = parse(format!("time [s],a [m]\n{rows}").as_bytes()).unwrap();
        let message = raw.validate(&RecordOptions::default()).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
}

/// Functions of a universal file are columns as those of a table are.
#[test]
fn a_universal_file_of_very_many_functions_is_refused() {
    let text = String::from_utf8(fixture("double.uff")).unwrap();
    let many = text.repeat(10_001 / text.matches("    58\n").count().max(1) + 1);
    assert!(matches!(refusal(many.as_bytes()), ReadError::TooManyColumns { .. }));
}
