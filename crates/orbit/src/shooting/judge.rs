//! What only orbits know, and the path asks of its judge: multipliers, orbits of shorter period, the same
//! orbit a period later, contacts, and grazing of rigid stops.

use hammerbeam_path::{Image, Judge, Node, Outside, PathEvents, PathProblem, RootCorner};

use super::{
    ShootingProblem,
    beside::{Beginning, Beside},
};
use crate::{corner, stability};
use hammerbeam_motion::exact::MotionError;

impl Judge for ShootingProblem {
    /// The first node stays, however the orbit is cut.
    fn memory_weights(&self) -> Option<Vec<f64>> {
        let weight = self.hertz_per_norm() * self.hertz_per_norm();
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

    fn outside(&mut self, events: PathEvents) -> Option<Outside> {
        if !self.watches_stability() {
            return None;
        }
        self.spectrum().ok().map(|spectrum| stability::outside(spectrum, events))
    }

    /// Distance from the orbits of shorter period, by the nodes that lie whole excitation periods apart, or
    /// where there are none by the motion.
    ///
    /// With `z_j` the nodes and s nodes in k excitation periods it is the root mean square of `z_{j+s} -
    /// z_j`, the least one over the proper divisors k of N for which s is a whole number.
    fn distance_to_simpler(&mut self, point: &[f64]) -> f64 {
        let (periods, m) = (self.period_multiple() as usize, self.segments());
        let states = &point[..self.unknowns()];
        let shift = |k: usize| {
            (periods.is_multiple_of(k) && (m * k).is_multiple_of(periods)).then_some(m * k / periods)
        };
        let distance = |nodes: usize| {
            let later = states.iter().cycle().skip(nodes * self.node_size());
            let squares: f64 = states.iter().zip(later).map(|(a, b)| (a - b) * (a - b)).sum();
            self.hertz_per_norm() * (squares / m as f64).sqrt()
        };
        let by_nodes = (1..periods).filter_map(shift).map(distance).reduce(f64::min);
        match by_nodes {
            None if periods > 1 => self.distance_by_motion(point),
            by_nodes => by_nodes.unwrap_or(f64::INFINITY),
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
        let reach = reach / self.hertz_per_norm();
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
    /// Distance of a point from the orbits of shorter period by its motion; infinite where that cannot be
    /// computed.
    fn distance_by_motion(&mut self, point: &[f64]) -> f64 {
        let Ok(mut beside) = self.take_beside() else { return f64::INFINITY };
        let begin = Beginning {
            scaled: &point[..self.scale.values().len()],
            scales: self.scale.values(),
            phase: self.phase,
            frequency_hz: self.frequency(point),
            period_multiple: self.period_multiple,
            parameter: self.varied.parameter().map(|parameter| (parameter, point[point.len() - 1])),
        };
        let distance = beside.distance(begin);
        self.beside = Some(beside);
        self.hertz_per_norm * distance
    }

    /// The motions beside; whoever takes them puts them back.
    pub(super) fn take_beside(&mut self) -> Result<Box<Beside>, MotionError> {
        match self.beside.take() {
            Some(beside) => Ok(beside),
            None => Beside::new(self.system(), self.integrator.settings()).map(Box::new),
        }
    }
}
