//! Maxima of an orbit on the continuous motion.
//!
//! They are taken from the course of the motion (`course.rs`): first what every passage adds, and the largest
//! forces; then the accelerations in the force steps, of which the hardest one comes first; then the flights
//! (`flight_maximum.rs`), of which the longest comes first; last the displacements in force steps
//! (`step_maximum.rs`). So most of them are shown to lie below what was found before by a bound alone.

use super::{
    ExactIntegrator, MotionError,
    collocation::NODES,
    course::{Course, CourseStep, Passage},
    flight_maximum::Flown,
    hole,
    run::Run,
    step_maximum::Peaks,
};
use crate::Stretch;

/// Maxima of a motion on the continuous motion, and its contacts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Maxima {
    /// Largest absolute displacement of the response point, `max |y|` [m].
    pub displacement: f64,
    /// Largest absolute acceleration of the response point, `max |y''|`, apart from the jumps of the velocity
    /// at impacts on rigid stops [m/s^2].
    pub acceleration: f64,
    /// Largest contact force over all elements with a contact [N]; impacts on rigid stops have none, stops
    /// that are stuck to have.
    pub contact_force: f64,
    /// Largest speed with which a contact closes [m/s].
    pub impact_velocity: f64,
    /// Sum of the impulses of all contacts [N s].
    pub impulse: f64,
    /// Energy that the structure has lost to all contacts [J], what is stored in them at the end included; 0
    /// for laws that lose none.
    pub energy_lost: f64,
    /// Number of contacts that closed; on a rigid stop where chatter came to its end, how often it did, and
    /// not how often it was struck, which is infinite.
    pub touches: u32,
    /// Elements that were closed all the time, with or without pressure, one bit each (the first 64). One
    /// that goes over from one of its two contacts to the other is not among them.
    pub closed_throughout: u64,
}

impl Maxima {
    /// Those of this stretch of a motion and of the next one together.
    #[must_use]
    pub fn and(&self, next: &Self) -> Self {
        Self {
            displacement: self.displacement.max(next.displacement),
            acceleration: self.acceleration.max(next.acceleration),
            contact_force: self.contact_force.max(next.contact_force),
            impact_velocity: self.impact_velocity.max(next.impact_velocity),
            impulse: self.impulse + next.impulse,
            energy_lost: self.energy_lost + next.energy_lost,
            touches: self.touches + next.touches,
            closed_throughout: self.closed_throughout & next.closed_throughout,
        }
    }

    /// Number of contacts: those that closed, and those that were closed throughout.
    #[must_use]
    pub fn contacts(&self) -> u32 {
        self.touches + self.closed_throughout.count_ones()
    }
}

/// What a course holds that can be among the maxima.
#[derive(Debug, Default)]
struct Observation<'a> {
    maxima: Maxima,
    flights: Vec<Flown<'a>>,
    /// Force steps, each with the stretch that it is in; that with the largest force at a node comes first.
    steps: Vec<(usize, CourseStep)>,
    /// The largest force at a node of the first step [N].
    hardest: f64,
    /// Of the force of elements with a contact.
    forces: Peaks,
    /// Impacts on the rigid stop of each element, and how many of them ended its chatter.
    impacts: Vec<[u32; 2]>,
}

impl ExactIntegrator {
    /// Maxima of a motion over stretches that follow one another, each from its own state, of the response
    /// point given at construction.
    ///
    /// # Errors
    /// See [`MotionError`].
    pub fn observe(&mut self, motion: &[(Stretch, &[f64])]) -> Result<Maxima, MotionError> {
        let course = self.take_course(motion)?;
        let maxima = self.maxima_of(&course);
        self.course = course;
        maxima
    }

    /// From now on what happens is noted, so that [`ExactIntegrator::observe`] need not go through the same
    /// motion again.
    pub fn begin_course(&mut self) {
        self.course.clear();
        self.notes_course = true;
    }

    /// From now on nothing is noted; what was stays until the next course begins.
    pub fn end_course(&mut self) {
        self.notes_course = false;
    }

    /// The course of a motion, which is gone through where it was not gone through last.
    fn take_course(&mut self, motion: &[(Stretch, &[f64])]) -> Result<Course, MotionError> {
        if !self.course.is_of(motion) {
            self.begin_course();
            let advanced =
                motion.iter().try_for_each(|(stretch, state)| self.advance(stretch, state).map(|_| ()));
            self.end_course();
            if let Err(error) = advanced {
                self.course.clear();
                return Err(error);
            }
        }
        Ok(std::mem::take(&mut self.course))
    }

