//! Writers of OUTPUT4 in all its encodings, for tests of the reader.

/// How a matrix is written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Strings {
    /// From the first to the last row that is not zero.
    Dense,
    /// Strings of rows, place and length in one word.
    Sparse,
    /// Strings of rows, place and length in two words: BIGMAT.
    Big,
}

/// Columns of a matrix as strings: first row from 1, and values.
fn strings_of(column: &[f64]) -> Vec<(usize, Vec<f64>)> {
    let mut strings: Vec<(usize, Vec<f64>)> = Vec::new();
    for (row, value) in column.iter().enumerate().filter(|(_, value)| **value != 0.0) {
        match strings.last_mut() {
            Some((first, values)) if *first + values.len() == row + 1 => values.push(*value),
            _ => strings.push((row + 1, vec![*value])),
        }
    }
    strings
}

/// From the first to the last value that is not zero.
fn dense_string(column: &[f64]) -> Option<(usize, Vec<f64>)> {
    let first = column.iter().position(|value| *value != 0.0)?;
    let last = column.iter().rposition(|value| *value != 0.0)?;
    Some((first + 1, column[first..=last].to_vec()))
}

/// Binary OUTPUT4 of one matrix.
pub struct Binary {
    /// How columns are written.
    pub strings: Strings,
    /// The byte of the highest order first.
    pub big_endian: bool,
    /// Numbers of 8 bytes, not of 4.
    pub double: bool,
    /// Bytes of a word.
    pub word: usize,
}

impl Binary {
    /// The bytes of a matrix, given as columns.
    pub fn write(&self, name: &str, columns: &[Vec<f64>]) -> Vec<u8> {
        let rows = columns[0].len() as i64;
        let signed = if self.strings == Strings::Big { -rows } else { rows };
        let kind = if self.double { 2 } else { 1 };
        let mut out = Vec::new();
        let mut header = Vec::new();
        for number in [columns.len() as i64, signed, 6, kind] {
            header.extend(self.whole(number));
        }
        header.extend(format!("{name:<width$}", width = 2 * self.word).bytes());
        self.record(&mut out, &header);
        for (number, column) in columns.iter().enumerate() {
            self.column(&mut out, number as i64 + 1, column);
        }
        let mut last = Vec::new();
        [columns.len() as i64 + 1, 1, 1].iter().for_each(|number| last.extend(self.whole(*number)));
        last.extend(self.real(1.0));
        self.record(&mut out, &last);
        out
    }

    fn column(&self, out: &mut Vec<u8>, number: i64, column: &[f64]) {
        let words = |values: usize| values * if self.double && self.word == 4 { 2 } else { 1 };
        let (mut first, mut body, mut length) = (0, Vec::new(), 0);
        if self.strings == Strings::Dense {
            let Some((row, values)) = dense_string(column) else { return };
            (first, length) = (row as i64, words(values.len()));
            values.iter().for_each(|value| body.extend(self.real(*value)));
        } else {
            for (row, values) in strings_of(column) {
                let own = words(values.len());
                if self.strings == Strings::Big {
                    body.extend(self.whole(own as i64 + 1));
                    body.extend(self.whole(row as i64));
                } else {
                    body.extend(self.whole(65536 * (own as i64 + 1) + row as i64));
                }
                values.iter().for_each(|value| body.extend(self.real(*value)));
                length += own + if self.strings == Strings::Big { 2 } else { 1 };
            }
            if length == 0 {
                return;
            }
        }
        let mut record = Vec::new();
        [number, first, length as i64].iter().for_each(|number| record.extend(self.whole(*number)));
        record.extend(body);
        self.record(out, &record);
    }

    fn record(&self, out: &mut Vec<u8>, bytes: &[u8]) {
        let length = self.ordered((bytes.len() as u32).to_le_bytes().to_vec());
        out.extend(&length);
        out.extend(bytes);
        out.extend(&length);
    }

    fn whole(&self, number: i64) -> Vec<u8> {
        self.ordered(if self.word == 4 {
            (number as i32).to_le_bytes().to_vec()
        } else {
            number.to_le_bytes().to_vec()
        })
    }

    fn real(&self, value: f64) -> Vec<u8> {
        self.ordered(if self.double || self.word == 8 {
            value.to_le_bytes().to_vec()
        } else {
            (value as f32).to_le_bytes().to_vec()
        })
    }

    fn ordered(&self, mut bytes: Vec<u8>) -> Vec<u8> {
        if self.big_endian {
            bytes.reverse();
        }
        bytes
    }
}

/// Text OUTPUT4 of one matrix of double numbers, three on a line.
pub fn text(name: &str, columns: &[Vec<f64>], strings: Strings) -> String {
    let rows = columns[0].len() as i64;
    let signed = if strings == Strings::Big { -rows } else { rows };
    let mut out = format!("{:8}{signed:8}{:8}{:8}{name:<8}1P,3E23.16\n", columns.len(), 6, 2);
    for (number, column) in columns.iter().enumerate() {
        let number = number + 1;
        if strings == Strings::Dense {
            let Some((first, values)) = dense_string(column) else { continue };
            out += &format!("{number:8}{first:8}{:8}\n", values.len());
            out += &lines(&values);
            continue;
        }
        let head = if strings == Strings::Big { 2 } else { 1 };
        let strings_here = strings_of(column);
        let words: usize = strings_here.iter().map(|(_, values)| head + 2 * values.len()).sum();
        if words > 0 {
            out += &format!("{number:8}{:8}{words:8}\n", 0);
        }
        for (row, values) in strings_here {
            let length = 2 * values.len() + 1;
            out += &match strings {
                Strings::Big => format!("{length:8}{row:8}\n"),
                _ => format!("{:8}\n", 65536 * length + row),
            };
            out += &lines(&values);
        }
    }
    out + &format!("{:8}{:8}{:8}\n", columns.len() + 1, 1, 1) + &lines(&[1.0])
}

fn lines(values: &[f64]) -> String {
    let field = |value: &f64| {
        let text = format!("{value:.16e}");
        let (mantissa, exponent) = text.split_once('e').unwrap();
        let exponent: i32 = exponent.parse().unwrap();
        format!("{:>23}", format!("{mantissa}E{exponent:+03}"))
    };
    values.chunks(3).map(|line| line.iter().map(field).collect::<String>() + "\n").collect()
}
