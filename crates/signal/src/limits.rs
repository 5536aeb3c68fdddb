//! Upper limits of what is read and created: a wrong file or number then ends with a message, and does not
//! exhaust memory or time.
//!
//! Readers of studies and measurements open their files here; `hammerbeam-matrices` keeps the same rule for
//! matrices. Devices, pipes and folders are refused: they may have no end, or keep a reader waiting.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

/// Bytes of a file of measurements, also of everything that an archive unpacks to.
pub const LARGEST_FILE: u64 = 256 << 20;
/// Bytes of a file written by hand.
pub const LARGEST_TEXT: u64 = 16 << 20;
/// Samples of all channels of a record together, also after filling gaps or resampling.
pub const MAX_SAMPLES: usize = 1 << 25;
/// Columns of a table of measurements.
pub const MAX_COLUMNS: usize = 10_000;
/// Structures within one another in a MATLAB file.
pub(crate) const MAX_DEPTH: usize = 32;
/// Bytes of a name in a file of measurements.
pub(crate) const LONGEST_NAME: usize = 1000;
/// Largest magnitude of a sample in its unit; the squares of larger ones and their sums are not finite.
pub const LARGEST_SAMPLE: f64 = 1e60;
/// Least magnitude of the largest sample of a channel that is not all zero; squares of smaller ones
/// underflow.
pub const SMALLEST_SAMPLE: f64 = 1e-60;

/// Content of a file.
///
/// * `most`: bytes it may have.
///
/// # Errors
/// The operating system cannot give the file, or it is larger.
pub fn read_bytes(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Opening a pipe would wait for its writer.
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file"));
    }
    let file = File::open(path)?;
    // A file may grow while it is read.
    if file.metadata()?.len() > most {
        return Err(too_large(most));
    }
    let mut bytes = Vec::new();
    file.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most { Err(too_large(most)) } else { Ok(bytes) }
}

/// Text of a file.
///
/// * `most`: bytes it may have.
///
/// # Errors
/// The operating system cannot give the file, it is larger, or it is not text in UTF-8.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let no_text = |_| io::Error::new(io::ErrorKind::InvalidData, "it is no text in UTF-8");
    String::from_utf8(read_bytes(path, most)?).map_err(no_text)
}

fn too_large(most: u64) -> io::Error {
    let mebibytes = most >> 20;
    io::Error::new(
        io::ErrorKind::FileTooLarge,
        format!("it is larger than {mebibytes} MiB, the most that is read"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_the_largest_size_is_read_and_one_byte_more_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        std::fs::write(&path, "12345").unwrap();
        assert_eq!(read_text(&path, 5).unwrap(), "12345");
        assert_eq!(read_bytes(&path, 4).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        std::fs::write(&path, [0xff]).unwrap();
        assert!(read_text(&path, 5).is_err() && read_bytes(&path, 5).is_ok());
    }

    #[cfg(unix)]
    #[test]
    fn a_device_is_refused() {
        let error = read_bytes(Path::new("/dev/zero"), 3 << 20).unwrap_err();
        assert_eq!(error.to_string(), "it is no regular file");
    }
}
