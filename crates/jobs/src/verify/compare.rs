//! When a stored solution and a recomputed one agree; the formulae stand in the module docs.

use hammerbeam_motion::{Law, LocalElement, System, general::ElementMaxima};
use hammerbeam_orbit::{BranchEventKind, PeriodicSolution};
use hammerbeam_results::row::Row;

use super::{
    claims::Claims,
    quantity::VerifiedQuantity,
    recompute::Recomputed,
    spectrum::{Multiplier, norm},
    unknown::{Unknown, behind_hard_contacts, touches_at_nodes},
};

/// How far a multiplier may be from where an event puts it: events are located to a part of the step, and
/// multipliers change fast there.
const EVENT: f64 = 1e-5;
/// Accuracy of the stored maxima beside that of the motion.
const FORCE: f64 = 1e-9;
const DISPLACEMENT: f64 = 1e-9;
const ACCELERATION: f64 = 1e-7;

/// A comparison: `difference` may be `tolerance` at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Comparison {
    pub(super) quantity: VerifiedQuantity,
    pub(super) stored: f64,
    pub(super) recomputed: f64,
    /// Over what it may be, in units of the tolerance.
    pub(super) difference: f64,
    /// Whether it is allowed for since a contact grazes.
    pub(super) grazing: bool,
}

/// The measures of an orbit by which differences are judged.
struct Measures {
    gain: f64,
    /// Largest relative displacement [m] and velocity [m/s] of an element that a unit of the relative state
    /// makes.
    contact: [f64; 2],
    /// Bound of the relative acceleration of an element just before it touches [m/s^2].
    approach: f64,
    /// What a unit of force accelerates the element by, of rigid stops [m/s^2/N].
    rigid: Vec<Option<f64>>,
    /// The same of the response point, and its acceleration [m/s^2].
    displacement: f64,
    acceleration: f64,
}

impl Measures {
    fn of(
        (system, response): (&System, &[f64]),
        scales: &[f64],
        frequency_hz: f64,
        found: &Recomputed,
    ) -> Self {
        let n = system.dof();
        let (lengths, velocities) = scales.split_at(n);
        let size = |shape: &[f64], scale: &dyn Fn(usize) -> f64| {
            shape.iter().enumerate().map(|(i, phi)| (phi * scale(i)).powi(2)).sum::<f64>().sqrt()
        };
        let stops = || system.elements().iter().filter(|element| !element.law.contacts().is_empty());
        let most = |scale: &dyn Fn(usize) -> f64| stops().map(|e| size(&e.shape, scale)).fold(0.0, f64::max);
        let frequencies = &system.model().natural_frequencies;
        Self {
            gain: found.gain,
            contact: [most(&|i| lengths[i]), most(&|i| velocities[i])],
            approach: most(&|i| frequencies[i] * velocities[i])
                + driven(system, frequency_hz)
                + pushed(system) * found.maxima.contact_force,
            rigid: system.elements().iter().map(mobility_if_rigid).collect(),
            displacement: size(response, &|i| lengths[i]),
            acceleration: size(response, &|i| frequencies[i] * velocities[i]),
        }
    }

    /// `g_v = 1 + V_r / v + W L_r / v^2`, for the velocity at a touch.
    ///
    /// A state that is wrong by `e` changes the penetration by `L_r e` and its velocity by `V_r e`. The
    /// touch, where the penetration is zero, comes earlier or later by `L_r e / v`, over which the
    /// acceleration, `W` at most, changes the velocity by `W L_r e / v`. So `|dv| <= (V_r + W L_r / v) e`.
    /// `W` is what a state of size one, all loads (a weight among them) and the largest force of another
    /// element make of it. A weak touch need not be one of a shallow contact: where a deep contact just
    /// opens, the flight between is as low as `v^2 / 2 W` and the penetration behind the touch as deep as
    /// ever, and says nothing of `v`.
    fn touch_factor(&self, impact: f64) -> f64 {
        let [length, velocity] = self.contact;
        1.0 + velocity / impact + self.approach * length / (impact * impact)
    }

