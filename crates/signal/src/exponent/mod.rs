//! The largest Lyapunov exponent of a series.
//!
//! States are rebuilt from one series `x` by delays, `X_i = (x_i, x_{i+J}, .., x_{i+(m-1)J})` (Takens 1981).
//! Neighbours in that space that are not neighbours in time move apart like `exp(l t)`; `l` is the largest
//! exponent.
//!
//! | method | what is averaged | file |
//! |---|---|---|
//! | Wolf et al. 1985, fixed evolution time | the growth of one distance along the record, its neighbour replaced after each stretch by one in nearly the same direction | `wolf.rs` |
//! | Rosenstein et al. 1993 | `ln` of the distance of nearest neighbours, `k` steps later; `l` is the slope | `divergence.rs` |
//! | Kantz 1994 | `ln` of the mean distance of all neighbours within a radius, in the last coordinate | `divergence.rs` |
//!
//! **Delay.** The smaller of the first minimum of the average mutual information (Fraser and Swinney 1986)
//! and the first lag at which the autocorrelation has fallen below `1 - 1/e` (Rosenstein et al.); at least 1.
//! `delay.rs`
//!
//! **Records that repeat** to 1/1000 of their standard deviation are refused: a periodic motion has no
//! distances that grow, and its coinciding states no distances but rounding. `repeat.rs`
//!
//! **Dimension.** The smallest with at most 1 % false nearest neighbours (Kennel et al. 1992: a neighbour is
//! false if the next coordinate moves it away by more than 15 times its distance, or to more than twice the
//! standard deviation). `dimension.rs`
//!
//! **Theiler window.** Neighbours closer in time than the mean period do not count (Theiler 1986). The mean
//! period is twice the mean time between crossings of the mean.
//!
//! **Where to fit.** The authors choose the straight part of `S(k) = <ln d>` by eye. Here it is that between
//! 30 % and 70 % of the rise from `S(0)` to the final level for flows (a mean period of more than [`FLOW`]
//! samples), where distances have turned into the growing direction and do not yet feel the attractor's size.
//! For maps, whose few steps cannot wait, it begins after the first step, in which that turning takes place,
//! and ends at 60 %. The final level is only one if the curve is level there: neighbours of flows are
//! followed for twice as long as often as it is not. A curve that comes down again has no straight part. The
//! part can be given instead, and should be looked at: the curve belongs to the result. `slope.rs`
//!
//! The curve of a flow that goes round with one period, as Rössler's does, waves with that period, and 30 %
//! to 70 % of its rise are no whole number of waves. What an eye takes there is
//! [`StraightPart::SteepestPeriod`]: the mean period in which the curve grows most, after the first one and below 80 % of the rise; over a whole period the waves cancel. It is no rule for all flows: the steepest of many stretches is too steep where scatter or the first turning of neighbours
//! makes it so (Lorenz).
//!
//! **Scatter.** The states are cut into ten groups by time; each has its slope (its mean growth). The
//! standard error of their mean is given. It says how far another record of the same length might be off, and
//! is no interval of confidence: groups are not independent, and the methods have errors of their own (the
//! part that is fitted, a radius that is not small) that all groups share. A positive number also comes out
//! of noise. Only together with [`classify`](crate::classify) and a curve with a straight part is it a sign
//! of chaos.
//!
//! # Source
//! Wolf, Swift, Swinney and Vastano, Physica D 16 (1985), 285-317; Rosenstein, Collins and De Luca, Physica D
//! 65 (1993), 117-134; Kantz, Phys. Lett. A 185 (1994), 77-87; Fraser and Swinney, Phys. Rev. A 33 (1986),
//! 1134-1140; Kennel, Brown and Abarbanel, Phys. Rev. A 45 (1992), 3403-3411; Theiler, Phys. Rev. A 34
//! (1986), 2427-2432.

mod delay;
mod dimension;
mod divergence;
mod embedding;
mod repeat;
mod slope;
mod tree;
mod wolf;

pub use divergence::{Divergence, DivergenceSettings, StraightPart, kantz, rosenstein};
pub use embedding::{Embedding, EmbeddingChoice, embedding};
pub use wolf::{WolfExponent, WolfSettings, wolf};

/// Mean period in samples from which on a series is taken as a flow, not a map.
pub const FLOW: f64 = 6.0;
/// Groups whose scatter tells the uncertainty.
const GROUPS: usize = 10;

/// An exponent, and how far parts of the record scatter about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scattered {
    /// The exponent [1/s].
    pub value: f64,
    /// Standard error of the mean of ten parts of the record [1/s]. It knows nothing of the error of the
    /// method, which is often larger.
    pub scatter: f64,
}

/// Standard error of the mean of groups.
fn scatter(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (n - 1.0).max(1.0);
    (variance / n).sqrt()
}
