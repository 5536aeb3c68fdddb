//! NumPy archives (`.npz`): a zip archive of arrays, stored or deflated.
//!
//! Of the zip format only the necessary parts are read: the central directory at the end, and the files it
//! lists.
//!
//! # Source
//! PKWARE, APPNOTE.TXT "ZIP File Format Specification", sections 4.3.7, 4.3.12, 4.3.16.

use std::io::Read;

use flate2::{Crc, read::DeflateDecoder};

use super::{
    arrays::arrange,
    bytes::{ByteReader, NumberRoom},
    npy,
};
use crate::{error::ReadError, finding::RecordFinding, limits::LARGEST_FILE, raw::RawRecord};

pub(super) fn read(bytes: &[u8]) -> Result<RawRecord, ReadError> {
    let mut arrays = Vec::new();
    let mut findings = Vec::new();
    let mut room = LARGEST_FILE;
    let mut numbers = NumberRoom::new();
    for entry in directory(bytes)? {
        match entry.name.strip_suffix(".npy") {
            Some(name) => match npy::arrays(&entry.content(bytes, &mut room)?, name, &mut numbers) {
                Ok(found) => arrays.extend(found),
                Err(ReadError::Unsupported { what, .. }) => {
                    findings.push(RecordFinding::LeftOut { name: name.to_owned(), reason: what });
                }
                Err(error) => return Err(error),
            },
            None => {
                let reason = "no array".to_owned();
                findings.push(RecordFinding::LeftOut { name: entry.name, reason });
            }
        }
    }
    arrange(arrays, findings)
}

struct Entry {
    name: String,
    method: u16,
    crc: u32,
    compressed: usize,
    size: usize,
    offset: usize,
}

/// The entries of the central directory.
fn directory(bytes: &[u8]) -> Result<Vec<Entry>, ReadError> {
    let truncated = || ReadError::Truncated { what: "the directory of the archive is missing".to_owned() };
    let end = bytes.windows(4).rposition(|window| window == b"PK\x05\x06").ok_or_else(truncated)?;
    let mut record = ByteReader::new(&bytes[end..], false);
    record.take(10, "the end of the directory")?;
    let count = record.u16("the number of files")?;
    record.u32("the size of the directory")?;
    let start = record.u32("the offset of the directory")? as usize;
    let mut directory = ByteReader::new(bytes.get(start..end).ok_or_else(truncated)?, false);
    (0..count).map(|_| entry(&mut directory)).collect()
}

fn entry(directory: &mut ByteReader) -> Result<Entry, ReadError> {
    let what = "the directory of the archive";
    directory.take(10, what)?;
    let method = directory.u16(what)?;
    directory.take(4, what)?;
    let crc = directory.u32(what)?;
    let compressed = directory.u32(what)? as usize;
    let size = directory.u32(what)? as usize;
    let lengths = [directory.u16(what)?, directory.u16(what)?, directory.u16(what)?].map(usize::from);
    directory.take(8, what)?;
    let offset = directory.u32(what)? as usize;
    let name = String::from_utf8_lossy(directory.take(lengths[0], what)?).into_owned();
    directory.take(lengths[1] + lengths[2], what)?;
    Ok(Entry { name, method, crc, compressed, size, offset })
}

impl Entry {
    /// Its content, decompressed.
    ///
    /// * `room`: remaining bytes that the archive may unpack to.
    fn content(&self, bytes: &[u8], room: &mut u64) -> Result<Vec<u8>, ReadError> {
        *room = room.checked_sub(self.size as u64).ok_or(ReadError::TooLarge)?;
        let what = "a file of the archive";
        let truncated = || ReadError::Truncated { what: format!("{} is not whole", self.name) };
        let mut local = ByteReader::new(bytes.get(self.offset..).ok_or_else(truncated)?, false);
        local.take(26, what)?;
        let lengths = [local.u16(what)?, local.u16(what)?].map(usize::from);
        local.take(lengths[0] + lengths[1], what)?;
        let data = local.take(self.compressed, what)?;
        let content = match self.method {
            0 => data.to_vec(),
            8 => {
                let mut content = Vec::with_capacity(self.size.min(1 << 24));
                DeflateDecoder::new(data)
                    .take(self.size as u64 + 1)
                    .read_to_end(&mut content)
                    .map_err(|_| truncated())?;
                content
            }
            method => {
                return Err(ReadError::Unsupported {
                    what: format!("compression method {method}"),
                    instead: "numpy.savez and numpy.savez_compressed write others",
                });
            }
        };
        let mut crc = Crc::new();
        crc.update(&content);
        if content.len() != self.size || crc.sum() != self.crc {
            return Err(ReadError::Malformed {
                what: format!("{} is damaged: its checksum is wrong", self.name),
            });
        }
        Ok(content)
    }
}