    /// `g = 1 + min(g_v - 1, L_r / p)`, for what the contacts of an element do, by its own impacts and its
    /// own deepest penetration: its force follows the penetration, which is wrong by `L_r e` of `p`. A rigid
    /// stop that holds the structure presses with what keeps it from being accelerated, a difference of what
    /// makes `W`, over the mobility m: `W / (m F)` more, and that alone where nothing strikes it.
    fn contact_factor(&self, (rigid, element): (Option<f64>, &ElementMaxima)) -> f64 {
        let struck = self.struck_factor(element);
        match rigid {
            Some(mobility) if element.contact_force > 0.0 => {
                let struck = if element.impact_velocity > 0.0 { struck } else { 1.0 };
                struck + self.approach / (mobility * element.contact_force)
            }
            _ => struck,
        }
    }

    fn struck_factor(&self, element: &ElementMaxima) -> f64 {
        1.0 + (self.touch_factor(element.impact_velocity) - 1.0).min(self.contact[0] / element.deepest)
    }

    /// The factor of the element in which something is largest; `None` if it is zero in all.
    fn factor_of_largest(&self, found: &Recomputed, of: impl Fn(&ElementMaxima) -> f64) -> Option<f64> {
        let largest = self.elements(found).max_by(|a, b| of(a.1).total_cmp(&of(b.1)))?;
        (of(largest.1) > 0.0).then(|| self.contact_factor(largest))
    }

    /// `sum_j g_j J_j`.
    fn impulse(&self, found: &Recomputed) -> f64 {
        let pushing = self.elements(found).filter(|(_, element)| element.impulse > 0.0);
        let factor = |(rigid, element): (Option<f64>, &ElementMaxima)| {
            if element.impact_velocity > 0.0 {
                self.struck_factor(element)
            } else {
                self.contact_factor((rigid, element))
            }
        };
        pushing.map(|element| factor(element) * element.1.impulse).sum()
    }

    fn elements<'f>(&self, found: &'f Recomputed) -> impl Iterator<Item = (Option<f64>, &'f ElementMaxima)> {
        self.rigid.iter().copied().zip(&found.of_elements)
    }
}

fn mobility_if_rigid(element: &LocalElement) -> Option<f64> {
    element.law.rigid().map(|_| element.shape.iter().map(|phi| phi * phi).sum())
}

/// Largest relative acceleration of an element that the loads and the supports make [m/s^2].
fn driven(system: &System, frequency_hz: f64) -> f64 {
    let circular = std::f64::consts::TAU * frequency_hz;
    let of_element = |element: &LocalElement| -> f64 {
        let orders = system.orders().iter().enumerate().map(|(index, &order)| {
            let load = system.modal_load(index, circular).amplitude;
            let modal: faer::c64 = load.iter().zip(&element.shape).map(|(b, phi)| *b * *phi).sum();
            let rate = (f64::from(order) * circular).powi(2);
            let moved = system.support_amplitudes(index, circular);
            let carried = moved.iter().zip(&element.support_ratios);
            modal.norm() + carried.map(|((u, _), ratio)| ratio.abs() * (u.norm() * rate)).sum::<f64>()
        });
        orders.sum()
    };
    system.elements().iter().map(of_element).fold(0.0, f64::max)
}

/// Largest relative acceleration that a unit of force in each of the other elements makes of one [m/s^2/N].
fn pushed(system: &System) -> f64 {
    let elements = system.elements();
    let product = |a: &LocalElement, b: &LocalElement| -> f64 {
        a.shape.iter().zip(&b.shape).map(|(a, b)| a * b).sum::<f64>().abs()
    };
    let of_others = |k: usize| -> f64 {
        let others = elements.iter().enumerate().filter(|(j, _)| *j != k);
        others.map(|(_, other)| product(&elements[k], other)).sum()
    };
    (0..elements.len()).map(of_others).fold(0.0, f64::max)
}

