//! Small texts in each format: what is read, and what is refused with its line.

use hammerbeam_matrices::{FileMatrix, MatrixFormat, parse_matrices};
use hammerbeam_structure::RowLabel;

#[track_caller]
fn one(text: &str) -> FileMatrix {
    let mut matrices = parse_matrices(text.as_bytes(), None).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(matrices.len(), 1);
    matrices.remove(0)
}

fn values(matrix: &FileMatrix) -> Vec<(u32, u32, f64)> {
    let mut values: Vec<_> =
        matrix.entries.iter().map(|entry| (entry.row, entry.column, entry.value)).collect();
    values.sort_by_key(|value| (value.0, value.1));
    values
}

#[track_caller]
fn refused(text: &str, parts: &[&str]) {
    let message = match parse_matrices(text.as_bytes(), None) {
        Ok(_) => panic!("this was read:\n{text}"),
        Err(error) => error.to_string(),
    };
    for part in parts {
        assert!(message.contains(part), "\"{part}\" is missing in: {message}");
    }
}

const HEAD: &str = "%%MatrixMarket matrix coordinate real symmetric\n% a remark\n";

#[test]
fn matrix_market_in_its_forms() {
    let symmetric = one(&format!("{HEAD}2 2 3\n1 1 2.5\n2 1 -1\n2 2 1e3\n"));
    assert_eq!(values(&symmetric), [(0, 0, 2.5), (1, 0, -1.0), (1, 1, 1e3)]);
    assert!(symmetric.one_triangle);
    let general = one("%%MatrixMarket matrix coordinate integer general\n2 3 2\n1 3 7\n2 1 -4\n");
    assert_eq!(values(&general), [(0, 2, 7.0), (1, 0, -4.0)]);
    let array = one("%%matrixmarket MATRIX array real symmetric\n2 2\n1\n2\n3\n");
    assert_eq!(values(&array), [(0, 0, 1.0), (1, 0, 2.0), (1, 1, 3.0)]);
}

#[test]
fn matrix_market_that_is_wrong_is_refused_with_its_line() {
    refused("%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1\n", &["line 1", "pattern"]);
    refused("%%MatrixMarket matrix coordinate complex general\n1 1 1\n1 1 1 0\n", &["complex"]);
    refused("%%MatrixMarket matrix coordinate real skew-symmetric\n1 1 0\n", &["skew-symmetric"]);
    refused(&format!("{HEAD}2 2 3\n1 1 2.5\n2 1 nan\n"), &["line 5", "NaN", "finite"]);
    refused(&format!("{HEAD}2 2 3\n1 1 2.5\n3 1 1\n"), &["line 5", "a row is 3", "1 to 2"]);
    refused(&format!("{HEAD}2 2 3\n1 1 2.5\n2 1 1\n"), &["line 6", "2 entries", "says 3"]);
    refused(&format!("{HEAD}2 2 3\n1 1 2.5\n2 1\n"), &["line 5", "number"]);
    refused(&format!("{HEAD}99999999999 2 3\n"), &["line 3", "allowed"]);
    refused("%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n", &["ends within"]);
}

#[test]
fn rows_columns_and_values() {
    let abaqus = one("1 1  1.5e+00\n1 2 -2.0\n2 1 -2.0\n2 2 4.0\n");
    assert_eq!((abaqus.rows, values(&abaqus)[1]), (2, (0, 1, -2.0)));
    let input = one("** MATRIX\n3,1, 1,1, -2.0\n1,1,1,1,1.5\n3,1,3,1,4.0\n");
    assert_eq!(values(&input), [(0, 0, 1.5), (1, 0, -2.0), (1, 1, 4.0)]);
    let labels: Vec<String> = input.labels.iter().map(RowLabel::to_string).collect();
    assert_eq!(labels, ["node 1 x", "node 3 x"]);
    refused("1 1 1.0\n1 2\n", &["line 2", "a row, a column and a value"]);
    refused("1 1 1.0\n0 2 1.0\n", &["line 2", "a row is 0"]);
    refused("1 1 1.0\n1 2 x\n", &["line 2", "\"x\""]);
    refused("1 1 1.0\n1,1,1,1,1.0\n", &["line 2", "as many numbers"]);
}

