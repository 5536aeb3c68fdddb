//! A reduced structure with its load and its local elements: the equations of motion.
//!
//! `q'' + C q' + diag(w^2) q = Re sum_m b_m(W) exp(i 2 pi m cycles) + sum_e phi_e f_e(r_e)`, `r_e = phi_e .
//! q + s_e u`, with the circular excitation frequency `W = 2 pi f`. Amplitudes may depend on the frequency
//! (`amplitude.rs`): then so do `u` and `b_m`, besides the powers of `W` in `b_m`, and derivatives by the
//! frequency hold the slope of that curve.

mod symmetry;
mod varied;

use std::f64::consts::TAU;

use faer::{Mat, c64};
use hammerbeam_structure::ReducedModel;

use crate::{AmplitudeCurve, DampingPart, Harmonic, Law, Load, parameter::Kin};

/// Why a model, a load and elements do not make a system.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// A vector over the modes has the wrong length.
    #[error("{what} has {found} entries, the model has {expected} modes")]
    #[expect(missing_docs, reason = "the message names its fields")]
    Length { what: String, found: usize, expected: usize },
    /// Support motion is prescribed, but the model has no moving support.
    #[error("support motion is prescribed, but no support of the structure can move")]
    NoMovingSupport,
    /// A number of the model, the load or an element is infinite or not a number.
    #[error("{what} holds {found}, must be finite")]
    #[expect(missing_docs, reason = "the message names its fields")]
    NotFinite { what: String, found: f64 },
    /// A constant load has no amplitude over the frequency.
    #[error("a load of order 0 cannot have an amplitude over the frequency")]
    ConstantOverFrequency,
}

/// A local element: a law between two points, or between a point and its surroundings.
#[derive(Debug, Clone, PartialEq)]
pub struct LocalElement {
    /// Name for reports.
    pub name: String,
    /// `phi_e`: relative displacement per modal coordinate, and modal load per unit force, length n.
    pub shape: Vec<f64>,
    /// `s_e`: relative displacement per unit support displacement: 0 for a stop that rides on the support.
    pub support_ratio: f64,
    /// The force law.
    pub law: Law,
}

/// A reduced structure with its load and its local elements.
#[derive(Debug, Clone)]
pub struct System {
    model: ReducedModel,
    elements: Vec<LocalElement>,
    orders: Vec<u32>,
    support: Vec<c64>,
    forces: Vec<Vec<c64>>,
    /// The load as given: support and forces at the scale one.
    unscaled: (Vec<c64>, Vec<Vec<c64>>),
    /// Harmonics whose amplitude depends on the frequency.
    driven: Option<Driven>,
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

/// Harmonics that a curve of the frequency is a factor of: support motion and forces, by the orders of the
/// system.
#[derive(Debug, Clone)]
struct Driven {
    support: Vec<c64>,
    forces: Vec<Vec<c64>>,
    curve: AmplitudeCurve,
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
    pub fn new(model: ReducedModel, load: &Load, elements: Vec<LocalElement>) -> Result<Self, SystemError> {
        check(&model, load, &elements)?;
        let mut orders: Vec<u32> = load
            .support
            .iter()
            .chain(load.forces.iter().map(|force| &force.harmonic))
            .map(|h| h.order)
            .collect();
        orders.sort_unstable();
        orders.dedup();
        let (support, forces) = by_orders(&orders, load, model.dof());
        let unscaled = (support.clone(), forces.clone());
        let ratio = Mat::from_fn(model.dof(), model.dof(), |i, j| {
            if i == j { 2.0 * model.natural_frequencies[i] } else { 0.0 }
        });
        let given = model.support.as_ref().map_or(vec![0.0; model.dof()], |support| support.damping.clone());
        let given_damping = DampingPart { matrix: model.damping.clone(), support: given };
        let damping_parts = vec![DampingPart { matrix: ratio, support: vec![0.0; model.dof()] }];
        Ok(Self {
            given_laws: elements.iter().map(|element| element.law).collect(),
            families: Vec::new(),
            model,
            elements,
            orders,
            support,
            forces,
            unscaled,
            driven: None,
            excitation_scale: 1.0,
            damping_parts,
            added_damping: vec![0.0],
            given_damping,
        })
    }

