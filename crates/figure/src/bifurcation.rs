//! The bifurcations whose curves are drawn.

/// The bifurcation that a curve consists of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Bifurcation {
    /// A multiplier of +1.
    #[default]
    Fold,
    /// A multiplier of −1.
    Flip,
    /// A complex pair on the unit circle.
    NeimarkSacker,
    /// A contact that is touched with zero velocity.
    Grazing,
}

impl Bifurcation {
    /// Its name in a legend.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::Flip => "flip",
            Self::NeimarkSacker => "Neimark–Sacker",
            Self::Grazing => "grazing",
        }
    }
}
