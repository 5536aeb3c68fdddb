//! Reading the force law of a stop from its table.
//!
//! A one-sided law with `side = "both"`, and a two-sided stop with a damper, is read as two one-sided ones:
//! the force on either side is that of a one-sided stop there, and no more than one of them touches at a
//! time, unless they press at rest. So whatever holds for one-sided stops (parting while there is
//! penetration left, impacts that are remembered, what sticks to a rigid stop) holds for these.

use super::{
    read_formula,
    stop_law::{Approach, GapMeasured, HertzStiffness, ImpactModel, Side, StopLaw},
};
use crate::document::{Quantity, Table, Value, quantity};

/// Which law it is.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Hertz,
    Linear,
    TwoSided,
    Cubic,
    Formula,
    HuntCrossley,
    Restitution(ImpactModel),
    Rigid,
}

const KINDS: [(&str, Kind); 13] = [
    ("hertz", Kind::Hertz),
    ("linear", Kind::Linear),
    ("two-sided", Kind::TwoSided),
    ("cubic", Kind::Cubic),
    ("formula", Kind::Formula),
    ("rigid", Kind::Rigid),
    ("hunt-crossley", Kind::HuntCrossley),
    ("herbert-mcwhannell", Kind::Restitution(ImpactModel::HerbertMcwhannell)),
    ("lee-wang", Kind::Restitution(ImpactModel::LeeWang)),
    ("lankarani-nikravesh", Kind::Restitution(ImpactModel::LankaraniNikravesh)),
    ("gonthier", Kind::Restitution(ImpactModel::Gonthier)),
    ("flores", Kind::Restitution(ImpactModel::Flores)),
    ("hu-guo", Kind::Restitution(ImpactModel::HuGuo)),
];

/// The law of a stop, or those of the two that it is read as.
pub(super) enum ReadLaw {
    /// One law.
    One(StopLaw),
    /// Two one-sided laws, above and below.
    Pair([StopLaw; 2]),
}

/// The sides on which a one-sided law acts.
#[derive(Clone, Copy)]
enum Sides {
    One(Side),
    Both,
}

impl Sides {
    fn of(self, law: impl Fn(Side) -> StopLaw) -> ReadLaw {
        match self {
            Self::One(side) => ReadLaw::One(law(side)),
            Self::Both => ReadLaw::Pair([law(Side::Above), law(Side::Below)]),
        }
    }
}

pub(super) fn read_kind(table: &Table<'_>) -> Option<Kind> {
    table.required("law").and_then(|value| value.choice(&KINDS))
}

pub(super) fn read(table: &Table<'_>, kind: Kind) -> Option<ReadLaw> {
    match kind {
        Kind::Hertz => {
            let stiffness = read_hertz(table);
            let (approach, sides) = read_one_sided(table);
            let (stiffness, approach) = (stiffness?, approach?);
            Some(sides?.of(|side| StopLaw::Hertz { stiffness, approach, side }))
        }
        Kind::Linear => {
            let stiffness = required(table, "stiffness_n_m", &quantity::STIFFNESS);
            let damping =
                table.optional("damping_n_s_m").map_or(Some(0.0), |value| value.number(&quantity::DAMPER));
            let (approach, sides) = read_one_sided(table);
            let (stiffness_n_m, damping_n_s_m, approach) = (stiffness?, damping?, approach?);
            Some(sides?.of(|side| StopLaw::Linear { stiffness_n_m, damping_n_s_m, approach, side }))
        }
        Kind::TwoSided => read_two_sided(table),
        Kind::Cubic => read_cubic(table).map(ReadLaw::One),
        Kind::Formula => read_formula::read(table).map(ReadLaw::One),
        Kind::Rigid => read_rigid(table),
        Kind::HuntCrossley => read_hunt_crossley(table),
        Kind::Restitution(model) => read_restitution(table, model),
    }
}

fn read_rigid(table: &Table<'_>) -> Option<ReadLaw> {
    let restitution = required(table, "restitution", &quantity::RIGID_RESTITUTION);
    let why = "a rigid stop has no stiffness to press with";
    let (approach, sides) = read_with_gap(table, (why, "allowed: a gap"));
    let (restitution, approach) = (restitution?, approach?);
    Some(sides?.of(|side| StopLaw::Rigid { restitution, approach, side }))
}

/// With the loss itself, or with a coefficient of restitution for every impact.
fn read_hunt_crossley(table: &Table<'_>) -> Option<ReadLaw> {
    if !table.has("restitution") {
        let stiffness = read_hertz(table);
        if !table.has("loss_s_m") {
            let help = vec!["allowed: one of `loss_s_m` and `restitution`".into()];
            table.problem("loss_s_m", "`loss_s_m` is missing in this stop".into(), help);
        }
        let loss = table.optional("loss_s_m").and_then(|value| value.number(&quantity::LOSS));
        let (approach, sides) = read_one_sided(table);
        let (stiffness, loss_s_m, approach) = (stiffness?, loss?, approach?);
        return Some(sides?.of(|side| StopLaw::HuntCrossley { stiffness, loss_s_m, approach, side }));
    }
    if let Some(loss) = table.optional("loss_s_m") {
        let help = vec!["allowed: one of `loss_s_m` and `restitution`".into()];
        loss.problem("`loss_s_m` is given besides `restitution`".into(), help);
    }
    read_restitution(table, ImpactModel::HuntCrossley)
}

fn read_restitution(table: &Table<'_>, model: ImpactModel) -> Option<ReadLaw> {
    let stiffness = read_hertz(table);
    let restitution = required(table, "restitution", &quantity::RESTITUTION);
    let why = "the law needs the speed of each impact";
    let allowed = "allowed: a gap; a contact that is closed at rest has no impact to remember";
    let (approach, sides) = read_with_gap(table, (why, allowed));
    let (stiffness, restitution, approach) = (stiffness?, restitution?, approach?);
    Some(sides?.of(|side| StopLaw::Restitution { model, stiffness, restitution, approach, side }))
}