const SUBSTRUCTURE: &str = "**\n** GENERATION OF SUBSTRUCTURE\n*USER ELEMENT,NODES=         2,LINEAR\n\
    ** ELEMENT NODES\n**        20,        10,\n1, 2\n2, 3\n*MATRIX,TYPE=STIFFNESS\n 4.0,\n-1.0, 5.0,\n \
    0.5,\n 0.0, 6.0\n\
    *MATRIX, TYPE=MASS\n1.0\n0.0,1.0\n0.0,0.0,2.0\n";

#[test]
fn substructures_have_rows_by_node_and_direction() {
    let matrices = parse_matrices(SUBSTRUCTURE.as_bytes(), None).unwrap();
    assert_eq!(matrices.iter().map(|matrix| matrix.name.as_str()).collect::<Vec<_>>(), ["STIFFNESS", "MASS"]);
    let expected = [(0, 0, 4.0), (1, 0, -1.0), (1, 1, 5.0), (2, 0, 0.5), (2, 2, 6.0)];
    assert_eq!(values(&matrices[0]), expected);
    let labels: Vec<String> = matrices[1].labels.iter().map(RowLabel::to_string).collect();
    assert_eq!(labels, ["node 20 x", "node 20 y", "node 10 z"]);
    refused(&SUBSTRUCTURE.replace("0.0,0.0,2.0\n", "0.0,0.0\n"), &["ends within a row"]);
    refused(&SUBSTRUCTURE.replace("-1.0, 5.0", "-1.0, five"), &["line 10", "\"five\""]);
}

const DMIG: &str = "DMIG    KAAX           0       6       2       0                       2\n\
    DMIG*   KAAX                           7               1\n\
    *                      7               1 4.500000000D+00\n\
    *                      9               0-1.500000000D+00\n\
    DMIG*   KAAX                           9               0\n\
    *                      9               0 2.500000000D+00\n";

#[test]
fn dmig_in_large_small_and_free_fields() {
    let small = "DMIG    KAAX    0       6       2\n\
        DMIG    KAAX    7       1               7       1       4.5\n        9       0       -1.5\n\
        DMIG    KAAX    9                       9               2.5\n";
    let free = "DMIG,KAAX,0,6,2\nDMIG,KAAX,7,1,,7,1,4.5\n,9,0,-1.5\nDMIG,KAAX,9,0,,9,0,2.5\n";
    for text in [DMIG, small, free] {
        let matrix = one(text);
        assert_eq!(values(&matrix), [(0, 0, 4.5), (1, 0, -1.5), (1, 1, 2.5)], "{text}");
        let labels: Vec<String> = matrix.labels.iter().map(RowLabel::to_string).collect();
        assert_eq!(
            (matrix.name.as_str(), matrix.one_triangle, labels.join(", ")),
            ("KAAX", true, "node 7 x, mode 9".into())
        );
    }
    assert!((one(DMIG).precision / 5e-10 - 1.0).abs() < 1e-9);
    refused(&DMIG.replace("4.500000000D+00", "4.5000x0000D+00"), &["line 2", "4.5000x0000D+00"]);
    refused(&DMIG.replacen("6       2", "7       2", 1), &["line 1", "the form of a matrix is 7"]);
    refused(&DMIG[DMIG.find('\n').unwrap() + 1..], &["no matrix KAAX"]);
}

const HARWELL: &str = "A small matrix                                                          KEY     \n\
             3             1             1             1             0\n\
    RSA                        3             3             4             0\n\
    (4I5)           (4I5)           (1P,4E16.8)         \n\
    \x20   1    3    4    5\n\
    \x20   1    3    2    3\n\
    \x20 4.00000000E+00 -1.00000000E+00  5.00000000E+00  6.00000000D+00\n";

