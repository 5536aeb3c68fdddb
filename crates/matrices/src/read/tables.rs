//! Tables of the bundle and of finite element programs that say what rows, nodes and lines are.

use std::{collections::BTreeMap, io::BufRead};

use hammerbeam_structure::{Direction, RowKind, RowLabel};

use super::{
    cards::next_card,
    text::{Lines, number, shown, whole},
};
use crate::error::{MatrixFault, PlacedFault};

/// Places of nodes.
pub type Nodes = BTreeMap<i64, [f64; 3]>;

/// `dofs.csv`: `row,node,direction,kind,name`, rows from 1 in their order.
pub(crate) fn dofs<R: BufRead>(source: R) -> Result<Vec<RowLabel>, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut labels = Vec::new();
    let mut named: BTreeMap<String, u64> = BTreeMap::new();
    while let Some(line) = lines.next()? {
        let text = String::from_utf8_lossy(line).into_owned();
        if labels.is_empty() && text.trim_start_matches('\u{feff}').starts_with("row")
            || text.trim().is_empty()
        {
            continue;
        }
        let label = dof(&text, labels.len()).map_err(|fault| fault.at(lines.place()))?;
        let second = labels.len() as u64 + 1;
        if !label.name.is_empty()
            && let Some(first) = named.insert(label.name.clone(), second)
        {
            let label = format!("the name \"{}\"", label.name);
            return Err(MatrixFault::DuplicateLabel { label, first, second }.at(lines.place()));
        }
        labels.push(label);
    }
    Ok(labels)
}

fn dof(text: &str, before: usize) -> Result<RowLabel, MatrixFault> {
    let mut fields = text.splitn(5, ',').map(str::trim);
    let mut field = || fields.next().unwrap_or_default().to_owned();
    let (row, node, direction, kind, name) = (field(), field(), field(), field(), field());
    let is_hidden = |letter: char| {
        letter.is_control()
            || matches!(letter, '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}')
    };
    if name.contains(is_hidden) {
        let expected = "a name without control characters";
        return Err(MatrixFault::Unexpected { expected, found: shown(name.as_bytes()) });
    }
    let found = whole(row.as_bytes(), "a row")?;
    if found != before as i64 + 1 {
        return Err(MatrixFault::OutOfRange { what: "a row", found, allowed: (before + 1).to_string() });
    }
    let node = if node.is_empty() { 0 } else { whole(node.as_bytes(), "a node")? };
    let kind = match kind.as_str() {
        "physical" | "" => RowKind::Physical,
        "modal" => RowKind::Modal,
        _ => {
            return Err(MatrixFault::Unexpected {
                expected: "physical or modal",
                found: shown(kind.as_bytes()),
            });
        }
    };
    let direction = match (Direction::named(&direction), kind) {
        (Some(direction), _) => direction,
        (None, RowKind::Modal) => Direction::Other(0),
        (None, _) => {
            let expected = "a direction x, y, z, rx, ry, rz or a number";
            return Err(MatrixFault::Unexpected { expected, found: shown(direction.as_bytes()) });
        }
    };
    Ok(RowLabel { node, direction, kind, name: name.trim_matches('"').to_owned() })
}

/// CalculiX `.dof`: a line `node.direction` for each row.
pub(crate) fn dof_lines<R: BufRead>(source: R) -> Result<Vec<RowLabel>, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut labels = Vec::new();
    while let Some(line) = lines.next()? {
        let text = String::from_utf8_lossy(line).trim().to_owned();
        if text.is_empty() {
            continue;
        }
        let label = text
            .split_once('.')
            .ok_or_else(|| MatrixFault::Unexpected {
                expected: "node.direction",
                found: shown(text.as_bytes()),
            })
            .and_then(|(node, direction)| {
                let direction = Direction::numbered(whole(direction.as_bytes(), "a direction")?);
                Ok(RowLabel::physical(whole(node.as_bytes(), "a node")?, direction))
            });
        labels.push(label.map_err(|fault| fault.at(lines.place()))?);
    }
    Ok(labels)
}

