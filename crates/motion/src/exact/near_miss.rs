//! How near a motion is to touching once more or once less: what tells two grazings between neighbouring
//! orbits that have the same contacts. Equations (G6) and (G7) of the book, `docs/theory`, say what a
//! touch does.
//!
//! The [`NEAREST`] smallest values of each kind:
//!
//! * The clearance `min s (level - r)` over the turns of a flight towards a contact, the highest of each
//!   flight: where a new contact appears it vanishes, linearly in whatever varies.
//! * The squared speed of a touch: where a contact vanishes so does it, linearly too, since the penetration
//!   is `v^2/2a` there. Where a contact stops opening for an instant, the touch behind that instant vanishes.
//! * The penetration of a turn between two presses of one contact: where the contact begins to open there it
//!   vanishes, linearly.
//!
//! Turns of a flight are found on a grid as fine as its curvature asks for, and the highest of them is closed
//! in by Newton's method where it is near; in the intervals at its ends, where it may begin or end with its
//! stretch, by its slope there. Turns of a contact that stays closed are the valleys of its force at the
//! nodes of its steps (`valley.rs`); the lowest ones are closed in.

use super::{
    ExactIntegrator,
    course::{Course, Passage},
    flight_maximum::{FlightFunction, Flown, turn_of},
    valley::{Valley, lowest_valleys},
};
use crate::law::RoundHole;

/// Turns within this share of the largest clearance of a flight are closed in.
const NEAR: f64 = 0.1;
/// Share of the size of a flight within which it begins at the level itself.
const LEFT: f64 = 1e-12;
/// Share of the largest clearance by which a turn may lie above the grid.
const EXCESS: f64 = 0.01;
const MOST_PLACES: usize = 256;
/// Steps of Newton's method from a node to the turn of a contact, behind which a parabola does the rest.
const POLISHES: usize = 3;

/// How many of each kind are told: where one of them stays small the next ones show what happens elsewhere in
/// the orbit.
pub const NEAREST: usize = 4;

/// How near a motion is to other contacts: the smallest values of each kind, ascending, infinite where there
/// are not so many.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearMisses {
    /// Clearance of the highest turn of a flight towards a contact [m].
    pub clearances: [f64; NEAREST],
    /// Squared speed of a touch [m^2/s^2].
    pub squared_touch_speeds: [f64; NEAREST],
    /// Penetration of the lowest turn between two presses of one contact [m].
    pub penetrations: [f64; NEAREST],
}

impl NearMisses {
    const NONE: Self = Self {
        clearances: [f64::INFINITY; NEAREST],
        squared_touch_speeds: [f64::INFINITY; NEAREST],
        penetrations: [f64::INFINITY; NEAREST],
    };
}

/// Puts a value among the smallest ones.
fn put_among(smallest: &mut [f64; NEAREST], mut value: f64) {
    for place in smallest {
        if value < *place {
            std::mem::swap(place, &mut value);
        }
    }
}

impl ExactIntegrator {
    /// Near misses of the motion that was noted last (see [`ExactIntegrator::begin_course`]).
    pub fn near_misses(&mut self) -> NearMisses {
        let course = std::mem::take(&mut self.course);
        let mut least = NearMisses::NONE;
        for piece in 0..course.stretches.len() {
            self.let_go();
            self.drive_over(&course.stretches[piece].stretch);
            for passage in course.of_stretch(piece) {
                match *passage {
                    Passage::Touch { speed, .. } => {
                        put_among(&mut least.squared_touch_speeds, speed * speed);
                    }
                    Passage::Flight { start, duration, state, held, .. } if course.held(held).is_empty() => {
                        let flown = Flown { piece, start, duration, state: course.numbers(state), held: &[] };
                        self.put_turns(&flown, &mut least.clearances);
                    }
                    _ => {}
                }
            }
        }
        for element in 0..self.laws.len() {
            // What acts always does not open.
            if self.laws[element].contacts().is_empty() {
                continue;
            }
            for valley in lowest_valleys(&course, element, NEAREST) {
                put_among(&mut least.penetrations, self.penetration_of_turn(&course, &valley));
            }
        }
        self.let_go();
        self.course = course;
        least
    }