fn required(table: &Table<'_>, key: &'static str, quantity: &Quantity) -> Option<f64> {
    table.required(key).and_then(|value| value.number(quantity))
}

/// `stiffness_n_m15`, or radii, moduli and Poisson's ratios.
fn read_hertz(table: &Table<'_>) -> Option<HertzStiffness> {
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

fn read_sides(table: &Table<'_>) -> Option<Sides> {
    let choices =
        [("above", Sides::One(Side::Above)), ("below", Sides::One(Side::Below)), ("both", Sides::Both)];
    table.required("side").and_then(|value| value.choice(&choices))
}

fn read_gap(table: &Table<'_>) -> Option<Approach> {
    let gap = table.optional("gap_m").map_or(Some(0.0), |value| value.number(&quantity::GAP));
    let measured = read_measured(table);
    gap.zip(measured).map(|(gap_m, measured)| Approach::Gap { gap_m, measured })
}

/// Gap and side of a law that takes no preload.
///
/// * `why`, `allowed`: why it takes none, and what it takes instead.
fn read_with_gap(table: &Table<'_>, (why, allowed): (&str, &str)) -> (Option<Approach>, Option<Sides>) {
    let sides = read_sides(table);
    let gap = read_gap(table);
    if !table.has("preload_n") {
        return (gap, sides);
    }
    table.refuse("preload_n", format!("`preload_n` is given, but {why}"), vec![allowed.to_owned()]);
    (None, sides)
}

/// Gap or preload, and the sides.
fn read_one_sided(table: &Table<'_>) -> (Option<Approach>, Option<Sides>) {
    let sides = read_sides(table);
    let Some(preload) = table.optional("preload_n") else {
        return (read_gap(table), sides);
    };
    for key in ["gap_m", "gap_measured"] {
        if let Some(value) = table.optional(key) {
            let help = vec!["allowed: either a gap or a preload".into()];
            value.problem(format!("`{key}` is given besides `preload_n`"), help);
        }
    }
    (preload.number(&quantity::PRELOAD).map(|preload_n| Approach::Preload { preload_n }), sides)
}

fn read_measured(table: &Table<'_>) -> Option<GapMeasured> {
    let choices = [("undeformed", GapMeasured::Undeformed), ("at-rest", GapMeasured::AtRest)];
    table.optional("gap_measured").map_or(Some(GapMeasured::Undeformed), |value| value.choice(&choices))
}

/// `gap_m` for both sides, or `gap_above_m` and `gap_below_m`; with a damper two linear stops.
fn read_two_sided(table: &Table<'_>) -> Option<ReadLaw> {
    let stiffness = required(table, "stiffness_n_m", &quantity::STIFFNESS);
    let damping = table.optional("damping_n_s_m").map_or(Some(0.0), |value| value.number(&quantity::DAMPER));
    let both = table.optional("gap_m");
    let each = ["gap_above_m", "gap_below_m"].map(|key| table.optional(key));
    if both.is_some() {
        for gap in each.iter().flatten() {
            let help = vec!["allowed: `gap_m` for both sides, or `gap_above_m` and `gap_below_m`".into()];
            gap.problem("a gap of one side is given besides `gap_m`".into(), help);
        }
    }
    let common = both.map_or(Some(0.0), |value| value.number(&quantity::GAP));
    let [above, below] = each.map(|gap| gap.map_or(common, |value| value.number(&quantity::GAP)));
    let measured = read_measured(table);
    let (stiffness_n_m, damping_n_s_m, measured) = (stiffness?, damping?, measured?);
    let (gap_above_m, gap_below_m) = (above?, below?);
    if damping_n_s_m == 0.0 {
        let gap_measured = measured;
        return Some(ReadLaw::One(StopLaw::TwoSided {
            stiffness_n_m,
            gap_above_m,
            gap_below_m,
            gap_measured,
        }));
    }
    let one = |(side, gap_m)| {
        let approach = Approach::Gap { gap_m, measured };
        StopLaw::Linear { stiffness_n_m, damping_n_s_m, approach, side }
    };
    Some(ReadLaw::Pair([(Side::Above, gap_above_m), (Side::Below, gap_below_m)].map(one)))
}

/// Any of three constants, at least one of which is there and not 0.
fn read_cubic(table: &Table<'_>) -> Option<StopLaw> {
    let constant = |key: &'static str, quantity: &Quantity| {
        table.optional(key).map_or(Some(0.0), |value| value.number(quantity))
    };
    let linear = constant("stiffness_n_m", &quantity::SIGNED_STIFFNESS);
    let quadratic = constant("stiffness_n_m2", &quantity::QUADRATIC_STIFFNESS);
    let cubic = constant("stiffness_n_m3", &quantity::CUBIC_STIFFNESS);
    let keys = ["stiffness_n_m3", "stiffness_n_m2", "stiffness_n_m"];
    let none = !keys.into_iter().any(|key| table.has(key));
    if [linear, quadratic, cubic] == [Some(0.0); 3] {
        let what = if none { "is missing in this stop" } else { "is 0 N/m^3, and there is no other term" };
        let help = "allowed: any number but zero for `stiffness_n_m3`, `stiffness_n_m2` or `stiffness_n_m`";
        table.problem("stiffness_n_m3", format!("`stiffness_n_m3` {what}"), vec![help.into()]);
        return None;
    }
    Some(StopLaw::Cubic { stiffness_n_m: linear?, stiffness_n_m2: quadratic?, stiffness_n_m3: cubic? })
}