/// Every comparison of a solution.
///
/// * `(row, claims, solution)`: what tables show, what is claimed to happen there, and the solution.
/// * `sensitivity`: how much the monodromy matrix changes with the first node, as far as that is wanted.
pub(super) fn compare(
    (system, response): (&System, &[f64]),
    (row, claims, solution): (&Row, Claims, &PeriodicSolution),
    scales: &[f64],
    found: &Recomputed,
    (tolerance, sensitivity): (f64, f64),
) -> Vec<Comparison> {
    let measures = Measures::of((system, response), scales, solution.frequency_hz, found);
    let mut list = vec![plain(VerifiedQuantity::Residual, solution.residual, found.residual, found.residual)];
    let margin = tolerance * found.gain * measures.contact[0];
    let rigid = nearest(system, found, |law| law.rigid().is_some());
    let damped = nearest(system, found, |law| law.onset_damping() > 0.0);
    let slowest = (2.0 * measures.approach * margin).sqrt();
    let slow = if damped <= margin { slowest } else { 0.0 };
    let cut = touches_at_nodes(system, solution, margin);
    let unknown = Unknown::of((system, response), found, (margin, slow), &cut);
    maxima(row, (solution, found), (&measures, unknown), &mut list);
    let grazing = found.extrema.iter().filter(|extremum| extremum.abs() <= margin).count();
    let turned = found.kinks.iter().filter(|(_, penetration)| penetration.abs() <= margin).count();
    // Where it grazes the motion may cross the level again and again within rounding.
    let crossed = match grazing {
        0 => 0,
        _ => found.touches.iter().filter(|speed| **speed <= slowest).count(),
    };
    list.push(contacts(row, found, grazing + crossed + turned + cut.len()));
    // At a damper multipliers jump on the row of the grazing, which lies where the grazing was located.
    let (damped_row, located) = if claims.events.has(BranchEventKind::Grazing) {
        (damped.min(nearest_kink(system, found)), margin.max(EVENT * measures.contact[0]))
    } else {
        (f64::INFINITY, margin)
    };
    let jumps = rigid.min(damped) <= margin || damped_row <= located;
    let unknown_matrix = sensitivity + behind_hard_contacts(system, scales, found) / tolerance;
    let of_multipliers = multipliers(solution, found, unknown_matrix).into_iter();
    list.extend(of_multipliers.map(|found| Comparison { grazing: jumps, ..found }));
    list.extend(leading(row, solution));
    // Behind grazing on a rigid stop everything varies like the root of the distance from it. Where an impact
    // comes just as a contact opens or closes that remembers how it began, the motion itself jumps: the
    // contact goes on, or begins anew.
    let begins_anew = |(element, penetration): &(usize, f64)| {
        penetration.abs() <= margin && system.elements()[*element].law.remembers_impact()
    };
    let jumps_itself = found.kinks.iter().any(begins_anew);
    if jumps_itself || grazing > 0 && system.has_rigid_stops() {
        list.iter_mut().for_each(|comparison| comparison.grazing = true);
    }
    let unknown = tolerance * (1.0 + norm(&found.monodromy) + unknown_matrix);
    // Beside a rigid stop multipliers are far outside the unit circle.
    list.extend(events(claims, found, &measures, (unknown, rigid.min(damped_row))));
    list
}

/// Least distance from grazing [m] of the contacts of some laws.
fn nearest(system: &System, found: &Recomputed, of: impl Fn(&Law) -> bool) -> f64 {
    let elements = system.elements().iter().zip(&found.of_elements);
    let nearest = elements.filter(|(element, _)| of(&element.law)).map(|(_, maxima)| maxima.nearest);
    nearest.fold(f64::INFINITY, f64::min)
}

