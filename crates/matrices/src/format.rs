//! The formats that are read, and by what they are known.

use crate::read::{mat5::is_mat, output4_binary};

/// A format of files with matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatrixFormat {
    /// Matrix Market.
    MatrixMarket,
    /// Rows, columns and values: CalculiX, and Abaqus' coordinate and matrix input formats.
    Triplets,
    /// Substructures of Abaqus and CalculiX.
    UserElement,
    /// Nastran `DMIG` cards.
    Punch,
    /// Nastran OUTPUT4, text or binary.
    Output4,
    /// Harwell-Boeing.
    HarwellBoeing,
    /// MAT files of version 5.
    Mat5,
}

impl MatrixFormat {
    /// Names in study files with their formats.
    pub const NAMED: [(&'static str, Self); 9] = [
        ("matrix-market", Self::MatrixMarket),
        ("calculix", Self::Triplets),
        ("abaqus", Self::Triplets),
        ("abaqus-substructure", Self::UserElement),
        ("nastran-punch", Self::Punch),
        ("nastran-op4", Self::Output4),
        ("harwell-boeing", Self::HarwellBoeing),
        ("calculix-substructure", Self::UserElement),
        ("mat", Self::Mat5),
    ];

    /// All names.
    #[must_use]
    pub fn names() -> Vec<&'static str> {
        Self::NAMED.iter().map(|(name, _)| *name).collect()
    }

    /// The format that a name stands for.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMED.iter().find(|(known, _)| *known == name).map(|(_, format)| *format)
    }

    /// The format of a file by its first bytes.
    #[must_use]
    pub fn of(first: &[u8]) -> Option<Self> {
        if output4_binary::encoding(first).is_some() {
            return Some(Self::Output4);
        }
        if is_mat(first) {
            return Some(Self::Mat5);
        }
        if first.len() >= 14 && first[..14].eq_ignore_ascii_case(b"%%MatrixMarket") {
            return Some(Self::MatrixMarket);
        }
        let text = String::from_utf8_lossy(first).to_ascii_uppercase();
        let lines: Vec<&str> = text.lines().collect();
        if lines.iter().any(|line| line.starts_with("DMIG")) {
            return Some(Self::Punch);
        }
        if lines.iter().any(|line| line.replace(' ', "").starts_with("*USERELEMENT")) {
            return Some(Self::UserElement);
        }
        let first_line =
            lines.iter().find(|line| !line.trim().is_empty() && !line.starts_with(['*', '$', '#']))?;
        if is_output4_header(first_line) {
            return Some(Self::Output4);
        }
        if lines.get(2).is_some_and(|line| is_harwell_boeing_type(line)) {
            return Some(Self::HarwellBoeing);
        }
        let numbers = first_line.split([' ', '\t', ',']).filter(|word| !word.is_empty());
        let count = numbers.clone().count();
        let are_numbers = numbers.clone().all(|word| word.replace('D', "E").parse::<f64>().is_ok());
        if (count == 3 || count == 5) && are_numbers {
            return Some(Self::Triplets);
        }
        // Without its first lines a punch file begins within a list of cards.
        text.contains("\nDMIG").then_some(Self::Punch)
    }
}

/// Four whole numbers of 8 or 16 columns and a name.
fn is_output4_header(line: &str) -> bool {
    let of_width = |width: usize| {
        let field = |place: usize| line.get(place * width..(place + 1) * width);
        let whole = |place: usize| field(place).is_some_and(|text| text.trim().parse::<i64>().is_ok());
        let name = line.get(4 * width..4 * width + 1).and_then(|text| text.chars().next());
        (0..4).all(whole) && name.is_some_and(|first| first.is_ascii_alphabetic())
    };
    line.is_ascii() && (of_width(8) || of_width(16))
}

fn is_harwell_boeing_type(line: &str) -> bool {
    let kind: Vec<char> = line.chars().take(3).collect();
    let of = |place: usize, letters: &str| kind.get(place).is_some_and(|letter| letters.contains(*letter));
    of(0, "RCP") && of(1, "SUHZR") && of(2, "AE")
}
