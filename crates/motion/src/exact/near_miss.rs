//! How near a motion is to touching once more or once less: what tells two grazings between neighbouring orbits that have the same contacts.
//!
//! * The least clearance `min s (level - r)` over the turns of a flight towards a contact, the highest of each flight: where a new contact appears it vanishes, linearly in whatever varies.
//! * The least squared speed of a touch: where a contact vanishes so does it, linearly too, since the penetration is `v^2/2a` there.
//!
//! Turns are found on a grid as fine as the curvature of the flight asks for, and the highest of them is closed in by Newton's method where it is near. While a force acts nothing is looked for.

use super::{
    ExactIntegrator,
    course::Passage,
    flight_maximum::{FlightFunction, Flown},
};

/// Turns within this share of the largest clearance of a flight are closed in.
const NEAR: f64 = 0.1;
/// Share of the largest clearance by which a turn may lie above the grid.
const EXCESS: f64 = 0.01;
const MOST_PLACES: usize = 256;

/// How near a motion is to other contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearMisses {
    /// Least clearance of a turn in flight towards a contact [m]; infinite where there is none.
    pub clearance: f64,
    /// Least squared speed of a touch [m^2/s^2]; infinite without touches.
    pub touch_speed_squared: f64,
}

impl ExactIntegrator {
    /// Near misses of the motion that was noted last (see [`ExactIntegrator::begin_course`]).
    pub fn near_misses(&mut self) -> NearMisses {
        let course = std::mem::take(&mut self.course);
        let mut least = NearMisses { clearance: f64::INFINITY, touch_speed_squared: f64::INFINITY };
        for piece in 0..course.stretches.len() {
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
        self.course = course;
        least
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
        let model = ReducedModel {
            natural_frequencies: vec![1.0],
            damping: Mat::zeros(1, 1),
            points: vec![PointOutput { name: "mass".into(), shape: vec![1.0], support_ratio: 0.0 }],
            support: None,
            uniform_acceleration: vec![1.0],
        };
        let law = Law::Linear(LinearStop::with_gap(100.0, 1.5).unwrap());
        let stop = LocalElement { name: "stop".into(), shape: vec![1.0], support_ratio: 0.0, law };
        let system = System::new(model, &Load::default(), vec![stop]).unwrap();
        let mut integrator = ExactIntegrator::new(system, ExactSettings::default()).unwrap();
        let end = 3.0 * std::f64::consts::PI;
        let stretch = Stretch { frequency_hz: 1.0, start: 0.0, end };
        // From the lowest place if the highest is behind the stop.
        let sign = if amplitude > 1.5 { -1.0 } else { 1.0 };
        integrator.begin_course();
        integrator.advance(&stretch, &[sign * amplitude, 0.0]).unwrap();
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
}