    /// Penetration of the turn beside a node, extrapolated where it lies in a neighbouring step.
    fn penetration_of_turn(&mut self, course: &Course, valley: &Valley) -> f64 {
        self.recall(course, valley.piece, &valley.step);
        let state = course.numbers(valley.step.state);
        let mut time = self.step.node_time(valley.node);
        for _ in 0..POLISHES {
            let jet = self.element_jet_in_step(state, valley.element, time);
            let next = (time - jet.slope / jet.curvature).clamp(0.0, valley.step.length);
            if next.is_nan() || next == time {
                break;
            }
            time = next;
        }
        let jet = self.element_jet_in_step(state, valley.element, time);
        let rest = 0.5 * jet.slope * jet.slope / jet.curvature;
        let turn = jet.value - if rest.is_finite() { rest } else { 0.0 };
        let contacts = self.laws[valley.element].contacts().iter();
        contacts.fold(0.0, |most, contact| most.max(contact.sign * (turn - contact.level)))
    }

    /// Puts the clearance of the highest turn towards each contact in a flight among the smallest ones.
    fn put_turns(&self, flown: &Flown, smallest: &mut [f64; NEAREST]) {
        for (element, law) in self.laws.iter().enumerate().filter(|(_, law)| !law.contacts().is_empty()) {
            let flight = FlightReading::new(self, flown, element);
            let values = flight.on_grid(flight.places().min(MOST_PLACES));
            for contact in law.contacts() {
                let clearances: Vec<f64> =
                    values.iter().map(|r| contact.sign * (contact.level - r)).collect();
                if let Some(clearance) = nearest_turn(&flight, contact.sign, &clearances) {
                    put_among(smallest, clearance);
                }
            }
        }
    }
}

/// What tells of contact in a flight: the relative displacement of an element, or the reading of a hole.
enum FlightReading<'a> {
    Output { size: f64, function: FlightFunction<'a> },
    Hole { hole: &'a RoundHole, size: f64, both: [FlightFunction<'a>; 2] },
}

impl<'a> FlightReading<'a> {
    fn new(integrator: &'a ExactIntegrator, flown: &'a Flown<'a>, element: usize) -> Self {
        let function = |output: usize| FlightFunction::new(integrator, flown, (output, 0));
        let size = |output: usize| integrator.flight_bound(flown, (output, 0));
        match integrator.laws[element].round_hole() {
            Some(hole) => {
                let size = size(element).hypot(size(element + 1));
                Self::Hole { hole, size, both: [function(element), function(element + 1)] }
            }
            None => Self::Output { size: size(element), function: function(element) },
        }
    }

    /// Bound of what it reads.
    fn size(&self) -> f64 {
        match self {
            Self::Output { size, .. } | Self::Hole { size, .. } => *size,
        }
    }

    fn duration(&self) -> f64 {
        match self {
            Self::Output { function, .. } => function.duration(),
            Self::Hole { both: [first, _], .. } => first.duration(),
        }
    }

    /// Number of intervals of the grid; the square of a displacement turns twice as often as that does.
    fn places(&self) -> usize {
        match self {
            Self::Output { size, function } => function.places(EXCESS * size),
            Self::Hole { size, both, .. } => {
                2 * both.iter().map(|function| function.places(EXCESS * size)).max().unwrap_or(1)
            }
        }
    }

    fn on_grid(&self, count: usize) -> Vec<f64> {
        match self {
            Self::Output { function, .. } => function.on_grid(count),
            Self::Hole { hole, both: [first, second], .. } => {
                let pairs = first.on_grid(count).into_iter().zip(second.on_grid(count));
                pairs.map(|(y, z)| hole.reading([y, 0.0, 0.0], [z, 0.0, 0.0])[0]).collect()
            }
        }
    }

    fn at(&self, time: f64) -> (f64, f64, f64) {
        match self {
            Self::Output { function, .. } => function.at(time),
            Self::Hole { hole, both, .. } => {
                let [y, z] = both.each_ref().map(|function| {
                    let (value, slope, curvature) = function.at(time);
                    [value, slope, curvature]
                });
                let [value, slope, curvature] = hole.reading(y, z);
                (value, slope, curvature)
            }
        }
    }

    /// Where Newton's method comes to a turn from near one, and the value there.
    fn turn(&self, near: f64) -> (f64, f64) {
        turn_of(|time| self.at(time), near, self.duration())
    }
}

