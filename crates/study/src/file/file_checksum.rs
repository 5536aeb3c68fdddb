//! What a file of a study held when it was read.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

/// Largest file of matrices [bytes].
const LARGEST: u64 = 16 << 30;

/// CRC-32 of the bytes of a file, and their number.
///
/// # Errors
/// It cannot be read, is no file, or is too large.
pub(super) fn checksum(path: &Path) -> io::Result<String> {
    let about = path.metadata()?;
    if !about.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
    }
    if about.len() > LARGEST {
        let message = format!("it has {} bytes, at most {LARGEST} are allowed", about.len());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let mut file = File::open(path)?;
    let (mut hasher, mut buffer, mut length) = (crc32fast::Hasher::new(), vec![0; 1 << 16], 0_u64);
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(format!("{:08x}-{length}", hasher.finalize())),
            count => {
                hasher.update(&buffer[..count]);
                length += count as u64;
            }
        }
    }
}
