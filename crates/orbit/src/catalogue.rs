//! The orbits known at one frequency, each of them once, and Newton's method that adds to them.
//!
//! An orbit of N excitation periods has N states at phase 0 and is known if one of them is. Newton's method
//! for N periods also ends at orbits whose period is a part of N; they are kept as what they are, so that
//! they are recognised at once when they come again.

use hammerbeam_motion::{System, exact::ExactIntegrator};

use crate::{
    OrbitError, OrbitSettings, PeriodicSolution, Response,
    free_vibration::free_vibration,
    matching::{distance_in_phase, states_at_phase},
    off_impacts::started_off_impacts,
    shooting::ShootingProblem,
    size::{Cut, orbit_scale, scale_from},
    solve::{Wanted, approach, correct, has_minimal_period, integrator, solution},
    state_scale::{StateScale, state_scale},
};

/// Two orbits this close, relative to the orbit, are the same.
const SAME: f64 = 1e-6;

/// An orbit and what is needed to recognise it.
#[derive(Debug)]
pub(crate) struct Known {
    pub solution: PeriodicSolution,
    scale: StateScale,
    phases: Vec<Vec<f64>>,
    /// Whether its branch has been followed.
    pub followed: bool,
}

/// What a search has found.
#[derive(Debug, Clone, PartialEq)]
pub struct FoundOrbits {
    /// The orbits, in the order that the search promises.
    pub orbits: Vec<PeriodicSolution>,
    /// What kept the search from looking everywhere it meant to look: motion that could not be computed, its
    /// bound, or an interruption; or why one of the orbits stands for a family of them
    /// ([`OrbitError::FreeVibration`]).
    pub incomplete: Option<OrbitError>,
}

/// The orbits known at one frequency.
#[derive(Debug)]
pub(crate) struct Catalogue<'a> {
    pub system: &'a System,
    pub response: &'a Response,
    pub settings: &'a OrbitSettings,
    pub frequency_hz: f64,
    pub known: Vec<Known>,
    /// Why one orbit stands for many that touch nothing, if it does.
    family: Option<OrbitError>,
    /// Kept from one use to the next with the matrices it has made; `None` only while it is in use.
    integrator: Option<ExactIntegrator>,
}

/// Where Newton's method has ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Arrived {
    /// Place in the list.
    pub place: usize,
    pub is_new: bool,
}

impl<'a> Catalogue<'a> {
    /// An empty one.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if no integrator can be made for the system.
    pub fn new(
        system: &'a System,
        response: &'a Response,
        settings: &'a OrbitSettings,
        frequency_hz: f64,
    ) -> Result<Self, OrbitError> {
        let integrator = Some(integrator(system, response, settings)?);
        Ok(Self { system, response, settings, frequency_hz, known: Vec::new(), family: None, integrator })
    }

    /// The orbits that are wanted, in the order in which they were met, and what kept the search from finding
    /// all of them, if nothing else did.
    pub fn into_found(
        self,
        is_wanted: impl Fn(&PeriodicSolution) -> bool,
        incomplete: Option<OrbitError>,
    ) -> FoundOrbits {
        let known = self.known.into_iter().map(|known| known.solution);
        let incomplete = match incomplete {
            None | Some(OrbitError::SearchTrials { .. }) => self.family.or(incomplete),
            incomplete => incomplete,
        };
        FoundOrbits { orbits: known.filter(is_wanted).collect(), incomplete }
    }

    /// The integrator.
    pub fn integrator(&mut self) -> &mut ExactIntegrator {
        self.integrator.as_mut().expect("it is back after every use")
    }

    /// Force steps taken so far.
    pub fn steps(&mut self) -> u64 {
        self.integrator().counts().steps
    }

    /// Number of orbits with this period.
    pub fn count(&self, period_multiple: u32) -> usize {
        self.known.iter().filter(|known| known.solution.period_multiple == period_multiple).count()
    }

    /// Scale of one state.
    pub fn scale(&self, state: &[f64]) -> StateScale {
        state_scale(self.system, state, self.frequency_hz)
    }

    /// Scale of the motion over the excitation period that begins with a state at phase 0.
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if it cannot be computed.
    pub fn scale_of_motion(&mut self, state: &[f64]) -> Result<StateScale, OrbitError> {
        Ok(self.scale_and_next(state)?.0)
    }

    /// Scale of that motion, and the state with which it ends, where it is known (`size.rs`).
    ///
    /// # Errors
    /// [`OrbitError::Motion`] if it cannot be computed.
    pub fn scale_and_next(&mut self, state: &[f64]) -> Result<(StateScale, Option<Vec<f64>>), OrbitError> {
        let frequency_hz = self.frequency_hz;
        Ok(scale_from(self.integrator(), state, frequency_hz)?)
    }

