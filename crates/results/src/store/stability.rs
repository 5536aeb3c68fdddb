//! How the stability of a solution is stored: 0 unstable, 1 stable, 2 marginal; and which multipliers are on
//! the unit circle, one byte each.

use hammerbeam_orbit::Stability;
use rusqlite::types::{FromSql, FromSqlError, FromSqlResult, ValueRef};

/// The number of a stability.
pub(super) fn number(stability: Stability) -> i64 {
    match stability {
        Stability::Unstable => 0,
        Stability::Stable => 1,
        Stability::Marginal => 2,
    }
}

/// A stability as it is read.
pub(super) struct Stored(pub Stability);

impl FromSql for Stored {
    fn column_result(value: ValueRef<'_>) -> FromSqlResult<Self> {
        match value.as_i64()? {
            0 => Ok(Self(Stability::Unstable)),
            1 => Ok(Self(Stability::Stable)),
            2 => Ok(Self(Stability::Marginal)),
            other => Err(FromSqlError::OutOfRange(other)),
        }
    }
}

/// Marks as bytes.
pub(super) fn bytes(marks: &[bool]) -> Vec<u8> {
    marks.iter().map(|&mark| u8::from(mark)).collect()
}

/// Marks of those bytes.
pub(super) fn marks(bytes: &[u8]) -> Vec<bool> {
    bytes.iter().map(|&byte| byte != 0).collect()
}