/// Least distance [m] from the level of a contact with a damper at which an impact elsewhere turns it.
fn nearest_kink(system: &System, found: &Recomputed) -> f64 {
    let damped = |e: usize| system.elements()[e].law.onset_damping() > 0.0;
    let kinks = found.kinks.iter().filter(|(element, _)| damped(*element));
    kinks.map(|(_, penetration)| penetration.abs()).fold(f64::INFINITY, f64::min)
}

fn plain(quantity: VerifiedQuantity, stored: f64, recomputed: f64, difference: f64) -> Comparison {
    Comparison { quantity, stored, recomputed, difference, grazing: false }
}

fn maxima(
    row: &Row,
    (solution, found): (&PeriodicSolution, &Recomputed),
    (measures, unknown): (&Measures, Unknown),
    list: &mut Vec<Comparison>,
) {
    let (stored, new) = (&row.maxima, &found.maxima);
    let pressed = measures.factor_of_largest(found, |element| element.contact_force);
    // Where nothing presses, what jumps at an impact has made the motion.
    let struck = || measures.factor_of_largest(found, |element| element.impact_velocity);
    let factor = pressed.or_else(struck).unwrap_or(1.0);
    let mut push = |quantity, stored: f64, new: f64, measure: f64| {
        // Without a contact both are zero.
        let difference = if stored == new { 0.0 } else { (stored - new).abs() / (measures.gain * measure) };
        list.push(plain(quantity, stored, new, difference));
    };
    push(
        VerifiedQuantity::Displacement,
        stored.displacement,
        new.displacement,
        new.displacement.max(measures.displacement),
    );
    let acceleration = (factor * new.acceleration).max(measures.acceleration);
    let is_known = (stored.acceleration - new.acceleration).abs() > unknown.acceleration;
    let measure = if is_known { acceleration } else { f64::INFINITY };
    push(VerifiedQuantity::Acceleration, stored.acceleration, new.acceleration, measure);
    let is_none = stored.contact_force.max(new.contact_force) <= unknown.force;
    let measure = if is_none { f64::INFINITY } else { factor * new.contact_force };
    push(VerifiedQuantity::ContactForce, stored.contact_force, new.contact_force, measure);
    let [struck, touched] =
        [stored.impact_velocity, new.impact_velocity].map(|speed| speed.max(unknown.touch_at_node));
    // Whether a contact that grazes is touched at all is rounding.
    let speed = if touched > 0.0 { touched } else { struck };
    let touch = if speed > 0.0 { measures.touch_factor(speed) } else { 1.0 };
    let measure = if struck.max(touched) <= unknown.speed { f64::INFINITY } else { touch * speed };
    push(VerifiedQuantity::ImpactVelocity, struck, touched, measure);
    let period = f64::from(solution.period_multiple) / solution.frequency_hz;
    let is_none = is_none && stored.impulse.max(new.impulse) <= unknown.force * period;
    let measure = if is_none { f64::INFINITY } else { measures.impulse(found) };
    push(VerifiedQuantity::Impulse, stored.impulse, new.impulse, measure);
}

/// As many contacts may come or go as graze, or are touched where the orbit is cut. Of a motion that grazes
/// touches so slow that they come no deeper than what is known of the penetration count, too.
fn contacts(row: &Row, found: &Recomputed, grazing: usize) -> Comparison {
    let (stored, new) = (row.maxima.contacts, found.maxima.contacts);
    let missing = stored.abs_diff(new);
    let allowed = missing > 0 && missing as usize <= grazing;
    Comparison {
        grazing: allowed,
        ..plain(
            VerifiedQuantity::Contacts,
            stored.into(),
            new.into(),
            if missing > 0 { f64::INFINITY } else { 0.0 },
        )
    }
}

