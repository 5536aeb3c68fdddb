//! From matrices of components to those of the coordinates that are left.
//!
//! The rows y of all components are `y = T x`: components share the rows of common nodes, rows without
//! entries and held ones are zero, Lagrange rows leave one coordinate less each, and the rows of a moving
//! support are its direction times its displacement. The coordinates x are the free ones, then one for each
//! support that moves; `K_x = T^T K T`, and `M_x`, `C_x` alike.

use std::collections::BTreeMap;

use super::{
    Direction, Entry, Matrices, MatrixComponent, MatrixPart, RowKind, RowSet, SupportRows, SymmetricMatrix,
    constraints::{Dependent, conditions, lagrange_rows},
    joined::{Joined, SharedRows, Unplaced},
    map::CoordinateMap,
    model::MatrixReport,
};
use crate::StructureError;

/// Most rows that a message counts up.
const NAMED: usize = 8;

/// Matrices over the coordinates that are left.
#[derive(Debug)]
pub(super) struct Assembled {
    pub stiffness: SymmetricMatrix,
    pub mass: SymmetricMatrix,
    pub damping: Option<SymmetricMatrix>,
    /// `T`, rows over the joined rows.
    pub map: CoordinateMap,
    /// Coordinates that are free; after them one for each support that moves.
    pub free: usize,
    pub joined: Joined,
    pub report: MatrixReport,
}

enum RowState {
    Free,
    Zero,
    Moving { support: usize, weight: f64 },
}

impl Matrices {
    /// These components and nothing else: no places of nodes, no points, nothing that holds them.
    ///
    /// * `memory_limit_bytes`: memory that matrices, factors and the search for modes may take [bytes].
    #[must_use]
    pub fn new(components: Vec<MatrixComponent>, memory_limit_bytes: u64) -> Self {
        Self {
            components,
            nodes: BTreeMap::new(),
            lines: Vec::new(),
            points: Vec::new(),
            supports: Vec::new(),
            fixed: Vec::new(),
            acceleration: None,
            memory_limit_bytes,
        }
    }

    /// Joins components.
    ///
    /// # Errors
    /// Matrices of different size, labels that are too few or stand for two rows that are to be joined.
    pub(super) fn joined(&self) -> Result<Joined, StructureError> {
        self.components.iter().try_for_each(MatrixComponent::check)?;
        let SharedRows { labels, rows } = SharedRows::of(&self.components)?;
        let size = labels.len();
        let sum = |of: &dyn Fn(&MatrixComponent) -> Option<SymmetricMatrix>| {
            let mut entries = Vec::new();
            for (component, places) in self.components.iter().zip(&rows) {
                let Some(matrix) = of(component) else { continue };
                entries.extend(matrix.entries().map(|(row, column, value)| Entry {
                    row: places[row] as u32,
                    column: places[column] as u32,
                    value,
                }));
            }
            SymmetricMatrix::from_entries(size, &entries)
        };
        let single = self.components.len() == 1;
        let of = |matrix: &dyn Fn(&MatrixComponent) -> Option<SymmetricMatrix>| match single {
            true => matrix(&self.components[0]).unwrap_or_else(|| SymmetricMatrix::from_entries(size, &[])),
            false => sum(matrix),
        };
        let damped = self.components.iter().any(|component| component.damping.is_some());
        let mut joined = Joined {
            stiffness: of(&|component| Some(component.stiffness.clone())),
            mass: of(&|component| Some(component.mass.clone())),
            damping: damped.then(|| of(&|component| component.damping.clone())),
            labels,
            rows,
            precision: self.components.iter().map(|component| component.precision).fold(0.0, f64::max),
            unplaced: Unplaced::default(),
        };
        joined.unplaced = joined.unplaced(&self.nodes);
        Ok(joined)
    }

