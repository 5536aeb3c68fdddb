//! Reading the force law of a stop from its table.
//!
//! A one-sided law with `side = "both"`, and a two-sided stop with a damper, is read as two one-sided ones:
//! the force on either side is that of a one-sided stop there, and no more than one of them touches at a
//! time, unless they press at rest. So whatever holds for one-sided stops (parting while there is
//! penetration left, impacts that are remembered, what sticks to a rigid stop) holds for these.

use hammerbeam_motion::law::{
    DESCRIPTIONS, HertzStiffness, LawAlternative, LawDescription, LawKey, LawKeyKind, LawSides, LawValue,
    NoPreload,
};

use super::{
    read_formula,
    stop_law::{Approach, GapMeasured, StopLaw, StopRest, StopSide},
};
use crate::document::{
    Key, Quantity, TomlTable, Value,
    key::{KeyRange, Words},
    quantity,
};

/// The law of a stop, or those of the two that it is read as.
pub(super) enum ReadLaw {
    /// One law.
    One(StopLaw),
    /// Two one-sided laws, above and below.
    Pair([StopLaw; 2]),
}

/// The sides on which a one-sided law acts.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sides {
    One(StopSide),
    Both,
}

impl Sides {
    fn of(self, law: impl Fn(StopSide) -> StopLaw) -> ReadLaw {
        match self {
            Self::One(side) => ReadLaw::One(law(side)),
            Self::Both => ReadLaw::Pair([law(StopSide::Above), law(StopSide::Below)]),
        }
    }
}

pub(super) const SIDE: Key<Words<Sides>> = Key::new(
    "side",
    Words(&[
        ("above", Sides::One(StopSide::Above)),
        ("below", Sides::One(StopSide::Below)),
        ("both", Sides::Both),
    ]),
    "contact where `r > gap`, or where `r < -gap`, or [on both sides](#on-both-sides), or all around, as a \
     [round hole](#round-holes)",
)
.further(", `\"around\"`")
.without("required for one-sided laws");
pub(super) const GAP: Key<Quantity> = Key::new("gap_m", quantity::GAP, "distance at rest").or(0.0);
pub(super) const GAP_MEASURED: Key<Words<GapMeasured>> = Key::new(
    "gap_measured",
    Words(&[("undeformed", GapMeasured::Undeformed), ("at-rest", GapMeasured::AtRest)]),
    "whether gaps count from the undeformed structure, or from where it rests under its constant loads \
     (gravity, forces of order 0) without any stop",
)
.or(GapMeasured::Undeformed);
pub(super) const PRELOAD: Key<Quantity> = Key::new(
    "preload_n",
    quantity::PRELOAD,
    "force with which a one-sided stop presses on the undeformed structure; instead of a gap",
)
.without("none");

