//! Elements of a MATLAB file: a tag with type and size, then the data.

use std::io::Read;

use flate2::read::ZlibDecoder;

use crate::{
    error::ReadError,
    read::bytes::{ByteReader, NumberFormat},
};

/// Type of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ElementType {
    Numbers(NumberFormat),
    Matrix,
    Compressed,
    /// Encoded text, and unknown types.
    Other,
}

/// An element.
#[derive(Debug)]
pub(super) struct Element<'a> {
    pub kind: ElementType,
    pub data: &'a [u8],
}

/// The next element. Small ones have their data in the tag; others are padded to eight bytes, except
/// compressed ones.
pub(super) fn next<'a>(bytes: &mut ByteReader<'a>) -> Result<Element<'a>, ReadError> {
    let first = bytes.u32("the tag of an element")?;
    let (small, kind) = (first >> 16, first & 0xffff);
    if small > 0 {
        let data = bytes.take(4, "a small element")?;
        let data = data
            .get(..small as usize)
            .ok_or_else(|| ReadError::Malformed { what: format!("a small element of {small} bytes") })?;
        return Ok(Element { kind: type_of(kind), data });
    }
    let size = bytes.u32("the size of an element")? as usize;
    let data = bytes.take(size, "an element")?;
    let kind = type_of(kind);
    if kind != ElementType::Compressed {
        let padding = size.next_multiple_of(8) - size;
        bytes.take(padding.min(bytes.len()), "the filling of an element")?;
    }
    Ok(Element { kind, data })
}

const fn type_of(number: u32) -> ElementType {
    match number {
        1 => ElementType::Numbers(NumberFormat::I8),
        2 => ElementType::Numbers(NumberFormat::U8),
        3 => ElementType::Numbers(NumberFormat::I16),
        4 => ElementType::Numbers(NumberFormat::U16),
        5 => ElementType::Numbers(NumberFormat::I32),
        6 => ElementType::Numbers(NumberFormat::U32),
        7 => ElementType::Numbers(NumberFormat::F32),
        9 => ElementType::Numbers(NumberFormat::F64),
        12 => ElementType::Numbers(NumberFormat::I64),
        13 => ElementType::Numbers(NumberFormat::U64),
        14 => ElementType::Matrix,
        15 => ElementType::Compressed,
        _ => ElementType::Other,
    }
}

/// Values of an element of numbers; they may be stored in fewer bytes than the class of the array has.
pub(super) fn numbers(element: &Element, big_endian: bool) -> Result<Vec<f64>, ReadError> {
    match element.kind {
        ElementType::Numbers(format) => Ok(format.values(element.data, big_endian)),
        _ => Err(ReadError::Malformed {
            what: "numbers are missing where an array should have them".to_owned(),
        }),
    }
}

/// A variable, decompressed.
///
/// * `room`: remaining bytes that the file may unpack to.
pub(super) fn inflate(data: &[u8], room: &mut u64) -> Result<Vec<u8>, ReadError> {
    let mut inflated = Vec::new();
    ZlibDecoder::new(data)
        .take(*room + 1)
        .read_to_end(&mut inflated)
        .map_err(|_| ReadError::Truncated { what: "a compressed variable is not whole".to_owned() })?;
    *room = room.checked_sub(inflated.len() as u64).ok_or(ReadError::TooLarge)?;
    Ok(inflated)
}
