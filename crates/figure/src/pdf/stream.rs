//! Compressed streams.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};

/// Bytes as the content of a compressed stream.
pub(super) fn deflated(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).and_then(|()| encoder.finish()).expect("writing into memory does not fail")
}
