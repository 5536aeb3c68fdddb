//! A reduced structure with its load and its local elements: the equations of motion.
//! Equation (F1) of the book, `docs/theory`.
//!
//! `q'' + C q' + diag(w^2) q = Re sum_m b_m(W) exp(i 2 pi m cycles) + sum_e phi_e f_e(r_e)`, `r_e = phi_e . q
//! + sum_s s_es u_s`, with the circular excitation frequency `W = 2 pi f` and the displacements `u_s` of the
//! supports. Amplitudes may depend on the frequency (`amplitude.rs`): then so do `u_s` and `b_m`, besides the
//! powers of `W` in `b_m`, and derivatives by the frequency hold the slope of that curve.

mod driven;
mod error;
mod symmetry;
mod varied;

use std::sync::Arc;

use faer::{Mat, c64};
use hammerbeam_structure::ReducedModel;

use driven::{DrivenLoad, DrivenLoads};

pub use error::SystemError;

use crate::{FrequencyFactor, Harmonic, Law, Load, LocalElement, SupportHarmonic};

/// A reduced structure with its load and its local elements.
#[derive(Debug, Clone)]
pub struct System {
    model: ReducedModel,
    elements: Vec<LocalElement>,
    orders: Vec<u32>,
    /// Amplitudes of the supports for each order.
    supports: Vec<Vec<c64>>,
    forces: Vec<Vec<c64>>,
    /// The load as given: supports and forces at the scale one.
    unscaled: (Vec<Vec<c64>>, Vec<Vec<c64>>),
    /// Harmonics whose amplitude depends on the frequency.
    driven: DrivenLoads,
    excitation_scale: f64,
    /// Parts that can be added to the damping, and how much of each is.
    damping_parts: Vec<DampingPart>,
    added_damping: Vec<f64>,
    /// The damping as given.
    given_damping: DampingPart,
    /// The laws as given.
    given_laws: Vec<Law>,
    /// Families of systems that it belongs to.
    families: Vec<Kin>,
}

/// A part of the damping that can be added: what a unit of it adds to the equations of motion.
///
/// Every system has part 0, a ratio to critical damping of all modes; [`System::with_damping_part`] gives it
/// others, as a damper between two masses.
#[derive(Debug, Clone, PartialEq)]
pub struct DampingPart {
    /// `D` [1/s per unit], n x n, symmetric.
    pub matrix: Mat<f64>,
    /// `d_s` [kg^1/2/s per unit] of each support that moves, length n: how it transmits the velocity of that
    /// support; see [`SupportInput`](hammerbeam_structure::SupportInput).
    pub supports: Vec<Vec<f64>>,
}

/// Systems over a number. Their modal coordinates depend on it smoothly: modes keep their order and their
/// signs, and elements and loads theirs.
pub trait Family: std::fmt::Debug + Send + Sync {
    /// The system with a value of the number.
    ///
    /// # Errors
    /// Why there is none, in words.
    fn member(&self, value: f64) -> Result<Member, String>;
}

/// A system of a family.
#[derive(Debug, Clone)]
pub struct Member {
    /// The system.
    pub system: System,
    /// The response point in its coordinates: shape, length n, and support ratios.
    pub response: (Vec<f64>, Vec<f64>),
}

/// A family that a system is a member of.
#[derive(Debug, Clone)]
pub(crate) struct Kin {
    pub family: Arc<dyn Family>,
    /// Value of the member.
    pub value: f64,
    /// Change that counts as large.
    pub size: f64,
}

/// Modal load of one order and its derivative by the circular frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalLoad {
    /// `b_m`, length n.
    pub amplitude: Vec<c64>,
    /// `d b_m / d W`, length n.
    pub by_frequency: Vec<c64>,
}

impl System {
    /// Puts a model, its load and its local elements together.
    ///
    /// # Errors
    /// See [`SystemError`].
    pub fn new(
        model: ReducedModel,
        load: &Load,
        mut elements: Vec<LocalElement>,
    ) -> Result<Self, SystemError> {
        check(&model, load, &elements)?;
        elements.iter_mut().for_each(|element| element.support_ratios.resize(model.supports.len(), 0.0));
        let mut orders: Vec<u32> = load.harmonics().map(|harmonic| harmonic.order).collect();
        orders.sort_unstable();
        orders.dedup();
        let (supports, forces) = by_orders(&orders, load, &model);
        let unscaled = (supports.clone(), forces.clone());
        let ratio = Mat::from_fn(model.dof(), model.dof(), |i, j| {
            if i == j { 2.0 * model.natural_frequencies[i] } else { 0.0 }
        });
        let given = model.supports.iter().map(|support| support.damping.clone()).collect();
        let given_damping = DampingPart { matrix: model.damping.clone(), supports: given };
        let untouched = vec![vec![0.0; model.dof()]; model.supports.len()];
        let damping_parts = vec![DampingPart { matrix: ratio, supports: untouched }];
        Ok(Self {
            given_laws: elements.iter().map(|element| element.law.clone()).collect(),
            families: Vec::new(),
            model,
            elements,
            orders,
            supports,
            forces,
            unscaled,
            driven: DrivenLoads::default(),
            excitation_scale: 1.0,
            damping_parts,
            added_damping: vec![0.0],
            given_damping,
        })
    }

