//! How near a motion is to touching once more or once less: what tells two grazings between neighbouring orbits that have the same contacts.
//!
//! * The least clearance `min s (level - r)` over the turns of a flight towards a contact, the highest of each flight: where a new contact appears it vanishes, linearly in whatever varies.
//! * The least squared speed of a touch: where a contact vanishes so does it, linearly too, since the penetration is `v^2/2a` there. Where a contact stops opening for an instant, the touch behind that instant vanishes.
//! * The least penetration of a turn between two presses of one contact: where the contact begins to open there it vanishes, linearly.
//!
//! Turns of a flight are found on a grid as fine as its curvature asks for, and the highest of them is closed in by Newton's method where it is near. Turns of a contact that stays closed are
//! the valleys of its force at the nodes of its steps; the lowest one is closed in.

use super::{
    ExactIntegrator,
    collocation::NODES,
    course::{Course, CourseStep, Passage},
    flight_maximum::{FlightFunction, Flown},
};

/// Turns within this share of the largest clearance of a flight are closed in.
const NEAR: f64 = 0.1;
/// Share of the largest clearance by which a turn may lie above the grid.
const EXCESS: f64 = 0.01;
const MOST_PLACES: usize = 256;
/// Steps of Newton's method from a node to the turn of a contact, behind which a parabola does the rest.
const POLISHES: usize = 3;

/// How near a motion is to other contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearMisses {
    /// Least clearance of a turn in flight towards a contact [m]; infinite where there is none.
    pub clearance: f64,
    /// Least squared speed of a touch [m^2/s^2]; infinite without touches.
    pub touch_speed_squared: f64,
    /// Least penetration of a turn between two presses of one contact [m]; infinite where there is none.
    pub penetration: f64,
}

impl NearMisses {
    const NONE: Self =
        Self { clearance: f64::INFINITY, touch_speed_squared: f64::INFINITY, penetration: f64::INFINITY };
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
                    Passage::Touch { speed } => {
                        least.touch_speed_squared = least.touch_speed_squared.min(speed * speed);
                    }
                    Passage::Flight { start, duration, state, held, .. } if course.held(held).is_empty() => {
                        let flown = Flown { piece, start, duration, state: course.numbers(state), held: &[] };
                        least.clearance = least.clearance.min(self.clearance_of_turns(&flown));
                    }
                    _ => {}
                }
            }
        }
        let mut valleys = lowest_valleys(&course, self.laws.len());
        // What acts always does not open.
        valleys
            .retain(|valley| valley.is_some_and(|valley| !self.laws[valley.element].contacts().is_empty()));
        for valley in valleys.into_iter().flatten() {
            least.penetration = least.penetration.min(self.penetration_of_turn(&course, &valley));
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
            let jet = self.jet_in_step(state, valley.element, time);
            let next = (time - jet.slope / jet.curvature).clamp(0.0, valley.step.length);
            if next.is_nan() || next == time {
                break;
            }
            time = next;
        }
        let jet = self.jet_in_step(state, valley.element, time);
        let rest = 0.5 * jet.slope * jet.slope / jet.curvature;
        let turn = jet.value - if rest.is_finite() { rest } else { 0.0 };
        let contacts = self.laws[valley.element].contacts().iter();
        contacts.fold(0.0, |most, contact| most.max(contact.sign * (turn - contact.level)))
    }

    /// Least clearance of the turns of a flight over all contacts.
    fn clearance_of_turns(&self, flown: &Flown) -> f64 {
        let mut least = f64::INFINITY;
        for (element, law) in self.laws.iter().enumerate().filter(|(_, law)| !law.contacts().is_empty()) {
            let flight = FlightFunction::new(self, flown, (element, 0));
            let size = self.flight_bound(flown, (element, 0));
            let values = flight.on_grid(flight.places(EXCESS * size).min(MOST_PLACES));
            for contact in law.contacts() {
                let clearances = values.iter().map(|r| contact.sign * (contact.level - r));
                least = least.min(nearest_turn(&flight, contact.sign, clearances.collect()).unwrap_or(least));
            }
        }
        least
    }
}

/// A node of a force step that is pressed less than its neighbours.
#[derive(Debug, Clone, Copy)]
struct Valley {
    piece: usize,
    step: CourseStep,
    element: usize,
    node: usize,
    /// Magnitude of the force there [N].
    force: f64,
}

