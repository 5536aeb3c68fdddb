//! Parts of sections.

/// One of `2^halvings` equal parts of a section.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    /// Number of the section.
    pub section: u64,
    /// Number of the part, from 0.
    pub number: u32,
    /// How often the section was halved.
    pub halvings: u32,
}

impl Part {
    /// All of a section.
    #[must_use]
    pub fn whole(section: u64) -> Self {
        Self { section, number: 0, halvings: 0 }
    }

    /// Start and end in sections, counted from the start of the first of `period` sections.
    pub(crate) fn ends(self, period: u64) -> (f64, f64) {
        let parts = f64::from(1_u32 << self.halvings);
        let at = |number: u32| (self.section % period) as f64 + f64::from(number) / parts;
        (at(self.number), at(self.number + 1))
    }

    /// Its share of a section.
    pub(crate) fn share(self) -> f64 {
        f64::from(1_u32 << self.halvings).recip()
    }
}
