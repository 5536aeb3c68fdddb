//! The largest Lyapunov exponent of a series.
//!
//! States are reconstructed from one series `x` by delays, `X_i = (x_i, x_{i+J}, .., x_{i+(m-1)J})` (Takens
//! 1981). Neighbours in that space that are not neighbours in time diverge like `exp(l t)`; `l` is the
//! largest exponent.
//!
//! | method | what is averaged | file |
//! |---|---|---|
//! | Wolf et al. 1985 | growth of one distance along the record, with its neighbour replaced | `wolf.rs` |
//! | Rosenstein et al. 1993 | `ln` of the distance of nearest neighbours, `k` steps later | `divergence.rs` |
//! | Kantz 1994 | `ln` of the mean distance of all neighbours within a radius | `divergence.rs` |
//!
//! The exponent is the slope of the average over `k` for the last two. Wolf's method has a fixed evolution
//! time; Kantz's method takes distances in the last coordinate.
//!
//! **Delay.** The smaller of the first minimum of the average mutual information (Fraser and Swinney 1986)
//! and the first lag at which the autocorrelation has fallen below `1 - 1/e` (Rosenstein et al.); at least 1.
//! `delay.rs`
//!
//! **Records that repeat** to 1/1000 of their standard deviation are refused. No distance grows in a periodic
//! motion, and the distances of its coinciding states are rounding. `repeat.rs`
//!
//! **Dimension.** The smallest with at most 1 % false nearest neighbours (Kennel et al. 1992: a neighbour is
//! false if the next coordinate moves it away by more than 15 times its distance, or to more than twice the
//! standard deviation). `dimension.rs`
//!
//! **Theiler window.** Neighbours closer in time than the mean period do not count (Theiler 1986). The mean
//! period is twice the mean time between crossings of the mean.
//!
//! **Fitted part.** The authors choose the straight part of `S(k) = <ln d>` by eye. For flows (a mean period
//! above [`LEAST_FLOW_PERIOD`] samples) it is here the part between 30 % and 70 % of the rise from `S(0)` to
//! the final level. There distances have turned into the growing direction, and the size of the attractor
//! does not limit them yet. For maps, which take few steps, it starts after the first step, in which
//! distances turn, and ends at 60 %. The final level has a meaning only if the curve is level at its end;
//! until then neighbours of flows are followed for twice as long again. A curve that falls again has no
//! straight part. The part can be specified instead. The curve is part of the result, so that the choice can
//! be checked. `slope.rs`
//!
//! The curve of a flow with one dominant period, such as Rössler's, oscillates with that period, and 30 % to
//! 70 % of its rise are not a whole number of oscillations. A reader would choose
//! [`StraightPart::SteepestPeriod`]: the mean period in which the curve grows most, after the first period
//! and below 80 % of the rise. Over a whole period the oscillations cancel. It is not a rule for all flows:
//! the steepest of many intervals is too steep where scatter or the first turning of neighbours dominates
//! (Lorenz).
//!
//! **Scatter.** The states are divided into ten groups by time, each with its own slope (its mean growth).
//! The result includes the standard error of their mean. It estimates the deviation of another record of the
//! same length, but is not a confidence interval: groups are not independent, and they share the errors of
//! the method (the fitted part, a radius that is not small). Noise gives a positive number, too. It indicates
//! chaos only together with [`classify`](crate::classify) and a curve with a straight part.
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
mod scatter;
mod slope;
mod states;
mod tree;
mod wolf;

pub use divergence::{Divergence, DivergenceSettings, StraightPart, kantz, rosenstein};
pub use embedding::{Embedding, EmbeddingChoice, embedding};
pub use scatter::{ExponentEstimate, LEAST_FLOW_PERIOD};
pub use wolf::{WolfExponent, WolfSettings, wolf};