    /// Adds a load of which a curve of the frequency is a factor: the amplitude of a shaker that does not
    /// keep it.
    ///
    /// * `load`: its amplitudes, which the curve multiplies; no constant part. A load that was added before
    ///   is replaced.
    ///
    /// # Errors
    /// See [`SystemError`].
    pub fn with_amplitude_over_frequency(
        mut self,
        load: &Load,
        curve: AmplitudeCurve,
    ) -> Result<Self, SystemError> {
        check(&self.model, load, &[])?;
        let harmonics = || load.support.iter().chain(load.forces.iter().map(|force| &force.harmonic));
        if harmonics().any(|harmonic| harmonic.order == 0) {
            return Err(SystemError::ConstantOverFrequency);
        }
        let mut orders = self.orders.clone();
        orders.extend(harmonics().map(|harmonic| harmonic.order));
        orders.sort_unstable();
        orders.dedup();
        let (zero, n) = (c64::new(0.0, 0.0), self.dof());
        let before = |order: &u32| self.orders.iter().position(|other| other == order);
        let moved = |support: &[c64]| -> Vec<c64> {
            orders.iter().map(|order| before(order).map_or(zero, |index| support[index])).collect()
        };
        let pushed = |forces: &[Vec<c64>]| -> Vec<Vec<c64>> {
            orders
                .iter()
                .map(|order| before(order).map_or_else(|| vec![zero; n], |index| forces[index].clone()))
                .collect()
        };
        let (support, forces) = (moved(&self.support), pushed(&self.forces));
        let unscaled = (moved(&self.unscaled.0), pushed(&self.unscaled.1));
        let driven = by_orders(&orders, load, n);
        self.driven = Some(Driven { support: driven.0, forces: driven.1, curve });
        (self.orders, self.support, self.forces, self.unscaled) = (orders, support, forces, unscaled);
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

    /// Complex amplitude of the support displacement [m] of the order with that index in [`System::orders`]
    /// at the circular frequency `W` [rad/s], and its derivative by `W`.
    #[must_use]
    pub fn support_amplitude(&self, order_index: usize, circular_frequency: f64) -> (c64, c64) {
        let given = self.support[order_index];
        match self.driven_at(circular_frequency) {
            None => (given, c64::new(0.0, 0.0)),
            Some((driven, factor, slope)) => {
                let support = driven.support[order_index];
                (given + support * factor, support * slope)
            }
        }
    }

    /// What the frequency drives, its factor with the scale of the excitation, and the derivative of that by
    /// the circular frequency.
    fn driven_at(&self, circular_frequency: f64) -> Option<(&Driven, f64, f64)> {
        let driven = self.driven.as_ref()?;
        let (factor, slope) = driven.curve.at(circular_frequency / TAU);
        Some((driven, self.excitation_scale * factor, self.excitation_scale * slope / TAU))
    }

    /// Modal load of the order with that index in [`System::orders`], at the circular frequency `W` [rad/s].
    ///
    /// `b_m = (m W)^2 U_m g - i m W U_m d + F_m`.
    #[must_use]
    pub fn modal_load(&self, order_index: usize, circular_frequency: f64) -> ModalLoad {
        let mut amplitude = self.forces[order_index].clone();
        let mut by_frequency = vec![c64::new(0.0, 0.0); self.dof()];
        if let Some((driven, factor, slope)) = self.driven_at(circular_frequency) {
            for (mode, force) in driven.forces[order_index].iter().enumerate() {
                amplitude[mode] += force * factor;
                by_frequency[mode] += force * slope;
            }
        }
        if let Some(support) = &self.model.support {
            let order = f64::from(self.orders[order_index]);
            let (u, u_w) = self.support_amplitude(order_index, circular_frequency);
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

/// Support motion and forces of a load for each order.
fn by_orders(orders: &[u32], load: &Load, n: usize) -> (Vec<c64>, Vec<Vec<c64>>) {
    let of_order = |order: u32, h: &Harmonic| if h.order == order { complex(h) } else { c64::new(0.0, 0.0) };
    let support = orders
        .iter()
        .map(|&order| load.support.iter().map(|harmonic| of_order(order, harmonic)).sum())
        .collect();
    let force_of = |order: u32, mode: usize| {
        load.forces.iter().map(|force| of_order(order, &force.harmonic) * force.shape[mode]).sum()
    };
    let forces = orders.iter().map(|&order| (0..n).map(|i| force_of(order, i)).collect()).collect();
    (support, forces)
}

fn complex(harmonic: &Harmonic) -> c64 {
    if harmonic.order == 0 {
        return c64::new(harmonic.amplitude * harmonic.phase.cos(), 0.0);
    }
    c64::new(harmonic.amplitude * harmonic.phase.cos(), harmonic.amplitude * harmonic.phase.sin())
}

fn check(model: &ReducedModel, load: &Load, elements: &[LocalElement]) -> Result<(), SystemError> {
    if !load.support.is_empty() && model.support.is_none() {
        return Err(SystemError::NoMovingSupport);
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
    for harmonic in &load.support {
        finite("the support motion".into(), &[harmonic.amplitude, harmonic.phase])?;
    }
    for element in elements {
        shape(format!("element {}", element.name), &element.shape)?;
        finite(format!("element {}", element.name), &[element.support_ratio])?;
    }
    Ok(())
}

fn finite(what: String, values: &[f64]) -> Result<(), SystemError> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(&found) => Err(SystemError::NotFinite { what, found }),
        None => Ok(()),
    }
}
