//! OUTPUT4 in all its encodings gives one matrix; what is cut or damaged is refused with its place.

use hammerbeam_matrices::{FileMatrix, parse_matrices};

use hammerbeam_testkit::output4::{Binary, Strings, text};

/// A symmetric matrix with gaps within its columns, and an empty column.
fn columns() -> Vec<Vec<f64>> {
    vec![
        vec![4.0, 0.0, -1.5, 0.25, 0.0],
        vec![0.0; 5],
        vec![-1.5, 0.0, 6.0, 0.0, 2.0],
        vec![0.25, 0.0, 0.0, 7.0, 0.125],
        vec![0.0, 0.0, 2.0, 0.125, 9.0],
    ]
}

fn dense(matrix: &FileMatrix) -> Vec<Vec<f64>> {
    let mut columns = vec![vec![0.0; matrix.rows]; matrix.columns];
    for entry in &matrix.entries {
        columns[entry.column as usize][entry.row as usize] = entry.value;
    }
    columns
}

fn binaries() -> Vec<Binary> {
    let mut all = Vec::new();
    for strings in [Strings::Dense, Strings::Sparse, Strings::Big] {
        for big_endian in [false, true] {
            all.extend([(true, 4), (false, 4), (true, 8)].map(|(double, word)| Binary {
                strings,
                big_endian,
                double,
                word,
            }));
        }
    }
    all
}

#[test]
fn every_encoding_gives_the_same_matrix() {
    for binary in binaries() {
        let bytes = binary.write("KXX", &columns());
        let matrices = parse_matrices(&[bytes.clone(), bytes].concat(), None).unwrap();
        assert_eq!(matrices.len(), 2);
        assert_eq!((matrices[1].name.as_str(), dense(&matrices[1])), ("KXX", columns()));
    }
    for strings in [Strings::Dense, Strings::Sparse, Strings::Big] {
        let text = text("KXX", &columns(), strings) + &text("MXX", &columns(), strings);
        let matrices = parse_matrices(text.as_bytes(), None).unwrap();
        assert_eq!(matrices.len(), 2);
        assert_eq!((matrices[1].name.as_str(), dense(&matrices[1])), ("MXX", columns()), "{strings:?}");
    }
}

#[test]
fn a_file_that_ends_anywhere_is_refused_with_its_place() {
    for binary in binaries() {
        let bytes = binary.write("KXX", &columns());
        for end in 1..bytes.len() {
            if let Err(error) = parse_matrices(&bytes[..end], None) {
                let message = error.to_string();
                assert!(message.contains("byte") || message.contains("not known"), "{end}: {message}");
            } else {
                panic!("{end} of {} bytes were read", bytes.len());
            }
        }
    }
    let text = text("KXX", &columns(), Strings::Big);
    let lines = text.lines().count();
    for end in 1..lines {
        let cut: Vec<&str> = text.lines().take(end).collect();
        let message = parse_matrices((cut.join("\n") + "\n").as_bytes(), None).unwrap_err().to_string();
        assert!(message.contains("line"), "{message}");
    }
}

#[test]
fn a_length_that_is_garbage_allocates_nothing() {
    let binary = Binary { strings: Strings::Big, big_endian: false, double: true, word: 4 };
    let mut bytes = binary.write("KXX", &columns());
    bytes[32..36].copy_from_slice(&0x3fff_ffff_u32.to_le_bytes());
    let message = parse_matrices(&bytes, None).unwrap_err().to_string();
    assert!(message.contains("byte 32") && message.contains("ends within"), "{message}");
}