/// `nodes.csv`: `node,x,y,z` [m].
pub(crate) fn nodes<R: BufRead>(source: R) -> Result<Nodes, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut nodes = Nodes::new();
    while let Some(line) = lines.next()? {
        let first = line.iter().find(|byte| !b" \t\xef\xbb\xbf".contains(byte));
        if !first.is_some_and(|byte| byte.is_ascii_digit() || *byte == b'-') {
            continue;
        }
        let place = place_of(line).and_then(|(node, at)| note(&mut nodes, node, at));
        place.map_err(|fault| fault.at(lines.place()))?;
    }
    Ok(nodes)
}

/// A node and its coordinates, missing ones 0.
fn place_of(line: &[u8]) -> Result<(i64, [f64; 3]), MatrixFault> {
    let mut fields = line.split(|byte| *byte == b',');
    let node = whole(fields.next().unwrap_or_default(), "a node")?;
    let mut at = [0.0; 3];
    for (place, field) in at.iter_mut().zip(fields) {
        if field.iter().any(|byte| !byte.is_ascii_whitespace()) {
            *place = number(field, "a coordinate")?;
        }
    }
    Ok((node, at))
}

fn note(nodes: &mut Nodes, node: i64, at: [f64; 3]) -> Result<(), MatrixFault> {
    match nodes.insert(node, at) {
        Some(before) if before != at => {
            let (what, found) = ("a node with two places", node);
            Err(MatrixFault::OutOfRange { what, found, allowed: "one place for each node".into() })
        }
        _ => Ok(()),
    }
}

/// Nodes of an input deck of Abaqus or CalculiX: the lines after `*NODE`.
pub(crate) fn deck_nodes<R: BufRead>(source: R) -> Result<Nodes, PlacedFault> {
    let mut lines = Lines::new(source);
    let (mut nodes, mut within) = (Nodes::new(), false);
    while let Some(line) = lines.next()? {
        if line.starts_with(b"**") || line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        if line.starts_with(b"*") {
            let keyword = line.split(|byte| *byte == b',').next().unwrap_or_default();
            within = keyword.trim_ascii().eq_ignore_ascii_case(b"*NODE");
            continue;
        }
        if within {
            let place = place_of(line).and_then(|(node, at)| note(&mut nodes, node, at));
            place.map_err(|fault| fault.at(lines.place()))?;
        }
    }
    Ok(nodes)
}

/// Grid points of Nastran bulk data, in the basic coordinate system.
pub(crate) fn grid_nodes<R: BufRead>(source: R) -> Result<Nodes, PlacedFault> {
    let mut lines = Lines::new(source);
    let mut nodes = Nodes::new();
    while let Some(card) = next_card(&mut lines, &["GRID"])? {
        let noted = (|| {
            let node = whole(card.field(0).as_bytes(), "a grid point")?;
            if !matches!(card.field(1), "" | "0") {
                let what = format!("the coordinate system {} of grid point {node}", card.field(1));
                let instead = "write nodes.csv with places in the basic system";
                return Err(MatrixFault::Unsupported { what, instead });
            }
            let mut at = [0.0; 3];
            for (axis, place) in at.iter_mut().enumerate() {
                let field = card.field(2 + axis);
                *place = if field.is_empty() { 0.0 } else { number(field.as_bytes(), "a coordinate")? };
            }
            note(&mut nodes, node, at)
        })();
        noted.map_err(|fault: MatrixFault| fault.at(card.place))?;
    }
    Ok(nodes)
}

/// `lines.csv`: pairs `node,node` that are joined by a line.
pub(crate) fn lines<R: BufRead>(source: R) -> Result<Vec<[i64; 2]>, PlacedFault> {
    let mut text = Lines::new(source);
    let mut pairs = Vec::new();
    while let Some(line) = text.next()? {
        if !line.first().is_some_and(|byte| byte.is_ascii_digit() || *byte == b'-') {
            continue;
        }
        let mut fields = line.split(|byte| *byte == b',');
        let mut node = || whole(fields.next().unwrap_or_default(), "a node");
        let pair = node().and_then(|from| Ok([from, node()?]));
        pairs.push(pair.map_err(|fault| fault.at(text.place()))?);
    }
    Ok(pairs)
}
