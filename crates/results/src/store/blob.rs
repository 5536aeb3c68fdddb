//! Arrays of numbers as little-endian bytes.

use super::StoreError;

pub(super) fn pack<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Vec<u8> {
    numbers.into_iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// The numbers, of which there must be `expected`.
pub(super) fn unpack(what: &'static str, bytes: &[u8], expected: usize) -> Result<Vec<f64>, StoreError> {
    if Some(bytes.len()) != expected.checked_mul(8) {
        return Err(StoreError::Damaged { what, found: bytes.len(), expected: expected.saturating_mul(8) });
    }
    let (numbers, _) = bytes.as_chunks::<8>();
    Ok(numbers.iter().map(|number| f64::from_le_bytes(*number)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back_bit_by_bit() {
        let numbers = [1.0, -0.0, f64::MIN_POSITIVE / 3.0, 1e300];
        let back = unpack("numbers", &pack(&numbers), 4).unwrap();
        assert!(numbers.iter().zip(&back).all(|(a, b)| a.to_bits() == b.to_bits()));
    }

    #[test]
    fn a_wrong_size_is_refused() {
        assert!(matches!(
            unpack("numbers", &[0; 9], 1),
            Err(StoreError::Damaged { found: 9, expected: 8, .. })
        ));
    }
}