    fn maxima_of(&mut self, course: &Course) -> Result<Maxima, MotionError> {
        let mut observation = Observation::default();
        observation.maxima.closed_throughout = if course.stretches.is_empty() { 0 } else { u64::MAX };
        for piece in 0..course.stretches.len() {
            self.look_through(course, piece, &mut observation);
        }
        let Observation { mut maxima, mut flights, steps, forces, impacts, .. } = observation;
        // An infinite number of impacts, of which some were followed, counts once.
        maxima.touches -=
            impacts.iter().filter(|[_, ends]| *ends > 0).map(|[all, ends]| all - ends).sum::<u32>();
        maxima.contact_force = self.largest_force(course, forces);
        let watches = self.outputs.len() > self.laws.len();
        maxima.contact_force = self.largest_pressing_force(course, &steps, maxima.contact_force);
        if watches {
            maxima.acceleration = self.largest_acceleration(course, &steps);
        }
        flights.retain(|flown| watches || !flown.held.is_empty());
        flights.sort_by(|x, y| y.duration.total_cmp(&x.duration));
        for flown in &flights {
            self.observe_flight(course, flown, watches, &mut maxima)?;
        }
        if watches {
            maxima.displacement = self.largest_displacement(course, &steps, maxima.displacement);
        }
        self.let_go();
        Ok(maxima)
    }

    /// Notes what happened in one stretch of a course.
    fn look_through<'a>(&mut self, course: &'a Course, piece: usize, observation: &mut Observation<'a>) {
        let maxima = &mut observation.maxima;
        maxima.closed_throughout &= course.stretches[piece].closed;
        for passage in course.of_stretch(piece) {
            match *passage {
                Passage::Flight { start, duration, state, closed, held, impulses } => {
                    let (state, held) = (course.numbers(state), course.held(held));
                    maxima.closed_throughout &= closed;
                    maxima.impulse += course.numbers(impulses).iter().sum::<f64>();
                    observation.flights.push(Flown { piece, start, duration, state, held });
                }
                Passage::Impact { element, impulse, energy, sticks } => {
                    observation.impacts.resize(self.laws.len(), [0; 2]);
                    observation.impacts[element][0] += 1;
                    observation.impacts[element][1] += u32::from(sticks && self.laws[element].chatters());
                    maxima.impulse += impulse;
                    maxima.energy_lost += energy;
                }
                Passage::Touch { element, speed } => {
                    maxima.touches += 1;
                    maxima.closed_throughout &= !bit(element);
                    maxima.impact_velocity = maxima.impact_velocity.max(speed.abs());
                }
                Passage::Step(step) => {
                    maxima.energy_lost += step.energy_taken;
                    maxima.closed_throughout &= step.closed;
                    maxima.impulse += course.numbers(step.impulses).iter().sum::<f64>();
                    let forces = course.numbers(step.force);
                    let nodal = forces.as_chunks::<NODES>().0;
                    for (place, (element, law)) in course.active(&step).iter().enumerate() {
                        if !law.contacts().is_empty() {
                            let force = hole::magnitudes(law, nodal, place);
                            let impulse: f64 =
                                (0..NODES).map(|j| step.grading.rule().at_end[0][j] * force[j]).sum();
                            maxima.impulse += (impulse * step.length).abs();
                            observation.forces.note((piece, step), *element, &force);
                        }
                    }
                    observation.steps.push((piece, step));
                    let hardest = forces.iter().fold(0.0_f64, |hardest, force| hardest.max(force.abs()));
                    if hardest > observation.hardest {
                        observation.hardest = hardest;
                        let last = observation.steps.len() - 1;
                        observation.steps.swap(0, last);
                    }
                }
            }
        }
    }

    /// Raises the maxima to what a flight holds.
    fn observe_flight(
        &mut self,
        course: &Course,
        flown: &Flown,
        watches: bool,
        maxima: &mut Maxima,
    ) -> Result<(), MotionError> {
        let (response, stretch) = (self.laws.len(), course.stretches[flown.piece].stretch);
        self.turn_to(&stretch, flown.held)?;
        if watches {
            maxima.displacement = self.flight_maximum(flown, (response, 0), maxima.displacement);
            maxima.acceleration = self.flight_maximum(flown, (response, 2), maxima.acceleration);
        }
        for output in self.outputs.len() - flown.held.len()..self.outputs.len() {
            maxima.contact_force = self.flight_maximum(flown, (output, 0), maxima.contact_force);
        }
        Ok(())
    }
}

/// Elements that are closed, one bit each: penetrated, whether or not the contact presses, or held.
pub(crate) fn closed_bits(run: &Run) -> u64 {
    let contacts = run.closed.iter().zip(&run.parted).enumerate();
    let penetrated = contacts.filter(|(_, (closed, parted))| closed.is_some() || parted.is_some());
    bits(penetrated.map(|(element, _)| element)) | bits(run.stuck.iter().copied())
}

fn bits(elements: impl Iterator<Item = usize>) -> u64 {
    elements.fold(0, |bits, element| bits | bit(element))
}

/// That of an element, 0 behind the first 64.
pub(crate) fn bit(element: usize) -> u64 {
    1_u64.checked_shl(element as u32).unwrap_or(0)
}
