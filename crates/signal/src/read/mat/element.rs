//! Elements of a MATLAB file: a tag with type and size, then the data.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::{Bytes, ReadError, Stored};

/// Type of an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Numbers(Stored),
    Matrix,
    Compressed,
    /// Encoded text, and types that are not known.
    Rest,
}

/// An element.
#[derive(Debug)]
pub(super) struct Element<'a> {
    pub kind: Kind,
    pub data: &'a [u8],
}

/// The next element. Small ones have their data in the tag; others are filled up to eight bytes, except
/// compressed ones.
pub(super) fn next<'a>(bytes: &mut Bytes<'a>) -> Result<Element<'a>, ReadError> {
    let first = bytes.u32("the tag of an element")?;
    let (small, kind) = (first >> 16, first & 0xffff);
    if small > 0 {
        let data = bytes.take(4, "a small element")?;
        let data = data
            .get(..small as usize)
            .ok_or_else(|| ReadError::Malformed { what: format!("a small element of {small} bytes") })?;
        return Ok(Element { kind: kind_of(kind), data });
    }
    let size = bytes.u32("the size of an element")? as usize;
    let data = bytes.take(size, "an element")?;
    let kind = kind_of(kind);
    if kind != Kind::Compressed {
        let filling = size.next_multiple_of(8) - size;
        bytes.take(filling.min(bytes.len()), "the filling of an element")?;
    }
    Ok(Element { kind, data })
}

const fn kind_of(number: u32) -> Kind {
    match number {
        1 => Kind::Numbers(Stored::I8),
        2 => Kind::Numbers(Stored::U8),
        3 => Kind::Numbers(Stored::I16),
        4 => Kind::Numbers(Stored::U16),
        5 => Kind::Numbers(Stored::I32),
        6 => Kind::Numbers(Stored::U32),
        7 => Kind::Numbers(Stored::F32),
        9 => Kind::Numbers(Stored::F64),
        12 => Kind::Numbers(Stored::I64),
        13 => Kind::Numbers(Stored::U64),
        14 => Kind::Matrix,
        15 => Kind::Compressed,
        _ => Kind::Rest,
    }
}

/// Values of an element of numbers; they may be stored smaller than the array's class says.
pub(super) fn numbers(element: &Element, big_endian: bool) -> Result<Vec<f64>, ReadError> {
    match element.kind {
        Kind::Numbers(stored) => Ok(stored.values(element.data, big_endian)),
        _ => Err(ReadError::Malformed {
            what: "numbers are missing where an array should have them".to_owned(),
        }),
    }
}

/// A variable, decompressed.
///
/// * `room`: bytes that the file may still unpack to.
pub(super) fn inflate(data: &[u8], room: &mut u64) -> Result<Vec<u8>, ReadError> {
    let mut inflated = Vec::new();
    ZlibDecoder::new(data)
        .take(*room + 1)
        .read_to_end(&mut inflated)
        .map_err(|_| ReadError::Truncated { what: "a compressed variable is not whole".to_owned() })?;
    *room = room.checked_sub(inflated.len() as u64).ok_or(ReadError::TooLarge)?;
    Ok(inflated)
}
