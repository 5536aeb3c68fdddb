//! What can be wrong with a formula.

/// Most characters of a formula.
pub const LONGEST: usize = 1000;
/// Most parentheses within one another.
pub const DEEPEST: usize = 50;

/// Why a text is no formula of a force. Places count characters from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "the messages name their fields")]
pub enum FormulaError {
    #[error("the formula is empty")]
    Empty,
    #[error("the formula has {found} characters, more than {LONGEST}")]
    TooLong { found: usize },
    #[error("there are more than {DEEPEST} parentheses within one another at character {place}")]
    TooDeep { place: usize },
    #[error("`{found}` at character {place} has no meaning in a formula")]
    Character { place: usize, found: char },
    #[error("`{name}` at character {place} is not known")]
    UnknownName { place: usize, name: String },
    #[error("the number `{found}` at character {place} is too large")]
    Number { place: usize, found: String },
    #[error(
        "`{name}` at character {place} is a function and needs its argument in parentheses, `{name}(...)`"
    )]
    NoArgument { place: usize, name: String },
    #[error("a number, a name or a parenthesis is missing before `{found}` at character {place}")]
    MissingOperand { place: usize, found: String },
    #[error("the formula ends where a number, a name or a parenthesis is missing")]
    Unfinished,
    #[error("an operator is missing before `{found}` at character {place}")]
    MissingOperator { place: usize, found: String },
    #[error("the sign of an exponent at character {place} needs parentheses, as in `x^(-2)`")]
    SignedExponent { place: usize },
    #[error("the second of two powers, at character {place}, needs parentheses: `(a^b)^c` or `a^(b^c)`")]
    PowerOfPower { place: usize },
    #[error("`)` at character {place} closes nothing")]
    ClosesNothing { place: usize },
    #[error("`(` at character {place} is not closed")]
    NotClosed { place: usize },
    #[error("the formula has neither `x` nor `v`: a constant force is a load of order 0")]
    NoVariable,
    #[error("`{name}` cannot be the name of a constant: {why}")]
    ConstantName { name: String, why: &'static str },
    #[error("the constant `{name}` is {found}, must be finite")]
    ConstantValue { name: String, found: f64 },
    #[error("the constant `{name}` is not in the formula")]
    ConstantNotUsed { name: String },
    #[error("the {what} is {found} at rest (`x = 0`, `v = 0`), must be finite")]
    NotFiniteAtRest { what: &'static str, found: f64 },
    #[error("the formula cannot be read")]
    Unread,
}
