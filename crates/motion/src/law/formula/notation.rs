//! How formulas are written, and what is wrong with those that are not.
//!
//! What a formula may be is decided here and not by the library that evaluates it, in which `-x^2` is
//! `(-x)^2`, `a^b^c` is `(a^b)^c`, and a comma or a brace has a meaning of its own. A formula is read from
//! left to right, where an operand or an operator is expected; what comes out is the same formula with its
//! constants in their places, a sign of its own for the minus in front of a term, and nothing in it that the
//! library would not read as it is meant. Its length and its depth are bounded, and so is what the library
//! makes of them.

use super::{
    arithmetic::{Function, NEGATIVE, number_at},
    error::{DEEPEST, FormulaError, LONGEST},
};

/// Names of the variables: displacement and velocity.
pub const VARIABLES: [&str; 2] = ["x", "v"];
/// Names with a value.
pub const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// What a piece of a formula is.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Token<'a> {
    Number(&'a str),
    Name(&'a str),
    /// One of `+ - * / ^`.
    Operator(char),
    Open,
    Close,
}

/// Its tokens with their places, and what of the text each is.
fn tokens(text: &str) -> Result<Vec<(usize, Token<'_>)>, FormulaError> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let place = 1 + text.len() - rest.len();
        let name = rest.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
        let (token, length) = if let Some(number) = number_at(rest) {
            (Some(Token::Number(number)), number.len())
        } else if first == '_' || first.is_ascii_alphabetic() {
            (Some(Token::Name(&rest[..name])), name)
        } else {
            let token = match first {
                ' ' => None,
                '(' => Some(Token::Open),
                ')' => Some(Token::Close),
                '+' | '-' | '*' | '/' | '^' => Some(Token::Operator(first)),
                found => return Err(FormulaError::Character { place, found }),
            };
            (token, 1)
        };
        tokens.extend(token.map(|token| (place, token)));
        rest = &rest[length..];
    }
    Ok(tokens)
}

impl std::fmt::Display for Token<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(text) | Self::Name(text) => f.write_str(text),
            Self::Operator(sign) => write!(f, "{sign}"),
            Self::Open => f.write_str("("),
            Self::Close => f.write_str(")"),
        }
    }
}

/// A parenthesis that is open, or the formula as a whole.
struct Level {
    place: usize,
    /// Whether the present term is a power.
    is_power: bool,
}

/// Reads a formula from left to right.
struct Reader<'a> {
    constants: &'a [(String, f64)],
    used: Vec<bool>,
    levels: Vec<Level>,
    /// Whether the last token was the sign of a term.
    signed: bool,
    written: String,
}

/// The formula as the library is to read it.
pub(super) fn read(text: &str, constants: &[(String, f64)]) -> Result<String, FormulaError> {
    constants.iter().try_for_each(|(name, value)| check_constant(name, *value))?;
    let length = text.chars().count();
    if length > LONGEST {
        return Err(FormulaError::TooLong { found: length });
    }
    let tokens = tokens(text)?;
    if tokens.is_empty() {
        return Err(FormulaError::Empty);
    }
    let whole = Level { place: 0, is_power: false };
    let used = vec![false; constants.len()];
    let mut reader = Reader { constants, used, levels: vec![whole], signed: false, written: String::new() };
    let mut before = None;
    for (index, &(place, token)) in tokens.iter().enumerate() {
        let next = tokens.get(index + 1).map(|(_, next)| *next);
        match before {
            Some(Token::Number(_) | Token::Name(_) | Token::Close) if !reader.is_call(before, token) => {
                reader.behind_operand(place, token)?;
            }
            _ => reader.operand(place, token, (before, next))?,
        }
        before = Some(token);
    }
    reader.finish(before)
}

fn check_constant(name: &str, value: f64) -> Result<(), FormulaError> {
    let first = name.bytes().next().unwrap_or(b'0');
    let is_name = (first == b'_' || first.is_ascii_alphabetic())
        && name.bytes().all(|byte| byte == b'_' || byte.is_ascii_alphanumeric());
    let is_taken = VARIABLES.contains(&name)
        || CONSTANTS.iter().any(|(other, _)| *other == name)
        || Function::ALL.iter().any(|(other, _)| *other == name);
    let why = match (is_name, is_taken) {
        (false, _) => "names have letters, digits and `_`, and begin with no digit",
        (_, true) => "it has a meaning already",
        _ if !value.is_finite() => {
            return Err(FormulaError::ConstantValue { name: name.to_owned(), found: value });
        }
        _ => return Ok(()),
    };
    Err(FormulaError::ConstantName { name: name.to_owned(), why })
}

