//! Branches in other parameters and curves of bifurcations by columns.

use hammerbeam_orbit::Stability;

use super::{ColumnTable, ColumnValues, named};
use crate::store::{Store, StoreError, StoredVariedRow};

/// `parameter_branches` and `curves`, each only if there is something in it, with the columns of their CSV
/// files.
///
/// # Errors
/// [`StoreError`].
pub fn varied_tables(store: &Store) -> Result<Vec<ColumnTable>, StoreError> {
    let mut tables = Vec::new();
    for (name, is_curve) in [("parameter_branches", false), ("curves", true)] {
        let mut found = VariedColumns::default();
        for piece in store.pieces()?.iter().filter(|piece| piece.is_curve == is_curve) {
            for branch in &piece.branches {
                store.each_varied_row::<StoreError>((piece.id, branch.branch), |row| {
                    found.rows.push(row);
                    Ok(())
                })?;
                let rows = found.rows.len();
                found.of.resize(rows, branch.kind.clone().into());
                found.piece.resize(rows, piece.id.into());
                found.branch.resize(rows, branch.branch.into());
                found.multiple.resize(rows, branch.period_multiple.into());
                found.parameter.resize(rows, piece.parameter.clone().into());
            }
        }
        if !found.rows.is_empty() {
            tables.push(found.table(name));
        }
    }
    Ok(tables)
}

#[derive(Default)]
struct VariedColumns {
    of: Vec<std::borrow::Cow<'static, str>>,
    piece: Vec<i64>,
    branch: Vec<i64>,
    multiple: Vec<i64>,
    parameter: Vec<std::borrow::Cow<'static, str>>,
    rows: Vec<StoredVariedRow>,
}

/// The numbers of a row, in their order.
const NUMBERS: [&str; 9] = [
    "max_abs_displacement_m",
    "max_abs_acceleration_m_s2",
    "max_contact_force_n",
    "max_impact_velocity_m_s",
    "impulse_n_s",
    "leading_multiplier_re",
    "leading_multiplier_im",
    "residual",
    "error_estimate",
];

impl VariedColumns {
    fn table(self, name: &str) -> ColumnTable {
        let rows = &self.rows;
        let number =
            |of: &dyn Fn(&StoredVariedRow) -> f64| ColumnValues::Numbers(rows.iter().map(of).collect());
        let stable = rows.iter().map(|row| row.stability == Stability::Stable).collect();
        let mut columns = named([
            ("of", ColumnValues::Words(self.of)),
            ("piece", ColumnValues::Whole(self.piece)),
            ("branch", ColumnValues::Whole(self.branch)),
            ("period_multiple", ColumnValues::Whole(self.multiple)),
            ("parameter_name", ColumnValues::Words(self.parameter)),
            ("parameter", number(&|row| row.parameter)),
            ("frequency_hz", number(&|row| row.frequency_hz)),
        ]);
        for (place, name) in NUMBERS.into_iter().enumerate() {
            columns.push((name.to_owned(), number(&|row| row.numbers[place])));
        }
        columns.extend(named([
            ("contacts", ColumnValues::Whole(rows.iter().map(|row| row.contacts.into()).collect())),
            ("stable", ColumnValues::Flags(stable)),
            ("stability", ColumnValues::Words(rows.iter().map(|row| row.stability.word().into()).collect())),
            ("event", ColumnValues::Words(rows.iter().map(|row| row.event.clone().into()).collect())),
        ]));
        if name != "curves" {
            columns.remove(0);
        }
        ColumnTable::new(name, columns)
    }
}