/// * `unknown`: of the monodromy matrix, over the tolerance.
fn multipliers(solution: &PeriodicSolution, found: &Recomputed, unknown: f64) -> Vec<Comparison> {
    let mut left = found.multipliers.clone();
    let mut list = Vec::new();
    for (index, [re, im]) in solution.floquet_multipliers.iter().enumerate() {
        let stored = faer::c64::new(*re, *im);
        let distance = |k: usize, left: &[Multiplier]| (left[k].value - stored).norm();
        let nearest = (0..left.len()).min_by(|a, b| distance(*a, &left).total_cmp(&distance(*b, &left)));
        let Some(nearest) = nearest else { break };
        let error = distance(nearest, &left);
        let multiplier = left.swap_remove(nearest);
        // One that is called marginal lies on the circle here, too.
        let is_marked = solution.on_circle.get(index).is_some_and(|on| *on);
        let error = if is_marked { error.max((multiplier.value.norm() - 1.0).abs()) } else { error };
        let measure = multiplier.condition * (1.0 + norm(&found.monodromy) + unknown);
        let difference = if error.is_nan() { f64::INFINITY } else { error / measure };
        let (stored, new) = (stored.norm(), multiplier.value.norm());
        list.push(plain(VerifiedQuantity::Multipliers, stored, new, difference));
    }
    if solution.floquet_multipliers.len() != found.multipliers.len() {
        let counts = (solution.floquet_multipliers.len() as f64, found.multipliers.len() as f64);
        list.push(plain(VerifiedQuantity::Multipliers, counts.0, counts.1, f64::INFINITY));
    }
    list
}

/// What the row says of the multipliers is what is stored of them.
fn leading(row: &Row, solution: &PeriodicSolution) -> Option<Comparison> {
    let [re, im] = solution.floquet_multipliers.first().copied().unwrap_or_default();
    let same = row.leading_multiplier == [re, im.abs()] && row.stability == solution.stability();
    let [row_re, row_im] = row.leading_multiplier;
    (!same).then(|| plain(VerifiedQuantity::Multipliers, row_re.hypot(row_im), re.hypot(im), f64::INFINITY))
}

/// Where each event puts a multiplier, apart from what is not known of it; a grazing has an extremum of a
/// penetration at zero.
///
/// * `(unknown, jump)`: how well multipliers are known, for one of condition one, and how near a contact is
///   to a grazing at which they jump: from one side of the place of such an event to the other, so that none
///   need be there.
fn events(
    claims: Claims,
    found: &Recomputed,
    measures: &Measures,
    (unknown, jump): (f64, f64),
) -> Vec<Comparison> {
    let nearest = |distance: &dyn Fn(faer::c64) -> f64| {
        let distances = found
            .multipliers
            .iter()
            .map(|multiplier| (distance(multiplier.value) - unknown * multiplier.condition).max(0.0));
        distances.fold(f64::INFINITY, f64::min)
    };
    let kinks = found.kinks.iter().map(|(_, penetration)| penetration);
    let touch = found.extrema.iter().chain(kinks).map(|turn| turn.abs()).fold(f64::INFINITY, f64::min);
    let jumps = jump <= EVENT * measures.contact[0];
    let mut list = Vec::new();
    let mut claim = |distance: f64| {
        list.push(plain(VerifiedQuantity::Events, 0.0, distance, distance));
    };
    use BranchEventKind::{Flip, Fold, Grazing, NeimarkSacker};
    for kind in [Fold, Flip, NeimarkSacker].into_iter().filter(|kind| claims.events.has(*kind) && !jumps) {
        claim(nearest(&|m| claims.off_place(kind, m)));
    }
    if claims.events.has(Grazing) {
        claim(touch / measures.contact[0]);
    }
    list
}

/// Bound of the difference of a quantity.
pub(super) fn bound(quantity: VerifiedQuantity, tolerance: f64) -> f64 {
    match quantity {
        VerifiedQuantity::Events => EVENT.max(tolerance),
        VerifiedQuantity::Displacement => DISPLACEMENT.max(tolerance),
        VerifiedQuantity::ContactForce => FORCE.max(tolerance),
        VerifiedQuantity::Acceleration => ACCELERATION.max(tolerance),
        _ => tolerance,
    }
}
