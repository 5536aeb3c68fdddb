//! Where a contact that stays closed is pressed least between two presses.

use super::{
    collocation::NODES,
    course::{Course, CourseStep, Passage},
    hole,
};

/// A node of a force step that is pressed less than its neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Valley {
    pub piece: usize,
    pub step: CourseStep,
    pub element: usize,
    pub node: usize,
    /// Magnitude of the force there [N].
    force: f64,
}

impl Valley {
    fn is(&self, other: &Self) -> bool {
        (self.piece, self.node, self.step.start) == (other.piece, other.node, other.step.start)
    }
}

/// The lowest valleys of an element's force, at most so many, among the nodes of the steps that one contact
/// lasts, the lowest first. An orbit begins as it ends: its first stretch is looked at once more behind the
/// last.
pub(super) fn lowest_valleys(course: &Course, element: usize, most: usize) -> Vec<Valley> {
    let mut valleys: Vec<Valley> = Vec::new();
    let (mut earlier, mut middle) = (f64::NAN, None::<Valley>);
    let pieces = (0..course.stretches.len()).chain(0..course.stretches.len().min(1));
    let passages =
        pieces.flat_map(|piece| course.of_stretch(piece).iter().map(move |passage| (piece, passage)));
    for (piece, passage) in passages {
        let step = match passage {
            Passage::Touch { .. } => continue,
            Passage::Step(step) => Some(step),
            _ => None,
        };
        let place = step.and_then(|step| course.active(step).iter().position(|(other, _)| *other == element));
        let (Some(step), Some(place)) = (step, place) else {
            (earlier, middle) = (f64::NAN, None);
            continue;
        };
        let law = &course.active(step)[place].1;
        let forces = hole::magnitudes(law, course.numbers(step.force).as_chunks::<NODES>().0, place);
        for (node, force) in forces.iter().map(|force| force.abs()).enumerate() {
            if let Some(middle) = middle.filter(|middle| earlier >= middle.force && middle.force < force)
                && !valleys.iter().any(|known| known.is(&middle))
            {
                valleys.push(middle);
            }
            earlier = middle.map_or(f64::NAN, |middle| middle.force);
            middle = Some(Valley { piece, step: *step, element, node, force });
        }
    }
    valleys.sort_by(|a, b| a.force.total_cmp(&b.force));
    valleys.truncate(most);
    valleys
}
