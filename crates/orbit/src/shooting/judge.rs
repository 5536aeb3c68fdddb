//! What only orbits know, and the path asks of its judge: multipliers, orbits of shorter period, the same
//! orbit a period later, contacts, and grazing of rigid stops.
//!
//! The orbit as it begins some whole excitation periods later is its nodes in another order, where they lie
//! so far apart. Else each node is carried along the motion from the last one before it.

use hammerbeam_motion::exact::{ExactIntegrator, MotionError};
use hammerbeam_path::{
    Image, Judge, Node, Outside, PathEvents, PathProblem, RootCorner, norm as weighed_norm,
};

use super::{
    ShootingProblem,
    beside::{Beside, KnownImages, OrbitStart, Simpler},
    carried::{Along, Carried},
};
use crate::{by_rows::norm, corner, stability};

/// Index of the test function of complex pairs.
const NEIMARK_SACKER: usize = 1;
/// Distance of an orbit from its mirror image, relative to it, up to which it may be a symmetric one: of
/// those that Newton's method finds the images lie nearer.
const SYMMETRIC: f64 = 1e-5;
/// Images that are known less well are of no use.
const MOST_MAGNIFIED: f64 = 1e3;

impl Judge for ShootingProblem {
    /// The first node stays, however the orbit is cut.
    fn memory_weights(&self) -> Option<Vec<f64>> {
        let weight = self.length_per_norm() * self.length_per_norm();
        Some(std::iter::repeat_n(weight, self.node_size()).chain([1.0]).collect())
    }

    /// The complex pairs of multipliers that are not on the unit circle, by the one in the upper half-plane.
    fn note(&mut self, numbers: &mut Vec<f64>) {
        numbers.clear();
        if self.watches_stability()
            && let Ok(spectrum) = self.spectrum()
        {
            numbers.extend(stability::pairs_off_circle(spectrum).flatten());
        }
    }

    fn hides_zeros(&self, before: &[f64], behind: &[f64]) -> bool {
        stability::pairs_cross_both_ways(before.as_chunks().0, behind.as_chunks().0)
    }

    /// The function of complex pairs does where one of them becomes two real multipliers.
    fn jumps(&self, index: usize, before: &[f64], behind: &[f64]) -> bool {
        index == NEIMARK_SACKER && stability::one_turns_real(before.as_chunks().0, behind.as_chunks().0)
    }

    fn outside(&mut self, events: PathEvents) -> Option<Outside> {
        if !self.watches_stability() {
            return None;
        }
        self.spectrum().ok().map(|spectrum| stability::outside(spectrum, events))
    }

    /// Distance from the orbits of shorter period and, for a walk of asymmetric orbits, from symmetric ones.
    fn distance_to_simpler(&mut self, point: &[f64]) -> f64 {
        let shorter = self.distance_to_shorter_period(point);
        if self.is_asymmetric() && self.has_symmetric_orbits() {
            shorter.min(self.distance_to_symmetric(point))
        } else {
            shorter
        }
    }

    /// The orbit as it begins some whole excitation periods later.
    fn images(&self) -> usize {
        self.period_multiple() as usize
    }

    fn image(&mut self, k: usize, of: &Node) -> Option<Image> {
        self.image_by_periods(k, of)
    }

    /// Impacts on rigid stops have a speed that goes like the root of the depth.
    fn has_root_corners(&self) -> bool {
        self.system().has_rigid_stops()
    }

    fn root_corner(
        &mut self,
        point: &[f64],
        reach: f64,
        lies_ahead: &dyn Fn(&[f64]) -> bool,
    ) -> Option<RootCorner> {
        let reach = reach / self.length_per_norm();
        corner::grazing_near(self, point, reach, lies_ahead)
    }

    fn signature(&self) -> u64 {
        // FNV-1a over the numbers of touches; without any, elements may be closed or open throughout.
        let still = self.touches().iter().all(|&t| t == 0);
        let closed = if still { self.integrator.closed_throughout() } else { 0 };
        let words = self.touches().iter().map(|&t| u64::from(t)).chain([closed]);
        words.fold(0xcbf2_9ce4_8422_2325, |hash, word| (hash ^ word).wrapping_mul(0x0100_0000_01b3))
    }
}

