//! Numbers of starts, walks and solutions.
//!
//! A start has two walks, one for each side; a walk has the 2^32 keys of its solutions, in their order.
//! Starts of the diagram have the numbers `job * MOST_STARTS + n`; those of pieces (`[[vary]]`, `[[curve]]`)
//! lie beyond all of them.

use hammerbeam_orbit::Side;

/// Most starts of one job or piece: the numbers of starts leave no room for more.
pub const MOST_STARTS: u32 = 1024;

/// First start of a piece.
pub(super) const OF_PIECES: u32 = 1 << 29;

/// Key of a solution.
pub fn solution_key(start: u32, side: Side, number: u32) -> i64 {
    first_key(walk_id(start, side)) + i64::from(number)
}

/// The start on whose walks a solution lies.
pub fn start_of_key(key: i64) -> u32 {
    (key >> 33) as u32
}

/// The side on which a solution lies.
pub(super) fn side_of_key(key: i64) -> Side {
    if key >> 32 & 1 == 1 { Side::Down } else { Side::Up }
}

/// Number of a walk: two for each start.
pub(super) fn walk_id(start: u32, side: Side) -> i64 {
    i64::from(start) * 2 + i64::from(side == Side::Down)
}

/// Key of the first solution a walk can have.
pub(super) fn first_key(walk: i64) -> i64 {
    walk << 32
}

/// Numbers of the starts of a job.
pub(super) fn starts_of_job(job: u32) -> std::ops::Range<u32> {
    job * MOST_STARTS..(job + 1) * MOST_STARTS
}

/// Numbers of the starts of a piece, by its key.
pub(super) fn starts_of_piece(piece: u32) -> std::ops::Range<u32> {
    OF_PIECES + piece * MOST_STARTS..OF_PIECES + (piece + 1) * MOST_STARTS
}

/// Whether a start is one of a piece.
pub(super) fn is_of_piece(start: u32) -> bool {
    start >= OF_PIECES
}

/// The word for a side.
pub(super) fn side_word(side: Side) -> &'static str {
    match side {
        Side::Up => "up",
        Side::Down => "down",
    }
}
