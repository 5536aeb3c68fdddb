//! The force law of a stop, as the study states it: which law of the list, the values of its keys, and how
//! the stop rests.

use hammerbeam_motion::law::{
    HertzStiffness, LawDescription, LawIdentity, LawKey, LawKeyKind, LawPhrase, LawValue,
};
use serde::{Serialize, Serializer, ser::SerializeMap};

/// Force law of a local element.
#[derive(Debug, Clone)]
pub struct StopLaw {
    description: &'static LawDescription,
    values: Vec<LawValue>,
    rest: StopRest,
}

/// How a stop rests.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StopRest {
    /// On one side, at a gap or pressing.
    OneSided {
        /// Gap or preload.
        approach: Approach,
        /// On which side the stop is.
        side: StopSide,
    },
    /// On both sides of a clearance.
    TwoSided {
        /// Rest distance above [m].
        gap_above_m: f64,
        /// Rest distance below [m].
        gap_below_m: f64,
        /// From where the gaps count.
        gap_measured: GapMeasured,
    },
    /// All around, as a round hole.
    Around {
        /// Clearance [m].
        gap_m: f64,
    },
    /// It always acts.
    Always,
}

/// How close a one-sided stop is at rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Approach {
    /// At a distance.
    Gap {
        /// Distance [m].
        gap_m: f64,
        /// From where it counts.
        measured: GapMeasured,
    },
    /// Pressing on the undeformed structure.
    Preload {
        /// Force [N].
        preload_n: f64,
    },
}

/// From where a gap counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum GapMeasured {
    /// From the undeformed structure.
    Undeformed,
    /// From where the structure rests under the constant loads.
    AtRest,
}

/// On which side of the point a one-sided stop is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopSide {
    /// Contact where `r > gap`.
    Above,
    /// Contact where `r < -gap`.
    Below,
}

impl StopLaw {
    /// * `values`: of the keys of the law, in their order.
    pub(super) fn new(description: &'static LawDescription, values: Vec<LawValue>, rest: StopRest) -> Self {
        Self { description, values, rest }
    }

    /// The law of the list that it is.
    #[must_use]
    pub fn description(&self) -> &'static LawDescription {
        self.description
    }

    /// How the stop rests.
    #[must_use]
    pub fn rest(&self) -> StopRest {
        self.rest
    }

    /// The values of the keys of the law, in their order.
    #[must_use]
    pub fn values(&self) -> &[LawValue] {
        &self.values
    }

    /// The keys of the law with their values.
    pub fn keys(&self) -> impl DoubleEndedIterator<Item = (&'static LawKey, &LawValue)> {
        self.description.keys.iter().zip(&self.values)
    }

    /// The number of a key; `None` if the law has no such key, or its value is no number.
    #[must_use]
    pub fn number(&self, key: &str) -> Option<f64> {
        self.keys().find(|(known, _)| known.name == key).and_then(|(_, value)| match value {
            LawValue::Number(number) => Some(*number),
            LawValue::Hertz(_) | LawValue::Formula(..) => None,
        })
    }

    /// The keys with their values in the order in which they are put into words, without what is 0 and may be
    /// left out.
    #[must_use]
    pub fn in_words(&self) -> Vec<(&'static LawKey, &LawValue)> {
        let is_there = |(key, value): &(&LawKey, &LawValue)| {
            let may_miss = key.phrase == LawPhrase::Beside || matches!(key.kind, LawKeyKind::Term { .. });
            !may_miss || **value != LawValue::Number(0.0)
        };
        let there = self.keys().filter(is_there);
        if self.description.words.last_first { there.rev().collect() } else { there.collect() }
    }

    /// Its gap [m], if it has a single one.
    #[must_use]
    pub fn gap_m(&self) -> Option<f64> {
        match self.rest {
            StopRest::OneSided { approach: Approach::Gap { gap_m, .. }, .. } => Some(gap_m),
            StopRest::Around { gap_m } => Some(gap_m),
            StopRest::TwoSided { gap_above_m, gap_below_m, .. } if gap_above_m == gap_below_m => {
                Some(gap_above_m)
            }
            _ => None,
        }
    }

    /// From where its gap counts, if it has one.
    #[must_use]
    pub fn gap_measured(&self) -> GapMeasured {
        match self.rest {
            StopRest::OneSided { approach: Approach::Gap { measured, .. }, .. } => measured,
            StopRest::TwoSided { gap_measured, .. } => gap_measured,
            _ => GapMeasured::Undeformed,
        }
    }
}

