//! The values of a function.

use super::{
    header::{BinaryLayout, FunctionHeader},
    lines::DatasetLines,
};
use crate::{
    error::ReadError,
    finding::RecordFinding,
    raw::{RawChannel, RawRecord, TimeAxis},
    read::bytes::NumberFormat,
    unit::{MeasuredQuantity, unit},
};

/// Values point by point, in the order in which they are stored.
pub(super) fn of_bytes(bytes: &[u8], header: &FunctionHeader, binary: &BinaryLayout) -> Vec<f64> {
    let format = if header.double { NumberFormat::F64 } else { NumberFormat::F32 };
    if header.even || header.abscissa_size(binary) == format.size() {
        return format.values(bytes, binary.big_endian);
    }
    let point = 4 + (header.values_per_point() - 1) * 8;
    bytes
        .chunks_exact(point)
        .flat_map(|point| {
            let mut values = NumberFormat::F32.values(&point[..4], binary.big_endian);
            values.extend(NumberFormat::F64.values(&point[4..], binary.big_endian));
            values
        })
        .collect()
}

/// Values of the text form, up to the line that ends the dataset.
///
/// Columns may touch where a number has a sign: a sign that does not follow an exponent letter starts a new
/// number.
pub(super) fn of_text(
    file: &mut DatasetLines,
    header: &FunctionHeader,
    number: usize,
) -> Result<Vec<f64>, ReadError> {
    let expected = header.points * header.values_per_point();
    let mut values = Vec::with_capacity(expected.min(1 << 24));
    while values.len() < expected {
        let line = file.next().filter(|line| line.trim() != "-1").ok_or_else(|| ReadError::Truncated {
            what: format!("function {number} has {} of {expected} values", values.len()),
        })?;
        for field in fields(&line) {
            let value = field.replace(['D', 'd'], "e").parse().map_err(|_| ReadError::Malformed {
                what: format!("\"{field}\" in function {number} is not a number"),
            })?;
            values.push(value);
        }
    }
    if values.len() > expected {
        let what = format!("function {number} has more values than its {} points", header.points);
        return Err(ReadError::Malformed { what });
    }
    Ok(values)
}

fn fields(line: &str) -> Vec<&str> {
    let mut fields = Vec::new();
    for word in line.split_whitespace() {
        let mut start = 0;
        for (at, pair) in word.as_bytes().windows(2).enumerate() {
            if matches!(pair[1], b'+' | b'-') && !matches!(pair[0], b'e' | b'E' | b'd' | b'D') {
                fields.push(&word[start..=at]);
                start = at + 1;
            }
        }
        fields.push(&word[start..]);
    }
    fields
}

/// Adds a function of time to the record.
pub(super) fn add(values: Vec<f64>, header: FunctionHeader, raw: &mut RawRecord) {
    let per_point = header.values_per_point();
    let column = |index: usize| values.iter().skip(index).step_by(per_point).copied().collect::<Vec<_>>();
    let factor = header
        .abscissa_unit
        .as_deref()
        .and_then(unit)
        .filter(|unit| unit.quantity == MeasuredQuantity::Time)
        .map_or(1.0, |unit| unit.factor);
    let (axis, first) = if header.even {
        (TimeAxis::Even { step_s: factor * header.step, start_s: factor * header.start }, 0)
    } else {
        (TimeAxis::Times(column(0).iter().map(|value| factor * value).collect()), 1)
    };
    let (unit, assumed) = header.unit();
    if let Some(unit) = unit.clone().filter(|_| assumed) {
        raw.findings.push(RecordFinding::UnitAssumed { channel: header.name.clone(), unit });
    }
    let parts: &[&str] = if header.complex { &[" (real)", " (imaginary)"] } else { &[""] };
    for (index, part) in parts.iter().enumerate() {
        let name = format!("{}{part}", header.name);
        raw.add(axis.clone(), RawChannel { name, unit: unit.clone(), samples: column(first + index) });
    }
}