    /// Adds a load of which a factor depends on the frequency: a shaker that does not keep its amplitude, an
    /// unbalance, a prescribed acceleration.
    ///
    /// * `load`: its amplitudes, which the factor multiplies; no constant part.
    ///
    /// # Errors
    /// See [`SystemError`].
    pub fn with_amplitude_over_frequency(
        mut self,
        load: &Load,
        factor: impl Into<FrequencyFactor>,
    ) -> Result<Self, SystemError> {
        check(&self.model, load, &[])?;
        if load.harmonics().any(|harmonic| harmonic.order == 0) {
            return Err(SystemError::ConstantOverFrequency);
        }
        let mut orders = self.orders.clone();
        orders.extend(load.harmonics().map(|harmonic| harmonic.order));
        orders.sort_unstable();
        orders.dedup();
        let before = |order: &u32| self.orders.iter().position(|other| other == order);
        let (moving, n) = (self.model.supports.len(), self.dof());
        let again = |given: &[Vec<c64>], length: usize| -> Vec<Vec<c64>> {
            let none = || vec![c64::new(0.0, 0.0); length];
            orders.iter().map(|order| before(order).map_or_else(none, |i| given[i].clone())).collect()
        };
        let (supports, forces) = (again(&self.supports, moving), again(&self.forces, n));
        let unscaled = (again(&self.unscaled.0, moving), again(&self.unscaled.1, n));
        let mut driven = self.driven.clone();
        driven.rearrange(|given| again(given, given.first().map_or(0, Vec::len)));
        let (own_supports, own_forces) = by_orders(&orders, load, &self.model);
        driven.push(DrivenLoad { supports: own_supports, forces: own_forces, factor: factor.into() });
        self.driven = driven;
        (self.orders, self.supports, self.forces, self.unscaled) = (orders, supports, forces, unscaled);
        Ok(self)
    }

    /// Number of modes n; states have length 2n.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.model.dof()
    }

    /// The linear structure.
    #[must_use]
    pub fn model(&self) -> &ReducedModel {
        &self.model
    }

    /// The local elements.
    #[must_use]
    pub fn elements(&self) -> &[LocalElement] {
        &self.elements
    }

    /// Whether an element has a law that remembers the speed of its impact, so that stretches start where its
    /// contact is open.
    #[must_use]
    pub fn remembers_impacts(&self) -> bool {
        self.elements.iter().any(|element| element.law.remembers_impact())
    }

    /// Whether an element is a rigid stop, whose impacts turn velocities round at once.
    #[must_use]
    pub fn has_rigid_stops(&self) -> bool {
        self.elements.iter().any(|element| element.law.rigid().is_some())
    }

    /// Orders of the load, ascending; 0 is the constant part.
    #[must_use]
    pub fn orders(&self) -> &[u32] {
        &self.orders
    }

    /// Complex amplitude of each support's displacement [m] of the order with that index in
    /// [`System::orders`] at the circular frequency `W` [rad/s], and its derivative by `W`.
    #[must_use]
    pub fn support_amplitudes(&self, order_index: usize, circular_frequency: f64) -> Vec<(c64, c64)> {
        let zero = c64::new(0.0, 0.0);
        let mut moved: Vec<(c64, c64)> =
            self.supports[order_index].iter().map(|given| (*given, zero)).collect();
        for driven in self.driven.at(circular_frequency, self.excitation_scale) {
            for (moved, own) in moved.iter_mut().zip(&driven.load.supports[order_index]) {
                moved.0 += own * driven.factor;
                moved.1 += own * driven.slope;
            }
        }
        moved
    }

    /// Modal load of the order with that index in [`System::orders`], at the circular frequency `W` [rad/s].
    ///
    /// `b_m = sum_s ((m W)^2 g_s - i m W d_s) U_sm + F_m`.
    #[must_use]
    pub fn modal_load(&self, order_index: usize, circular_frequency: f64) -> ModalLoad {
        let mut amplitude = self.forces[order_index].clone();
        let mut by_frequency = vec![c64::new(0.0, 0.0); self.dof()];
        for driven in self.driven.at(circular_frequency, self.excitation_scale) {
            for (mode, force) in driven.load.forces[order_index].iter().enumerate() {
                amplitude[mode] += force * driven.factor;
                by_frequency[mode] += force * driven.slope;
            }
        }
        let moved = self.support_amplitudes(order_index, circular_frequency);
        for (support, (u, u_w)) in self.model.supports.iter().zip(moved) {
            let order = f64::from(self.orders[order_index]);
            let i = c64::new(0.0, 1.0);
            for mode in 0..self.dof() {
                let (inertia, damping) = (support.inertia[mode], support.damping[mode]);
                let velocity = i * order * damping;
                let rate = (order * circular_frequency).powi(2) * inertia - velocity * circular_frequency;
                amplitude[mode] += u * rate;
                let rate_w = 2.0 * order * order * circular_frequency * inertia - velocity;
                by_frequency[mode] += u * rate_w + u_w * rate;
            }
        }
        ModalLoad { amplitude, by_frequency }
    }
}

