//! The *reopening* of a contact: at an internal minimum of its penetration it loses its pressure for an
//! instant, and closes again at once. Equation (G12) of the book, `docs/theory`.
//!
//! An impact-speed-dependent law loses `C r'/v` of its force, with the speed v of the impact. Where the
//! penetration of a contact has a minimum of zero, the orbits on one side keep the old v. On the other side
//! the contact opens for an instant and starts anew, with a v next to zero. Then it can hardly be pressed in,
//! since the force grows like one over v: it acts like a rigid stop without rebound. The motion jumps from
//! one side to the other, so a branch that comes there ends, from either side:
//!
//! - a contact has a minimum of its penetration below [`NEARLY_OPEN`] of its maximum, and comes to more than
//!   [`IS_DEEP`] of that behind it;
//! - a contact starts with less than [`HARDLY_STRIKES`] of the largest speed of an impact, and yet its force
//!   comes to more than [`PRESSES`] of the largest. (One that just grazes has next to no force.)
//!
//! **How the branch gets there from the side where the contact has opened.** A contact that starts with a
//! small v and is pressed on with the force P has `k p^1.5 (1 + C p'/v) = P`, inertia apart, so `p^2.5 = 5/2
//! P v t/(k C)` after the time t. A flight of the height h ends with the speed `v = sqrt(2 a h)`. So p, and
//! with it all that follows, goes like `h^(1/5)`: the map over a period has a part `u h^(1/5)`, and the
//! periodic orbits obey `h = b (f - f*) + c h^(1/5)` near the border. There `h^(1/5)` is large beside h: **h
//! goes like `(f - f*)^5`, and the largest multiplier like `h^(-4/5)`, which is `(f - f*)^-4`**. The branch
//! ends at a finite frequency `f*` in an orbit that presses without penetration, with a multiplier that has
//! no bound. It cannot be computed up to there: a state is rounded by `eps`, so its image is by `eps` times
//! the multiplier. Where that is more than the tolerance of the shooting, steps shrink to nothing although
//! `f*` is not reached. A walk with [`SHORT_STEPS`] short steps is therefore checked for a reopening of its
//! orbit's contacts, and ends at one.
//!
//! Before steps are that short they may make no progress, and the side of the border on which a row lies is
//! no longer resolved: the general integrator finds another motion. So an orbit whose largest multiplier is
//! beyond [`UNRESOLVED`] and whose contact starts with next to no speed is the end, too.
//!
//! Steps of the path need not be short there, while steps of the motion are. The sensitivities of a force
//! that goes like `1/v` round by so much that no step of the motion within the contact seems good enough, and
//! an evaluation takes thousands of them instead of some. Where a point took more than
//! [`MOST_STEPS_AT_TOUCH`] of them for each touch, a contact that starts with next to no speed is the end as
//! well. There the work shows that it presses, so it need not come to [`PRESSES`], only to [`JUST_PRESSES`]
//! of the largest force.

use hammerbeam_motion::{
    Stretch, System,
    exact::{ContactPiece, ExactIntegrator, MotionError},
};

/// So many short steps that longer ones have not made up for raise the question, and as many more raise it
/// again: a fold is passed with a few, a reopening is approached with no other.
pub(crate) const SHORT_STEPS: u64 = 50;

/// Steps of the motion for each touch of an orbit, on the average of the evaluations of a step of the path
/// and in the evaluation of the orbit itself; some ten are usual.
pub(crate) const MOST_STEPS_AT_TOUCH: u64 = 500;

/// Largest multiplier up to which an orbit beside a reopening is distinguished from the one on its other
/// side. In three systems the general integrator took the motion on the other side from 7e7, 1.1e8 and 7e8
/// on.
pub(crate) const UNRESOLVED: f64 = 2e7;

/// Least penetration within a contact, over its largest.
const NEARLY_OPEN: f64 = 1e-3;
/// Speed of an impact, over the largest.
const HARDLY_STRIKES: f64 = 1e-3;
/// Force of a contact, over the largest.
const PRESSES: f64 = 1e-2;
/// The same where the work of the motion shows besides that the contact presses. One that grazes with
/// [`HARDLY_STRIKES`] of the largest speed comes to that to the power of 6/5, 2.5e-4.
const JUST_PRESSES: f64 = 1e-3;
/// Penetration behind the place at which a contact reopens, over the largest: at [`PRESSES`] of the largest
/// force, `0.01^(2/3)`. What comes less deep hardly presses, whether a new contact starts or not.
const IS_DEEP: f64 = 0.0464;
/// Penetration, over the displacements of the modes at the start of the contact, whose minima are rounding.
const SHALLOW: f64 = 1e-9;
/// Places at which the penetration is read in a contact, and again around its least value.
const READINGS: usize = 256;
/// Closer looks, each by the factor `READINGS/2`.
const LOOKS: usize = 3;