/// Which law it is. Of two with one word the second is meant where its key is given.
pub(super) fn read_description(table: &TomlTable<'_>) -> Option<&'static LawDescription> {
    let mut named: Vec<(&str, &'static LawDescription)> = Vec::new();
    for described in DESCRIPTIONS {
        if !named.iter().any(|(name, _)| *name == described.name) {
            named.push((described.name, described));
        }
    }
    let first = table.required("law").and_then(|value| value.choice(&named))?;
    let other = first.alternative.filter(|alternative| table.has(alternative.other)).and_then(|_| {
        let is_other = |described: &&&LawDescription| {
            described.name == first.name && described.identity != first.identity
        };
        DESCRIPTIONS.iter().find(is_other).copied()
    });
    Some(other.unwrap_or(first))
}

/// The law of that description, from its keys.
pub(super) fn read(table: &TomlTable<'_>, description: &'static LawDescription) -> Option<ReadLaw> {
    if let Some(alternative) = description.alternative.filter(|alternative| !alternative.is_default)
        && let Some(other) = table.optional(alternative.other)
    {
        let help = vec![format!("allowed: one of `{}` and `{}`", alternative.other, alternative.own)];
        let message = format!("`{}` is given besides `{}`", alternative.other, alternative.own);
        other.problem(message, help);
    }
    let values = read_values(table, description);
    match description.sides {
        LawSides::One { no_preload, .. } => {
            let (approach, sides) = match no_preload {
                None => read_one_sided(table),
                Some(refused) => read_with_gap(table, refused),
            };
            let (values, approach) = (values?, approach?);
            let law = |side| StopLaw::new(description, values.clone(), StopRest::OneSided { approach, side });
            Some(sides?.of(law))
        }
        LawSides::Two { pair: (key, one_sided), .. } => {
            let rest = read_gaps(table);
            let (values, rest) = (values?, rest?);
            if values[key] == LawValue::Number(0.0) {
                return Some(ReadLaw::One(StopLaw::new(description, values, rest)));
            }
            let one = |side| StopLaw::new(one_sided, values.clone(), one_side_of(rest, side));
            Some(ReadLaw::Pair([StopSide::Above, StopSide::Below].map(one)))
        }
        LawSides::Always { .. } => Some(ReadLaw::One(StopLaw::new(description, values?, StopRest::Always))),
    }
}

/// The values of all keys; every fault of them is noted.
pub(super) fn read_values(table: &TomlTable<'_>, description: &LawDescription) -> Option<Vec<LawValue>> {
    let read: Vec<Option<LawValue>> =
        description.keys.iter().map(|key| read_value(table, key, description)).collect();
    let values: Vec<LawValue> = read.into_iter().collect::<Option<_>>()?;
    let is_nothing = |(key, value): (&LawKey, &LawValue)| {
        matches!(key.kind, LawKeyKind::Term { .. }) && *value == LawValue::Number(0.0)
    };
    if description.keys.iter().zip(&values).all(is_nothing) {
        refuse_no_term(table, description.keys);
        return None;
    }
    Some(values)
}

fn read_value(table: &TomlTable<'_>, key: &LawKey, description: &LawDescription) -> Option<LawValue> {
    let or = |default: f64, quantity| {
        let given = table.optional(key.name);
        given.map_or(Some(default), |value| value.number(quantity)).map(LawValue::Number)
    };
    match &key.kind {
        LawKeyKind::Formula => read_formula::read(table),
        LawKeyKind::HertzStiffness => read_hertz(table).map(LawValue::Hertz),
        LawKeyKind::Term { quantity } => or(0.0, quantity),
        LawKeyKind::Number { quantity, default: Some(default) } => or(*default, quantity),
        LawKeyKind::Number { quantity, default: None } => {
            let distinguishes = |known: &LawAlternative| known.is_default && known.own == key.name;
            let given = match description.alternative.filter(distinguishes) {
                None => table.required(key.name),
                Some(alternative) => {
                    if !table.has(key.name) {
                        let help =
                            vec![format!("allowed: one of `{}` and `{}`", key.name, alternative.other)];
                        table.problem(key.name, format!("`{}` is missing in this stop", key.name), help);
                    }
                    table.optional(key.name)
                }
            };
            given.and_then(|value| value.number(quantity)).map(LawValue::Number)
        }
    }
}

/// Notes that a law of several terms has none; the last is named.
fn refuse_no_term(table: &TomlTable<'_>, keys: &[LawKey]) {
    let Some(last) = keys.last() else { return };
    let names: Vec<String> = keys.iter().rev().map(|key| format!("`{}`", key.name)).collect();
    let zero = last.quantity().map_or_else(String::new, |quantity| quantity.with_unit(0.0));
    let what = if keys.iter().any(|key| table.has(key.name)) {
        format!("is {zero}, and there is no other term")
    } else {
        "is missing in this stop".to_owned()
    };
    let (first, others) = names.split_at(names.len() - 1);
    let help = format!("allowed: any number but zero for {} or {}", first.join(", "), others.join(""));
    table.problem(last.name, format!("`{}` {what}", last.name), vec![help]);
}

/// `stiffness_n_m15`, or radii, moduli and Poisson's ratios.
fn read_hertz(table: &TomlTable<'_>) -> Option<HertzStiffness> {
    const SPHERES: [&str; 3] = ["radii_m", "moduli_pa", "poisson_ratios"];
    let given = table.optional("stiffness_n_m15");
    let of_spheres = SPHERES.iter().any(|key| table.has(key));
    if !of_spheres && let Some(given) = given {
        return given.number(&quantity::HERTZ_STIFFNESS).map(HertzStiffness::Given);
    }
    if !of_spheres {
        let help = vec!["allowed: `stiffness_n_m15`, or `radii_m`, `moduli_pa` and `poisson_ratios`".into()];
        table.problem("stiffness_n_m15", "`stiffness_n_m15` is missing in this stop".into(), help);
        return None;
    }
    if let Some(given) = given {
        let help =
            vec!["allowed: one of `stiffness_n_m15` and `radii_m`, `moduli_pa`, `poisson_ratios`".into()];
        given.problem(
            "`stiffness_n_m15` is given besides `radii_m`, `moduli_pa`, `poisson_ratios`".into(),
            help,
        );
    }
    let radii = table.required("radii_m").and_then(|value| read_radii(&value));
    let moduli = table.required("moduli_pa").and_then(|value| value.numbers(&quantity::MODULUS));
    let ratios = table.required("poisson_ratios").and_then(|value| value.numbers(&quantity::POISSON));
    Some(HertzStiffness::Spheres { radii_m: radii?, moduli_pa: moduli?, poisson_ratios: ratios? })
}

/// Two radii, one of which may be "flat".
fn read_radii(value: &Value<'_>) -> Option<[Option<f64>; 2]> {
    let radius = |element: &Value<'_>| {
        if element.is_text() {
            return element.choice(&[("flat", None)]);
        }
        element.number(&quantity::RADIUS).map(Some)
    };
    let radii = value.exactly::<2, Option<f64>>("2 radii", radius)?;
    if radii == [None, None] {
        value.problem("`radii_m` has two planes".into(), vec!["allowed: one \"flat\" at most".into()]);
        return None;
    }
    Some(radii)
}

/// The side, with a word for who means a round hole.
fn read_sides(table: &TomlTable<'_>) -> Option<Sides> {
    if let Some(value) = table.optional(SIDE.name)
        && value.is_text()
        && value.text() == Some("around")
    {
        let help = "allowed: with two points, as at = [\"tip.y\", \"tip.z\"]; else above, below, both";
        value.problem("`side` is \"around\", but `at` names one point".to_owned(), vec![help.to_owned()]);
        return None;
    }
    SIDE.read(table)
}

fn read_gap(table: &TomlTable<'_>) -> Option<Approach> {
    let (gap, measured) = (GAP.read(table), GAP_MEASURED.read(table));
    gap.zip(measured).map(|(gap_m, measured)| Approach::Gap { gap_m, measured })
}

/// Gap and side of a law that takes no preload.
fn read_with_gap(table: &TomlTable<'_>, refused: NoPreload) -> (Option<Approach>, Option<Sides>) {
    let NoPreload { why, allowed } = refused;
    let sides = read_sides(table);
    let gap = read_gap(table);
    if !table.has("preload_n") {
        return (gap, sides);
    }
    table.refuse("preload_n", format!("`preload_n` is given, but {why}"), vec![allowed.to_owned()]);
    (None, sides)
}

/// Gap or preload, and the sides.
fn read_one_sided(table: &TomlTable<'_>) -> (Option<Approach>, Option<Sides>) {
    let sides = read_sides(table);
    let Some(preload) = table.optional(PRELOAD.name) else {
        return (read_gap(table), sides);
    };
    for key in ["gap_m", "gap_measured"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: either a gap or a preload".into()];
            value.problem(format!("`{key}` is given besides `preload_n`"), help);
        }
    }
    (PRELOAD.range.take(&preload).map(|preload_n| Approach::Preload { preload_n }), sides)
}

