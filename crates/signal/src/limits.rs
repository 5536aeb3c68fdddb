//! What is read and made at most: a wrong file or number then ends with a sentence, and not for want of
//! memory or time.
//!
//! Every reader of the program opens its file here. A device, a pipe or an archive has no size that could be
//! looked up beforehand, so no more than the limit is ever taken from any of them.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

use crate::error::{SignalError, ensure};

/// Bytes of a file of measurements, also of all that an archive unpacks to.
pub const LARGEST_FILE: u64 = 256 << 20;
/// Bytes of a file that someone has written by hand.
pub const LARGEST_TEXT: u64 = 16 << 20;
/// Samples of all channels of a record together, also of one that was filled up or sampled anew.
pub const MOST_SAMPLES: usize = 1 << 25;
/// Largest magnitude of a sample in its unit; with larger ones squares and their sums are not finite.
pub const LARGEST_SAMPLE: f64 = 1e60;
/// Magnitude that the largest sample of a channel has at least, if it is not 0; of smaller ones no squares
/// are left.
pub const SMALLEST_SAMPLE: f64 = 1e-60;

/// Content of a file.
///
/// * `most`: bytes it may have.
///
/// # Errors
/// The machine does not give the file, or it is larger.
pub fn read_bytes(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    // What a device or a pipe says of its size is nothing.
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
/// The machine does not give the file, it is larger, or it is no text in UTF-8.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    let no_text = |_| io::Error::new(io::ErrorKind::InvalidData, "it is no text in UTF-8");
    String::from_utf8(read_bytes(path, most)?).map_err(no_text)
}

/// Whether a character is none that is seen: what a terminal obeys, ends a line, turns the direction of
/// writing, has no width, or is a tag.
#[must_use]
pub fn is_control(character: char) -> bool {
    character.is_control()
        || matches!(
            character,
            '\u{61c}'
                | '\u{200b}'..='\u{200f}'
                | '\u{2028}'..='\u{202e}'
                | '\u{2060}'..='\u{206f}'
                | '\u{feff}'
                | '\u{e0000}'..='\u{e007f}'
        )
}

/// Refuses to make a record of so many samples.
///
/// # Errors
/// [`SignalError::Input`] beyond [`MOST_SAMPLES`].
pub(crate) fn ensure_count(samples: f64) -> Result<(), SignalError> {
    let allowed = format!("at most {MOST_SAMPLES}");
    ensure("the number of samples at the new rate", samples, allowed, samples <= MOST_SAMPLES as f64)
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
    fn a_device_without_end_is_refused() {
        let error = read_bytes(Path::new("/dev/zero"), 3 << 20).unwrap_err();
        assert_eq!(error.to_string(), "it is larger than 3 MiB, the most that is read");
    }
}
