//! Names of points and masses.

use std::collections::HashSet;

use crate::StructureError;

/// Names with a meaning of their own: ends of a beam, the fixed surroundings, what moves as prescribed.
const RESERVED: [&str; 5] = ["left", "right", "ground", "space", "support"];

/// Checks that names are not empty, not reserved and unique.
pub(crate) fn check_names<'a>(
    what: &'static str,
    names: impl Iterator<Item = &'a str>,
) -> Result<(), StructureError> {
    let mut seen = HashSet::new();
    for name in names {
        if name.trim().is_empty() {
            return Err(StructureError::EmptyName { what });
        }
        if RESERVED.contains(&name) {
            return Err(StructureError::ReservedName { name: name.into() });
        }
        if !seen.insert(name) {
            return Err(StructureError::DuplicateName { name: name.into() });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reserved_empty_and_repeated_names_are_refused() {
        let check = |names: &[&'static str]| check_names("point", names.iter().copied());
        assert_eq!(check(&["a", "b"]), Ok(()));
        assert_eq!(check(&["left"]), Err(StructureError::ReservedName { name: "left".into() }));
        assert_eq!(check(&["a", "a"]), Err(StructureError::DuplicateName { name: "a".into() }));
        assert_eq!(check(&[" "]), Err(StructureError::EmptyName { what: "point" }));
    }
}
