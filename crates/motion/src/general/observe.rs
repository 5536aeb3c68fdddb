//! Maxima of a motion and its contacts, by the integrator's own means.
//!
//! Displacements have their extrema where their velocity vanishes: each change of its sign between samples of
//! the dense output is bracketed, and the extremum is taken from a step of the method itself that ends there.
//! Where steps of an element meet, the sign is that of the state itself, for both: a step may end at an
//! extremum, as where a contact grazes, and the dense outputs on its two sides differ by rounding.
//! The acceleration has no such derivative; its maximum is sought between samples, and taken from a step that
//! ends there too. Impulses are integrals of the forces on the dense output by Gauss' rule with eight nodes
//! in each step.

mod extrema;

use super::{
    Counts, GeneralError, GeneralSettings, Point, VectorField,
    march::March,
    settings::{check, check_frequency},
    stepper::Stepper,
    stops::Impact,
    system_field::{
        SystemField,
        region::{force_in_region, switches_of},
    },
    watch::{Accepted, Place, Watcher},
};
use crate::{Contact, Flow, Stretch, System, vectors::dot};

/// A motion over a stretch, with its maxima and contacts.
#[derive(Debug, Clone)]
pub struct Observed {
    /// Final state and sensitivities.
    pub flow: Flow,
    /// Work done.
    pub counts: Counts,
    /// Length of the step that would have come next, as [`GeneralSettings::first_step`] of the stretch that
    /// follows.
    pub next_step: f64,
    /// Largest absolute displacement of the response point, `max |y|` [m].
    pub displacement: f64,
    /// Largest absolute acceleration of the response point, `max |y''|` [m/s^2].
    pub acceleration: f64,
    /// Largest contact force over all elements with a contact [N].
    pub contact_force: f64,
    /// Largest speed with which a contact closes [m/s].
    pub impact_velocity: f64,
    /// Sum of the impulses of all contacts [N s].
    pub impulse: f64,
    /// Speeds with which contacts closed, apart from rigid stops, in the order of time [m/s].
    pub touches: Vec<f64>,
    /// Impacts on the rigid stop of each element, and how many of them ended its chatter; empty without rigid
    /// stops.
    pub impacts: Vec<[u32; 2]>,
    /// Elements with a contact that was closed all the time, with or without pressure, one bit each (the
    /// first 64).
    pub closed_throughout: u64,
    /// Extrema of the penetrations `sign (r - level)` of all contacts, open or closed [m]: contacts that
    /// graze have some near zero. An impact on a rigid stop gives `v^2/(2 |r''|)`, to which the motion would
    /// have gone.
    pub extrema: Vec<f64>,
    /// Penetrations at which the motion of an element turns with a velocity that jumps, in an impact on a
    /// rigid stop elsewhere: extrema without a horizontal tangent, each with the number of its element [m].
    pub kinks: Vec<(usize, f64)>,
    /// The extrema element by element.
    pub of_elements: Vec<ElementMaxima>,
}

/// What the contacts of one element do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementMaxima {
    /// Largest contact force [N].
    pub contact_force: f64,
    /// Largest speed with which a contact closes [m/s]; zero if none does.
    pub impact_velocity: f64,
    /// Sum of the impulses [N s].
    pub impulse: f64,
    /// Deepest of the extrema of the penetration [m], zero if none is above the level; of impacts on a rigid
    /// stop as in [`Observed::extrema`].
    pub deepest: f64,
    /// Least magnitude of the extrema of the penetration [m]: next to zero where a contact grazes; infinite
    /// without extrema.
    pub nearest: f64,
}

impl Default for ElementMaxima {
    /// Of an element that does nothing.
    fn default() -> Self {
        Self { contact_force: 0.0, impact_velocity: 0.0, impulse: 0.0, deepest: 0.0, nearest: f64::INFINITY }
    }
}

impl ElementMaxima {
    /// An extremum of the penetration [m].
    pub fn meet(&mut self, extremum: f64) {
        self.deepest = self.deepest.max(extremum);
        self.nearest = self.nearest.min(extremum.abs());
    }

