//! Kinds of settled motions.

/// Kind of a settled motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MotionKind {
    /// It repeats after a number of excitation periods.
    Periodic {
        /// In excitation periods, from 1.
        period: u32,
    },
    /// Regular and without a period.
    QuasiPeriodic,
    /// Neighbouring motions diverge exponentially.
    Chaotic,
    /// Undecided.
    #[default]
    Doubtful,
}

impl MotionKind {
    /// One of each kind, in the order of a legend.
    pub(crate) const ALL: [Self; 4] =
        [Self::Periodic { period: 1 }, Self::QuasiPeriodic, Self::Chaotic, Self::Doubtful];

    /// Whether both are of one kind, whatever their periods.
    pub(crate) fn is_like(self, other: Self) -> bool {
        std::mem::discriminant(&self) == std::mem::discriminant(&other)
    }

    /// The kind without its period.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Periodic { .. } => "periodic",
            Self::QuasiPeriodic => "quasi-periodic",
            Self::Chaotic => "chaotic",
            Self::Doubtful => "doubtful",
        }
    }

    /// The kind in words, with the period.
    pub(crate) fn words(self) -> String {
        match self {
            Self::Periodic { period } => format!("period {period}"),
            other => other.name().to_owned(),
        }
    }
}