#[test]
fn harwell_boeing_in_fixed_columns() {
    let text = HARWELL;
    let matrix = one(text);
    assert_eq!(values(&matrix), [(0, 0, 4.0), (1, 1, 5.0), (2, 0, -1.0), (2, 2, 6.0)]);
    assert_eq!((matrix.name.as_str(), matrix.one_triangle), ("KEY", true));
    refused(&text.replace("RSA", "PSA"), &["line 3", "pattern"]);
    refused(&text.replace("RSA", "CSA"), &["complex"]);
    refused(&text.replace("    1    3    2    3", "    1    9    2    3"), &["line 6", "1 to 3"]);
    let cut = text.find("\n  4.0").unwrap();
    refused(&text[..cut], &["ends within"]);
}

const SCIPY: &str = "Default title                                                           0       \n\
    \x20            3             1             1             1\n\
    RUA                        2             2             4             0\n\
    (40I2)          (40I2)          (3E25.16)           \n 1 3 5\n 1 2 1 2\n\
    \x20 2.0000000000000000E+04 -1.0000000000000000E+04 -1.0000000000000000E+04\n\
    \x20 3.0000000000000000E+04\n";

/// SciPy writes lines whose columns are not those of the format in the head: blanks are between the numbers.
#[test]
fn harwell_boeing_as_scipy_writes_it() {
    let text = SCIPY;
    assert_eq!(values(&one(text)), [(0, 0, 2e4), (0, 1, -1e4), (1, 0, -1e4), (1, 1, 3e4)]);
    refused(&text.replace("3.0000000000000000E+04", "3.0 4.0"), &["an entry should be a number"]);
}

/// A format that the user names is the one that is read: a file of another one is no matrix of it.
#[test]
fn files_of_another_format_than_the_named_one_are_refused() {
    let market = format!("{HEAD}6 6 2\n1 1 2.5\n6 6 1.0\n");
    let texts = [
        (MatrixFormat::MatrixMarket, market.as_str()),
        (MatrixFormat::Triplets, "1 1 1.5\n1 2 -2.0\n2 2 4.0\n"),
        (MatrixFormat::UserElement, SUBSTRUCTURE),
        (MatrixFormat::Punch, DMIG),
        (MatrixFormat::HarwellBoeing, SCIPY),
    ];
    for (of, text) in texts {
        assert!(parse_matrices(text.as_bytes(), Some(of)).is_ok(), "{of:?}");
        for (other, _) in texts.iter().filter(|(other, _)| *other != of) {
            let read = parse_matrices(text.as_bytes(), Some(*other));
            assert!(read.is_err(), "{of:?} was read as {other:?}");
        }
        assert!(parse_matrices(text.as_bytes(), Some(MatrixFormat::Mat5)).is_err(), "{of:?}");
        assert!(parse_matrices(text.as_bytes(), Some(MatrixFormat::Output4)).is_err(), "{of:?}");
    }
    let error = parse_matrices(market.as_bytes(), Some(MatrixFormat::Triplets)).unwrap_err().to_string();
    assert!(error.contains("line 1") && error.contains("head of another format"), "{error}");
}

#[test]
fn what_is_of_no_format_says_which_there_are() {
    refused("hello world\n", &["the format is not known", "matrix-market", "nastran-op4"]);
    refused("", &["the format is not known"]);
    let wrong = parse_matrices(b"hello world\n", Some(MatrixFormat::Triplets)).unwrap_err();
    assert!(wrong.to_string().contains("line 1"), "{wrong}");
}

#[test]
fn a_matrix_with_far_more_rows_than_entries_is_refused() {
    let text = "%%MatrixMarket matrix coordinate real symmetric\n20000000 20000000 1\n1 1 1.0\n";
    let message = parse_matrices(text.as_bytes(), None).unwrap_err().to_string();
    assert!(message.contains("at most 64064 with 1 entries"), "{message}");
}

/// Each matrix of a punch file takes labels of all rows of the file.
#[test]
fn very_many_matrices_in_a_file_are_refused() {
    let headers: String = (0..1001).map(|k| format!("DMIG    M{k:<7}       0       6       1\n")).collect();
    refused(&headers, &["the number of matrices is 1001", "1000 in a file"]);
}
