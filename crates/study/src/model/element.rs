//! Stops of a study as local elements, `r` positive towards the stop.

use hammerbeam_motion::{
    Law, LawError, Load, LocalElement,
    law::{
        Degree, Formula, HertzStop, HuntCrossleyStop, LinearStop, PowerSpring, RestitutionModel,
        RestitutionStop, RigidStop, TwoSidedStop,
    },
};
use hammerbeam_structure::{PointOutput, ReducedModel};

use crate::file::{
    Approach, FixedTo, GapMeasured, HertzStiffness, ImpactModel, Place, Side, Stop, StopLaw, StudyError,
    StudyFile,
};

use super::load::rest;

/// Relative displacement of an element, `r = shape . q + support_ratios . u`.
#[derive(Debug, Clone)]
struct Relative {
    shape: Vec<f64>,
    support_ratios: Vec<f64>,
}

impl Relative {
    fn of(place: &Place, model: &ReducedModel) -> Self {
        let point = |name: &str| model.point(name).expect("the study knows the names of its structure");
        match place {
            Place::At { point: name, fixed_to } => {
                let PointOutput { shape, support_ratios, .. } = point(name).clone();
                let mut relative = Self { shape, support_ratios };
                if let FixedTo::Support(carrier) = fixed_to {
                    relative.support_ratios[*carrier] -= 1.0;
                }
                relative
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

    fn towards(self, side: Side) -> Self {
        let turned = |values: &[f64]| values.iter().map(|value| -value).collect();
        match side {
            Side::Above => self,
            Side::Below => Self { shape: turned(&self.shape), support_ratios: turned(&self.support_ratios) },
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

/// The local elements of all stops.
pub(super) fn elements(
    file: &StudyFile,
    model: &ReducedModel,
    load: &Load,
) -> Result<Vec<LocalElement>, StudyError> {
    let rest = rest(load, model);
    let mut elements = Vec::new();
    for stop in &file.study.stops {
        let key = format!("stop[{}]", stop.entry.number());
        let relative = Relative::of(&stop.place, model);
        if relative.shape.iter().all(|entry| *entry == 0.0) {
            return Err(immovable(file, &key));
        }
        let rest = match (stop.law.gap_measured(), &rest) {
            (GapMeasured::Undeformed, _) => &vec![0.0; model.dof()],
            (GapMeasured::AtRest, Ok(rest)) => rest,
            (GapMeasured::AtRest, Err(mode)) => return Err(no_rest(file, &key, *mode)),
        };
        let made = of_stop(stop, relative, rest);
        elements.extend(made.map_err(|error| file.fault(&key, error.to_string(), Vec::new()))?);
    }
    Ok(elements)
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

/// The element of a stop; two of them for a two-sided one that the sag has pushed past one of its springs.
fn of_stop(stop: &Stop, relative: Relative, rest: &[f64]) -> Result<Vec<LocalElement>, LawError> {
    let element = |relative: Relative, law| vec![relative.element(&stop.name, law)];
    Ok(match stop.law {
        StopLaw::Hertz { stiffness, approach, side } => {
            let relative = relative.towards(side);
            let law = hertz(stiffness.value(), approach, relative.at(rest))?;
            element(relative, Law::Hertz(law))
        }
        StopLaw::HuntCrossley { stiffness, loss_s_m, approach, side } => {
            let relative = relative.towards(side);
            let elastic = hertz(stiffness.value(), approach, relative.at(rest))?;
            element(relative, Law::HuntCrossley(HuntCrossleyStop::new(elastic, loss_s_m)?))
        }
        StopLaw::Restitution { model, stiffness, restitution, approach, side } => {
            let relative = relative.towards(side);
            let elastic = hertz(stiffness.value(), approach, relative.at(rest))?;
            let law = RestitutionStop::new(elastic, model.formula(), restitution)?;
            element(relative, Law::Restitution(law))
        }
        StopLaw::Linear { stiffness_n_m, damping_n_s_m, approach, side } => {
            let relative = relative.towards(side);
            let law = linear(stiffness_n_m, approach, relative.at(rest))?.with_damping(damping_n_s_m)?;
            element(relative, Law::Linear(law))
        }
        StopLaw::Rigid { restitution, approach, side } => {
            let relative = relative.towards(side);
            let gap = if let Approach::Gap { gap_m, .. } = approach { gap_m } else { 0.0 };
            let law = RigidStop::at_level(restitution, gap + relative.at(rest))?;
            element(relative, Law::Rigid(law))
        }
        StopLaw::TwoSided { stiffness_n_m, gap_above_m, gap_below_m, .. } => {
            let shift = relative.at(rest);
            let (above, below) = (gap_above_m + shift, gap_below_m - shift);
            if above >= 0.0 && below >= 0.0 {
                element(relative, Law::TwoSided(TwoSidedStop::new(stiffness_n_m, above, below)?))
            } else {
                let upper = Law::Linear(linear_at(stiffness_n_m, above)?);
                let lower = Law::Linear(linear_at(stiffness_n_m, below)?);
                let name = |side: &str| format!("{} ({side})", stop.name);
                let flipped = relative.clone().towards(Side::Below);
                vec![relative.element(&name("above"), upper), flipped.element(&name("below"), lower)]
            }
        }
        StopLaw::Cubic { stiffness_n_m, stiffness_n_m2, stiffness_n_m3 } => {
            let terms = [
                (stiffness_n_m3, Degree::Cubic, String::new()),
                (stiffness_n_m2, Degree::Quadratic, " (quadratic)".to_owned()),
                (stiffness_n_m, Degree::Linear, " (linear)".to_owned()),
            ];
            let element = |(stiffness, degree, word): (f64, Degree, String)| {
                let law = Law::Power(PowerSpring::new(stiffness, degree)?);
                Ok::<_, LawError>(relative.clone().element(&format!("{}{word}", stop.name), law))
            };
            let there = terms.into_iter().filter(|(stiffness, ..)| *stiffness != 0.0);
            return there.map(element).collect();
        }
        StopLaw::Formula { ref formula, ref constants } => {
            element(relative, Law::Formula(Formula::new(formula, constants)?))
        }
    })
}

fn hertz(stiffness: f64, approach: Approach, rest: f64) -> Result<HertzStop, LawError> {
    match approach {
        Approach::Preload { preload_n } => HertzStop::with_preload(stiffness, preload_n),
        Approach::Gap { gap_m, .. } => match gap_m + rest {
            level if level >= 0.0 => HertzStop::with_gap(stiffness, level),
            level => HertzStop::with_preload(stiffness, stiffness * (-level).powf(1.5)),
        },
    }
}

fn linear(stiffness: f64, approach: Approach, rest: f64) -> Result<LinearStop, LawError> {
    match approach {
        Approach::Preload { preload_n } => LinearStop::with_preload(stiffness, preload_n),
        Approach::Gap { gap_m, .. } => linear_at(stiffness, gap_m + rest),
    }
}

/// A spring that begins at `r = level`, which a preload expresses where it is negative.
fn linear_at(stiffness: f64, level: f64) -> Result<LinearStop, LawError> {
    if level >= 0.0 {
        LinearStop::with_gap(stiffness, level)
    } else {
        LinearStop::with_preload(stiffness, -stiffness * level)
    }
}

impl ImpactModel {
    /// The formula of the model.
    #[must_use]
    pub fn formula(self) -> RestitutionModel {
        match self {
            Self::HuntCrossley => RestitutionModel::HuntCrossley,
            Self::HerbertMcwhannell => RestitutionModel::HerbertMcWhannell,
            Self::LeeWang => RestitutionModel::LeeWang,
            Self::LankaraniNikravesh => RestitutionModel::LankaraniNikravesh,
            Self::Gonthier => RestitutionModel::Gonthier,
            Self::Flores => RestitutionModel::Flores,
            Self::HuGuo => RestitutionModel::HuGuo,
        }
    }
}

impl HertzStiffness {
    /// The constant [N/m^1.5].
    #[must_use]
    pub fn value(self) -> f64 {
        match self {
            Self::Given(stiffness) => stiffness,
            Self::Spheres { radii_m, moduli_pa, poisson_ratios } => {
                let radii = radii_m.map(|radius| radius.unwrap_or(f64::INFINITY));
                HertzStop::stiffness_of_spheres(radii, moduli_pa, poisson_ratios)
            }
        }
    }
}
