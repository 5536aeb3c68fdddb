//! Motion of a linear structure with local stops and springs, with exact sensitivities.
//!
//! # Mathematics
//! A [`System`] is a reduced structure with its load and its local elements,
//!
//! `q'' + C q' + diag(w^2) q = b(t) + sum_e phi_e f_e(r_e)`, `r_e = phi_e . q + sum_s s_es u_s`,
//!
//! where the elements depend on few scalars: their relative displacements `r_e`. The structure is known
//! exactly and only the forces `F_e(t)` are not, so the forces are discretised and not the modes. Both
//! integrators map a state `z = [q; q']` over a [`Stretch`], which is bounded by two phases of the
//! excitation, and give a [`Flow`]: the new state, the fundamental matrix, and the derivative by the
//! frequency at fixed phases.
//!
//! **Flight.** While no force acts, `z` is a particular solution of the load and a homogeneous one, `x(t) =
//! E(t) x(0)`, both in closed form: one 2 x 2 propagator for each block (a mode, or a pair of eigenvalues
//! where dampers couple modes). Over the flight `|r''|` and `|r'''|` have known bounds, sums of known
//! decaying amplitudes. From them follow steps that provably cannot jump over a contact; repeated, they
//! converge on the first one. No touch is missed, down to a rounding margin of `8 eps` times the terms of
//! `r`. The same search goes on while forces act, with bounds on the forces, for contacts that close and for
//! closed ones that open, if an enclosure of their penetration or pressure does not prove at once that they
//! stay closed; there the promise is on the motion that is computed, whose distance from the exact one is the
//! error of the step.
//!
//! **Contact.** Over a step of length h, with nodes `t_k`, the forces are `F(t) = sum_l F_l L_l(t)` and
//!
//! `r_k = r_particular(t_k) + X_k x + sum_l W_kl F_l`, `F_k = f(r_k)`, `x+ = E x + P F`.
//!
//! `W` and `P` are integrals of the modes' impulse responses against `L_l` and exact; what is left is
//! Newton's method with the small matrix `1 - W f'`. The step resolves the force, whatever the highest mode.
//! A Hertz force begins like `t^1.5`: in the graded variable `t = h s^2` it is smooth, so a contact takes a
//! step up to its middle and one down to its release, whose time is part of the solution.
//!
//! **Round holes** push back along the radius of two displacements, `F = f(rho) (y, z)/rho`. They are two
//! elements with an output and an input each. At the nodes `F_k = F(y_k, z_k)`, so `f'` has blocks of two.
//! Contacts are those of the reading `c/2 + (y^2 + z^2)/(2 c)`, whose derivatives have bounds from those of y
//! and z ([`law::RoundHole`], `exact/hole.rs`).
//!
//! **Laws that lose energy** depend on the relative velocity, too, which is known as exactly: `r'_k =
//! r'_particular(t_k) + X'_k x + sum_l W'_kl F_l`, where `W'` and `X'` have `C A` in the place of C. Newton's
//! matrix is `1 - f_r W - f_v W'`. Such a contact pushes or is idle: its force ends where the penetration or
//! the pressure vanishes (`law`), which is an event of its own; a contact that has parted is watched, with
//! the certified steps of a flight, for its pressure to come back. Some laws remember the speed v of the
//! impact that began the present contact, with `dv = dr' - r'' dr/r'` at the touch.
//!
//! **Rigid stops** have no force. An impact is a jump of the velocities with a saltation matrix of its own;
//! bounces that come to their end leave a structure that is held on the stop, which is a linear structure
//! again, with one mode less, and flies like the free one until the pressing force ends ([`exact`],
//! `impact.rs` and `held.rs`). Elements act on it as on the free one: its steps have `X`, `W`, `P` and E from
//! its own modes, and the reactions of the stops are in its inputs. The pressing force is an output with a
//! direct part of the forces, `lambda = C_l x + lambda_particular + Gamma F`, and the step ends where it
//! vanishes (`pressing.rs`). There the accelerations are continuous and nothing jumps in the sensitivities;
//! where a jump of a force or of a velocity throws the stop off, they jump by `B lambda dr/v` (`stick.rs`).
//!
//! **Sensitivities** `V` go through the same equations differentiated: `dr = (1 - W f')^-1 (X V + d
//! r_particular)`, `V+ = E V + P f' dr`. Where the force is continuous, nothing jumps as a contact opens or
//! closes; where it begins with the jump `-c r'` of a damper, `V+ = (1 - c B C) V`. One further column can be
//! the derivative by a [`Parameter`] `p` of the system. The particular solution is linear in the scale of the
//! excitation; a gap shifts the argument of its law, `dr -> dr - 1`; any other constant of a law has the
//! direct part `f_p` in `dF = f' (1 - W f')^-1 (X V + d r_particular + W f_p) + f_p`, for a stiffness `F/k`.
//! Damping of the structure changes the system matrix by `dA` and so acts on the whole motion: `ds/dt = A s +
//! dA x + ...`. Each part of x, the particular, the free and the forced one, drives its part of s in closed
//! form, with `dE`, `dX`, `dW` and `dP`, the changes of the matrices of a step, for coupled modes too
//! ([`exact`], `by_damping.rs`).
//!
//! **The check.** [`general`] integrates any vector field with its variational equations, by a Runge-Kutta
//! method of order eight. It shares no code with [`exact`] beyond the laws and is what that is tested
//! against, and measured against.
//!
//! # Example
//! A mass of 1 kg falls on a spring, from 1 m above it and from rest.
//! ```
//! use hammerbeam_motion::{
//!     Harmonic, HarmonicForce, Law, Load, LocalElement, Stretch, System,
//!     exact::{ExactIntegrator, ExactSettings}, law::LinearStop,
//! };
//! use hammerbeam_structure::{Damping, Lumped, LumpedMass, Reduction};
//!
//! let mass = LumpedMass { name: "mass".into(), mass: 1.0 };
//! let structure = Lumped { masses: vec![mass], ..Lumped::default() }.structure()?;
//! let model = structure.reduce(&Reduction::None, &Damping::none(), &[])?.model;
//! let shape = model.point("mass").expect("the mass has a point").shape.clone();
//! let constant = Harmonic { order: 0, amplitude: -9.81, phase: 0.0 };
//! let weight = HarmonicForce { shape: shape.clone(), harmonic: constant };
//! // Laws take r positive towards the stop, which lies below.
//! let floor = LocalElement {
//!     name: "floor".into(),
//!     shape: shape.iter().map(|phi| -phi).collect(),
//!     support_ratios: vec![0.0],
//!     law: Law::Linear(LinearStop::with_gap(1e6, 1.0)?),
//! };
//! let system = System::new(model, &Load { support: vec![], forces: vec![weight] }, vec![floor])?;
//! let mut integrator = ExactIntegrator::new(system, ExactSettings::default())?;
//! // In free fall until t = sqrt(2 h / g) = 0.4515 s; thereafter thrown back up.
//! let flow = integrator.flow(&Stretch { frequency_hz: 1.0, start: 0.0, end: 0.5 }, &[0.0, 0.0])?;
//! assert!(flow.state[1] > 0.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Limits
//! No friction. Round holes are elastic, and nothing beside them is rigid or loses energy. While forces act,
//! the end of a hold is looked for on polynomials through twelve nodes, which
//! resolve it to some 1e-9 of its parts, not with the bounds of a flight. Stops that throw one another off
//! beside such forces leave errors of up to 2e-6 in the sensitivities. A stretch cannot start in a contact
//! whose law remembers its impact, since a state `[q; q']` does not tell how the contact began; motions and
//! tangent vectors go on from the stretch before (`exact`). Such laws say nothing of a contact that is
//! pressed on without an impact. Where such a contact closes in the very instant in which one with a damper
//! does, the speed that it remembers has no derivative; that for one order of the two is given.

mod amplitude;
pub mod exact;
mod frequency_factor;
pub mod general;
mod in_front;
mod instant;
pub mod law;
mod load;
mod local_element;
mod parameter;
mod point_motion;
mod start_reach;
mod stretch;
mod system;
mod vectors;

pub use amplitude::{AmplitudeCurve, AmplitudeError};
pub use frequency_factor::FrequencyFactor;
pub use in_front::in_front_of_contacts;
pub use law::{Contact, Force, Law, LawConstant, LawError};
pub use load::{Harmonic, HarmonicForce, Load, SupportHarmonic};
pub use local_element::LocalElement;
pub use parameter::{Parameter, ParameterError};
pub use point_motion::PointMotion;
pub use start_reach::start_reach;
pub use stretch::{Flow, Stretch};
pub use system::{DampingPart, Family, Member, ModalLoad, System, SystemError};
