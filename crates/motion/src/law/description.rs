//! What a law says of itself beside its force: its keys in the study file with their ranges and units, how it
//! is drawn and put into words, which of its constants can vary, and how it is built from what was read.
//!
//! Everything outside of a law's own file reads this: the reader of the study file, its identity and its
//! documentation, the parameters of `[[vary]]` and `[[curve]]`, the reports and the sketches.

use super::{Law, LawConstant, LawError, Quantity};

/// A law of the study file.
#[derive(Debug)]
pub struct LawDescription {
    /// Its word in the study file.
    pub name: &'static str,
    /// What the identity of a study calls it; must not change, or the study is another one.
    pub identity: LawIdentity,
    /// The force as a formula in the symbols of its keys, as the documentation has it.
    pub force: &'static str,
    /// On which sides it acts, and so which keys say where it rests.
    pub sides: LawSides,
    /// Its constants.
    pub keys: &'static [LawKey],
    /// Where two laws have one word: which keys distinguish them.
    pub alternative: Option<LawAlternative>,
    /// How it is drawn.
    pub symbol: LawSymbol,
    /// How it is put into words.
    pub words: LawWords,
}

/// What makes the elements of a stop.
type Made = Result<Vec<LawPart>, LawError>;

/// What the identity of a study calls a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawIdentity {
    /// A name.
    Named(&'static str),
    /// A model of a family of laws with that name.
    Model {
        /// Of the family.
        family: &'static str,
        /// Of the model.
        model: &'static str,
    },
}

/// On which sides a law acts.
#[derive(Debug, Clone, Copy)]
pub enum LawSides {
    /// On the side that `side` says, or on both as two stops; with `gap_m` or `preload_n`.
    One {
        /// Why it takes no preload, if it takes none.
        no_preload: Option<NoPreload>,
        /// Makes the elements of a stop that rests so.
        build: fn(LawValues<'_>, LawRest) -> Made,
    },
    /// On both sides of a clearance, with `gap_m`, or `gap_above_m` and `gap_below_m`.
    Two {
        /// Number of the key that, if it is not 0, makes two one-sided stops of it, and the law of these,
        /// which has the same keys.
        pair: (usize, &'static LawDescription),
        /// Makes the elements of a stop whose forces begin at `r = above` and `r = -below`, given in this
        /// order [m]; negative where it presses.
        build: fn(LawValues<'_>, [f64; 2]) -> Made,
    },
    /// It always acts, and has no gap.
    Always {
        /// Makes the elements.
        build: fn(LawValues<'_>) -> Made,
    },
}

/// Why a one-sided law takes no preload.
#[derive(Debug, Clone, Copy)]
pub struct NoPreload {
    /// The reason, to follow "but".
    pub why: &'static str,
    /// What it takes instead.
    pub allowed: &'static str,
}

/// Which keys distinguish two laws of one word: the second is meant where its key is given.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LawAlternative {
    /// Key of this law.
    pub own: &'static str,
    /// Key of the other one.
    pub other: &'static str,
    /// Whether this law is the one that is meant where neither is given.
    pub is_default: bool,
}

/// A key of a law.
#[derive(Debug, Clone, Copy)]
pub struct LawKey {
    /// The key in the study file, which ends in its unit.
    pub name: &'static str,
    /// What the identity of a study calls it.
    pub field: &'static str,
    /// What stands for it in the formula of the force.
    pub symbol: &'static str,
    /// What its value is.
    pub kind: LawKeyKind,
    /// How its value is put into words.
    pub phrase: LawPhrase,
    /// What it is, for the page of keys.
    pub meaning: &'static str,
    /// The constant of the law that it is, if it can vary by exact derivatives.
    pub varies: Option<VariesAs>,
}

/// What the value of a key is.
#[derive(Debug, Clone, Copy)]
pub enum LawKeyKind {
    /// A number.
    Number {
        /// Its unit and range.
        quantity: Quantity,
        /// Its value where it is not given; `None` if it has to be.
        default: Option<f64>,
    },
    /// One of several numbers that default to 0, of which one must not be.
    Term {
        /// Its unit and range.
        quantity: Quantity,
    },
    /// The constant of a Hertz contact: a number, or two spheres.
    HertzStiffness,
    /// A formula with its constants.
    Formula,
}

/// How the value of a key is put into words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawPhrase {
    /// The value alone.
    Value,
    /// The value behind a noun.
    Named(&'static str),
    /// What stands beside the value before, if it is not 0.
    Beside,
}

/// When a key varies as which constant of its law.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VariesAs {
    /// Always.
    Always(LawConstant),
    /// Where its value is not 0; a value of 0 is a number of the study as any other.
    UnlessZero(LawConstant),
}

/// How a law is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LawSymbol {
    /// A sphere.
    Sphere,
    /// A sphere that loses energy.
    LossySphere,
    /// A spring.
    Spring,
    /// A wall.
    Wall,
    /// Springs on both sides.
    TwoSprings,
    /// A spring that always acts.
    ActiveSpring,
}

/// How a law is put into words.
#[derive(Debug, Clone, Copy)]
pub struct LawWords {
    /// What it is, in reports.
    pub report: &'static str,
    /// The same in captions, which are shorter.
    pub caption: &'static str,
    /// Whether the last key is named first, as the highest power of a spring is.
    pub last_first: bool,
}

/// What was read for a key.
#[derive(Debug, Clone, PartialEq)]
pub enum LawValue {
    /// A number.
    Number(f64),
    /// The constant of a Hertz contact.
    Hertz(HertzStiffness),
    /// A formula, and its constants by their names, in the order of these.
    Formula(String, Vec<(String, f64)>),
}

/// The constant of a Hertz contact, given or from two spheres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum HertzStiffness {
    /// Given [N/m^1.5].
    Given(f64),
    /// Of two spheres.
    Spheres {
        /// Radii [m]; `None` is a plane.
        radii_m: [Option<f64>; 2],
        /// Young's moduli [Pa].
        moduli_pa: [f64; 2],
        /// Poisson's ratios.
        poisson_ratios: [f64; 2],
    },
}

