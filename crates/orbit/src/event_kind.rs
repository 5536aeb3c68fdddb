//! What can happen at a row, on branches and on curves, each with its name; and sets of that.

/// What can happen at a row of a branch, or of a curve of bifurcations.
///
/// The order is that in which names are joined; numbers of the kinds are stored, so new ones come last.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BranchEventKind {
    /// The branch turns in its parameter (cyclic fold).
    Fold,
    /// A multiplier passes -1.
    Flip,
    /// A complex pair of multipliers passes the unit circle.
    NeimarkSacker,
    /// Branches cross.
    BranchPoint,
    /// A contact is reached with zero velocity.
    Grazing,
    /// First row of a branch in the frequency; where a branch in another parameter or a curve was started.
    Start,
    /// Last row of a branch in the frequency.
    End,
    /// The parameter of a curve turns.
    Turn,
    /// Two folds meet.
    Cusp,
    /// A multiplier at +1 and one at -1.
    FoldFlip,
    /// A multiplier at +1 and a complex pair on the unit circle.
    FoldNeimarkSacker,
    /// A multiplier at -1 and a complex pair on the unit circle.
    FlipNeimarkSacker,
    /// Two complex pairs on the unit circle.
    DoubleNeimarkSacker,
    /// A flip that changes its criticality.
    DegenerateFlip,
    /// A branch point of symmetric orbits that changes its criticality.
    DegenerateBranchPoint,
    /// A Neimark-Sacker point that changes its criticality.
    DegenerateNeimarkSacker,
    /// A grazing orbit has a multiplier at +1.
    GrazingFold,
    /// A grazing orbit has a multiplier at -1.
    GrazingFlip,
    /// A grazing orbit has a complex pair on the unit circle.
    GrazingNeimarkSacker,
    /// A touch without curvature.
    DegenerateGrazing,
    /// A grazing orbit grazes a second contact, or the same one a second time.
    DoubleGrazing,
    /// On a curve whose orbits do not graze: their contacts change.
    GrazingOnCurve,
    /// Resonance 1:1 on a curve.
    Resonance11,
    /// Resonance 1:2.
    Resonance12,
    /// Resonance 1:3.
    Resonance13,
    /// Resonance 1:4.
    Resonance14,
}

impl BranchEventKind {
    /// All of them, in their order.
    pub const ALL: [Self; 26] = [
        Self::Fold,
        Self::Flip,
        Self::NeimarkSacker,
        Self::BranchPoint,
        Self::Grazing,
        Self::Start,
        Self::End,
        Self::Turn,
        Self::Cusp,
        Self::FoldFlip,
        Self::FoldNeimarkSacker,
        Self::FlipNeimarkSacker,
        Self::DoubleNeimarkSacker,
        Self::DegenerateFlip,
        Self::DegenerateBranchPoint,
        Self::DegenerateNeimarkSacker,
        Self::GrazingFold,
        Self::GrazingFlip,
        Self::GrazingNeimarkSacker,
        Self::DegenerateGrazing,
        Self::DoubleGrazing,
        Self::GrazingOnCurve,
        Self::Resonance11,
        Self::Resonance12,
        Self::Resonance13,
        Self::Resonance14,
    ];

    /// Those that rows of branches have; the others are on curves.
    pub const OF_BRANCHES: [Self; 7] = [
        Self::Fold,
        Self::Flip,
        Self::NeimarkSacker,
        Self::BranchPoint,
        Self::Grazing,
        Self::Start,
        Self::End,
    ];

    /// That of branches with this name.
    #[must_use]
    pub fn of_branches(name: &str) -> Option<Self> {
        Self::OF_BRANCHES.into_iter().find(|kind| kind.name() == name)
    }

    /// Its name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::NeimarkSacker => "neimark-sacker",
            Self::BranchPoint => "branch-point",
            Self::Grazing | Self::GrazingOnCurve => "grazing",
            Self::Start => "start",
            Self::End => "end",
            Self::Turn => "turn",
            Self::Cusp => "cusp",
            Self::FoldFlip => "fold-flip",
            Self::FoldNeimarkSacker => "fold-neimark-sacker",
            Self::FlipNeimarkSacker => "flip-neimark-sacker",
            Self::DoubleNeimarkSacker => "double-neimark-sacker",
            Self::DegenerateFlip => "degenerate-flip",
            Self::DegenerateBranchPoint => "degenerate-branch-point",
            Self::DegenerateNeimarkSacker => "degenerate-neimark-sacker",
            Self::GrazingFold => "grazing-fold",
            Self::GrazingFlip => "grazing-flip",
            Self::GrazingNeimarkSacker => "grazing-neimark-sacker",
            Self::DegenerateGrazing => "degenerate-grazing",
            Self::DoubleGrazing => "double-grazing",
            Self::Resonance11 => "resonance-1:1",
            Self::Resonance12 => "resonance-1:2",
            Self::Resonance13 => "resonance-1:3",
            Self::Resonance14 => "resonance-1:4",
        }
    }
}

/// What happens at a row; several kinds may coincide.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EventSet(u32);

impl EventSet {
    /// The kinds with their marks: those that are set.
    #[must_use]
    pub fn of<const N: usize>(marks: [(bool, BranchEventKind); N]) -> Self {
        let set = marks.into_iter().filter(|(is_set, _)| *is_set);
        set.fold(Self::default(), |events, (_, kind)| events.with(kind))
    }

    /// The set with one more.
    #[must_use]
    pub fn with(self, kind: BranchEventKind) -> Self {
        Self(self.0 | 1 << kind as u32)
    }

    /// The set without one.
    #[must_use]
    pub fn without(self, kind: BranchEventKind) -> Self {
        Self(self.0 & !(1 << kind as u32))
    }

    /// Whether this happens.
    #[must_use]
    pub fn has(self, kind: BranchEventKind) -> bool {
        self.0 >> kind as u32 & 1 == 1
    }

    /// Whether nothing happens.
    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Whether the motion bifurcates there: a fold, a flip, a Neimark-Sacker point or a branch point.
    #[must_use]
    pub fn is_bifurcation(self) -> bool {
        use BranchEventKind::{BranchPoint, Flip, Fold, NeimarkSacker};
        [Fold, Flip, NeimarkSacker, BranchPoint].into_iter().any(|kind| self.has(kind))
    }

    /// All that happens, in the order of the kinds.
    pub fn kinds(self) -> impl Iterator<Item = BranchEventKind> {
        BranchEventKind::ALL.into_iter().filter(move |kind| self.has(*kind))
    }

    /// The names joined by `+`, empty if nothing happens.
    #[must_use]
    pub fn label(self) -> String {
        self.kinds().map(BranchEventKind::name).collect::<Vec<_>>().join("+")
    }

    /// One bit for each kind, as they are stored.
    #[must_use]
    pub fn bits(self) -> u32 {
        self.0
    }

    /// The set of these bits; `None` if one stands for nothing.
    #[must_use]
    pub fn of_bits(bits: u32) -> Option<Self> {
        (bits >> BranchEventKind::ALL.len() == 0).then_some(Self(bits))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_bit_of_its_own_in_the_order_of_all() {
        for (place, kind) in BranchEventKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, place);
            let only = EventSet::default().with(kind);
            assert_eq!(only.kinds().collect::<Vec<_>>(), [kind]);
            assert_eq!(EventSet::of_bits(only.bits()), Some(only));
            assert_eq!(only.without(kind), EventSet::default());
        }
        assert_eq!(EventSet::of_bits(1 << BranchEventKind::ALL.len()), None);
    }
}
