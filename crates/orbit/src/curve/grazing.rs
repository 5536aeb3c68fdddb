//! A contact that is touched with zero velocity: conditions at the node where the orbit is cut.
//!
//! `sign (r - level) = 0` and `r' = 0` with `r = phi . q + s u(x)`, both over the scale of the orbit; `s u`
//! is the sum over the supports. Their derivatives: by the state `phi`; by the phase `r'/f` and `r''/f` as
//! far as `u` has them; by the frequency the derivatives of `s u` and `s u'` at a fixed phase; by the
//! excitation scale `a` the derivatives of `u` over `a`; by the gap `-1` in the first.
//!
//! An open contact is touched from outside, where its clearance is least; a closed one from inside, where its
//! penetration is. A law whose force depends on the velocity opens where its force vanishes, with
//! penetration: the touch from inside is none of its grazings. A rigid stop is never closed for a while
//! without holding.

use hammerbeam_motion::{Parameter, Stretch, exact::MotionError};

use super::{
    linear::Linear,
    shooting::{CurveOrbit, Shooting},
    touched::Touch,
};
use crate::OrbitError;

/// Looks for the touch per excitation period.
const LOOKS: usize = 2000;
/// By how much the opposite contact of a symmetric orbit is further from grazing, in parts of the orbit, and
/// how well half a period is met [cycles].
const OPPOSITE: f64 = 1e-6;
/// Farthest from grazing that the contact of a grazing orbit is, as it was located before, in parts of the
/// orbit.
const FARTHEST: f64 = 1e-2;

/// Where the clearance of a contact turns.
#[derive(Debug, Clone)]
pub(super) struct Turn {
    pub phase: f64,
    pub state: Vec<f64>,
    /// How far that is from grazing [m].
    distance: f64,
    from_inside: bool,
}

impl Touch {
    /// The contact of that number, in the order of the elements and their contacts.
    fn of_contact(shooting: &Shooting, number: usize) -> Option<Self> {
        let elements = shooting.integrator.system().elements().iter().enumerate();
        elements
            .flat_map(|(e, element)| (0..element.law.contacts().len()).map(move |contact| (e, contact)))
            .nth(number)
            .map(|(element, contact)| Self { element, contact, from_inside: false })
    }

    /// Whether it belongs to a round hole: its clearance is no row of the state, and no curve of its grazings
    /// is followed.
    fn is_of_hole(self, shooting: &Shooting) -> bool {
        shooting.integrator.system().elements()[self.element].law.round_hole().is_some()
    }

    /// Its number in the order of the elements and their contacts.
    pub fn number(self, shooting: &Shooting) -> usize {
        let before = &shooting.integrator.system().elements()[..self.element];
        before.iter().map(|element| element.law.contacts().len()).sum::<usize>() + self.contact
    }