    /// Assembles what is left when groups of supports move, in their order.
    ///
    /// # Errors
    /// Rows that are not there, a name that no support has, nothing left free.
    pub(super) fn assembled(&self, moving: &[&[&str]]) -> Result<Assembled, StructureError> {
        let joined = self.joined()?;
        let size = joined.labels.len();
        let mut states: Vec<RowState> = (0..size).map(|_| RowState::Free).collect();
        let (stiff, massive) = (joined.stiffness.occupied(), joined.mass.occupied());
        let damped = joined.damping.as_ref().map(SymmetricMatrix::occupied);
        let mut empty_rows = 0;
        for row in 0..size {
            let is_damped = damped.as_ref().is_some_and(|damped| damped[row]);
            if !stiff[row] && !massive[row] && !is_damped {
                states[row] = RowState::Zero;
                empty_rows += 1;
            }
        }
        let lagrange = lagrange_rows(&joined.stiffness, &joined.mass);
        lagrange.iter().for_each(|&row| states[row] = RowState::Zero);
        let mut fixed_rows = 0;
        let mut hold = |states: &mut Vec<RowState>, rows: &[usize]| {
            fixed_rows += rows.len();
            rows.iter().for_each(|&row| states[row] = RowState::Zero);
        };
        for (number, set) in self.fixed.iter().enumerate() {
            hold(&mut states, &set.found(&MatrixPart::Fixed(number), &joined)?);
        }
        for support in self
            .supports
            .iter()
            .filter(|support| !moving.iter().any(|names| names.contains(&support.name.as_str())))
        {
            if let SupportRows::Of(set) = &support.rows {
                hold(&mut states, &set.found(&MatrixPart::Support(support.name.clone()), &joined)?);
            }
        }
        for (number, names) in moving.iter().enumerate() {
            names.iter().try_for_each(|name| self.take_along(name, number, &joined, &mut states))?;
        }
        let dependent = Dependent::of(conditions(&joined.stiffness, &lagrange), |row| {
            matches!(states[row], RowState::Free)
        });
        let (map, free) = coordinate_map(&states, &dependent, moving.len());
        if free == 0 {
            return Err(StructureError::NothingFree);
        }
        let mass = map.congruence(&joined.mass);
        let massive = mass.occupied();
        let report = MatrixReport {
            rows: self.components.iter().map(|component| component.stiffness.size()).sum(),
            joined: joined.rows.iter().map(Vec::len).sum::<usize>() - size,
            empty_rows,
            lagrange_rows: lagrange.len(),
            fixed_rows,
            coordinates: free,
            internal_rows: joined.unplaced.internal.len(),
            unplaced_rows: joined.unplaced.moving,
            massless: massive[..free].iter().filter(|massive| !**massive).count(),
            ..MatrixReport::default()
        };
        Ok(Assembled {
            stiffness: map.congruence(&joined.stiffness),
            damping: joined.damping.as_ref().map(|damping| map.congruence(damping)),
            mass,
            map,
            free,
            joined,
            report,
        })
    }

    /// Marks the rows that a moving support takes along and those that it holds.
    fn take_along(
        &self,
        name: &str,
        number: usize,
        joined: &Joined,
        states: &mut [RowState],
    ) -> Result<(), StructureError> {
        let support = self.supports.iter().find(|support| support.name == name);
        let support = support.ok_or_else(|| StructureError::UnknownPoint {
            what: "support motion".into(),
            name: name.into(),
            known: self.supports.iter().map(|support| support.name.clone()).collect(),
        })?;
        let SupportRows::Of(set) = &support.rows else { return Ok(()) };
        let along = unit(&support.along, &format!("the direction of support \"{name}\""))?;
        for row in set.found(&MatrixPart::Support(name.into()), joined)? {
            if let RowState::Moving { support: other, .. } = states[row]
                && other != number
            {
                let label = joined.label(row);
                return Err(StructureError::MovedTwice { names: vec![label] });
            }
            let weight = match joined.labels[row].as_ref().map(|label| label.direction) {
                Some(Direction::Translation(axis)) => along[usize::from(axis)],
                Some(_) => 0.0,
                // One row that nothing is known of moves as the support says.
                None => 1.0,
            };
            states[row] = RowState::Moving { support: number, weight };
        }
        Ok(())
    }
}

