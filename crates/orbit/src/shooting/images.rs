//! An orbit as it begins some whole excitation periods later.
//!
//! Where nodes lie so far apart it is the same nodes in another order. Else each node is carried along the
//! motion from the last one before it, by an integrator of its own.

use hammerbeam_motion::exact::{ExactIntegrator, MotionError};
use hammerbeam_path::{Image, Node, PathProblem, norm as weighed_norm};

use super::{
    ShootingProblem,
    carried::{Along, Carried},
};
use crate::spectrum::norm;

/// Images that are known less well tell nothing.
const MOST_MAGNIFIED: f64 = 1e3;

/// The images of one orbit.
#[derive(Debug)]
pub(super) struct KnownImages {
    of: Node,
    phase: f64,
    /// By their numbers, from 1 on.
    images: Vec<Option<Image>>,
}

impl ShootingProblem {
    /// The orbit and its tangent as they begin k excitation periods later; `None` where the motion cannot be
    /// computed, or parts by more than [`MOST_MAGNIFIED`] until then: then a branch may be stored again some
    /// periods later.
    pub(super) fn image_by_periods(&mut self, k: usize, of: &Node) -> Option<Image> {
        let (periods, m) = (self.period_multiple() as usize, self.segments());
        if (m * k).is_multiple_of(periods) {
            let node = Node { point: self.rotated(k, &of.point), tangent: self.rotated(k, &of.tangent) };
            return Some(Image { node, magnification: 1.0 });
        }
        let known = self.images.as_ref().filter(|known| known.phase == self.phase && known.of == *of);
        if known.is_none() {
            let images = self.carried_images(of).unwrap_or_else(|_| vec![None; periods - 1]);
            self.images = Some(Box::new(KnownImages { of: of.clone(), phase: self.phase, images }));
        }
        self.images.as_ref()?.images[k - 1].clone()
    }

    /// A point or tangent whose nodes lie k excitation periods later.
    fn rotated(&self, k: usize, vector: &[f64]) -> Vec<f64> {
        let last = self.unknowns();
        let shift = k * self.segments() / self.period_multiple() as usize * self.node_size();
        vector[shift..last].iter().chain(&vector[..shift]).chain(&vector[last..]).copied().collect()
    }

    fn carried_images(&mut self, of: &Node) -> Result<Vec<Option<Image>>, MotionError> {
        let mut beside = self.take_beside()?;
        let images = beside.integrator_at(self.varied, &of.point).map(|integrator| {
            let image = |k| self.carried_image(integrator, k, of).ok();
            let images = (1..self.period_multiple() as usize).map(image);
            images.map(|image| image.filter(|image| image.magnification <= MOST_MAGNIFIED)).collect()
        });
        self.beside = Some(beside);
        images
    }

    fn carried_image(
        &self,
        integrator: &mut ExactIntegrator,
        k: usize,
        of: &Node,
    ) -> Result<Image, MotionError> {
        let (periods, m, last) = (self.period_multiple() as usize, self.segments(), self.unknowns());
        let before = m * k / periods;
        let offset = (m * k - before * periods) as f64 / m as f64;
        let along = Along { scales: self.scale.values(), varied: self.varied, last_slope: of.tangent[last] };
        let mut node = Node::default();
        let mut magnification = 1.0_f64;
        for segment in (0..m).map(|node| (node + before) % m) {
            let mut stretch = self.stretch(segment, self.frequency(&of.point));
            stretch.end = stretch.start + offset;
            let from = self.node_slope(&of.point, &of.tangent, segment);
            let Carried { at, matrix } = from.flown(integrator, &stretch, along)?;
            node.point.extend(at.node);
            node.tangent.extend(at.slope);
            magnification = magnification.max(norm(&matrix));
        }
        node.point.push(of.point[last]);
        node.tangent.push(of.tangent[last]);
        let length = weighed_norm(self.weights(), &node.tangent);
        node.tangent.iter_mut().for_each(|entry| *entry /= length);
        Ok(Image { node, magnification })
    }
}
