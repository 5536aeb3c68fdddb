//! Rust source as a list of words and signs, without comments, literals and tests.

/// What the rules look at: a word (identifier, keyword, number), `::`, or one other sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Token {
    Word(String),
    Path,
    Sign(char),
}

impl Token {
    pub fn is(&self, text: &str) -> bool {
        match self {
            Self::Word(word) => word == text,
            Self::Path => text == "::",
            Self::Sign(sign) => text.chars().eq([*sign]),
        }
    }

    pub fn word(&self) -> Option<&str> {
        if let Self::Word(word) = self { Some(word) } else { None }
    }
}

/// The tokens of a file, but for what is compiled for tests only.
pub fn tokens(source: &str) -> Vec<Token> {
    without_tests(&split(source))
}

fn split(source: &str) -> Vec<Token> {
    let text: Vec<char> = source.chars().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        at += match rest {
            ['/', '/', ..] => rest.iter().position(|c| *c == '\n').unwrap_or(rest.len()),
            ['/', '*', ..] => block_comment(rest),
            ['"', ..] => string(rest),
            ['r', '"' | '#', ..] | ['b', 'r', '"' | '#', ..] if raw_string(rest).is_some() => {
                raw_string(rest).unwrap_or(1)
            }
            ['b', '"', ..] => 1 + string(&rest[1..]),
            ['\'', ..] => character(rest),
            [':', ':', ..] => {
                found.push(Token::Path);
                2
            }
            [first, ..] if is_word(*first) => {
                let length = rest.iter().position(|c| !is_word(*c)).unwrap_or(rest.len());
                found.push(Token::Word(rest[..length].iter().collect()));
                length
            }
            [first, ..] if first.is_whitespace() => 1,
            _ => {
                found.push(Token::Sign(rest[0]));
                1
            }
        };
    }
    found
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn block_comment(rest: &[char]) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < rest.len() {
        match rest[at..] {
            ['/', '*', ..] => (depth, at) = (depth + 1, at + 2),
            ['*', '/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            break;
        }
    }
    at
}

fn string(rest: &[char]) -> usize {
    let mut at = 1;
    while at < rest.len() && rest[at] != '"' {
        at += if rest[at] == '\\' { 2 } else { 1 };
    }
    at + 1
}

fn raw_string(rest: &[char]) -> Option<usize> {
    let start = rest.iter().position(|c| *c == 'r')? + 1;
    let hashes = rest[start..].iter().take_while(|c| **c == '#').count();
    if rest.get(start + hashes) != Some(&'"') {
        return None;
    }
    let ends =
        |at: &usize| rest[*at] == '"' && rest[at + 1..].iter().take_while(|c| **c == '#').count() >= hashes;
    (start + hashes + 1..rest.len()).find(ends).map(|end| end + 1 + hashes)
}

/// A character, or the sign of a lifetime, whose name is left as a word.
fn character(rest: &[char]) -> usize {
    match rest {
        ['\'', '\\', ..] => 3 + rest[3..].iter().position(|c| *c == '\'').unwrap_or(0),
        ['\'', _, '\'', ..] => 3,
        _ => 1,
    }
}

/// Leaves out every item under `#[cfg(test)]`.
fn without_tests(all: &[Token]) -> Vec<Token> {
    let mark: Vec<Token> = split("#[cfg(test)]");
    let mut kept = Vec::new();
    let mut at = 0;
    while at < all.len() {
        if all[at..].starts_with(&mark) {
            at += mark.len() + item_length(&all[at + mark.len()..]);
        } else {
            kept.push(all[at].clone());
            at += 1;
        }
    }
    kept
}

/// Tokens to the end of an item: its closing brace, or the semicolon of one that has none.
fn item_length(rest: &[Token]) -> usize {
    let mut depth = 0_i32;
    for (at, token) in rest.iter().enumerate() {
        if let Token::Sign(sign) = token {
            match sign {
                '{' | '(' | '[' => depth += 1,
                '}' | ')' | ']' => depth -= 1,
                _ => {}
            }
            if depth == 0 && (*sign == ';' || *sign == '}') {
                return at + 1;
            }
        }
    }
    rest.len()
}

#[test]
fn comments_literals_and_tests_are_left_out() {
    let source = "use a::B; // use c\nlet x = \"use d\"; /* use /* e */ f */ \
        let y = r#\"use \" g\"#; 'h' '\\'' &'i \
        #[cfg(test)] mod tests { use j; } fn k() {}";
    let words: Vec<String> =
        tokens(source).iter().filter_map(|token| token.word().map(str::to_owned)).collect();
    assert_eq!(words, ["use", "a", "B", "let", "x", "let", "y", "i", "fn", "k"]);
}
