//! Closed contacts whose force has a kink: where its slope jumps, while the force itself is continuous.
//!
//! A step follows one piece of the force, continued smoothly beyond its ends, so no kink lies in it. Where
//! the displacement comes to the end of the piece the step ends, as at the touch of another contact: the
//! distance to the kink is searched with the same proof (`touching.rs`), and the length of the step is
//! located on it (`event.rs`). There the law goes over to the next piece.
//!
//! The force is continuous, so nothing jumps in the state or in the sensitivities: `dF = f' dr` from either
//! side. A kink that is passed earlier by dt changes the impulse by `(f_1 - f_2) dt`, which is of second
//! order.
//!
//! Laws as built have their whole force; those of a run are in the piece that holds its displacement.

use super::{
    ExactIntegrator,
    flight::{Boundary, Touch},
    run::Run,
};

impl ExactIntegrator {
    /// Puts the laws with kinks into the pieces that hold the displacements at the start of a stretch.
    pub(super) fn find_pieces(&mut self, run: &Run) {
        for element in 0..self.laws.len() {
            if self.laws[element].has_kinks() {
                let jet = self.output_jet(&run.state, element, 0.0);
                self.laws[element] = self.laws[element].in_piece(jet.value);
            }
        }
    }

    /// Puts the law of a contact that closes into its first piece.
    pub(super) fn start_with_first_piece(&mut self, touch: Touch) {
        let law = &self.laws[touch.element];
        if law.has_kinks() {
            self.laws[touch.element] = law.in_piece(law.contacts()[touch.contact].level);
        }
    }

    /// The kinks at the ends of the piece that a closed contact is in.
    pub(super) fn watched_kinks(
        &self,
        element: usize,
        contact: usize,
    ) -> impl Iterator<Item = Touch> + use<> {
        let kinks = self.laws[element].kinks();
        let boundary = |deeper: usize| Boundary::Kink { deeper: deeper == 1 };
        (0..2).filter(move |&side| kinks[side].is_some()).map(move |side| Touch {
            element,
            contact,
            boundary: boundary(side),
        })
    }

    /// Goes over to the piece beyond a kink.
    pub(super) fn cross_kink(&mut self, element: usize, deeper: bool) {
        self.laws[element] = self.laws[element].beyond_kink(deeper);
    }
}
