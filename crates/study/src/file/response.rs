//! `[response]`: what is to be computed.

use serde::Serialize;

use crate::document::{TomlTable, Value};

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
    let depth = key("period_doubling_depth").map_or(Some(0), |value| value.whole(0, 10));
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
    let multiples: Vec<Option<u32>> = elements.iter().map(|element| element.whole(1, 64)).collect();
    let multiples = multiples.into_iter().collect::<Option<Vec<u32>>>()?;
    let mut distinct = multiples.clone();
    distinct.sort_unstable();
    distinct.dedup();
    if distinct.is_empty() || distinct.len() < multiples.len() {
        let what = if distinct.is_empty() { "is an empty list" } else { "names a multiple twice" };
        let help = vec!["allowed: whole numbers from 1 to 64, each once".into()];
        value.problem(format!("`period_multiples` {what}"), help);
        return None;
    }
    Some(distinct)
}