/// Names of the elements of impact-speed-dependent laws whose contacts are not touched as often as they were.
///
/// * `before`, `now`: touches of each contact, in the order of elements and their contacts.
pub(crate) fn elements_with_other_touches(system: &System, before: &[u32], now: &[u32]) -> Vec<String> {
    let mut pairs = before.iter().zip(now);
    let changed = system.elements().iter().filter(|element| {
        let contacts = element.law.contacts().len();
        let differs = pairs.by_ref().take(contacts).filter(|(before, now)| before != now).count() > 0;
        differs && element.law.remembers_impact()
    });
    changed.map(|element| element.name.clone()).collect()
}

/// Where a contact opens and is pressed on again.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reopening {
    /// Name of the local element.
    pub element: String,
    /// Phase of the excitation, from 0 to 1 [cycles].
    pub phase: f64,
}

/// The first reopening of an orbit of `cycles` that starts at a phase with a state.
///
/// # Errors
/// [`MotionError`] if the motion cannot be followed.
pub(crate) fn find(
    integrator: &mut ExactIntegrator,
    (start, state): (f64, Vec<f64>),
    (frequency_hz, cycles): (f64, f64),
) -> Result<Option<Reopening>, MotionError> {
    let stretch = Stretch { frequency_hz, start, end: start + cycles };
    let contacts = contacts_that_remember(integrator, &stretch, &state)?;
    for piece in &contacts {
        let Some(touch) = &piece.begin else { continue };
        let (from, to) = (touch.time, piece.end.unwrap_or(cycles / frequency_hz));
        // One that just grazes has next to no force, and minima of rounding.
        if !presses(piece, &contacts, PRESSES) {
            continue;
        }
        let reopening_time = if starts_slowly(piece, &contacts) {
            Some(from)
        } else {
            nearly_opens(integrator, &stretch, &state, piece, (from, to))?
        };
        if let Some(time) = reopening_time {
            return Ok(Some(reopening(integrator, piece, start + time * frequency_hz)));
        }
    }
    Ok(None)
}

/// The first contact of an orbit that starts with next to no speed and is pressed on.
///
/// # Errors
/// [`MotionError`] if the motion cannot be followed.
pub(crate) fn find_slow_start(
    integrator: &mut ExactIntegrator,
    (start, state): (f64, Vec<f64>),
    (frequency_hz, cycles): (f64, f64),
) -> Result<Option<Reopening>, MotionError> {
    let stretch = Stretch { frequency_hz, start, end: start + cycles };
    let contacts = contacts_that_remember(integrator, &stretch, &state)?;
    let reopens =
        |piece: &&ContactPiece| presses(piece, &contacts, JUST_PRESSES) && starts_slowly(piece, &contacts);
    let first = contacts.iter().filter(|piece| piece.begin.is_some()).find(reopens);
    Ok(first.map(|piece| {
        let time = piece.since();
        reopening(integrator, piece, start + time * frequency_hz)
    }))
}

/// Contacts of the elements of impact-speed-dependent laws.
fn contacts_that_remember(
    integrator: &mut ExactIntegrator,
    stretch: &Stretch,
    state: &[f64],
) -> Result<Vec<ContactPiece>, MotionError> {
    let contacts = integrator.trace(stretch, state, &[])?.contacts;
    let elements = integrator.system().elements();
    Ok(contacts.into_iter().filter(|piece| elements[piece.element].law.remembers_impact()).collect())
}

fn reopening(integrator: &ExactIntegrator, piece: &ContactPiece, phase: f64) -> Reopening {
    let element = integrator.system().elements()[piece.element].name.clone();
    Reopening { element, phase: phase.rem_euclid(1.0) }
}

/// Whether the force of a contact is more than this share of the largest of its element.
fn presses(piece: &ContactPiece, all: &[ContactPiece], share: f64) -> bool {
    piece.peak_force > share * largest_of(piece, all, |piece| piece.peak_force)
}

/// Whether a contact starts with next to no speed.
fn starts_slowly(piece: &ContactPiece, all: &[ContactPiece]) -> bool {
    let speed = |piece: &ContactPiece| piece.begin.as_ref().map_or(0.0, |touch| touch.velocity.abs());
    speed(piece) < HARDLY_STRIKES * largest_of(piece, all, speed)
}

/// The largest that the contacts of the element of one of them have.
fn largest_of(piece: &ContactPiece, all: &[ContactPiece], of: impl Fn(&ContactPiece) -> f64) -> f64 {
    all.iter().filter(|other| other.element == piece.element).map(of).fold(0.0, f64::max)
}

