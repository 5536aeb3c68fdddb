//! What rounding leaves unknown of the sensitivities behind a hard contact.
//!
//! The penetration p of a contact is a difference of numbers of the size m, so it is wrong by `eps m`, and
//! its stiffness `s = D |df/dr|`, per unit of mass, by about the share `eps m/p`. A displacement before a
//! step of the length h changes the velocity behind it by `s h`, which is wrong by
//!
//! `h s eps m/p`,
//!
//! independently of the other steps, so that the squares add up; over a contact to about `w eps m/p` with its
//! frequency `w`. For contacts of a thousandth of the period it is nothing; of one that lasts for 1e-9 s of a
//! period of 0.2 s and is 1e-11 m deep where the gap is 1 mm it is so large that no multiplier is known. For
//! p the largest `f/(df/dr)` of the step is taken, which is of its size.

/// The error of a contact that a step of this length adds [1/s].
///
/// * `(forces, slopes)`: at its nodes, f [N] and df/dr [N/m].
/// * `(mobility, unknown)`: D [1/kg] and `eps m` [m].
pub(super) fn of_contact(
    length: f64,
    (forces, slopes): (&[f64], &[f64]),
    (mobility, unknown): (f64, f64),
) -> f64 {
    let stiffness = slopes.iter().map(|slope| slope.abs()).sum::<f64>() / slopes.len() as f64;
    let depths = forces.iter().zip(slopes).map(|(f, s)| (f / s).abs());
    let depth = depths.filter(|depth| depth.is_finite()).fold(0.0, f64::max);
    if depth > 0.0 { length * mobility * stiffness * (unknown / depth) } else { 0.0 }
}
