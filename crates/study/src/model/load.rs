//! Excitation and loads of a study as harmonics over the modes.

use hammerbeam_motion::{FrequencyFactor, Harmonic, HarmonicForce, Load, SupportHarmonic};
use hammerbeam_structure::ReducedModel;

use crate::file::{
    self, ActingForce, Amplitude, ExcitationKind, ForcePlace, ForceSize, HarmonicExcitation, Study,
    StudyError, StudyFile, SupportDrive,
};

/// Refuses forces on points that cannot move.
pub(super) fn check(file: &StudyFile, model: &ReducedModel) -> Result<(), StudyError> {
    let does_nothing = |place: &[&str]| {
        let shapes: Vec<Vec<f64>> = place.iter().map(|at| shape(model, at)).collect();
        shapes.iter().all(|shape| shape.iter().all(|entry| *entry == 0.0))
    };
    let refused = |key: String, place: &[&str]| {
        let at = place.join("\" and \"");
        let message = format!("a force at \"{at}\" does nothing: its motion is prescribed or held");
        file.fault(&key, message, vec!["allowed: a point that can move".into()])
    };
    let key = |key: String, points: usize| format!("{key}.{}", if points > 1 { "between" } else { "at" });
    for (index, load) in file.study.loads.iter().enumerate() {
        let place: Vec<&str> = load.force_points().iter().map(String::as_str).collect();
        if !place.is_empty() && does_nothing(&place) {
            return Err(refused(key(format!("load[{index}]"), place.len()), &place));
        }
    }
    match file.study.excitation.harmonic().map(|harmonic| &harmonic.kind) {
        Some(ExcitationKind::Force { at, .. }) if does_nothing(&[at]) => {
            Err(refused("excitation.at".to_owned(), &[at]))
        }
        Some(ExcitationKind::Forces { forces }) => {
            for (index, force) in forces.iter().enumerate() {
                let place: Vec<&str> = force.place.points().iter().map(String::as_str).collect();
                if does_nothing(&place) {
                    return Err(refused(key(format!("excitation.force[{index}]"), place.len()), &place));
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

/// All that drives a structure.
#[derive(Debug, Default)]
pub(super) struct Drive {
    /// Loads whose amplitudes the frequency does not change.
    pub kept: Load,
    /// Loads that a factor of the frequency multiplies.
    pub driven: Vec<(Load, FrequencyFactor)>,
}

impl Drive {
    /// Excitation and loads of a study, in their order.
    pub fn of(study: &Study, model: &ReducedModel) -> Self {
        let mut drive = Self::default();
        if let Some(harmonic) = study.excitation.harmonic() {
            drive.excite(harmonic, model);
        }
        for load in &study.loads {
            drive.add(load, model);
        }
        drive
    }

    /// Adds what has an amplitude, times a power of the frequency that may be none.
    fn push(&mut self, amplitude: &Amplitude, power: FrequencyFactor, load: impl Fn(f64) -> Load) {
        match (amplitude.constant(), amplitude.curve()) {
            (Some(amplitude), _) if power == FrequencyFactor::default() => {
                let own = load(amplitude);
                self.kept.support.extend(own.support);
                self.kept.forces.extend(own.forces);
            }
            (Some(amplitude), _) => self.driven.push((load(amplitude), power)),
            (None, Some(curve)) => self.driven.push((load(1.0), power.with_curve(curve))),
            (None, None) => unreachable!("a table of amplitudes that was read has a curve"),
        }
    }

    fn excite(&mut self, excitation: &HarmonicExcitation, model: &ReducedModel) {
        let (order, phase) = (excitation.order, excitation.phase_rad);
        match &excitation.kind {
            ExcitationKind::SupportMotion { amplitude_m, .. } => {
                self.push(amplitude_m, FrequencyFactor::default(), |amplitude| {
                    support_motion(0, Harmonic { order, amplitude, phase })
                });
            }
            ExcitationKind::SupportAcceleration { amplitude_m_s2, .. } => {
                self.accelerate(0, amplitude_m_s2, (order, phase));
            }
            ExcitationKind::SupportMotions { supports } => {
                for (support, moving) in supports.iter().enumerate() {
                    self.drive_support(support, &moving.drive, (order, moving.phase_rad));
                }
            }
            ExcitationKind::Force { at, amplitude_n } => {
                let shape = shape(model, at);
                self.push(amplitude_n, FrequencyFactor::default(), |amplitude| {
                    force(shape.clone(), Harmonic { order, amplitude, phase })
                });
            }
            ExcitationKind::Forces { forces } => {
                for acting in forces {
                    self.act(acting, (order, phase + acting.phase_rad), model);
                }
            }
        }
    }

    fn add(&mut self, further: &file::Load, model: &ReducedModel) {
        match further {
            file::Load::Gravity { acceleration_m_s2 } => self.kept.forces.push(HarmonicForce {
                shape: model.uniform_acceleration.clone(),
                harmonic: Harmonic { order: 0, amplitude: *acceleration_m_s2, phase: 0.0 },
            }),
            file::Load::Force { at, amplitude_n, order, phase_rad } => {
                self.kept.forces.push(HarmonicForce {
                    shape: shape(model, at),
                    harmonic: Harmonic { order: *order, amplitude: *amplitude_n, phase: *phase_rad },
                });
            }
            file::Load::ActingForce { force, order } => self.act(force, (*order, force.phase_rad), model),
            file::Load::DrivenSupport { support, motion, order, phase_rad } => {
                self.drive_support(*support, motion, (*order, *phase_rad));
            }
            file::Load::SupportMotion { support, amplitude_m, order, phase_rad } => {
                let harmonic = Harmonic { order: *order, amplitude: *amplitude_m, phase: *phase_rad };
                self.kept.support.push(SupportHarmonic { support: *support, harmonic });
            }
        }
    }

    /// A force, which may be a pair or of an unbalance.
    fn act(&mut self, acting: &ActingForce, (order, phase): (u32, f64), model: &ReducedModel) {
        let shape = match &acting.place {
            ForcePlace::At(at) => shape(model, at),
            ForcePlace::Between([first, second]) => {
                let against = shape(model, second);
                shape(model, first).iter().zip(against).map(|(one, other)| one - other).collect()
            }
        };
        let of = |amplitude: f64| force(shape.clone(), Harmonic { order, amplitude, phase });
        match &acting.size {
            ForceSize::Amplitude(amplitude) => self.push(amplitude, FrequencyFactor::default(), of),
            ForceSize::Unbalance { mass_kg, eccentricity_m } => {
                let squared = mass_kg * eccentricity_m * f64::from(order).powi(2);
                self.push(&Amplitude::Constant(squared), FrequencyFactor::SQUARE, of);
            }
        }
    }

    /// A support whose displacement or acceleration is prescribed.
    fn drive_support(&mut self, support: usize, drive: &SupportDrive, (order, phase): (u32, f64)) {
        match drive {
            SupportDrive::Displacement(amplitude) => {
                self.push(amplitude, FrequencyFactor::default(), |amplitude| {
                    support_motion(support, Harmonic { order, amplitude, phase })
                });
            }
            SupportDrive::Acceleration(amplitude) => self.accelerate(support, amplitude, (order, phase)),
        }
    }

    /// A support whose acceleration is `a cos(m W t + p)`: its displacement is `-a/(m W)^2` times that.
    fn accelerate(&mut self, support: usize, amplitude: &Amplitude, (order, phase): (u32, f64)) {
        let part = -1.0 / f64::from(order).powi(2);
        self.push(amplitude, FrequencyFactor::INVERSE_SQUARE, |amplitude| {
            support_motion(support, Harmonic { order, amplitude: part * amplitude, phase })
        });
    }
}

fn support_motion(support: usize, harmonic: Harmonic) -> Load {
    Load { support: vec![SupportHarmonic { support, harmonic }], forces: Vec::new() }
}

fn force(shape: Vec<f64>, harmonic: Harmonic) -> Load {
    Load { support: Vec::new(), forces: vec![HarmonicForce { shape, harmonic }] }
}

fn shape(model: &ReducedModel, name: &str) -> Vec<f64> {
    model.point(name).expect("the study knows the names of its structure").shape.clone()
}

/// Modal displacements under the constant part of the load, `q_i = b_i / w_i^2`.
///
/// # Errors
/// The number of the first mode that a constant load drives and nothing restrains.
pub(super) fn rest(load: &Load, model: &ReducedModel) -> Result<Vec<f64>, usize> {
    let constant = load.forces.iter().filter(|force| force.harmonic.order == 0);
    let mut rest = vec![0.0; model.dof()];
    for force in constant {
        let amplitude = force.harmonic.amplitude * force.harmonic.phase.cos();
        rest.iter_mut().zip(&force.shape).for_each(|(sum, shape)| *sum += amplitude * shape);
    }
    for (mode, (value, w)) in rest.iter_mut().zip(&model.natural_frequencies).enumerate() {
        match (*value, *w) {
            (0.0, _) => {}
            (_, 0.0) => return Err(mode),
            _ => *value /= w * w,
        }
    }
    Ok(rest)
}

/// Refuses gravity on a structure that does not know which way is down.
///
/// # Errors
/// The fault at the load.
pub(super) fn check_direction(file: &StudyFile) -> Result<(), StudyError> {
    let file::Structure::Matrices(matrices) = &file.study.structure else { return Ok(()) };
    let gravity = file.study.loads.iter().position(|load| matches!(load, file::Load::Gravity { .. }));
    match (gravity, matrices.acceleration_direction) {
        (Some(load), None) => {
            let help = "allowed: with `acceleration_direction = \"-z\"`, say, in [structure]".to_owned();
            let message = "the structure is given as matrices, and no direction of gravity".to_owned();
            Err(file.fault(&format!("load[{load}]"), message, vec![help]))
        }
        _ => Ok(()),
    }
}