    /// Values, gradients by `[nodes; f; p; x]`, and the test `r''`.
    ///
    /// # Errors
    /// [`MotionError::Parameter`]: the structure cannot be built with a neighbouring value of the parameter.
    pub fn evaluate(self, shooting: &mut Shooting, place: &CurveOrbit) -> Result<Linear, MotionError> {
        let scales = shooting.scale.values().to_vec();
        let n = scales.len() / 2;
        let state: Vec<f64> = place.nodes.iter().zip(&scales).map(|(x, s)| x * s).collect();
        let at = (place.frequency_hz, place.phase);
        let by_family = shooting.integrator.clearance_by_family((self.element, self.contact), at, &state)?;
        let system = shooting.integrator.system();
        let element = &system.elements()[self.element];
        let contact = element.law.contacts()[self.contact];
        let [r, speed, acceleration] =
            system.relative_motion(self.element, place.frequency_hz, place.phase, &state);
        let carried = system.carried(&element.support_ratios, place.frequency_hz, place.phase);
        let unit = scales[2 * n - 1];
        // The slowest mode has the largest displacement.
        let length = scales[..n].iter().copied().fold(0.0, f64::max);
        let (f, sign) = (place.frequency_hz, contact.sign);
        let nodes = place.nodes.len();
        let mut rows = vec![vec![0.0; nodes + 3]; 2];
        for i in 0..n {
            rows[0][i] = sign * element.shape[i] * scales[i] / length;
            rows[1][n + i] = sign * element.shape[i] * scales[n + i] / unit;
        }
        let by_frequency = system.carried_by_frequency(&element.support_ratios, f, place.phase);
        rows[0][nodes] = sign * by_frequency[0] / length;
        rows[1][nodes] = sign * by_frequency[1] / unit;
        rows[0][nodes + 2] = sign * carried[1] / f / length;
        rows[1][nodes + 2] = sign * carried[2] / f / unit;
        match shooting.parameter {
            Parameter::ExcitationScale => {
                rows[0][nodes + 1] = sign * carried[0] / place.value / length;
                rows[1][nodes + 1] = sign * carried[1] / place.value / unit;
            }
            other if other.is_gap_of(self.element) => rows[0][nodes + 1] = -1.0 / length,
            _ => {
                let [r, speed] = by_family.unwrap_or_default();
                rows[0][nodes + 1] = sign * r / length;
                rows[1][nodes + 1] = sign * speed / unit;
            }
        }
        let values = vec![sign * (r - contact.level) / length, sign * speed / unit];
        Ok(Linear { values, rows, tests: vec![sign * acceleration / (unit * std::f64::consts::TAU * f)] })
    }

    /// The contact of that number, or the one that comes nearest to grazing, and where.
    pub fn choose(
        shooting: &mut Shooting,
        number: Option<usize>,
        orbit: (f64, &[Vec<f64>]),
        frequency_hz: f64,
    ) -> Result<Option<(Self, Turn)>, OrbitError> {
        let mut nearest: Option<(Self, Turn)> = None;
        for number in number.map_or(0..usize::MAX, |number| number..number + 1) {
            let Some(touch) = Self::of_contact(shooting, number) else { break };
            if touch.is_of_hole(shooting) {
                continue;
            }
            if let Some(turn) = touch.find(shooting, orbit, frequency_hz)?
                && nearest.as_ref().is_none_or(|(_, least)| turn.distance < least.distance)
            {
                nearest = Some((Self { from_inside: turn.from_inside, ..touch }, turn));
            }
        }
        Ok(nearest)
    }

    /// The other contact that a symmetric orbit, which touches this one at `turn`, touches half a period
    /// later, and how long that is [cycles]; `None` if it will not once the parameter changes.
    pub fn opposite(
        self,
        shooting: &mut Shooting,
        orbit: (f64, &[Vec<f64>]),
        frequency_hz: f64,
        turn: &Turn,
    ) -> Result<Option<(Self, f64)>, OrbitError> {
        let cycles = f64::from(shooting.period_multiple);
        for number in 0.. {
            let Some(touch) = Self::of_contact(shooting, number) else { break };
            if number == self.number(shooting) || touch.is_of_hole(shooting) {
                continue;
            }
            let Some(other) = touch.find(shooting, orbit, frequency_hz)? else { continue };
            let behind = (other.phase - turn.phase).rem_euclid(cycles);
            let is_half = (behind - 0.5 * cycles).abs() < OPPOSITE;
            // However well the grazing is known, of a symmetric orbit both are as far from it.
            let off = other.distance.min((other.distance - turn.distance).abs());
            let is_touched = !other.from_inside && off < OPPOSITE * touch.reach(shooting);
            if is_half && is_touched && self.stays_opposite(touch, shooting.parameter) {
                return Ok(Some((touch, behind)));
            }
        }
        Ok(None)
    }

    /// Whether the opposite contact stays that when the parameter changes: it does not where the parameter
    /// belongs to one of their two elements alone.
    fn stays_opposite(self, other: Self, parameter: Parameter) -> bool {
        parameter.constant_of(self.element) == parameter.constant_of(other.element)
    }

