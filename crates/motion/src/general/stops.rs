//! What is known of rigid stops: which are held, which contacts rest beside them, which were struck.

use super::system_field::region::switches_of;

/// What a state at the start, or one that was held, may be off a stop, relative to the way of the
/// fastest impact in a period.
pub(super) const AT_START: f64 = 1e-10;
/// Speed, relative to the usual one, below which it is rounding.
pub(super) const AT_REST: f64 = 8.0 * f64::EPSILON;

/// What is known of the rigid stops of a system.
#[derive(Debug, Clone, Default)]
pub(super) struct RigidStops {
    /// Element and switching function of each.
    pub(super) stops: Vec<(usize, usize)>,
    /// Elements that are held.
    pub(super) held: Vec<usize>,
    /// Contacts whose penetration these keep at zero.
    pub(super) resting: Vec<Resting>,
    /// Fastest impact so far [m/s].
    pub(super) fastest: f64,
    /// Impacts since they were asked for last.
    pub(super) impacts: Vec<Impact>,
    /// Touches since then of contacts that close and open in one instant, of elements, with their speeds
    /// [m/s].
    pub(super) touches: Vec<(usize, f64)>,
}

/// An impact that happened.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impact {
    pub(super) element: usize,
    pub(super) speed: f64,
    pub(super) impulse: f64,
    pub(super) sticks: bool,
    /// How far the motion would have gone beyond the stop, as far as its acceleration then tells; infinite
    /// where that pressed on [m].
    pub(super) depth: f64,
}

impl RigidStops {
    pub(super) fn of(system: &crate::System) -> Self {
        let (mut first, mut stops) = (0, Vec::new());
        for (e, element) in system.elements().iter().enumerate() {
            if element.law.rigid().is_some() {
                stops.push((e, first));
            }
            first += switches_of(element);
        }
        Self { stops, ..Self::default() }
    }
}

/// A contact whose penetration held stops keep at zero.
#[derive(Debug, Clone)]
pub(super) struct Resting {
    pub(super) element: usize,
    /// Switching function of the penetration.
    pub(super) penetration: usize,
    /// Switching function of the pressure, and what that is at rest.
    pub(super) pressure: Option<(usize, f64)>,
    /// Held stops that have a part in it, and its penetration by their displacements.
    pub(super) holders: Vec<(usize, f64)>,
}

impl Resting {
    /// Its switching functions on the side on which it is, from what the stops press with.
    pub(super) fn write(&self, pressing: &[f64], inside: &[bool], values: &mut [f64]) {
        let least = self.holders.iter().map(|&(stop, _)| pressing[stop]).fold(f64::INFINITY, f64::min);
        let on_its_side = |switch: usize| if inside[switch] { least } else { -least };
        values[self.penetration] = on_its_side(self.penetration);
        if let Some((switch, at_rest)) = self.pressure {
            values[switch] = if at_rest > 0.0 { at_rest } else { on_its_side(switch) };
        }
    }

    /// Whether it opens where that stop is left.
    pub(super) fn opens_with(&self, stop: usize) -> bool {
        self.holders.iter().any(|&(holder, part)| holder == stop && part > 0.0)
    }

    pub(super) fn open(&self, inside: &mut [bool]) {
        inside[self.penetration] = false;
        if let Some((switch, at_rest)) = self.pressure {
            inside[switch] = at_rest > 0.0;
        }
    }
}
