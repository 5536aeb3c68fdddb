//! Ranges within which material constants make sense, to catch wrong units.

use std::ops::RangeInclusive;

/// Young's moduli [Pa] from soft rubber to beyond diamond: a value of 210 means gigapascals.
pub const PLAUSIBLE_YOUNGS_MODULUS: RangeInclusive<f64> = 1e5..=2e12;

/// Densities [kg/m^3] from light foam to beyond osmium: a value of 7.8 means grams per cubic centimetre.
pub const PLAUSIBLE_DENSITY: RangeInclusive<f64> = 10.0..=3e4;