/// Support motions and forces of a load for each order.
fn by_orders(orders: &[u32], load: &Load, model: &ReducedModel) -> (Vec<Vec<c64>>, Vec<Vec<c64>>) {
    let n = model.dof();
    let of_order = |order: u32, h: &Harmonic| if h.order == order { complex(h) } else { c64::new(0.0, 0.0) };
    let motion_of = |order: u32, support: usize| {
        let own = load.support.iter().filter(|motion| motion.support == support);
        own.map(|motion| of_order(order, &motion.harmonic)).sum()
    };
    let supports = orders
        .iter()
        .map(|&order| (0..model.supports.len()).map(|support| motion_of(order, support)).collect())
        .collect();
    let force_of = |order: u32, mode: usize| {
        load.forces.iter().map(|force| of_order(order, &force.harmonic) * force.shape[mode]).sum()
    };
    let forces = orders.iter().map(|&order| (0..n).map(|i| force_of(order, i)).collect()).collect();
    (supports, forces)
}

fn complex(harmonic: &Harmonic) -> c64 {
    if harmonic.order == 0 {
        return c64::new(harmonic.amplitude * harmonic.phase.cos(), 0.0);
    }
    c64::new(harmonic.amplitude * harmonic.phase.cos(), harmonic.amplitude * harmonic.phase.sin())
}

fn check(model: &ReducedModel, load: &Load, elements: &[LocalElement]) -> Result<(), SystemError> {
    let count = model.supports.len();
    if !load.support.is_empty() && count == 0 {
        return Err(SystemError::NoMovingSupport);
    }
    if let Some(motion) = load.support.iter().find(|motion| motion.support >= count) {
        let what = "a support motion".to_owned();
        return Err(SystemError::NoSuchSupport { what, number: motion.support + 1, count });
    }
    let shape = |what: String, values: &[f64]| {
        if values.len() != model.dof() {
            return Err(SystemError::Length { what, found: values.len(), expected: model.dof() });
        }
        finite(what, values)
    };
    shape("the vector of eigenfrequencies".into(), &model.natural_frequencies)?;
    for force in &load.forces {
        shape("a load".into(), &force.shape)?;
        finite("a load".into(), &[force.harmonic.amplitude, force.harmonic.phase])?;
    }
    for SupportHarmonic { harmonic, .. } in &load.support {
        finite("the support motion".into(), &[harmonic.amplitude, harmonic.phase])?;
    }
    for element in elements {
        shape(format!("element {}", element.name), &element.shape)?;
        finite(format!("element {}", element.name), &element.support_ratios)?;
        let beyond = element.support_ratios.iter().skip(count);
        if let Some((index, _)) = beyond.enumerate().find(|(_, ratio)| **ratio != 0.0) {
            let what = format!("a part of the motion of element {}", element.name);
            return Err(SystemError::NoSuchSupport { what, number: count + index + 1, count });
        }
    }
    check_holes(elements)
}

/// Holes have two directions, and only elastic elements beside them.
fn check_holes(elements: &[LocalElement]) -> Result<(), SystemError> {
    let is_first =
        |index: usize| elements.get(index).is_some_and(|element| element.law.round_hole().is_some());
    let is_second = |index: usize| elements.get(index).is_some_and(|element| element.law.is_across_hole());
    for (index, element) in elements.iter().enumerate() {
        let half = is_first(index) && !is_second(index + 1)
            || is_second(index) && !(index > 0 && is_first(index - 1));
        if half {
            return Err(SystemError::HalfHole { name: element.name.clone() });
        }
    }
    let Some(hole) = elements.iter().find(|element| element.law.round_hole().is_some()) else {
        return Ok(());
    };
    let loses = |element: &&LocalElement| element.law.rigid().is_some() || element.law.depends_on_velocity();
    match elements.iter().find(loses) {
        Some(other) => Err(SystemError::BesideHole { name: other.name.clone(), hole: hole.name.clone() }),
        None => Ok(()),
    }
}

fn finite(what: String, values: &[f64]) -> Result<(), SystemError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&found) => Err(SystemError::NotFinite { what, found }),
        None => Ok(()),
    }
}