    /// Of a stretch and the one after it.
    #[must_use]
    pub fn joined(self, later: Self) -> Self {
        Self {
            contact_force: self.contact_force.max(later.contact_force),
            impact_velocity: self.impact_velocity.max(later.impact_velocity),
            impulse: self.impulse + later.impulse,
            deepest: self.deepest.max(later.deepest),
            nearest: self.nearest.min(later.nearest),
        }
    }
}

/// Motion of a system over a stretch, observed at a response point of displacement `shape . q +
/// support_ratios . u`.
///
/// * `state`: `[q; q']` in modal coordinates at the start, length 2n.
///
/// # Errors
/// See [`GeneralError`].
pub fn observe(
    system: &System,
    stretch: &Stretch,
    state: &[f64],
    (shape, support_ratios): (&[f64], &[f64]),
    settings: &GeneralSettings,
) -> Result<Observed, GeneralError> {
    check_frequency(stretch)?;
    let mut field = SystemField::new(system, stretch.frequency_hz);
    check(&field, (stretch.start, stretch.end), state, settings)?;
    field.check_start(stretch.start, state)?;
    let mut observer = Observer::new(&field, state, (shape, support_ratios));
    let mut march = March::new(&mut field, settings, (stretch.start, stretch.end), state);
    march.run(&mut observer)?;
    let flow = march.flow();
    let Observer { maxima, closed, extrema, kinks, contacts, impacts, of_elements, .. } = observer;
    let whole = of_elements.iter().copied().fold(ElementMaxima::default(), ElementMaxima::joined);
    let closed = contacts.iter().zip(&closed).filter(|(_, closed)| **closed).map(|(watched, _)| watched);
    Ok(Observed {
        flow: Flow {
            state: flow.state,
            by_state: flow.by_state,
            by_frequency: flow.by_parameter,
            by_parameter: Vec::new(),
        },
        counts: flow.counts,
        next_step: flow.next_step,
        displacement: maxima.displacement,
        acceleration: maxima.acceleration,
        contact_force: whole.contact_force,
        impact_velocity: whole.impact_velocity,
        impulse: whole.impulse,
        touches: maxima.touches,
        impacts,
        closed_throughout: closed
            .fold(0, |bits, watched| bits | 1_u64.checked_shl(watched.element as u32).unwrap_or(0)),
        extrema,
        kinks,
        of_elements,
    })
}

impl Observed {
    /// Number of contacts: those that closed, those that were closed throughout, and impacts on rigid stops,
    /// of which those of a stop that chatters to the end count once for every time that it does.
    #[must_use]
    pub fn contacts(&self) -> u32 {
        let of_stop = |[all, ends]: &[u32; 2]| if *ends > 0 { *ends } else { *all };
        self.touches.len() as u32
            + self.closed_throughout.count_ones()
            + self.impacts.iter().map(of_stop).sum::<u32>()
    }
}

#[derive(Default)]
struct Maxima {
    displacement: f64,
    acceleration: f64,
    touches: Vec<f64>,
}

/// What is read off: the response, or the relative displacement of an element.
#[derive(Clone, Copy)]
enum Output {
    Response,
    Element(usize),
}

/// A contact and its switching functions: one of the penetration, and one of the pressure if its law has it.
struct Watched {
    element: usize,
    contact: Contact,
    penetration: usize,
    pressure: Option<usize>,
}

impl Watched {
    /// All contacts of a system.
    fn of(field: &SystemField<'_>) -> Vec<Self> {
        let (mut first, mut watched) = (0, Vec::new());
        for (element, local) in field.system.elements().iter().enumerate() {
            let contacts = local.law.contacts();
            let pressure = local.law.has_pressure().then_some(first + contacts.len());
            watched.extend(contacts.iter().enumerate().map(|(k, &contact)| Self {
                element,
                contact,
                penetration: first + k,
                pressure,
            }));
            first += switches_of(local);
        }
        watched
    }

    fn presses(&self, inside: &[bool]) -> bool {
        inside[self.penetration] && self.pressure.is_none_or(|switch| inside[switch])
    }
}