/// A turn of a flight towards a contact, as the grid shows it.
#[derive(Debug, Clone, Copy)]
struct Turn {
    /// Place on the grid beside which it lies.
    node: usize,
    /// Clearance at its bottom by a parabola, and how far that is from the place, in intervals of the grid.
    clearance: f64,
    shift: f64,
}

/// Clearance of the turn that comes nearest, from the clearances on a grid over the flight.
///
/// What is let go by a rigid stop, or has struck one that gives nothing back, leaves it without speed; that
/// is no turn at its level.
fn nearest_turn(flight: &FlightReading<'_>, sign: f64, clearances: &[f64]) -> Option<f64> {
    let width = flight.duration() / (clearances.len() - 1) as f64;
    let inner = (1..clearances.len().saturating_sub(1)).filter_map(|node| inner_turn(clearances, node));
    let is_left = |node: usize| node == 0 && clearances[0].abs() <= LEFT * flight.size();
    let outer = [0, clearances.len() - 1].into_iter().filter_map(|node| {
        if is_left(node) || !may_turn_at_end(clearances, node) {
            return None;
        }
        let (_, slope, curvature) = flight.at(node as f64 * width);
        end_turn(clearances, node, (-sign * slope * width, -sign * curvature * width * width))
    });
    let nearest = inner.chain(outer).min_by(|a, b| a.clearance.total_cmp(&b.clearance))?;
    let largest = clearances.iter().fold(0.0_f64, |largest, clearance| largest.max(*clearance));
    if nearest.clearance > NEAR * largest {
        return Some(nearest.clearance);
    }
    let node = nearest.node as f64;
    let (place, value) = flight.turn((node + nearest.shift) * width);
    let inside = ((node - 1.0) * width..=(node + 1.0) * width).contains(&place);
    let closed_in = || clearances[nearest.node] + sign * (flight.at(node * width).0 - value);
    Some(if inside { closed_in() } else { nearest.clearance })
}

/// A place whose neighbours are both farther from the contact.
fn inner_turn(clearances: &[f64], node: usize) -> Option<Turn> {
    let [before, at, after] = [clearances[node - 1], clearances[node], clearances[node + 1]];
    if at > before || at >= after {
        return None;
    }
    let (slope, bend) = (0.5 * (after - before), after - 2.0 * at + before);
    Some(Turn { node, clearance: at - 0.5 * slope * slope / bend, shift: -slope / bend })
}

/// Whether a parabola through an end of the grid and the two places next to it says, about, that the
/// clearance turns between the first two.
fn may_turn_at_end(clearances: &[f64], end: usize) -> bool {
    let inwards = |k: usize| if end == 0 { k } else { end - k };
    if clearances.len() < 3 || clearances[inwards(1)] < clearances[end] {
        return clearances.len() == 2;
    }
    let [first, second] = [0, 1].map(|k| clearances[inwards(k + 1)] - clearances[inwards(k)]);
    // The slope of the parabola at the end is that of the first interval less half of what the next one adds.
    first - 0.5 * (second - first) < 0.25 * first
}

/// A turn in the first or the last interval, where a flight begins or ends with its stretch: one whose end is
/// nearer to the contact than the next place, and approaches it inwards.
///
/// * `slope`, `curvature`: of the clearance at that end, by intervals of the grid.
fn end_turn(clearances: &[f64], node: usize, (slope, curvature): (f64, f64)) -> Option<Turn> {
    let (next, inwards) = if node == 0 { (1, slope) } else { (node - 1, -slope) };
    let turns = inwards < 0.0 && clearances.get(next).is_some_and(|next| *next >= clearances[node]);
    let shift = -slope / curvature;
    (turns && shift.abs() <= 1.0).then(|| Turn {
        node,
        clearance: clearances[node] + 0.5 * slope * shift,
        shift,
    })
}

#[cfg(test)]
mod tests {
    use faer::Mat;
    use hammerbeam_structure::{PointOutput, ReducedModel};

    use super::NearMisses;
    use crate::{
        Law, Load, LocalElement, Stretch, System,
        exact::{ExactIntegrator, ExactSettings},
        law::LinearStop,
    };