impl ShootingProblem {
    /// Distance of a point from the orbits of shorter period, by the nodes that lie whole excitation periods
    /// apart, or where there are none by the motion.
    ///
    /// With `z_j` the nodes and s nodes in k excitation periods it is the root mean square of `z_{j+s} -
    /// z_j`, the least one over the proper divisors k of N for which s is a whole number.
    pub(crate) fn distance_to_shorter_period(&mut self, point: &[f64]) -> f64 {
        let (periods, m) = (self.period_multiple() as usize, self.segments());
        let shift = |k: usize| {
            (periods.is_multiple_of(k) && (m * k).is_multiple_of(periods)).then_some(m * k / periods)
        };
        let shifts = (1..periods).filter_map(shift);
        match shifts.map(|nodes| self.distance_by_nodes(point, nodes, 1.0)).reduce(f64::min) {
            None if periods > 1 => self.distance_by_motion(point, Simpler::Shorter),
            by_nodes => by_nodes.unwrap_or(f64::INFINITY),
        }
    }

    /// Whether there are orbits that are their own mirror images half their period later: in a symmetric
    /// system, of an odd number of excitation periods.
    pub(crate) fn has_symmetric_orbits(&self) -> bool {
        self.system().is_symmetric() && !self.period_multiple().is_multiple_of(2)
    }

    /// Notes whether the orbits to be followed are asymmetric ones that may meet symmetric ones, by the one
    /// at this point. In doubt they are not: then nothing is known of what they meet.
    pub(crate) fn note_symmetry(&mut self, point: &[f64]) {
        let symmetric = SYMMETRIC * self.length_per_norm();
        let is_asymmetric = self.has_symmetric_orbits()
            && (symmetric..f64::INFINITY).contains(&self.distance_to_symmetric(point));
        self.set_asymmetric(is_asymmetric);
    }

    /// Distance of a point from the symmetric orbits: from its mirror image half its period later, by its
    /// nodes if their number is even, else by its motion. That holds for an odd number of excitation periods.
    pub(crate) fn distance_to_symmetric(&mut self, point: &[f64]) -> f64 {
        let m = self.segments();
        if m.is_multiple_of(2) {
            self.distance_by_nodes(point, m / 2, -1.0)
        } else {
            self.distance_by_motion(point, Simpler::Symmetric)
        }
    }

    /// The root mean square of `s z_{j+n} - z_j` for a sign s, with `z_j` the nodes and n as many of them.
    fn distance_by_nodes(&self, point: &[f64], nodes: usize, sign: f64) -> f64 {
        let states = &point[..self.unknowns()];
        let later = states.iter().cycle().skip(nodes * self.node_size());
        let squares: f64 = states.iter().zip(later).map(|(a, b)| (a - sign * b) * (a - sign * b)).sum();
        self.length_per_norm() * (squares / self.segments() as f64).sqrt()
    }

    /// Distance of a point from simpler orbits by its motion; infinite where that cannot be computed.
    fn distance_by_motion(&mut self, point: &[f64], from: Simpler) -> f64 {
        let Ok(mut beside) = self.take_beside() else { return f64::INFINITY };
        let start = OrbitStart {
            scaled: &point[..self.scale.values().len()],
            scales: self.scale.values(),
            phase: self.phase,
            frequency_hz: self.frequency(point),
            period_multiple: self.period_multiple,
            parameter: self.varied.parameter().map(|parameter| (parameter, point[point.len() - 1])),
        };
        let distance = beside.distance(start, from);
        self.beside = Some(beside);
        self.length_per_norm * distance
    }

    /// The motions beside; whoever takes them puts them back.
    fn take_beside(&mut self) -> Result<Box<Beside>, MotionError> {
        match self.beside.take() {
            Some(beside) => Ok(beside),
            None => Beside::new(self.system(), self.integrator.settings()).map(Box::new),
        }
    }

    /// The orbit and its tangent as they start k excitation periods later; `None` where the motion cannot be
    /// computed, or parts by more than [`MOST_MAGNIFIED`] until then: then a branch may be stored again some
    /// periods later.
    fn image_by_periods(&mut self, k: usize, of: &Node) -> Option<Image> {
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