struct Observer<'a> {
    shape: &'a [f64],
    support_ratios: &'a [f64],
    contacts: Vec<Watched>,
    inside: Vec<bool>,
    /// Which contacts were closed all the time.
    closed: Vec<bool>,
    maxima: Maxima,
    extrema: Vec<f64>,
    kinks: Vec<(usize, f64)>,
    /// Velocity of each element at the end of the last step, behind impacts there [m/s].
    velocities: Vec<f64>,
    of_elements: Vec<ElementMaxima>,
    /// Impacts on rigid stops, and how many stuck.
    impacts: Vec<[u32; 2]>,
    /// Takes steps of its own to where something is largest.
    exact: Stepper,
    state: Vec<f64>,
    rates: Vec<f64>,
}

impl<'a> Observer<'a> {
    fn new(field: &SystemField<'_>, state: &[f64], (shape, support_ratios): (&'a [f64], &'a [f64])) -> Self {
        let contacts = Watched::of(field);
        Self {
            shape,
            support_ratios,
            inside: vec![false; field.switches()],
            closed: vec![true; contacts.len()],
            contacts,
            maxima: Maxima::default(),
            extrema: Vec::new(),
            kinks: Vec::new(),
            velocities: vec![0.0; field.system.elements().len()],
            of_elements: vec![ElementMaxima::default(); field.system.elements().len()],
            impacts: vec![
                [0; 2];
                if field.rigid.stops.is_empty() { 0 } else { field.system.elements().len() }
            ],
            exact: Stepper::new(field, state, false),
            state: state.to_vec(),
            rates: state.to_vec(),
        }
    }

    /// Value and velocity of an output; of a hole its reading and its rate.
    fn read(&self, field: &SystemField<'_>, output: Output, phase: f64, state: &[f64]) -> [f64; 2] {
        let (shape, ratios) = (self.shape, self.support_ratios);
        let (q, v) = state.split_at(shape.len());
        if let Output::Element(e) = output {
            return field.reading(e, (q, v), phase);
        }
        let [u, velocity, _] = field.carried(ratios, phase);
        [dot(shape, q) + u, dot(shape, v) + velocity]
    }

    fn acceleration(&mut self, field: &mut SystemField<'_>, at: Place<'_>) -> f64 {
        field.evaluate(Point { time: at.time, state: at.state, inside: at.inside }, &mut self.rates);
        let elastic = dot(self.shape, &self.rates[self.shape.len()..]) / field.period;
        elastic + field.carried(self.support_ratios, at.time)[2]
    }

    /// Takes every maximum at a place of the motion itself.
    fn take(&mut self, field: &mut SystemField<'_>, at: Place<'_>) {
        let [displacement, _] = self.read(field, Output::Response, at.time, at.state);
        let acceleration = self.acceleration(field, at).abs();
        self.maxima.displacement = self.maxima.displacement.max(displacement.abs());
        self.maxima.acceleration = self.maxima.acceleration.max(acceleration);
        let forces: Vec<f64> = self.forces(field, at).collect();
        for (element, force) in self.of_elements.iter_mut().zip(forces) {
            element.contact_force = element.contact_force.max(force);
        }
    }

    /// Notes an extremum of the penetration of an element.
    fn add_extremum(&mut self, element: usize, extremum: f64) {
        self.extrema.push(extremum);
        self.of_elements[element].meet(extremum);
    }

    /// Keeps the velocities of the elements, which impacts change.
    fn note_velocities(&mut self, field: &SystemField<'_>, at: Place<'_>) {
        for element in 0..self.velocities.len() {
            self.velocities[element] = self.read(field, Output::Element(element), at.time, at.state)[1];
        }
    }

    /// Notes the elements whose velocity changes its sign in impacts on the rigid stops of others.
    fn add_kinks(&mut self, field: &SystemField<'_>, at: Place<'_>, impacts: &[Impact]) {
        for (element, local) in field.system.elements().iter().enumerate() {
            let is_struck = impacts.iter().any(|impact| impact.element == element);
            if is_struck || field.rigid.held.contains(&element) {
                continue;
            }
            let [r, velocity] = self.read(field, Output::Element(element), at.time, at.state);
            if (velocity > 0.0) != (self.velocities[element] > 0.0) {
                let contacts = local.law.contacts().iter();
                self.kinks.extend(contacts.map(|contact| (element, contact.sign * (r - contact.level))));
            }
        }
    }

    fn add_speed(&mut self, element: usize, speed: f64) {
        self.of_elements[element].impact_velocity = self.of_elements[element].impact_velocity.max(speed);
    }

