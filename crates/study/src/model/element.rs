//! Stops of a study as local elements, `r` positive towards the stop.

use hammerbeam_motion::{
    Law, LawError, Load, LocalElement,
    law::{LawPart, LawRest, LawSides, LawValues, RigidStop},
};
use hammerbeam_structure::{PointOutput, ReducedModel};

use crate::file::{Approach, FixedTo, GapMeasured, Place, Stop, StopRest, StopSide, StudyError, StudyFile};

use super::load::rest;

const KNOWN: &str = "the study knows the names of its structure";

/// Relative displacement of an element, `r = shape . q + support_ratios . u`.
#[derive(Debug, Clone)]
struct Relative {
    shape: Vec<f64>,
    support_ratios: Vec<f64>,
}

impl Relative {
    fn of(place: &Place, model: &ReducedModel) -> Self {
        let point = |name: &str| model.point(name).expect(KNOWN);
        match place {
            Place::At { point, fixed_to } | Place::Around { first: point, fixed_to: [fixed_to, _], .. } => {
                Self::at_point(point, *fixed_to, model)
            }
            Place::Between { first, second } => {
                let (first, second) = (point(first), point(second));
                let less = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect();
                Self {
                    shape: less(&first.shape, &second.shape),
                    support_ratios: less(&first.support_ratios, &second.support_ratios),
                }
            }
        }
    }

    fn at_point(name: &str, fixed_to: FixedTo, model: &ReducedModel) -> Self {
        let PointOutput { shape, support_ratios, .. } = model.point(name).expect(KNOWN).clone();
        let mut relative = Self { shape, support_ratios };
        if let FixedTo::Support(carrier) = fixed_to {
            relative.support_ratios[carrier] -= 1.0;
        }
        relative
    }

    /// In the second direction of a round hole; `None` of other stops.
    fn across(place: &Place, model: &ReducedModel) -> Option<Self> {
        let Place::Around { second, fixed_to: [_, fixed_to], .. } = place else { return None };
        Some(Self::at_point(second, *fixed_to, model))
    }

    fn towards(self, side: StopSide) -> Self {
        let turned = |values: &[f64]| values.iter().map(|value| -value).collect();
        match side {
            StopSide::Above => self,
            StopSide::Below => {
                Self { shape: turned(&self.shape), support_ratios: turned(&self.support_ratios) }
            }
        }
    }

    /// `r` at rest.
    fn at(&self, rest: &[f64]) -> f64 {
        self.shape.iter().zip(rest).map(|(shape, q)| shape * q).sum()
    }

    fn element(self, name: &str, law: Law) -> LocalElement {
        LocalElement { name: name.to_owned(), shape: self.shape, support_ratios: self.support_ratios, law }
    }
}

/// The elements of a stop by their numbers, each with the sign of its force in that on the stop.
pub(super) type ElementsOfStop = Vec<(usize, f64)>;

/// The local elements of all stops, and which of them are of each stop.
pub(super) fn elements(
    file: &StudyFile,
    model: &ReducedModel,
    load: &Load,
) -> Result<(Vec<LocalElement>, Vec<ElementsOfStop>), StudyError> {
    let rest = rest(load, model);
    let (mut elements, mut of_stops): (Vec<LocalElement>, Vec<ElementsOfStop>) = (Vec::new(), Vec::new());
    for stop in &file.study.stops {
        let key = format!("stop[{}]", stop.entry.number());
        let relative = Relative::of(&stop.place, model);
        if relative.shape.iter().all(|entry| *entry == 0.0) {
            return Err(immovable(file, &key));
        }
        if let Some(across) = Relative::across(&stop.place, model) {
            if across.shape.iter().all(|entry| *entry == 0.0) {
                return Err(immovable(file, &key));
            }
            let made = round_hole(stop, [relative, across]);
            let made = made.map_err(|error| file.fault(&key, error.to_string(), Vec::new()))?;
            of_stops.push(vec![(elements.len(), 1.0)]);
            elements.extend(made);
            continue;
        }
        let rest = match (stop.law.gap_measured(), &rest) {
            (GapMeasured::Undeformed, _) => &vec![0.0; model.dof()],
            (GapMeasured::AtRest, Ok(rest)) => rest,
            (GapMeasured::AtRest, Err(mode)) => return Err(no_rest(file, &key, *mode)),
        };
        let made = of_stop(stop, relative, rest);
        let made = made.map_err(|error| file.fault(&key, error.to_string(), Vec::new()))?;
        let (made, signs): (Vec<LocalElement>, Vec<f64>) = made.into_iter().unzip();
        if let Some(other) =
            made.iter().find_map(|one| elements.iter().find(|other| leave_no_room(one, other)))
        {
            return Err(no_room(file, &key, other));
        }
        of_stops.push((elements.len()..).zip(signs).collect());
        elements.extend(made);
    }
    Ok((elements, of_stops))
}