/// `T`, and the number of free coordinates.
fn coordinate_map(states: &[RowState], dependent: &Dependent, supports: usize) -> (CoordinateMap, usize) {
    let is_free =
        |row: usize| matches!(states[row], RowState::Free) && !dependent.expressions.contains_key(&row);
    let mut place = vec![0; states.len()];
    let mut free = 0;
    for row in 0..states.len() {
        if is_free(row) {
            place[row] = free;
            free += 1;
        }
    }
    let mut map = CoordinateMap::new(free + supports);
    let term = |row: usize| match states[row] {
        RowState::Free => Some((place[row], 1.0)),
        RowState::Zero => None,
        RowState::Moving { support, weight } => Some((free + support, weight)),
    };
    for row in 0..states.len() {
        match dependent.expressions.get(&row) {
            None => map.push(term(row).filter(|(_, weight)| *weight != 0.0)),
            Some(expression) => {
                map.push(expression.iter().filter_map(|(&other, factor)| {
                    term(other).map(|(column, weight)| (column, weight * factor))
                }));
            }
        }
    }
    (map, free)
}

impl MatrixComponent {
    fn check(&self) -> Result<(), StructureError> {
        let rows = self.stiffness.size();
        let sizes = [
            ("mass", Some(self.mass.size())),
            ("damping", self.damping.as_ref().map(SymmetricMatrix::size)),
            ("list of labels", Some(self.labels.len()).filter(|count| *count > 0)),
        ];
        for (what, found) in sizes {
            if let Some(found) = found.filter(|found| *found != rows) {
                return Err(StructureError::RowCount { what, found, expected: rows });
            }
        }
        Ok(())
    }
}

impl RowSet {
    /// The joined rows that are meant.
    ///
    /// # Errors
    /// A row or a node that is not there.
    pub(super) fn found(&self, part: &MatrixPart, joined: &Joined) -> Result<Vec<usize>, StructureError> {
        let mut rows = Vec::new();
        for &row in &self.rows {
            let first = &joined.rows[0];
            let found = first.get(row).copied();
            rows.push(found.ok_or(StructureError::NoSuchRow {
                part: part.clone(),
                row: row + 1,
                rows: first.len(),
            })?);
        }
        if !self.nodes.is_empty() && joined.labels.iter().all(Option::is_none) {
            return Err(StructureError::NoLabels { part: Some(part.clone()) });
        }
        let wanted: std::collections::BTreeSet<i64> = self.nodes.iter().copied().collect();
        let mut met = std::collections::BTreeSet::new();
        for (row, label) in joined.labels.iter().enumerate() {
            let Some(label) = label.as_ref().filter(|label| label.kind == RowKind::Physical) else {
                continue;
            };
            if wanted.contains(&label.node)
                && (self.directions.is_empty() || self.directions.contains(&label.direction))
            {
                met.insert(label.node);
                rows.push(row);
            }
        }
        let missing: Vec<String> = wanted.difference(&met).take(NAMED).map(i64::to_string).collect();
        if !missing.is_empty() {
            return Err(StructureError::NoSuchNodes { part: part.clone(), nodes: missing });
        }
        rows.sort_unstable();
        rows.dedup();
        Ok(rows)
    }
}

/// A vector made of length 1.
pub(super) fn unit(vector: &[f64; 3], what: &str) -> Result<[f64; 3], StructureError> {
    let length = vector.iter().map(|part| part * part).sum::<f64>().sqrt();
    let length = crate::error::positive(&format!("the length of {what}"), length)?;
    Ok(vector.map(|part| part / length))
}
