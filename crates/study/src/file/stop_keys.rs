//! Rows of the page of keys for `[[stop]]`: what every stop has, and the keys of the laws.

use hammerbeam_motion::law::{DEEPEST, DESCRIPTIONS, LONGEST, LawKey, LawKeyKind};

use crate::document::{
    Key, KeyRow, MOST_NAMES, Quantity,
    key::{KeyRange, words},
    quantity,
};

use super::read_stop_law::{GAP, GAP_MEASURED, PRELOAD, SIDE};

/// What every stop has.
pub(super) fn rows() -> Vec<KeyRow> {
    let row = |name, allowed: &str, default, meaning| KeyRow::read_apart(name, allowed, default, meaning);
    vec![
        row("name", "text", "\"stop 1\", \"stop 2\", ...", "name in reports, each once"),
        row(
            "at",
            "a point, an end, a mass; two of them for a [round hole](#round-holes)",
            "required, or `between`",
            "where the stop is",
        ),
        row(
            "fixed_to",
            "a moving support, a held beam end, `\"space\"`, `\"ground\"`",
            "the moving support if there is one, else `\"space\"`; required where supports move differently",
            "what carries the stop; only with `at`",
        ),
        row("between", "`[\"a\", \"b\"]`, two points or masses", "none", "the element joins these two"),
        row("law", "a name of the table below", "required", "the force law"),
    ]
}

/// The keys that say where a stop rests, and those of the laws. Where laws have one name for different keys,
/// all rows but that of the most laws say of which laws they are.
pub(super) fn rows_of_laws() -> Vec<KeyRow> {
    let mut rows = vec![
        SIDE.row(),
        GAP.row(),
        gap_of_one_side("gap_above_m", "distance at rest above of a two-sided stop"),
        gap_of_one_side("gap_below_m", "the same below"),
        GAP_MEASURED.row(),
        PRELOAD.row(),
    ];
    let keys = law_keys();
    for (row, laws) in &keys {
        let others = keys.iter().filter(|(other, _)| other.name == row.name && other != row);
        let is_usual = others.map(|(_, others)| others.len()).max().is_none_or(|most| most < laws.len());
        let of = if is_usual { String::new() } else { words(laws.iter().copied()) };
        rows.push(KeyRow { of, ..row.clone() });
        if row.name == LawKey::hertz_stiffness().name {
            rows.extend(rows_of_spheres());
        }
    }
    let number = format!("a table of at most {MOST_NAMES} names with finite numbers");
    rows.push(KeyRow::read_apart("constants", number, "none", "the constants of a formula"));
    rows
}

fn gap_of_one_side(name: &'static str, meaning: &'static str) -> KeyRow {
    let gap = Key::new(name, GAP.range, meaning).further(", instead of `gap_m`");
    KeyRow { default: GAP.row().default, ..gap.row() }
}

/// The keys of all laws, each once, with the laws that have it.
fn law_keys() -> Vec<(KeyRow, Vec<&'static str>)> {
    let mut keys: Vec<(KeyRow, Vec<&'static str>)> = Vec::new();
    for described in DESCRIPTIONS {
        for row in described.keys.iter().map(row_of) {
            match keys.iter_mut().find(|(known, _)| *known == row) {
                Some((_, laws)) if laws.contains(&described.name) => {}
                Some((_, laws)) => laws.push(described.name),
                None => keys.push((row, vec![described.name])),
            }
        }
    }
    keys
}

fn row_of(key: &LawKey) -> KeyRow {
    let row = |allowed: String, default: &str| KeyRow::read_apart(key.name, allowed, default, key.meaning);
    let number = |quantity: &Quantity| KeyRange::allowed(quantity);
    match &key.kind {
        LawKeyKind::Number { quantity, default } => {
            let default = default.map_or("required".to_owned(), |default| quantity.written(default));
            row(number(quantity), &default)
        }
        LawKeyKind::Term { quantity } => row(number(quantity), "0"),
        LawKeyKind::HertzStiffness => row(number(&quantity::HERTZ_STIFFNESS), "required, or the next three"),
        LawKeyKind::Formula => {
            let most =
                format!("at most {LONGEST} characters, in at most {DEEPEST} parentheses within one another");
            row(most, "required")
        }
    }
}

fn rows_of_spheres() -> [KeyRow; 3] {
    let two = |name, quantity: Quantity, more: &str, meaning| {
        let allowed = format!("two of {}{more}", KeyRange::allowed(&quantity));
        KeyRow::read_apart(name, allowed, "none", meaning)
    };
    [
        two(
            "radii_m",
            quantity::RADIUS,
            "; one may be `\"flat\"`",
            "radii of the two spheres of a Hertz contact",
        ),
        two("moduli_pa", quantity::MODULUS, "", "their Young's moduli"),
        two("poisson_ratios", quantity::POISSON, "", "their Poisson's ratios"),
    ]
}
