//! What a page of the book has for the reader to do: files to save, commands to run, output to expect.

/// A piece of a tutorial.
pub enum Snippet {
    /// A file that the reader saves, under the name that the text above it gives.
    File { name: String, text: String },
    /// Commands, one a line.
    Commands(Vec<String>),
    /// Lines that the commands before print, in this order; `...` stands for anything.
    Output(Vec<String>),
}

/// A block between fences, with its language and the line above it that has words.
pub struct Block {
    pub language: String,
    pub text: String,
    pub above: String,
}

/// All blocks of a page.
pub fn blocks(page: &str) -> Vec<Block> {
    let (mut blocks, mut open, mut above) = (Vec::new(), None, String::new());
    for line in page.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (None, Some(language)) => {
                open =
                    Some(Block { language: language.to_owned(), text: String::new(), above: above.clone() });
            }
            (Some(_), Some(_)) => blocks.extend(open.take()),
            (Some(block), None) => block.text.extend([line, "\n"]),
            (None, None) if !line.trim().is_empty() => line.clone_into(&mut above),
            (None, None) => {}
        }
    }
    blocks
}

/// What there is to do on a tutorial page.
pub fn snippets(page: &str) -> Vec<Snippet> {
    let snippet = |block: Block| match block.language.as_str() {
        "toml" | "csv" => Some(Snippet::File { name: file_name(&block.above), text: block.text }),
        "sh" => Some(Snippet::Commands(block.text.lines().map(str::to_owned).collect())),
        "text" => Some(Snippet::Output(block.text.lines().map(str::to_owned).collect())),
        _ => None,
    };
    blocks(page).into_iter().filter_map(snippet).collect()
}

/// The last name in backquotes of a sentence such as "Save this as `tube.toml`:".
fn file_name(sentence: &str) -> String {
    let name = sentence.rsplit('`').nth(1);
    name.unwrap_or_else(|| panic!("no name of a file in \"{sentence}\"")).to_owned()
}

/// Pictures of a page that its commands draw: paths in the folder of the tutorial.
pub fn pictures<'a>(page: &'a str, tutorial: &str) -> Vec<&'a str> {
    let start = format!("](../images/tutorials/{tutorial}/");
    page.split(start.as_str()).skip(1).filter_map(|rest| rest.split(')').next()).collect()
}

/// The first line of `expected` that the output does not have behind those before it.
pub fn missing<'a>(expected: &'a [String], output: &str, is_same: IsSame) -> Option<&'a str> {
    let mut lines = output.lines();
    let mut asked = expected.iter().map(String::as_str).filter(|line| !["", "..."].contains(&line.trim()));
    asked.find(|line| !lines.any(|printed| is_like(line, printed, is_same)))
}

/// Whether a line is as the page has it, word for word; `...` stands for any words.
fn is_like(pattern: &str, line: &str, is_same: IsSame) -> bool {
    let words = |text: &'_ str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    are_like(&words(pattern), &words(line), is_same)
}

fn are_like(asked: &[String], words: &[String], is_same: IsSame) -> bool {
    match (asked.split_first(), words.split_first()) {
        (Some((first, rest)), word) if first == "..." => {
            are_like(rest, words, is_same) || word.is_some_and(|(_, others)| are_like(asked, others, is_same))
        }
        (Some((first, rest)), Some((word, others))) => {
            is_same(first, word) && are_like(rest, others, is_same)
        }
        (first, word) => first.is_none() && word.is_none(),
    }
}

/// Whether a word of the page and a printed one are the same.
pub type IsSame = fn(&str, &str) -> bool;

/// The same word; or numbers, units and commas behind them aside, within two per cent.
pub fn is_about(asked: &str, word: &str) -> bool {
    let number = |text: &str| text.trim_end_matches([',', ';', ':']).parse::<f64>().ok();
    let near = |(asked, found): (f64, f64)| (asked - found).abs() <= 0.02 * asked.abs();
    is_same(asked, word) || number(asked).zip(number(word)).is_some_and(near)
}

/// The same word; or counts of solutions, which depend on rounding, within two per cent.
pub fn is_same(asked: &str, word: &str) -> bool {
    let counts = asked.parse::<u64>().ok().zip(word.parse::<u64>().ok());
    asked == word || counts.is_some_and(|(asked, count)| 50 * asked.abs_diff(count) <= asked)
}

#[test]
fn dots_stand_for_anything_and_counts_may_differ_a_little() {
    let is_like = |pattern, line| is_like(pattern, line, is_same);
    assert!(is_like("after ...", "after 1.2 s") && is_like("a ...", "a b") && is_like("a", "a"));
    assert!(is_like("407 solutions", "405 solutions") && is_like("0.60 ...", "0.60"));
    assert!(
        !is_like("a", "a b") && !is_like("after ... s", "after 1.2 min") && !is_like("2 flips", "3 flips")
    );
    assert!(!is_like("peak at 29.4273 Hz", "peak at 29.4274 Hz"));
    assert!(is_about("1.000,", "1.01,") && !is_about("1.000", "1.03") && !is_about("1.0", "one"));
}
