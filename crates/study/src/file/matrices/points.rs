//! Points, supports and sets of rows.

use crate::document::{TomlTable, Value};

use super::{
    super::names::{Names, read_name},
    direction::{read_direction, read_name_of_direction, read_vector},
    entries::{MatrixPointEntry, MatrixSupportEntry, PointPlaceEntry, RowSetEntry},
};

/// Most nodes of a set.
const MOST_NODES: u32 = 1_000_000;

pub(super) fn read_point(
    table: TomlTable<'_>,
    components: &[String],
    names: &mut Names,
) -> Option<MatrixPointEntry> {
    let name = read_name(&table, names);
    let component = table.optional("component").map_or(Some(0), |value| {
        let known: Vec<&str> = components.iter().map(String::as_str).collect();
        let name = value.text()?;
        let found = known.iter().position(|known| *known == name);
        if found.is_none() {
            value.unknown_word(name, "a component of this structure", &known);
        }
        found
    });
    let given = ["node", "label", "row"].into_iter().filter(|key| table.has(key)).count();
    let place = if given == 1 {
        read_place(&table, component)
    } else {
        for key in ["node", "direction", "label", "row"] {
            table.optional(key);
        }
        let help = vec!["allowed: `node` with `direction`, `label`, or `row`".to_owned()];
        table.problem("name", format!("{given} of `node`, `label` and `row` are given"), help);
        None
    };
    table.finish();
    Some(MatrixPointEntry { name: name?, place: place? })
}

fn read_place(table: &TomlTable<'_>, component: Option<usize>) -> Option<PointPlaceEntry> {
    if table.has("node") {
        let node = table.required("node").and_then(|value| value.whole(0, u32::MAX));
        let direction = table.required("direction").and_then(|value| read_direction(&value));
        return Some(PointPlaceEntry::Node { node: node?, direction: direction? });
    }
    if table.has("label") {
        return table.required("label")?.text().map(|label| PointPlaceEntry::Label(label.to_owned()));
    }
    let row = table.required("row").and_then(|value| value.whole(1, u32::MAX));
    Some(PointPlaceEntry::Row { component: component?, row: row? })
}

pub(super) fn read_support(table: TomlTable<'_>, names: &mut Names) -> Option<MatrixSupportEntry> {
    let name = table.required("name").and_then(|value| {
        let name = value.text()?;
        names.add_support(&value, name).then(|| name.to_owned())
    });
    let everything = table.optional("everything").map_or(Some(false), |value| value.boolean());
    let direction = table.required("direction").and_then(|value| read_vector(&value));
    let rows = read_rows(&table, everything == Some(false));
    table.finish();
    let rows = rows?;
    let rows = (!everything?).then_some(rows);
    Some(MatrixSupportEntry { name: name?, rows, direction: direction? })
}

pub(super) fn read_rows(table: &TomlTable<'_>, required: bool) -> Option<RowSetEntry> {
    let nodes = table.optional("nodes").map_or(Some(Vec::new()), |value| read_nodes_list(&value));
    let rows = table.optional("rows").map_or(Some(Vec::new()), |value| {
        let rows = value.array_of("rows")?;
        rows.iter().map(|row| row.whole(1, u32::MAX)).collect()
    });
    let directions = table.optional("directions").map_or(Some(Vec::new()), |value| {
        let elements = value.array_of("directions")?;
        elements.iter().map(read_name_of_direction).collect()
    });
    let set = RowSetEntry { nodes: nodes?, rows: rows?, directions: directions? };
    if required && set.nodes.is_empty() && set.rows.is_empty() {
        let help = vec!["allowed: `nodes`, `rows`, or both".to_owned()];
        table.problem("nodes", "neither nodes nor rows are given".into(), help);
        return None;
    }
    Some(set)
}

/// Nodes one by one, or as runs in a text: `[3, "10-20"]`.
fn read_nodes_list(value: &Value<'_>) -> Option<Vec<[u32; 2]>> {
    let elements = value.array_of("nodes")?;
    let run = |element: &Value<'_>| {
        if !element.is_text() {
            return element.whole(0, u32::MAX).map(|node| [node, node]);
        }
        let text = element.text()?;
        let ends = text.split_once('-').and_then(|(first, last)| {
            Some([first.trim().parse::<u32>().ok()?, last.trim().parse::<u32>().ok()?])
        });
        let ends = ends.filter(|[first, last]| first <= last && last - first < MOST_NODES);
        if ends.is_none() {
            let help = vec![format!("allowed: \"first-last\", at most {MOST_NODES} nodes")];
            element.problem(format!("\"{text}\" is no run of nodes"), help);
        }
        ends
    };
    let runs = elements.iter().map(run).collect::<Option<Vec<_>>>()?;
    let count: u64 = runs.iter().map(|[first, last]| u64::from(last - first) + 1).sum();
    if count > u64::from(MOST_NODES) {
        let help = vec![format!("allowed: at most {MOST_NODES} nodes")];
        value.problem(format!("`nodes` are {count} nodes"), help);
        return None;
    }
    Some(runs)
}
