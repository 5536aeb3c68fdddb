//! The motion at which a walk gets no further, with its contacts.

use hammerbeam_motion::{
    Stretch,
    exact::{ContactPiece, Touchdown},
};

use super::orbit_path::OrbitPath;

/// The contacts of an orbit, segment by segment.
pub(super) struct LastMotion {
    segments: Vec<(Stretch, Vec<ContactPiece>)>,
}

/// An impact on a rigid stop.
pub(super) struct Impact<'m> {
    pub element: usize,
    pub frequency_hz: f64,
    /// Of the excitation [cycles].
    pub phase: f64,
    pub touch: &'m Touchdown,
}

impl LastMotion {
    /// The motion of the present point; `None` if it cannot be computed.
    pub fn of(path: &mut OrbitPath) -> Option<Self> {
        let OrbitPath { problem, follower, .. } = path;
        let point = &follower.current().point;
        problem.move_to(point).ok()?;
        let frequency_hz = problem.frequency(point);
        let mut segments = Vec::new();
        for (segment, node) in problem.nodes(point).iter().enumerate() {
            let stretch = problem.stretch(segment, frequency_hz);
            let contacts = problem.integrator().trace(&stretch, node, &[]).ok()?.contacts;
            segments.push((stretch, contacts));
        }
        Some(Self { segments })
    }

    /// Its impacts, in their order.
    pub fn impacts(&self) -> impl Iterator<Item = Impact<'_>> {
        self.segments.iter().flat_map(|(stretch, contacts)| {
            contacts.iter().filter(|contact| contact.jump.is_some()).filter_map(|contact| {
                let touch = contact.begin.as_ref()?;
                let (element, frequency_hz) = (contact.element, stretch.frequency_hz);
                Some(Impact {
                    element,
                    frequency_hz,
                    phase: stretch.start + touch.time * frequency_hz,
                    touch,
                })
            })
        })
    }
}