    /// Contact forces of the elements.
    fn forces<'b>(&'b self, field: &'b SystemField<'_>, at: Place<'b>) -> impl Iterator<Item = f64> + 'b {
        let mut flags = at.inside;
        let held = !field.rigid.held.is_empty();
        let pressing = if held { field.pressing_forces(at.time, at.state, at.inside) } else { Vec::new() };
        field.system.elements().iter().enumerate().map(move |(e, element)| {
            let (inside, rest) = flags.split_at(switches_of(element));
            flags = rest;
            if inside.is_empty() {
                return 0.0;
            }
            if element.law.round_hole().is_some() {
                let (q, _) = at.state.split_at(element.shape.len());
                let force = field.hole_force(e, q, at.time, inside);
                return force.map_or(0.0, |force| force.value[0].hypot(force.value[1]));
            }
            if element.law.rigid().is_some() {
                return pressing.get(e).copied().unwrap_or(0.0).max(0.0);
            }
            let [r, speed] = self.read(field, Output::Element(e), at.time, at.state);
            force_in_region(&field.laws[e], (r, speed), inside).value.abs()
        })
    }
}

impl<'f> Watcher<SystemField<'f>> for Observer<'_> {
    fn begin(&mut self, field: &mut SystemField<'f>, start: Place<'_>) {
        self.inside.copy_from_slice(start.inside);
        let closed = self.closed.iter_mut().zip(&self.contacts);
        closed.for_each(|(closed, watched)| *closed = start.inside[watched.penetration]);
        self.note_velocities(field, start);
        self.take(field, start);
    }

    fn wants(&self, _: f64) -> bool {
        true
    }

    fn step(&mut self, field: &mut SystemField<'f>, step: &Accepted<'_>) {
        let end = Place { time: step.end, state: step.stepper.end_state(), inside: step.inside };
        self.take(field, end);
        self.extrema_of(field, step, Output::Response);
        for element in 0..field.system.elements().len() {
            if !field.system.elements()[element].law.contacts().is_empty() {
                self.extrema_of(field, step, Output::Element(element));
            }
        }
        self.note_velocities(field, end);
        self.largest_acceleration(field, step);
        if self.contacts.iter().any(|watched| watched.presses(step.inside)) {
            self.add_impulse(field, step);
        }
        for element in 0..field.system.elements().len() {
            let law = &field.system.elements()[element].law;
            if law.has_pressure() || field.rigid.held.contains(&element) {
                self.largest_force(field, step, element);
            }
        }
    }

    fn crossed(&mut self, field: &mut SystemField<'f>, at: Place<'_>) {
        let impacts = std::mem::take(&mut field.rigid.impacts);
        for impact in &impacts {
            self.impacts[impact.element][0] += 1;
            let ends_chatter = impact.sticks && field.laws[impact.element].chatters();
            self.impacts[impact.element][1] += u32::from(ends_chatter);
            self.add_speed(impact.element, impact.speed);
            self.of_elements[impact.element].impulse += impact.impulse;
            if impact.depth.is_finite() {
                self.add_extremum(impact.element, impact.depth);
            }
        }
        if !impacts.is_empty() {
            self.add_kinks(field, at, &impacts);
            self.note_velocities(field, at);
        }
        for (element, speed) in std::mem::take(&mut field.rigid.touches) {
            self.maxima.touches.push(speed);
            self.add_speed(element, speed);
        }
        for place in 0..self.contacts.len() {
            let watched = &self.contacts[place];
            let is_rigid = field.laws[watched.element].rigid().is_some();
            if !is_rigid && at.inside[watched.penetration] && !self.inside[watched.penetration] {
                let element = watched.element;
                let [_, velocity] = self.read(field, Output::Element(element), at.time, at.state);
                self.maxima.touches.push(velocity.abs());
                self.add_speed(element, velocity.abs());
            }
            self.closed[place] &= at.inside[self.contacts[place].penetration];
        }
        // A force that sets in with a jump may be largest at once.
        if !impacts.is_empty()
            || field.system.elements().iter().any(|element| element.law.onset_damping() > 0.0)
        {
            self.take(field, at);
        }
        self.inside.copy_from_slice(at.inside);
    }
}