    /// Free vibration `A cos t` beside a stop at 1.5, over three half cycles from its highest place.
    fn of_amplitude(amplitude: f64) -> NearMisses {
        // From the lowest place if the highest is behind the stop.
        let sign = if amplitude > 1.5 { -1.0 } else { 1.0 };
        from(LinearStop::with_gap(100.0, 1.5).unwrap(), sign * amplitude, 3.0 * std::f64::consts::PI)
    }

    /// Near misses of a mass with `x'' = -x` beside a stop, let go at `displacement`.
    fn from(stop: LinearStop, displacement: f64, end: f64) -> NearMisses {
        from_state(stop, [displacement, 0.0], end)
    }

    fn from_state(stop: LinearStop, state: [f64; 2], end: f64) -> NearMisses {
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratios: vec![0.0] }],
            supports: vec![],
            uniform_acceleration: vec![1.0],
        };
        let stop = LocalElement {
            name: "stop".into(),
            shape: vec![1.0],
            support_ratios: vec![0.0],
            law: Law::Linear(stop),
        };
        let system = System::new(model, &Load::default(), vec![stop]).unwrap();
        let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end };
        integrator.begin_course();
        integrator.advance(&stretch, &state).unwrap();
        integrator.end_course();
        integrator.near_misses()
    }

    /// To rounding where it is near, else as good as a parabola through the grid.
    #[test]
    fn a_flight_that_turns_before_the_stop_misses_it_by_the_rest_of_the_gap() {
        for (amplitude, tolerance) in [(0.3, 1e-4), (1.0, 1e-4), (1.49, 1e-14), (1.5 - 1e-9, 1e-14)] {
            let found = of_amplitude(amplitude);
            assert!((found.clearances[0] - (1.5 - amplitude)).abs() < tolerance, "{amplitude}: {found:?}");
            assert_eq!(found.squared_touch_speeds[0], f64::INFINITY);
        }
    }

    /// The turn at half a period, in a flight that ends just behind it or begins just before it.
    #[test]
    fn a_turn_beside_an_end_of_a_flight_is_seen() {
        let stop = || LinearStop::with_gap(100.0, 1.5).unwrap();
        let half = std::f64::consts::PI;
        for beside in [0.1, 0.01, 1e-4] {
            let ending = from(stop(), -1.4, half + beside);
            assert!((ending.clearances[0] - 0.1).abs() < 1e-14, "{beside}: {ending:?}");
            let beginning = from_state(stop(), [1.4 * f64::cos(beside), 1.4 * f64::sin(beside)], half);
            assert!((beginning.clearances[0] - 0.1).abs() < 1e-14, "{beside}: {beginning:?}");
        }
    }

    #[test]
    fn a_touch_has_the_speed_that_energy_leaves_it() {
        for amplitude in [1.5 + 1e-6, 1.6, 3.0] {
            let found = of_amplitude(amplitude);
            let expected = amplitude * amplitude - 2.25;
            assert!(
                (found.squared_touch_speeds[0] - expected).abs() < 1e-9 * amplitude,
                "{amplitude}: {found:?}"
            );
            assert_eq!(found.clearances[0], f64::INFINITY, "{amplitude}");
        }
    }

    /// A spring of 99 N/m pressed with 9.9 N holds the mass at `x_e = -9.9/100`; pressed by `x + 0.1 > 0`, it
    /// vibrates there with 10 rad/s and comes back to `x_e - A` twice.
    #[test]
    fn a_contact_that_turns_before_it_opens_misses_that_by_what_is_left_of_its_penetration() {
        let stop = LinearStop::with_preload(99.0, 9.9).unwrap();
        for least in [1e-9, 1e-6, 5e-4] {
            let amplitude = 0.001 - least;
            let found = from(stop, -0.099 + amplitude, 0.5 * std::f64::consts::PI);
            // Twice within, and at the end, which is followed by the beginning.
            let [three @ .., fourth] = found.penetrations;
            assert!(three.iter().all(|turn| (turn - least).abs() < 1e-12), "{least}: {found:?}");
            assert_eq!(fourth, f64::INFINITY, "{least}");
            assert_eq!([found.clearances[0], found.squared_touch_speeds[0]], [f64::INFINITY; 2], "{least}");
        }
    }

    #[test]
    fn presses_with_a_flight_between_them_have_no_turn() {
        let found = of_amplitude(1.6);
        assert_eq!(found.penetrations[0], f64::INFINITY);
    }
}