/// The values of the keys of a law, in the order of its keys.
#[derive(Debug, Clone, Copy)]
pub struct LawValues<'a>(pub &'a [LawValue]);

/// How a one-sided stop rests against the undeformed structure, `r` positive towards it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawRest {
    /// Its force begins at `r = level` [m]; negative where it presses.
    Level(f64),
    /// It presses with this force [N].
    Preload(f64),
}

/// An element of a stop.
#[derive(Debug, Clone, PartialEq)]
pub struct LawPart {
    /// What is added to the name of the stop.
    pub suffix: &'static str,
    /// The law of the element.
    pub law: Law,
    /// Whether its displacement is that of the stop turned round.
    pub is_turned: bool,
}

impl LawPart {
    /// The only element of a stop.
    #[must_use]
    pub fn whole(law: Law) -> Vec<Self> {
        vec![Self { suffix: "", law, is_turned: false }]
    }
}

impl LawKey {
    /// A number that has to be given and is put into words by its value alone.
    #[must_use]
    pub const fn number(name: &'static str, symbol: &'static str, quantity: Quantity) -> Self {
        let kind = LawKeyKind::Number { quantity, default: None };
        Self { name, field: name, symbol, kind, phrase: LawPhrase::Value, meaning: "", varies: None }
    }

    /// The constant of a Hertz contact.
    #[must_use]
    pub const fn hertz_stiffness() -> Self {
        let varies = Some(VariesAs::Always(LawConstant::Stiffness));
        let kind = LawKeyKind::HertzStiffness;
        let (name, field) = ("stiffness_n_m15", "stiffness");
        let meaning = "constant k of a Hertz contact";
        Self { name, field, symbol: "k", kind, phrase: LawPhrase::Value, meaning, varies }
    }

    /// The same with a sentence on what it is.
    #[must_use]
    pub const fn meaning(mut self, meaning: &'static str) -> Self {
        self.meaning = meaning;
        self
    }

    /// The same with another phrase.
    #[must_use]
    pub const fn named(mut self, noun: &'static str) -> Self {
        self.phrase = LawPhrase::Named(noun);
        self
    }

