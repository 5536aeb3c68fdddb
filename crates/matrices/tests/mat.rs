//! MAT files of version 5: those of SciPy, and of our own writer in both orders of bytes; what is damaged.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use hammerbeam_matrices::{FileMatrix, parse_matrices};

/// `K` sparse and `M` full with a text between them, by `savemat` of SciPy, plain and compressed: see
/// `tests/data/mat.py`.
const PLAIN: &[u8] = include_bytes!("data/plain.mat");
const COMPRESSED: &[u8] = include_bytes!("data/compressed.mat");

fn stiffness() -> Vec<Vec<f64>> {
    vec![vec![4.0, -1.5, 0.0], vec![-1.5, 6.0, 0.25], vec![0.0, 0.25, 7.0]]
}

fn mass() -> Vec<Vec<f64>> {
    vec![vec![2.0, 0.0, 0.0], vec![0.0, 3.0, 0.0], vec![0.0, 0.0, 1e-3]]
}

fn dense(matrix: &FileMatrix) -> Vec<Vec<f64>> {
    let mut rows = vec![vec![0.0; matrix.columns]; matrix.rows];
    for entry in &matrix.entries {
        rows[entry.row as usize][entry.column as usize] = entry.value;
    }
    rows
}

#[test]
fn files_of_scipy_are_read_plain_and_compressed() {
    for bytes in [PLAIN, COMPRESSED] {
        let matrices = parse_matrices(bytes, None).unwrap();
        let names: Vec<&str> = matrices.iter().map(|matrix| matrix.name.as_str()).collect();
        assert_eq!(names, ["K", "M"]);
        assert_eq!(dense(&matrices[0]), stiffness());
        assert_eq!(dense(&matrices[1]), mass());
        assert_eq!(matrices[0].entries.len(), 7);
    }
}

/// An element with its tag and padding.
fn element(kind: u32, content: &[u8], big_endian: bool) -> Vec<u8> {
    let word = |word: u32| if big_endian { word.to_be_bytes() } else { word.to_le_bytes() };
    let mut bytes = [word(kind), word(content.len() as u32)].concat();
    bytes.extend(content);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}

/// A sparse matrix `K` whose values stand as whole numbers, as MATLAB saves what fits.
fn written(big_endian: bool, flags: u32) -> Vec<u8> {
    let words = |words: &[u32]| -> Vec<u8> {
        words.iter().flat_map(|w| if big_endian { w.to_be_bytes() } else { w.to_le_bytes() }).collect()
    };
    let mut header = b"MATLAB 5.0 MAT-file".to_vec();
    header.resize(124, b' ');
    header.extend(if big_endian { [1, 0] } else { [0, 1] });
    header.extend(if big_endian { b"MI" } else { b"IM" });
    let parts = [
        element(6, &words(&[flags, 4]), big_endian),
        element(5, &words(&[2, 2]), big_endian),
        element(1, b"K", big_endian),
        element(5, &words(&[0, 1, 0, 1]), big_endian),
        element(5, &words(&[0, 2, 4]), big_endian),
        element(1, &[5, 0xff, 0xff, 9], big_endian),
    ]
    .concat();
    [header, element(14, &parts, big_endian)].concat()
}

#[test]
fn both_orders_of_bytes_and_small_numbers_are_read() {
    for big_endian in [false, true] {
        let matrices = parse_matrices(&written(big_endian, 5), None).unwrap();
        assert_eq!(dense(&matrices[0]), [[5.0, -1.0], [-1.0, 9.0]]);
    }
}

#[test]
fn what_is_not_read_says_why() {
    let message = |bytes: &[u8]| parse_matrices(bytes, None).unwrap_err().to_string();
    assert!(message(&written(false, 5 | 0x0800)).contains("the complex matrix K is not read"));
    let mut hdf5 = written(false, 5);
    hdf5[..10].copy_from_slice(b"MATLAB 7.3");
    assert!(message(&hdf5).contains("save it with -v7 or -v6"));
    let mut row = written(false, 5);
    let place = row.len() - 16 - 24 - 4;
    row[place] = 9;
    assert!(message(&row).contains("byte 128"), "{}", message(&row));
}

/// Cut anywhere, or with any byte turned, a file is read or refused, and nothing else.
#[test]
fn damaged_files_end_in_an_answer() {
    for bytes in [PLAIN, COMPRESSED, &written(true, 5)] {
        for end in 0..bytes.len() {
            let _ = parse_matrices(&bytes[..end], None);
        }
        for place in 0..bytes.len() {
            for turned in [0x01, 0x80, 0xff] {
                let mut damaged = bytes.to_vec();
                damaged[place] ^= turned;
                let _ = parse_matrices(&damaged, None);
            }
        }
    }
}

#[test]
fn elements_without_a_type_are_refused() {
    let mut bytes = PLAIN[..128].to_vec();
    bytes.resize(4096, 0);
    let message = parse_matrices(&bytes, None).unwrap_err().to_string();
    assert!(message.contains("the type of an element is 0"), "{message}");
}