/// The two elements of a round hole.
fn round_hole(stop: &Stop, directions: [Relative; 2]) -> Result<[LocalElement; 2], LawError> {
    let (StopRest::Around { gap_m }, LawSides::One { build, .. }) =
        (stop.law.rest(), stop.law.description().sides)
    else {
        unreachable!("a stop around a point rests so, with a one-sided law")
    };
    let parts = build(LawValues(stop.law.values()), LawRest::Level(gap_m))?;
    let hole = parts.first().ok_or(LawError::NotForHole)?.law.in_round_hole()?;
    let directions = directions.map(|relative| (relative.shape, relative.support_ratios));
    Ok(LocalElement::round_hole(&stop.name, directions, hole))
}

/// Whether two rigid stops face each other and touch the point between them from both sides: stops on one
/// relative motion, whose shapes are the same but for their sign.
fn leave_no_room(one: &LocalElement, other: &LocalElement) -> bool {
    let level = |element: &LocalElement| element.law.rigid().map(RigidStop::level);
    let faces = |one: &[f64], other: &[f64]| one.iter().zip(other).all(|(a, b)| *a == -*b);
    let (Some(here), Some(there)) = (level(one), level(other)) else { return false };
    here + there <= 0.0
        && faces(&one.shape, &other.shape)
        && faces(&one.support_ratios, &other.support_ratios)
}

fn no_room(file: &StudyFile, key: &str, other: &LocalElement) -> StudyError {
    let message =
        format!("its point cannot move: it is at the rigid stop on the other side, \"{}\"", other.name);
    let help =
        vec!["allowed: a gap above 0 on one side at least; or the point held, and no stops there".into()];
    file.fault(key, message, help)
}

fn immovable(file: &StudyFile, key: &str) -> StudyError {
    let message = "the stop cannot act: the motion of its point is prescribed or held".to_owned();
    file.fault(key, message, vec!["allowed: a point that can move".into()])
}

fn no_rest(file: &StudyFile, key: &str, mode: usize) -> StudyError {
    let message = format!(
        "there is no rest position: a constant load drives rigid-body mode {}, which nothing restrains",
        mode + 1
    );
    file.fault(&format!("{key}.gap_measured"), message, vec!["allowed: gap_measured = \"undeformed\"".into()])
}

/// The elements of a stop, one as a rule, several where its law says so; each with the sign of its force in
/// that on the stop.
fn of_stop(stop: &Stop, relative: Relative, rest: &[f64]) -> Result<Vec<(LocalElement, f64)>, LawError> {
    let (law, values) = (&stop.law, LawValues(stop.law.values()));
    let (relative, parts) = match (law.rest(), law.description().sides) {
        (StopRest::OneSided { approach, side }, LawSides::One { build, .. }) => {
            let relative = relative.towards(side);
            let rests = match approach {
                Approach::Preload { preload_n } => LawRest::Preload(preload_n),
                Approach::Gap { gap_m, .. } => LawRest::Level(gap_m + relative.at(rest)),
            };
            (relative, build(values, rests)?)
        }
        (StopRest::TwoSided { gap_above_m, gap_below_m, .. }, LawSides::Two { build, .. }) => {
            let shift = relative.at(rest);
            (relative, build(values, [gap_above_m + shift, gap_below_m - shift])?)
        }
        (StopRest::Always, LawSides::Always { build }) => (relative, build(values)?),
        _ => unreachable!("a stop rests as its law is described"),
    };
    let element = |part: LawPart| {
        let turned = if part.is_turned { StopSide::Below } else { StopSide::Above };
        let name = format!("{}{}", stop.name, part.suffix);
        let sign = if part.is_turned { -1.0 } else { 1.0 };
        (relative.clone().towards(turned).element(&name, part.law), sign)
    };
    Ok(parts.into_iter().map(element).collect())
}