    /// The same, varying as a constant of the law.
    #[must_use]
    pub const fn varying(mut self, constant: LawConstant) -> Self {
        self.varies = Some(VariesAs::Always(constant));
        self
    }

    /// The constant that varies where the key has that value, if one does.
    #[must_use]
    pub fn constant(&self, value: &LawValue) -> Option<LawConstant> {
        match self.varies? {
            VariesAs::Always(constant) => Some(constant),
            VariesAs::UnlessZero(constant) => (*value != LawValue::Number(0.0)).then_some(constant),
        }
    }

    /// The unit and range of a number; those of the constant of a Hertz contact.
    #[must_use]
    pub fn quantity(&self) -> Option<Quantity> {
        match self.kind {
            LawKeyKind::Number { quantity, .. } | LawKeyKind::Term { quantity } => Some(quantity),
            LawKeyKind::HertzStiffness => Some(super::quantity::HERTZ_STIFFNESS),
            LawKeyKind::Formula => None,
        }
    }
}

impl LawKey {
    /// Whether it is a damper, without which the law loses no energy.
    #[must_use]
    pub fn is_damper(&self) -> bool {
        self.varies == Some(VariesAs::UnlessZero(LawConstant::Damping))
    }

    /// A value of a usual size.
    fn sample(&self) -> LawValue {
        let of_unit = |unit: &str| match unit {
            "N/m" => 1e5,
            "N/m^2" => 1e7,
            "N/m^3" => 1e12,
            "N s/m" => 5.0,
            "s/m" => 0.3,
            "m" => 1e-4,
            _ => 0.7,
        };
        match self.kind {
            LawKeyKind::HertzStiffness => LawValue::Hertz(HertzStiffness::Given(1e7)),
            LawKeyKind::Formula => LawValue::Formula("2e4*x + 3*v^3".into(), Vec::new()),
            // Keys of one unit differ.
            LawKeyKind::Number { quantity, .. } | LawKeyKind::Term { quantity } => {
                let longer = if quantity.unit().is_empty() { 1.0 } else { self.name.len() as f64 / 10.0 };
                LawValue::Number(of_unit(quantity.unit()) * longer)
            }
        }
    }
}

impl LawDescription {
    /// Values of usual sizes for its keys, for tests that go through all laws.
    #[must_use]
    pub fn sample_values(&self) -> Vec<LawValue> {
        let mut values: Vec<LawValue> = self.keys.iter().map(LawKey::sample).collect();
        if let LawSides::Two { pair: (key, _), .. } = self.sides {
            values[key] = LawValue::Number(0.0);
        }
        values
    }

    /// Whether a round hole can have the law along its radius, where none of its values loses energy.
    #[must_use]
    pub fn fits_round_hole(&self) -> bool {
        let LawSides::One { build, .. } = self.sides else { return false };
        let mut values = self.sample_values();
        let keys = self.keys.iter().zip(&mut values).filter(|(key, _)| key.is_damper());
        keys.for_each(|(_, value)| *value = LawValue::Number(0.0));
        let made = build(LawValues(&values), LawRest::Level(1e-3));
        made.is_ok_and(|parts| parts.first().is_some_and(|part| part.law.in_round_hole().is_ok()))
    }

    /// The elements of a stop of this law at that gap [m], with values of usual sizes.
    ///
    /// # Errors
    /// [`LawError`], if a sample is not one that the law can have.
    pub fn sample(&self, gap: f64) -> Result<Vec<LawPart>, LawError> {
        let values = self.sample_values();
        match self.sides {
            LawSides::One { build, .. } => build(LawValues(&values), LawRest::Level(gap)),
            LawSides::Two { build, .. } => build(LawValues(&values), [gap; 2]),
            LawSides::Always { build } => build(LawValues(&values)),
        }
    }
}

impl LawValues<'_> {
    /// The number of a key, by its place among the keys: of a Hertz constant its value [N/m^1.5]; not a
    /// number for a formula.
    #[must_use]
    pub fn number(self, key: usize) -> f64 {
        match &self.0[key] {
            LawValue::Number(number) => *number,
            LawValue::Hertz(stiffness) => stiffness.value(),
            LawValue::Formula(..) => f64::NAN,
        }
    }
}
