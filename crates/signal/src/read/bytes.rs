//! Numbers from bytes.

use crate::{error::ReadError, limits::MAX_SAMPLES};

/// How many more numbers a file may have.
#[derive(Debug)]
pub(super) struct NumberRoom(usize);

impl NumberRoom {
    pub(super) const fn new() -> Self {
        Self(MAX_SAMPLES)
    }

    /// Counts numbers before they are made.
    pub(super) fn take(&mut self, count: usize) -> Result<(), ReadError> {
        self.0 = self.0.checked_sub(count).ok_or(ReadError::TooManyNumbers)?;
        Ok(())
    }
}

/// Reads bytes from front to end.
#[derive(Debug, Clone, Copy)]
pub(super) struct ByteReader<'a> {
    rest: &'a [u8],
    big_endian: bool,
}

/// Storage format of a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberFormat {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

impl NumberFormat {
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
        }
    }

    /// Values of consecutive numbers in this format.
    pub(super) fn values(self, bytes: &[u8], big_endian: bool) -> Vec<f64> {
        bytes.chunks_exact(self.size()).map(|chunk| self.value(chunk, big_endian)).collect()
    }

    fn value(self, chunk: &[u8], big_endian: bool) -> f64 {
        let mut eight = [0; 8];
        let size = chunk.len();
        eight[..size].copy_from_slice(chunk);
        if big_endian {
            eight[..size].reverse();
        }
        let bits = u64::from_le_bytes(eight);
        match self {
            Self::I8 => f64::from(bits as u8 as i8),
            Self::U8 | Self::U16 | Self::U32 | Self::U64 => bits as f64,
            Self::I16 => f64::from(bits as u16 as i16),
            Self::I32 => f64::from(bits as u32 as i32),
            Self::I64 => bits as i64 as f64,
            Self::F32 => f64::from(f32::from_bits(bits as u32)),
            Self::F64 => f64::from_bits(bits),
        }
    }
}

impl<'a> ByteReader<'a> {
    pub(super) const fn new(rest: &'a [u8], big_endian: bool) -> Self {
        Self { rest, big_endian }
    }

    pub(super) const fn is_big_endian(&self) -> bool {
        self.big_endian
    }

    pub(super) const fn len(&self) -> usize {
        self.rest.len()
    }

    /// The next bytes.
    pub(super) fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], ReadError> {
        match self.rest.split_at_checked(count) {
            Some((bytes, rest)) => {
                self.rest = rest;
                Ok(bytes)
            }
            None => Err(ReadError::Truncated {
                what: format!("{what} should have {count} bytes, {} are left", self.rest.len()),
            }),
        }
    }

    fn unsigned(&mut self, count: usize, what: &str) -> Result<u64, ReadError> {
        let bytes = self.take(count, what)?;
        let push = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        Ok(if self.big_endian { bytes.iter().fold(0, push) } else { bytes.iter().rev().fold(0, push) })
    }

    pub(super) fn u16(&mut self, what: &str) -> Result<u16, ReadError> {
        self.unsigned(2, what).map(|value| value as u16)
    }

    pub(super) fn u32(&mut self, what: &str) -> Result<u32, ReadError> {
        self.unsigned(4, what).map(|value| value as u32)
    }
}
