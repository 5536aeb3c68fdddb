//! Why a walk ended, in terms of orbits.

/// Why a walk along a branch ended.
///
/// Places are frequencies [Hz], or values of the parameter where another one varies.
#[derive(Debug, Clone, PartialEq)]
pub enum StopReason {
    /// The branch left the frequency range and was cut exactly at its end.
    RangeEnd {
        /// End of the range, in the unit of what varies.
        place: f64,
    },
    /// The branch came back to its start.
    Closed,
    /// The branch came to the flip of a branch of shorter period, beyond which it returns as its own copy,
    /// shifted by excitation periods; or to a grazing beyond which it is one of shorter period.
    ShorterPeriod {
        /// Where, in the unit of what varies.
        place: f64,
        /// Whether it is a grazing.
        grazes: bool,
    },
    /// The branch, of asymmetric orbits, came to symmetric ones, beyond which it returns as its own mirror
    /// image, and so near to the branch point that rounding holds up its steps.
    Symmetric {
        /// Where, in the unit of what varies.
        place: f64,
    },
    /// The budget of solutions is used up.
    Budget {
        /// Number of solutions.
        solutions: usize,
    },
    /// No step, however short, led to an acceptable solution.
    StepTooShort {
        /// Where, in the unit of what varies.
        place: f64,
        /// Last step tried, in the arc length of the path.
        step: f64,
        /// Residual of the last attempt.
        residual: f64,
        /// What was wrong with it.
        doubt: String,
        /// Nothing takes energy out of the motion: motions that differ by a free vibration may lie closer
        /// together than rounding resolves.
        has_no_losses: bool,
    },
    /// No step, however short, led to an acceptable solution, and the last motion chatters at a rigid stop.
    Chatter {
        /// Where, in the unit of what varies.
        place: f64,
        /// Name of the local element.
        element: String,
        /// Impacts in a row, each slower than the one before, in the last motion.
        impacts: usize,
    },
    /// Two rigid stops are struck at one instant, and either impact changes the speed of the other. The
    /// motion beyond depends on which comes first, and so jumps.
    ImpactsTogether {
        /// Where, in the unit of what varies.
        place: f64,
        /// Names of both local elements, with "and" between them.
        elements: String,
        /// Phase of the excitation at which that happens [cycles].
        phase: f64,
    },
    /// However short the step, the path went on along a stretch that was already walked.
    RunsBack {
        /// Where, in the unit of what varies.
        place: f64,
        /// Arc length of the stretch that was met.
        met_arc_length: f64,
        /// As where the step is too short.
        has_no_losses: bool,
    },
    /// Beyond this place a contact opens and is pressed on again at once. With an impact-speed-dependent law
    /// its force jumps there, and so does the motion: the branch ends.
    ContactReopens {
        /// Where, in the unit of what varies.
        place: f64,
        /// Name of the local element.
        element: String,
        /// Phase of the excitation at which that happens [cycles].
        phase: f64,
    },
    /// Thousands of steps did not get anywhere.
    NoProgress {
        /// Where, in the unit of what varies.
        place: f64,
        /// So many steps.
        solutions: u64,
        /// Largest magnitude of a multiplier: where it is huge, next to no change of the frequency turns the
        /// whole orbit.
        largest_multiplier: f64,
        /// As where the step is too short.
        has_no_losses: bool,
    },
    /// The amplitude has no bound while the parameter stands still: the branch goes to infinity, and what
    /// lies beyond is another one; or nothing takes energy out of the motion, which went so far beyond all
    /// gaps that no step was found.
    Unbounded {
        /// Where, in the unit of what varies.
        place: f64,
        /// The mode that resonates, where that is one of the structure alone.
        mode: Option<ResonantMode>,
    },
    /// A mode without damping, which is not driven, vibrates freely at a multiple of the frequency of the
    /// motion: motions of every amplitude of it are periodic there, and none of them leads on.
    FreeVibration {
        /// Where, in the unit of what varies.
        place: f64,
        /// The mode.
        mode: ResonantMode,
    },
    /// The walk took more work than it may, or than it may without getting on.
    TooMuchWork {
        /// Where, in the unit of what varies.
        place: f64,
        /// Solutions until then.
        solutions: u64,
        /// Whether it still got on.
        gets_on: bool,
    },
    /// The motion could not be computed.
    Motion {
        /// Where, in the unit of what varies.
        place: f64,
        /// What the integrator said.
        message: String,
    },
}

impl StopReason {
    /// Where, in the unit of what varies; `None` where the reason has no place.
    #[must_use]
    pub fn place(&self) -> Option<f64> {
        let mut reason = self.clone();
        reason.place_mut().copied()
    }

    /// The same reason with its place in another unit.
    #[must_use]
    pub fn in_unit(mut self, unit: impl Fn(f64) -> f64) -> Self {
        if let Some(place) = self.place_mut() {
            *place = unit(*place);
        }
        self
    }

    fn place_mut(&mut self) -> Option<&mut f64> {
        match self {
            Self::RangeEnd { place }
            | Self::ShorterPeriod { place, .. }
            | Self::Symmetric { place }
            | Self::StepTooShort { place, .. }
            | Self::Chatter { place, .. }
            | Self::ImpactsTogether { place, .. }
            | Self::RunsBack { place, .. }
            | Self::ContactReopens { place, .. }
            | Self::NoProgress { place, .. }
            | Self::Unbounded { place, .. }
            | Self::FreeVibration { place, .. }
            | Self::TooMuchWork { place, .. }
            | Self::Motion { place, .. } => Some(place),
            Self::Closed | Self::Budget { .. } => None,
        }
    }
}

/// A mode without damping, or with next to none, at whose frequency or a part of it a branch ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResonantMode {
    /// Its number, the lowest being 1.
    pub number: usize,
    /// Its eigenfrequency [Hz].
    pub frequency_hz: f64,
    /// Its ratio to critical damping.
    pub damping_ratio: f64,
}