fn is_function(name: &str) -> bool {
    Function::ALL.iter().any(|(known, _)| *known == name)
}

impl Reader<'_> {
    /// Whether a parenthesis opens behind the name of a function.
    fn is_call(&self, before: Option<Token<'_>>, token: Token<'_>) -> bool {
        matches!((before, token), (Some(Token::Name(name)), Token::Open) if is_function(name))
    }

    fn level(&mut self) -> &mut Level {
        self.levels.last_mut().expect("the formula itself is never closed")
    }

    /// Takes a token where an operand is expected.
    fn operand(
        &mut self,
        place: usize,
        token: Token<'_>,
        (before, next): (Option<Token<'_>>, Option<Token<'_>>),
    ) -> Result<(), FormulaError> {
        let signed = std::mem::take(&mut self.signed);
        match token {
            Token::Number(found) => {
                if !found.parse::<f64>().is_ok_and(f64::is_finite) {
                    return Err(FormulaError::Number { place, found: found.to_owned() });
                }
                self.written.push_str(found);
            }
            Token::Name(name) => self.name(place, name, next)?,
            Token::Open => {
                if self.levels.len() > DEEPEST {
                    return Err(FormulaError::TooDeep { place });
                }
                self.levels.push(Level { place, is_power: false });
                self.written.push('(');
            }
            Token::Operator('+' | '-') if before == Some(Token::Operator('^')) => {
                return Err(FormulaError::SignedExponent { place });
            }
            Token::Operator(sign @ ('+' | '-')) if !signed => {
                if sign == '-' {
                    self.written.push('0');
                    self.written.push_str(NEGATIVE);
                }
                self.signed = true;
            }
            _ => return Err(FormulaError::MissingOperand { place, found: token.to_string() }),
        }
        Ok(())
    }

    /// Takes a token behind an operand.
    fn behind_operand(&mut self, place: usize, token: Token<'_>) -> Result<(), FormulaError> {
        match token {
            Token::Operator(sign) => {
                if sign == '^' && self.level().is_power {
                    return Err(FormulaError::PowerOfPower { place });
                }
                self.level().is_power = sign == '^';
                self.written.push(sign);
            }
            Token::Close if self.levels.len() > 1 => {
                self.levels.pop();
                self.written.push(')');
            }
            Token::Close => return Err(FormulaError::ClosesNothing { place }),
            _ => return Err(FormulaError::MissingOperator { place, found: token.to_string() }),
        }
        Ok(())
    }

    fn name(&mut self, place: usize, name: &str, next: Option<Token<'_>>) -> Result<(), FormulaError> {
        if is_function(name) {
            if next != Some(Token::Open) {
                return Err(FormulaError::NoArgument { place, name: name.to_owned() });
            }
            self.written.push_str(name);
        } else if VARIABLES.contains(&name) {
            self.written.push_str(name);
        } else if let Some((_, value)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
            self.value(*value);
        } else if let Some(index) = self.constants.iter().position(|(known, _)| known == name) {
            self.used[index] = true;
            self.value(self.constants[index].1);
        } else {
            return Err(FormulaError::UnknownName { place, name: name.to_owned() });
        }
        Ok(())
    }

    /// Writes a value such that reading it gives the same one.
    fn value(&mut self, value: f64) {
        let written = if value.is_sign_negative() {
            format!("(0{NEGATIVE}{:?})", -value)
        } else {
            format!("{value:?}")
        };
        self.written.push_str(&written);
    }

    fn finish(self, last: Option<Token<'_>>) -> Result<String, FormulaError> {
        if !matches!(last, Some(Token::Number(_) | Token::Name(_) | Token::Close)) {
            return Err(FormulaError::Unfinished);
        }
        if let Some(level) = self.levels.last().filter(|level| level.place > 0) {
            return Err(FormulaError::NotClosed { place: level.place });
        }
        let unused = self.constants.iter().zip(&self.used).find(|(_, used)| !**used);
        match unused {
            Some(((name, _), _)) => Err(FormulaError::ConstantNotUsed { name: name.clone() }),
            None => Ok(self.written),
        }
    }
}