    /// Newton's method for an orbit of `period_multiple` excitation periods or a part of them from nodes at
    /// equal phases, the first at `phase`.
    ///
    /// `None` if it does not converge. Where no motion can be computed either, the guess was just not good
    /// enough.
    pub fn probe(
        &mut self,
        guess: (f64, &[Vec<f64>]),
        period_multiple: u32,
    ) -> Result<Option<Arrived>, OrbitError> {
        self.probe_for(Wanted::Any, guess, period_multiple)
    }

    /// The same for orbits that are wanted.
    pub fn probe_for(
        &mut self,
        wanted: Wanted,
        (phase, nodes): (f64, &[Vec<f64>]),
        period_multiple: u32,
    ) -> Result<Option<Arrived>, OrbitError> {
        let shape = (period_multiple, nodes.len());
        let guess = Cut { phase, nodes, frequency_hz: self.frequency_hz, period_multiple };
        let Ok(scale) = guess.scale(self.integrator()) else { return Ok(None) };
        let integrator = self.integrator.take().expect("it is back after every use");
        let mut problem = ShootingProblem::new(integrator, shape, scale, 1.0).starting_at(phase);
        let result = approach(&mut problem, nodes, self.frequency_hz, (wanted, self.settings))
            .and_then(|(point, correction)| self.arrive(&mut problem, &point, correction));
        self.integrator = Some(problem.into_integrator());
        match result {
            Ok(arrived) => Ok(arrived),
            Err(OrbitError::NotConverged { .. } | OrbitError::Motion(_) | OrbitError::Eigenvalues(_)) => {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// The orbit at which Newton's method has ended, among those known.
    fn arrive(
        &mut self,
        problem: &mut ShootingProblem,
        point: &[f64],
        correction: f64,
    ) -> Result<Option<Arrived>, OrbitError> {
        let multiple = problem.period_multiple();
        if problem.phase() == 0.0
            && let Some(place) = self.place(&problem.nodes(point)[0], multiple)
        {
            return Ok(Some(Arrived { place, is_new: false }));
        }
        let found = solution(problem, point, correction)?;
        if found.phase != 0.0 {
            let state = states_at_phase(problem.integrator(), &found, 0.0)?.swap_remove(0);
            if let Some(place) = self.place(&state, multiple) {
                return Ok(Some(Arrived { place, is_new: false }));
            }
        }
        let scale = orbit_scale(problem.integrator(), &found)?;
        if has_minimal_period(problem.integrator(), &scale, &found)? {
            return self.add(problem.integrator(), found, scale).map(Some);
        }
        for part in (1..multiple).filter(|part| multiple.is_multiple_of(*part)) {
            let state = found.nodes[0].clone();
            let shorter = self.correct_shorter(problem, &state, part)?;
            if shorter.is_some() {
                return Ok(shorter);
            }
        }
        Ok(None)
    }

    /// The orbit of shorter period through a state, if it is one.
    fn correct_shorter(
        &mut self,
        problem: &mut ShootingProblem,
        state: &[f64],
        part: u32,
    ) -> Result<Option<Arrived>, OrbitError> {
        let mut motion = integrator(self.system, self.response, self.settings)?;
        let nodes = [state.to_vec()];
        let (phase, frequency_hz) = (problem.phase(), self.frequency_hz);
        let guess = Cut { phase, nodes: &nodes, frequency_hz, period_multiple: part };
        let Ok(scale) = guess.scale(&mut motion) else { return Ok(None) };
        let mut shorter = ShootingProblem::new(motion, (part, 1), scale.clone(), 1.0).starting_at(phase);
        let mut point = shorter.point(&nodes, frequency_hz);
        let Ok(correction) = correct(&mut shorter, &mut point, self.settings) else { return Ok(None) };
        let found = solution(&mut shorter, &point, correction)?;
        if scale.distance(&found.nodes[0], state) > SAME {
            return Ok(None);
        }
        self.add(problem.integrator(), found, scale).map(Some)
    }

    /// Adds an orbit that is not known; of those to which a free vibration may be added, the first only.
    fn add(
        &mut self,
        integrator: &mut ExactIntegrator,
        solution: PeriodicSolution,
        scale: StateScale,
    ) -> Result<Arrived, OrbitError> {
        if let Some(error) = free_vibration(self.system, &solution) {
            if let Some(place) = self.untouching(solution.period_multiple) {
                return Ok(Arrived { place, is_new: false });
            }
            self.family = Some(error);
        }
        let elsewhere = started_off_impacts(integrator, &solution)?;
        if let Some(place) = elsewhere.as_ref().and_then(|orbit| self.place_elsewhere(integrator, orbit)) {
            return Ok(Arrived { place, is_new: false });
        }
        let (multiple, count) = (solution.period_multiple as usize, solution.nodes.len());
        let phases = if count.is_multiple_of(multiple) && solution.phase == 0.0 {
            solution.nodes.iter().step_by(count / multiple).cloned().collect()
        } else {
            states_at_phase(integrator, &solution, 0.0)?
        };
        let solution = elsewhere.unwrap_or(solution);
        self.known.push(Known { solution, scale, phases, followed: false });
        Ok(Arrived { place: self.known.len() - 1, is_new: true })
    }

    /// Place of an orbit that does not start at phase 0, since an impact lies there.
    fn place_elsewhere(&self, integrator: &mut ExactIntegrator, orbit: &PeriodicSolution) -> Option<usize> {
        let multiple = orbit.period_multiple;
        self.known.iter().position(|known| {
            known.solution.period_multiple == multiple
                && states_at_phase(integrator, &known.solution, orbit.phase)
                    .is_ok_and(|states| distance_in_phase(&known.scale, &states, &orbit.nodes[0]) < SAME)
        })
    }

    /// Place of an orbit with this period that touches nothing.
    fn untouching(&self, period_multiple: u32) -> Option<usize> {
        let is_one =
            |orbit: &PeriodicSolution| orbit.period_multiple == period_multiple && orbit.maxima.contacts == 0;
        self.known.iter().position(|known| is_one(&known.solution))
    }

    /// Place of the orbit through a state whose period is `period_multiple` or a part of it.
    fn place(&self, state: &[f64], period_multiple: u32) -> Option<usize> {
        self.known.iter().position(|known| {
            period_multiple.is_multiple_of(known.solution.period_multiple)
                && distance_in_phase(&known.scale, &known.phases, state) < SAME
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test ends where its system is wrong")]

    use hammerbeam_motion::{
        Law,
        law::{Formula, PowerSpring},
    };

    use super::*;
    use crate::test_oscillator::oscillator;

    /// `x'' + 0.1 x' + x - x^3/10 = 1e-3 cos(2 pi t)` has a well at 0 and a hill at `x = sqrt(10)`, where the
    /// larger multiplier is `exp(l)`, 3.9, with `l^2 + 0.1 l - 2 = 0`.
    #[test]
    fn newtons_method_for_stable_orbits_leaves_a_hill_and_comes_to_a_well() {
        let (system, response) = oscillator(0.1, 1e-3, Law::Power(PowerSpring::cubic(-0.1).unwrap()));
        let settings = OrbitSettings::default();
        let mut catalogue = Catalogue::new(&system, &response, &settings, 1.0).unwrap();
        let (hill, well) = (vec![10.0_f64.sqrt(), 0.0], vec![0.0, 0.0]);
        let mut arrived_at =
            |wanted, at: &Vec<f64>| catalogue.probe_for(wanted, (0.0, std::slice::from_ref(at)), 1);
        assert_eq!(arrived_at(Wanted::StableNearby, &hill).unwrap(), None);
        assert!(arrived_at(Wanted::StableNearby, &well).unwrap().is_some_and(|arrived| arrived.is_new));
        assert!(arrived_at(Wanted::Any, &hill).unwrap().is_some_and(|arrived| arrived.is_new));
    }

    /// The van der Pol oscillator of `studies/van-der-pol.toml`: its damping grows with the square of the
    /// displacement, and so do the steps of a motion far away, to which Newton's method may jump.
    #[test]
    fn a_guess_that_leads_astray_costs_little() {
        let law = Law::Formula(Formula::new("0.3*(x^2 - 1)*v", &[]).unwrap());
        let (system, response) = oscillator(0.0, 1.0, law);
        let settings = OrbitSettings::default();
        let mut catalogue = Catalogue::new(&system, &response, &settings, 0.16).unwrap();
        for guess in [[416.0, 58.0], [-684.0, -202.0]] {
            let before = catalogue.integrator().counts().steps;
            assert_eq!(catalogue.probe((0.0, &[guess.to_vec()]), 1).unwrap(), None);
            // Once as many as make a motion a stray, not the 40 000 that it may take.
            let steps = catalogue.integrator().counts().steps - before;
            assert!((4000..10_000).contains(&steps), "{steps} force steps from {guess:?}");
        }
    }
}