/// When the penetration of a contact has a minimum next to zero.
fn nearly_opens(
    integrator: &mut ExactIntegrator,
    stretch: &Stretch,
    state: &[f64],
    piece: &ContactPiece,
    (mut from, mut to): (f64, f64),
) -> Result<Option<f64>, MotionError> {
    let mut deepest = 0.0_f64;
    let mut least = None;
    for look in 0..LOOKS {
        let times: Vec<f64> =
            (1..READINGS).map(|k| from + (to - from) * k as f64 / READINGS as f64).collect();
        let depths = penetrations(integrator, stretch, state, piece, &times)?;
        let largest = |depths: &[f64]| depths.iter().copied().fold(0.0_f64, f64::max);
        deepest = deepest.max(largest(&depths));
        let is_deep_behind = |k: usize| look > 0 || largest(&depths[k..]) > IS_DEEP * deepest;
        let minima = (1..depths.len() - 1)
            .filter(|&k| depths[k] <= depths[k - 1] && depths[k] < depths[k + 1] && is_deep_behind(k));
        let Some(k) = minima.min_by(|&a, &b| depths[a].total_cmp(&depths[b])) else { break };
        least = Some((depths[k], times[k]));
        (from, to) = (times[k - 1], times[k + 1]);
    }
    let shape = &integrator.system().elements()[piece.element].shape;
    let state = piece.begin.iter().flat_map(|touch| &touch.state);
    let modal: f64 = shape.iter().zip(state).map(|(phi, q)| (phi * q).abs()).sum();
    let is_resolved = deepest > SHALLOW * modal;
    Ok(least.filter(|(depth, _)| is_resolved && *depth < NEARLY_OPEN * deepest).map(|(_, time)| time))
}

/// Penetrations of a contact at some times since the start of the stretch.
fn penetrations(
    integrator: &mut ExactIntegrator,
    stretch: &Stretch,
    state: &[f64],
    piece: &ContactPiece,
    times: &[f64],
) -> Result<Vec<f64>, MotionError> {
    let phases: Vec<f64> = times.iter().map(|time| stretch.start + time * stretch.frequency_hz).collect();
    let samples = integrator.trace(stretch, state, &phases)?.samples;
    let system = integrator.system();
    let contact = system.elements()[piece.element].law.contacts()[piece.contact];
    let depth = |(phase, state): (&f64, &Vec<f64>)| {
        let [displacement, ..] = system.relative_motion(piece.element, stretch.frequency_hz, *phase, state);
        contact.sign * (displacement - contact.level)
    };
    Ok(phases.iter().zip(&samples).map(depth).collect())
}

#[cfg(test)]
mod tests {
    use hammerbeam_motion::{
        Harmonic, Law, Load, LocalElement, System,
        exact::ExactSettings,
        law::{HertzStop, RestitutionModel, RestitutionStop},
    };
    use hammerbeam_structure::{ReducedModel, SupportInput};

    use super::*;

    /// The stop is so soft that the support alone moves the contact: `r = - cos 2 pi x - cos(4 pi x)/2`,
    /// which has maxima of 3/4 around a minimum of 1/2 at the phase 1/2.
    fn phase_of_reopening(gap: f64) -> Option<f64> {
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: faer::mat![[0.2]],
            points: vec![],
            supports: vec![SupportInput { inertia: vec![0.0], damping: vec![0.0] }],
            uniform_acceleration: vec![0.0],
        };
        let harmonic = |order, amplitude| Harmonic { order, amplitude, phase: 0.0 };
        let load = Load { support: vec![harmonic(1, -1.0).into(), harmonic(2, -0.5).into()], forces: vec![] };
        let elastic = HertzStop::with_gap(1e-12, gap).unwrap();
        let law = RestitutionStop::new(elastic, RestitutionModel::LankaraniNikravesh, 0.7).unwrap();
        let law = Law::Restitution(law);
        let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratios: vec![1.0], law };
        let system = System::new(model, &load, vec![stop]).unwrap();
        let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
        let found = find(&mut integrator, (0.0, vec![0.0, 0.0]), (1.0, 1.0)).unwrap();
        assert!(found.iter().all(|reopening| reopening.element == "stop"));
        found.map(|reopening| reopening.phase)
    }

    #[test]
    fn a_contact_that_nearly_opens_or_has_just_opened_is_found_and_no_other() {
        // The largest penetration is 1/4.
        for gap in [0.49, 0.4990, 0.51, 0.6] {
            assert_eq!(phase_of_reopening(gap), None, "{gap}");
        }
        for gap in [0.4999, 0.5 - 1e-7, 0.5 + 1e-7] {
            let phase = phase_of_reopening(gap).unwrap();
            assert!((phase - 0.5).abs() < 1e-3, "{gap}: {phase}");
        }
    }
}