impl PartialEq for StopLaw {
    fn eq(&self, other: &Self) -> bool {
        self.description.identity == other.description.identity
            && self.values == other.values
            && self.rest == other.rest
    }
}

impl Serialize for StopLaw {
    /// The law by its name, then what it has; what is 0 by default and left out is absent, so that studies
    /// from before there was such a key stay the same studies.
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let name = match self.description.identity {
            LawIdentity::Named(name) => name,
            LawIdentity::Model { family, .. } => family,
        };
        let mut law = serializer.serialize_map(Some(1))?;
        law.serialize_entry(name, &Contents(self))?;
        law.end()
    }
}

/// What the identity of a study has of a law beside its name.
struct Contents<'a>(&'a StopLaw);

impl Serialize for Contents<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let StopLaw { description, rest, .. } = self.0;
        let mut entries = serializer.serialize_map(None)?;
        if let LawIdentity::Model { model, .. } = description.identity {
            entries.serialize_entry("model", model)?;
        }
        for (key, value) in self.0.keys() {
            let default = match key.kind {
                LawKeyKind::Number { default, .. } => default,
                LawKeyKind::Term { .. } => Some(0.0),
                LawKeyKind::HertzStiffness | LawKeyKind::Formula => None,
            };
            match value {
                LawValue::Number(number) if default == Some(*number) => {}
                LawValue::Number(number) => entries.serialize_entry(key.field, number)?,
                LawValue::Hertz(stiffness) => entries.serialize_entry(key.field, &Hertz(*stiffness))?,
                LawValue::Formula(text, constants) => {
                    entries.serialize_entry(key.field, text)?;
                    if !constants.is_empty() {
                        entries.serialize_entry("constants", &TomlTable(constants))?;
                    }
                }
            }
        }
        match rest {
            StopRest::Always => {}
            StopRest::Around { gap_m } => entries.serialize_entry("clearance_m", gap_m)?,
            StopRest::OneSided { approach, side } => {
                entries.serialize_entry("approach", approach)?;
                entries.serialize_entry("side", side)?;
            }
            StopRest::TwoSided { gap_above_m, gap_below_m, gap_measured } => {
                entries.serialize_entry("gap_above_m", gap_above_m)?;
                entries.serialize_entry("gap_below_m", gap_below_m)?;
                entries.serialize_entry("gap_measured", gap_measured)?;
            }
        }
        entries.end()
    }
}

/// Numbers by their names.
struct TomlTable<'a>(&'a [(String, f64)]);

impl Serialize for TomlTable<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

/// The constant of a Hertz contact.
struct Hertz(HertzStiffness);

impl Serialize for Hertz {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut entry = serializer.serialize_map(Some(1))?;
        match self.0 {
            HertzStiffness::Given(stiffness) => entry.serialize_entry("given", &stiffness)?,
            HertzStiffness::Spheres { radii_m, moduli_pa, poisson_ratios } => {
                entry.serialize_entry("spheres", &Spheres { radii_m, moduli_pa, poisson_ratios })?;
            }
        }
        entry.end()
    }
}

#[derive(Serialize)]
struct Spheres {
    radii_m: [Option<f64>; 2],
    moduli_pa: [f64; 2],
    poisson_ratios: [f64; 2],
}