/// `gap_m` for both sides, or `gap_above_m` and `gap_below_m`.
fn read_gaps(table: &TomlTable<'_>) -> Option<StopRest> {
    let both = table.optional("gap_m");
    let each = ["gap_above_m", "gap_below_m"].map(|key| table.optional(key));
    if both.is_some() {
        for gap in each.iter().flatten() {
            let help = vec!["allowed: `gap_m` for both sides, or `gap_above_m` and `gap_below_m`".into()];
            gap.problem("a gap of one side is given besides `gap_m`".into(), help);
        }
    }
    let common = both.map_or(GAP.default, |value| GAP.range.take(&value));
    let [above, below] = each.map(|gap| gap.map_or(common, |value| GAP.range.take(&value)));
    let measured = GAP_MEASURED.read(table);
    Some(StopRest::TwoSided { gap_above_m: above?, gap_below_m: below?, gap_measured: measured? })
}

/// One side of a stop on both sides.
fn one_side_of(rest: StopRest, side: StopSide) -> StopRest {
    match rest {
        StopRest::TwoSided { gap_above_m, gap_below_m, gap_measured: measured } => {
            let gap_m = if side == StopSide::Above { gap_above_m } else { gap_below_m };
            StopRest::OneSided { approach: Approach::Gap { gap_m, measured }, side }
        }
        other => other,
    }
}
