//! `[response]`: what is to be computed.

use serde::Serialize;

use crate::document::{
    Key, KeyRow, TomlTable, Value,
    key::{KeyRange, Whole},
};

use super::{Place, Stop, names::Names};

/// What a study asks for.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResponseTable {
    /// The point whose displacement and acceleration are reported.
    pub point: String,
    /// Orbit periods over excitation period, each of which is sought.
    pub period_multiples: Vec<u32>,
    /// Period doublings followed from the branches that were found by a search; no part of the identity.
    #[serde(skip)]
    pub period_doubling_depth: u32,
}

/// Orbit periods over excitation period.
const MULTIPLES: Whole = Whole(1, 64);
/// The same of a single orbit.
pub(super) const PERIOD_MULTIPLE: Key<Whole> =
    Key::new("period_multiple", MULTIPLES, "orbit period over excitation period").or(1);
const PERIOD_DOUBLING_DEPTH: Key<Whole> = Key::new(
    "period_doubling_depth",
    Whole(0, 10),
    "period doublings that are followed one after the other, whatever the multiple; raise it and run again \
     to go on",
)
.or(0);

/// Rows of the page of keys.
pub(super) fn rows() -> Vec<KeyRow> {
    let point = KeyRow::read_apart(
        "point",
        "a point, an end, a mass",
        "point (first point) of the first stop, else the first point or mass, else `\"right\"`",
        "whose displacement and acceleration are reported",
    );
    let multiples = KeyRow::read_apart(
        "period_multiples",
        format!("list of whole numbers from {}, each once", MULTIPLES.allowed()),
        "`[1]`",
        "orbit periods over excitation period: 1 for harmonic solutions, 2 and 3 for the 1/2 and 1/3 \
         subharmonic ones",
    );
    vec![point, multiples, PERIOD_DOUBLING_DEPTH.row()]
}

pub(super) fn read(root: &TomlTable<'_>, names: &Names, stops: Option<&[Stop]>) -> Option<ResponseTable> {
    let table = match root.optional("response") {
        Some(value) => Some(value.table()?),
        None => None,
    };
    let key = |key| table.as_ref().and_then(|table| table.optional(key));
    let point = match key("point") {
        Some(value) => names.point(&value),
        None => default_point(names, stops),
    };
    let multiples = key("period_multiples").map_or(Some(vec![1]), |value| read_multiples(&value));
    let depth = PERIOD_DOUBLING_DEPTH.read(&table);
    if let Some(table) = table {
        table.finish();
    }
    Some(ResponseTable { point: point?, period_multiples: multiples?, period_doubling_depth: depth? })
}

/// First point of the first stop, else the first point or mass, else the right end.
fn default_point(names: &Names, stops: Option<&[Stop]>) -> Option<String> {
    let of_stop = stops?.first().map(|stop| match &stop.place {
        Place::At { point, .. } => point.as_str(),
        Place::Around { first, .. } | Place::Between { first, .. } => first.as_str(),
    });
    Some(of_stop.or_else(|| names.first()).unwrap_or_else(|| names.right_end()).to_owned())
}

fn read_multiples(value: &Value<'_>) -> Option<Vec<u32>> {
    let elements = value.array_of("whole numbers")?;
    let multiples: Vec<Option<u32>> = elements.iter().map(|element| MULTIPLES.take(element)).collect();
    let multiples = multiples.into_iter().collect::<Option<Vec<u32>>>()?;
    let mut distinct = multiples.clone();
    distinct.sort_unstable();
    distinct.dedup();
    if distinct.is_empty() || distinct.len() < multiples.len() {
        let what = if distinct.is_empty() { "is an empty list" } else { "names a multiple twice" };
        let help = vec![format!("allowed: whole numbers from {} to {}, each once", MULTIPLES.0, MULTIPLES.1)];
        value.problem(format!("`period_multiples` {what}"), help);
        return None;
    }
    Some(distinct)
}