    /// Where the contact of the orbit with these nodes, the first at the phase `start`, turns nearest to its
    /// level, if that is near enough for a grazing.
    fn find(
        self,
        shooting: &mut Shooting,
        (start, nodes): (f64, &[Vec<f64>]),
        frequency_hz: f64,
    ) -> Result<Option<Turn>, OrbitError> {
        let periods = f64::from(shooting.period_multiple);
        let looks = LOOKS * shooting.period_multiple as usize;
        let phases: Vec<f64> = (0..=looks).map(|k| start + periods * k as f64 / looks as f64).collect();
        let orbit = Stretch { frequency_hz, start, end: start + periods };
        let looked = samples(shooting, (&orbit, nodes), &phases)?;
        let clearances: Vec<[f64; 2]> = phases
            .iter()
            .zip(&looked)
            .map(|(phase, state)| self.clearance(shooting, frequency_hz, *phase, state))
            .collect();
        let element = &shooting.integrator.system().elements()[self.element];
        let opens_at_its_level = !element.law.has_pressure() && element.law.rigid().is_none();
        let farthest = FARTHEST * self.reach(shooting);
        let (mut turns, mut from_inside) = (Vec::new(), Vec::new());
        for (phases, looks) in phases.windows(2).zip(clearances.windows(2)) {
            let [before, after] = [looks[0][1], looks[1][1]];
            let [is_least, is_most] = [before <= 0.0 && after > 0.0, before >= 0.0 && after < 0.0];
            if is_least || (is_most && opens_at_its_level) {
                // A step of the secant method on the rate.
                turns.push(phases[0] + before / (before - after) * (phases[1] - phases[0]));
                from_inside.push(is_most);
            }
        }
        if turns.is_empty() {
            return Ok(None);
        }
        let places = samples(shooting, (&orbit, nodes), &turns)?;
        let turn = |((phase, state), from_inside): ((f64, Vec<f64>), bool)| {
            // At an impact the rate jumps: it does not vanish near the turn.
            let [clearance, rate] = self.clearance(shooting, frequency_hz, phase, &state);
            let distance = clearance.abs() + rate.abs() / (std::f64::consts::TAU * frequency_hz);
            Turn { phase, state, distance, from_inside }
        };
        let found = turns.into_iter().zip(places).zip(from_inside).map(turn);
        Ok(found.filter(|turn| turn.distance < farthest).min_by(|a, b| a.distance.total_cmp(&b.distance)))
    }

    /// How far an orbit of the size of the scale moves the element [m].
    pub fn reach(self, shooting: &Shooting) -> f64 {
        let shape = &shooting.integrator.system().elements()[self.element].shape;
        shape.iter().zip(shooting.scale.values()).map(|(shape, scale)| (shape * scale).abs()).sum()
    }

    /// Clearance and its rate.
    pub fn clearance(self, shooting: &Shooting, frequency_hz: f64, phase: f64, state: &[f64]) -> [f64; 2] {
        let system = shooting.integrator.system();
        let contact = system.elements()[self.element].law.contacts()[self.contact];
        let [r, speed, _] = system.relative_motion(self.element, frequency_hz, phase, state);
        [contact.sign * (contact.level - r), -contact.sign * speed]
    }
}

/// States of an orbit at phases in their order, each from the node before it: what a slow impact makes of
/// rounding does not go on.
fn samples(
    shooting: &mut Shooting,
    (orbit, nodes): (&Stretch, &[Vec<f64>]),
    phases: &[f64],
) -> Result<Vec<Vec<f64>>, OrbitError> {
    let length = (orbit.end - orbit.start) / nodes.len() as f64;
    let mut samples = Vec::with_capacity(phases.len());
    for (k, node) in nodes.iter().enumerate() {
        let [start, end] = [k, k + 1].map(|k| orbit.start + k as f64 * length);
        let from = samples.len();
        let count = phases[from..].iter().take_while(|phase| **phase < end || k + 1 == nodes.len()).count();
        let segment = Stretch { start, end, ..*orbit };
        let of_segment = &phases[from..from + count];
        samples.extend(shooting.integrator.trace(&segment, node, of_segment)?.samples);
    }
    Ok(samples)
}
