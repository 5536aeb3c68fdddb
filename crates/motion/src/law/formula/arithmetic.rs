//! What a formula is computed with: the operators and functions, for any kind of number.

use std::{fmt::Debug, str::FromStr};

use exmex::{BinOp, MakeOperators, MatchLiteral, Operator};

/// Sign that stands for the minus in front of a term, behind a zero: `0~x^2` is `-(x^2)`.
pub(super) const NEGATIVE: &str = "~";

/// Numbers that a formula can be evaluated in.
pub(super) trait Arithmetic: Clone + Debug + Default + FromStr {
    fn plus(self, other: Self) -> Self;
    fn negative(self) -> Self;
    fn times(self, other: Self) -> Self;
    fn over(self, other: Self) -> Self;
    fn to_the(self, exponent: Self) -> Self;
    fn of(self, function: Function) -> Self;
}

/// A function that a formula can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the usual names")]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
}

impl Function {
    /// All of them, by their names.
    pub const ALL: [(&'static str, Self); 13] = [
        ("sin", Self::Sin),
        ("cos", Self::Cos),
        ("tan", Self::Tan),
        ("asin", Self::Asin),
        ("acos", Self::Acos),
        ("atan", Self::Atan),
        ("sinh", Self::Sinh),
        ("cosh", Self::Cosh),
        ("tanh", Self::Tanh),
        ("exp", Self::Exp),
        ("ln", Self::Ln),
        ("sqrt", Self::Sqrt),
        ("abs", Self::Abs),
    ];

    /// The function as the library calls it.
    fn call<T: Arithmetic>(self) -> fn(T) -> T {
        match self {
            Self::Sin => |x| x.of(Self::Sin),
            Self::Cos => |x| x.of(Self::Cos),
            Self::Tan => |x| x.of(Self::Tan),
            Self::Asin => |x| x.of(Self::Asin),
            Self::Acos => |x| x.of(Self::Acos),
            Self::Atan => |x| x.of(Self::Atan),
            Self::Sinh => |x| x.of(Self::Sinh),
            Self::Cosh => |x| x.of(Self::Cosh),
            Self::Tanh => |x| x.of(Self::Tanh),
            Self::Exp => |x| x.of(Self::Exp),
            Self::Ln => |x| x.of(Self::Ln),
            Self::Sqrt => |x| x.of(Self::Sqrt),
            Self::Abs => |x| x.of(Self::Abs),
        }
    }
}

/// The operators and functions, as the library asks for them.
#[derive(Debug, Clone)]
pub(super) struct Operators;

impl<T: Arithmetic> MakeOperators<T> for Operators {
    fn make<'a>() -> Vec<Operator<'a, T>> {
        // Terms are computed in the order in which they are written.
        let binary =
            |name, prio, apply| Operator::make_bin(name, BinOp { apply, prio, is_commutative: false });
        let mut all = vec![
            binary("+", 0, |a: T, b: T| a.plus(b)),
            binary("-", 0, |a: T, b: T| a.plus(b.negative())),
            binary("*", 1, |a: T, b: T| a.times(b)),
            binary("/", 1, |a: T, b: T| a.over(b)),
            binary(NEGATIVE, 2, |_, b: T| b.negative()),
            binary("^", 3, |a: T, b: T| a.to_the(b)),
        ];
        all.extend(Function::ALL.map(|(name, function)| Operator::make_unary(name, function.call())));
        all
    }
}

/// Numbers, as they are written in a formula.
#[derive(Debug, Clone)]
pub(super) struct Literals;

impl MatchLiteral for Literals {
    fn is_literal(text: &str) -> Option<&str> {
        number_at(text)
    }
}

/// The number with which a text starts, if it starts with one.
pub(super) fn number_at(text: &str) -> Option<&str> {
    let bytes = text.as_bytes();
    let is = |place: usize, signs: &[u8]| bytes.get(place).is_some_and(|byte| signs.contains(byte));
    let digits = |from: usize| bytes.iter().skip(from).take_while(|byte| byte.is_ascii_digit()).count();
    let whole = digits(0);
    let parts = if is(whole, b".") { digits(whole + 1) } else { 0 };
    if whole + parts == 0 {
        return None;
    }
    let mantissa = whole + parts + usize::from(is(whole, b"."));
    let power = mantissa + 1 + usize::from(is(mantissa + 1, b"+-"));
    let has_power = is(mantissa, b"eE") && digits(power) > 0;
    Some(&text[..if has_power { power + digits(power) } else { mantissa }])
}
