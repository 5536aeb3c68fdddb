//! Laws of contacts and springs in a word. Stiffness in N/m (Hertz: N/m^1.5), gaps in m.

use hammerbeam_motion::{
    Law,
    law::{
        Formula, HertzStop, HuntCrossleyStop, LinearStop, PowerSpring, RestitutionModel, RestitutionStop,
        RigidStop,
    },
};

/// A Hertz stop.
pub fn hertz(stiffness: f64, gap: f64) -> Law {
    Law::Hertz(HertzStop::with_gap(stiffness, gap).unwrap())
}

/// A linear stop.
pub fn linear(stiffness: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap())
}

/// A linear stop with a damper of `damping` N s/m.
pub fn damped(stiffness: f64, damping: f64, gap: f64) -> Law {
    Law::Linear(LinearStop::with_gap(stiffness, gap).unwrap().with_damping(damping).unwrap())
}

/// A Hertz stop with the loss of Hunt and Crossley, in s/m.
pub fn hunt_crossley(stiffness: f64, loss: f64, gap: f64) -> Law {
    Law::HuntCrossley(HuntCrossleyStop::new(HertzStop::with_gap(stiffness, gap).unwrap(), loss).unwrap())
}

/// A Hertz stop of an impact-speed-dependent law, with the coefficient of restitution `e`.
pub fn remembering(stiffness: f64, model: RestitutionModel, e: f64, gap: f64) -> Law {
    let hertz = HertzStop::with_gap(stiffness, gap).unwrap();
    Law::Restitution(RestitutionStop::new(hertz, model, e).unwrap())
}

/// A rigid stop.
pub fn rigid(restitution: f64, gap: f64) -> Law {
    Law::Rigid(RigidStop::with_gap(restitution, gap).unwrap())
}

/// A cubic spring, in N/m^3.
pub fn cubic(stiffness: f64) -> Law {
    Law::Power(PowerSpring::cubic(stiffness).unwrap())
}

/// A force that resists by a formula.
pub fn formula(text: &str) -> Law {
    Law::Formula(Formula::new(text, &[]).unwrap())
}
