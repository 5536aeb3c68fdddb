//! Lines and bytes of a universal file.

/// Reads lines with any line ending, and bytes between them.
pub(super) struct DatasetLines<'a> {
    rest: &'a [u8],
}

impl<'a> DatasetLines<'a> {
    pub(super) const fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// The bytes that are not read yet.
    pub(super) const fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line without its ending.
    pub(super) fn next(&mut self) -> Option<String> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|byte| *byte == b'\n').unwrap_or(self.rest.len());
        let line = String::from_utf8_lossy(&self.rest[..end]).trim_end_matches('\r').to_owned();
        self.rest = self.rest.get(end + 1..).unwrap_or_default();
        Some(line)
    }

    /// Skips to the line after the one that ends the dataset.
    ///
    /// # Returns
    /// Whether the dataset has an end.
    pub(super) fn skip_dataset(&mut self) -> bool {
        std::iter::from_fn(|| self.next()).any(|line| line.trim() == "-1")
    }

    /// The next bytes.
    pub(super) fn take(&mut self, count: usize) -> Option<&'a [u8]> {
        let (bytes, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(bytes)
    }
}