/// The lowest valley of each element's force, among the nodes of the steps that one contact lasts.
fn lowest_valleys(course: &Course, elements: usize) -> Vec<Option<Valley>> {
    let (mut lowest, mut latest) = (vec![None; elements], vec![(f64::NAN, None::<Valley>); elements]);
    let pieces = 0..course.stretches.len();
    let passages =
        pieces.flat_map(|piece| course.of_stretch(piece).iter().map(move |passage| (piece, passage)));
    for (piece, passage) in passages {
        let active = match passage {
            Passage::Step(step) => course.active(step),
            Passage::Touch { .. } => continue,
            _ => &[],
        };
        for (element, latest) in latest.iter_mut().enumerate() {
            if !active.iter().any(|(other, _)| *other == element) {
                *latest = (f64::NAN, None);
            }
        }
        let Passage::Step(step) = passage else { continue };
        for (&(element, _), forces) in active.iter().zip(course.numbers(step.force).as_chunks::<NODES>().0) {
            for (node, force) in forces.iter().map(|force| force.abs()).enumerate() {
                let (earlier, middle) = latest[element];
                if let Some(middle) = middle.filter(|middle| earlier >= middle.force && middle.force < force)
                {
                    let lower = |valley: &Valley| valley.force <= middle.force;
                    lowest[element] = lowest[element].filter(lower).or(Some(middle));
                }
                let here = Valley { piece, step: *step, element, node, force };
                latest[element] = (middle.map_or(f64::NAN, |middle| middle.force), Some(here));
            }
        }
    }
    lowest
}

/// Clearance of the turn that comes nearest, from the clearances on a grid over the flight.
fn nearest_turn(flight: &FlightFunction, sign: f64, clearances: Vec<f64>) -> Option<f64> {
    let is_turn = |k: &usize| clearances[*k] <= clearances[k - 1] && clearances[*k] < clearances[k + 1];
    let turns = (1..clearances.len().saturating_sub(1)).filter(is_turn);
    let nearest = turns.min_by(|a, b| clearances[*a].total_cmp(&clearances[*b]))?;
    let [before, at, after] = [clearances[nearest - 1], clearances[nearest], clearances[nearest + 1]];
    let (slope, bend) = (0.5 * (after - before), after - 2.0 * at + before);
    let on_parabola = at - 0.5 * slope * slope / bend;
    let largest = clearances.iter().fold(0.0_f64, |largest, clearance| largest.max(*clearance));
    if on_parabola > NEAR * largest {
        return Some(on_parabola);
    }
    let width = flight.duration() / (clearances.len() - 1) as f64;
    let (place, value) = flight.turn((nearest as f64 - slope / bend) * width);
    let inside = ((nearest - 1) as f64 * width..=(nearest + 1) as f64 * width).contains(&place);
    Some(if inside { at + sign * (flight.at(nearest as f64 * width).0 - value) } else { on_parabola })
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
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratio: 0.0 }],
            support: None,
            uniform_acceleration: vec![1.0],
        };
        let stop = LocalElement {
            name: "stop".into(),
            shape: vec![1.0],
            support_ratio: 0.0,
            law: Law::Linear(stop),
        };
        let system = System::new(model, &Load::default(), vec![stop]).unwrap();
        let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end };
        integrator.begin_course();
        integrator.advance(&stretch, &[displacement, 0.0]).unwrap();
        integrator.end_course();
        integrator.near_misses()
    }

    /// To rounding where it is near, else as good as a parabola through the grid.
    #[test]
    fn a_flight_that_turns_before_the_stop_misses_it_by_the_rest_of_the_gap() {
        for (amplitude, tolerance) in [(0.3, 1e-4), (1.0, 1e-4), (1.49, 1e-14), (1.5 - 1e-9, 1e-14)] {
            let found = of_amplitude(amplitude);
            assert!((found.clearance - (1.5 - amplitude)).abs() < tolerance, "{amplitude}: {found:?}");
            assert_eq!(found.touch_speed_squared, f64::INFINITY);
        }
    }

    #[test]
    fn a_touch_has_the_speed_that_energy_leaves_it() {
        for amplitude in [1.5 + 1e-6, 1.6, 3.0] {
            let found = of_amplitude(amplitude);
            let expected = amplitude * amplitude - 2.25;
            assert!(
                (found.touch_speed_squared - expected).abs() < 1e-9 * amplitude,
                "{amplitude}: {found:?}"
            );
            assert_eq!(found.clearance, f64::INFINITY, "{amplitude}");
        }
    }

    /// A spring of 99 N/m pressed with 9.9 N holds the mass at `x_e = -9.9/100`; pressed by `x + 0.1 > 0`, it vibrates there with 10 rad/s and comes back to
    /// `x_e - A` twice.
    #[test]
    fn a_contact_that_turns_before_it_opens_misses_that_by_what_is_left_of_its_penetration() {
        let stop = LinearStop::with_preload(99.0, 9.9).unwrap();
        for least in [1e-9, 1e-6, 5e-4] {
            let amplitude = 0.001 - least;
            let found = from(stop, -0.099 + amplitude, 0.5 * std::f64::consts::PI);
            assert!((found.penetration - least).abs() < 1e-12, "{least}: {found:?}");
            assert_eq!([found.clearance, found.touch_speed_squared], [f64::INFINITY; 2], "{least}");
        }
    }

    #[test]
    fn presses_with_a_flight_between_them_have_no_turn() {
        let found = of_amplitude(1.6);
        assert_eq!(found.penetration, f64::INFINITY);
    }
}
