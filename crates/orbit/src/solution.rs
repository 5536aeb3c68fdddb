//! What a computed periodic solution and a row of a branch hold.

use hammerbeam_motion::exact::Maxima;

use crate::{BranchEventKind, EventSet, LocatedEvent, Stability, spectrum::largest_modulus};

/// A converged periodic solution.
///
/// States are `[q; q']` in the modal coordinates of the system's model, length 2n.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicSolution {
    /// Excitation frequency [Hz].
    pub frequency_hz: f64,
    /// Orbit period over excitation period.
    pub period_multiple: u32,
    /// Phase of the excitation at which the orbit starts, at its first node [cycles], from 0 to 1; always 0
    /// without impact-speed-dependent laws.
    pub phase: f64,
    /// Shooting nodes: one state per segment, the first at [`phase`](Self::phase), the others at equal
    /// distances.
    pub nodes: Vec<Vec<f64>>,
    /// Floquet multipliers `[re, im]` of one orbit period, largest modulus first, positive imaginary part
    /// first in a pair.
    pub floquet_multipliers: Vec<[f64; 2]>,
    /// Which of them are on the unit circle as well as they are known (mathematics in `known_matrix.rs`).
    pub on_circle: Vec<bool>,
    /// Largest mismatch of the shooting equations, relative to the orbit (see the shooting module).
    pub residual: f64,
    /// Estimated error of the nodes, relative to the orbit (see the shooting module).
    pub error_estimate: f64,
    /// Maxima over one orbit period.
    pub maxima: OrbitMaxima,
}

impl PeriodicSolution {
    /// What follows from its Floquet multipliers, as well as they are known.
    #[must_use]
    pub fn stability(&self) -> Stability {
        Stability::of(&self.floquet_multipliers, &self.on_circle)
    }

    /// Whether all Floquet multipliers lie inside the unit circle, beyond doubt.
    #[must_use]
    pub fn stable(&self) -> bool {
        self.stability() == Stability::Stable
    }

    /// Whether no Floquet multiplier is known to lie outside the unit circle.
    #[must_use]
    pub fn may_be_stable(&self) -> bool {
        self.stability().may_be_stable()
    }

    /// Magnitude of the largest Floquet multiplier; 0 if there is none.
    #[must_use]
    pub fn largest_multiplier(&self) -> f64 {
        largest_modulus(&self.floquet_multipliers)
    }
}

/// Maxima of an orbit on the continuous motion, and its contacts, over one orbit period.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct OrbitMaxima {
    /// Largest absolute displacement of the response point, `max |y|` [m].
    pub displacement: f64,
    /// Largest absolute acceleration of the response point, `max |y''|` [m/s^2].
    pub acceleration: f64,
    /// Largest contact force over all elements [N].
    pub contact_force: f64,
    /// Largest speed with which a contact is reached [m/s].
    pub impact_velocity: f64,
    /// Sum of the impulses of all contacts [N s].
    pub impulse: f64,
    /// Number of contacts.
    pub contacts: u32,
}

impl From<Maxima> for OrbitMaxima {
    fn from(maxima: Maxima) -> Self {
        Self {
            displacement: maxima.displacement,
            acceleration: maxima.acceleration,
            contact_force: maxima.contact_force,
            impact_velocity: maxima.impact_velocity,
            impulse: maxima.impulse,
            contacts: maxima.contacts(),
        }
    }
}

/// The two directions in which a branch leaves its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The frequency increases at first.
    Up,
    /// The frequency decreases at first.
    Down,
}

/// Events at a row of a branch; several may coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Events {
    /// The branch turns in frequency (cyclic fold).
    pub fold: bool,
    /// A multiplier passes -1.
    pub flip: bool,
    /// A complex pair of multipliers passes the unit circle.
    pub neimark_sacker: bool,
    /// Branches cross.
    pub branch_point: bool,
    /// A contact is reached with zero velocity.
    pub grazing: bool,
    /// First row of the branch.
    pub start: bool,
    /// Last row of the branch.
    pub end: bool,
}

impl Events {
    /// The names of the events joined by `+`, empty if there are none.
    #[must_use]
    pub fn label(self) -> String {
        EventSet::from(self).label()
    }
}

impl From<Events> for EventSet {
    fn from(events: Events) -> Self {
        Self::of([
            (events.fold, BranchEventKind::Fold),
            (events.flip, BranchEventKind::Flip),
            (events.neimark_sacker, BranchEventKind::NeimarkSacker),
            (events.branch_point, BranchEventKind::BranchPoint),
            (events.grazing, BranchEventKind::Grazing),
            (events.start, BranchEventKind::Start),
            (events.end, BranchEventKind::End),
        ])
    }
}

/// One row of a branch: a solution and what happens at it.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchRow {
    /// The solution.
    pub solution: PeriodicSolution,
    /// Value of the parameter that varies, in its unit; `None` where it is the frequency.
    pub parameter: Option<f64>,
    /// Events located at it.
    pub events: Events,
    /// What is known of them; `None` where there are none.
    pub located: Option<LocatedEvent>,
}
