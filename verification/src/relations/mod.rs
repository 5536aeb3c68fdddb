//! Relations that hold between answers, whatever the answers are: the same physics written another way.
//!
//! A study is a TOML document; each relation makes another document of it, of which one knows what must come
//! out.
//!
//! * [`Units`]: study every number in other units of mass, length and time; answers the same in those units;
//!   multipliers and contacts the same.
//! * [`shifted`]: study all harmonics earlier by a part of the excitation period; answers the same: maxima,
//!   multipliers and contacts have no origin of time.
//! * [`mirrored`]: study all displacements negated: loads turn round, stops above become below; answers the
//!   same: maxima are of absolute values.
//! * [`swapped`]: study masses and stops in the reverse order under other names, a beam with left and right
//!   exchanged; answers the same.
//!
//! | file | what it does |
//! |---|---|
//! | `units.rs` | other units, by the unit that ends each key |
//! | `images.rs` | the other three |
//! | `answers.rs` | what a run answers, without units |
//! | `compare.rs` | whether two studies have the same answers |

mod answers;
mod compare;
mod images;
mod units;

pub use answers::{Answers, AnswersError, EventAnswer, Limits, OrbitAnswer};
pub use compare::{Difference, Disagreeing, differences};
pub use images::{mirrored, shifted, swapped};
pub use units::Units;

/// What is known to hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Relation {
    /// Other units.
    Units(Units),
    /// All harmonics earlier by this part of the excitation period.
    Shifted(f64),
    /// All displacements negated.
    Mirrored,
    /// Masses and stops in the reverse order under other names, or a beam with its ends exchanged.
    Swapped,
}

impl Relation {
    /// The study of the same physics.
    #[must_use]
    pub fn of(&self, study: &toml::Table) -> toml::Table {
        match self {
            Self::Units(units) => units.rescaled(study),
            Self::Shifted(cycles) => shifted(study, *cycles),
            Self::Mirrored => mirrored(study),
            Self::Swapped => swapped(study),
        }
    }

    /// The units in which the answers of that study come.
    #[must_use]
    pub fn units(&self) -> Units {
        if let Self::Units(units) = self { *units } else { Units::SI }
    }
}
