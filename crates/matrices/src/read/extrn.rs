//! The order of the rows of a Nastran superelement: card `EXTRN`.
//!
//! Pairs of a point and its components: `3 123456` is six rows, `2995001 0` one, of a scalar point, which is
//! the amplitude of a mode.

use std::io::BufRead;

use hammerbeam_structure::{Direction, RowLabel};

use super::{
    cards::next_card,
    text::{Lines, whole},
};
use crate::error::{MatrixFault, PlacedFault};

pub(crate) fn read<R: BufRead>(source: R) -> Result<Vec<RowLabel>, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut labels = Vec::new();
    while let Some(card) = next_card(&mut lines, &["EXTRN"])? {
        let mut pairs = card.fields.iter().filter(|field| !field.is_empty());
        while let Some(point) = pairs.next() {
            let components = pairs.next().ok_or_else(|| {
                MatrixFault::Truncated { what: "a pair of a point and its components" }.at(card.place)
            })?;
            rows(&mut labels, point, components).map_err(|fault| fault.at(card.place))?;
        }
    }
    if labels.is_empty() {
        return Err(MatrixFault::Truncated { what: "the search for an EXTRN card" }.at(lines.end()));
    }
    Ok(labels)
}

fn rows(labels: &mut Vec<RowLabel>, point: &str, components: &str) -> Result<(), MatrixFault> {
    let point = whole(point.as_bytes(), "a point")?;
    if components == "0" {
        labels.push(RowLabel::modal(point));
        return Ok(());
    }
    for digit in components.bytes() {
        if !(b'1'..=b'6').contains(&digit) {
            let found = whole(components.as_bytes(), "components")?;
            return Err(MatrixFault::OutOfRange {
                what: "components",
                found,
                allowed: "0, or digits 1 to 6".into(),
            });
        }
        labels.push(RowLabel::physical(point, Direction::numbered(i64::from(digit - b'0'))));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_have_a_row_for_each_component() {
        let text = "EXTRN          3     136 2995001       0\n         2995002       0\n$\n";
        let labels = read(text.as_bytes()).unwrap();
        let expected = ["node 3 x", "node 3 z", "node 3 rz", "mode 2995001", "mode 2995002"];
        assert_eq!(labels.iter().map(RowLabel::to_string).collect::<Vec<_>>(), expected);
        assert!(read(&b"EXTRN          3     178\n"[..]).is_err());
        assert!(read(&b"EXTRN          3\n"[..]).is_err());
    }
}
