//! What a parameter of a study is.

use hammerbeam_motion::LawConstant;
use serde::{Serialize, Serializer, ser::SerializeStructVariant};

/// What a parameter is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ParameterKind {
    /// Amplitude of the excitation [m or N].
    Amplitude,
    /// A constant of the law of a stop, in its unit.
    OfStop {
        /// Number of the stop, from 0; of two sides that of the first.
        stop: usize,
        /// Whether the next stop, its other side, has the constant in common with it.
        both_sides: bool,
        /// The constant.
        constant: LawConstant,
    },
    /// Ratio to critical damping of every mode.
    ModalRatio,
    /// A part of the damping of the structure.
    Damping(DampingKey),
    /// Another number of the model, by its key path.
    Number,
}

impl Serialize for ParameterKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        const TYPE: &str = "ParameterKind";
        let (stop, both_sides, constant) = match self {
            Self::Amplitude => return serializer.serialize_unit_variant(TYPE, 0, "amplitude"),
            Self::ModalRatio => return serializer.serialize_unit_variant(TYPE, 2, "modal-ratio"),
            Self::Damping(key) => return serializer.serialize_newtype_variant(TYPE, 3, "damping", key),
            Self::Number => return serializer.serialize_unit_variant(TYPE, 4, "number"),
            Self::OfStop { stop, both_sides, constant } => (stop, *both_sides, constant),
        };
        let (name, number) = match constant {
            LawConstant::Gap => ("gap", None),
            LawConstant::Stiffness => ("stiffness", None),
            LawConstant::Restitution => ("restitution", None),
            LawConstant::Damping => ("stop-damping", None),
            LawConstant::Further(number) => ("stop-constant", Some(number)),
        };
        let mut variant = serializer.serialize_struct_variant(TYPE, 1, name, 3)?;
        variant.serialize_field("stop", stop)?;
        if both_sides {
            variant.serialize_field("both_sides", &true)?;
        }
        if let Some(number) = number {
            variant.serialize_field("number", number)?;
        }
        variant.end()
    }
}

/// A constant of the damping of the structure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum DampingKey {
    /// Ratio to critical damping of a mode.
    ModalRatio {
        /// Number of the mode, from 0.
        mode: usize,
    },
    /// Rayleigh damping in proportion to the mass.
    RayleighMass,
    /// Rayleigh damping in proportion to the stiffness.
    RayleighStiffness,
    /// A damper of a lumped structure.
    Damper {
        /// Its number, from 0.
        damper: usize,
    },
    /// The damper at a point of a beam.
    PointDamper {
        /// Number of the point, from 0.
        point: usize,
    },
    /// The rotational damper at a point of a beam.
    RotationalDamper {
        /// Number of the point, from 0.
        point: usize,
    },
}
