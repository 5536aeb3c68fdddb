//! The planes of bending of a beam, and the names of its points in them.

/// A direction across a beam that bends in two planes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Plane {
    /// The first, in which gravity acts.
    Y,
    /// The second.
    Z,
}

impl Plane {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Y, Self::Z];

    /// What a point is called whose displacement lies in the plane.
    #[must_use]
    pub fn name_of(self, point: &str) -> String {
        match self {
            Self::Y => format!("{point}.y"),
            Self::Z => format!("{point}.z"),
        }
    }

    /// The point and the plane that a name means.
    #[must_use]
    pub fn split(name: &str) -> Option<(&str, Self)> {
        let of = |(suffix, plane)| name.strip_suffix(suffix).map(|point| (point, plane));
        [(".y", Self::Y), (".z", Self::Z)].into_iter().find_map(of)
    }

    /// What is given over the modes of one plane, over those of both.
    pub(crate) fn spread(self, values: &[f64]) -> Vec<f64> {
        let of = |value: &f64| match self {
            Self::Y => [*value, 0.0],
            Self::Z => [0.0, *value],
        };
        values.iter().flat_map(of).collect()
    }
}
