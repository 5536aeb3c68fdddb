//! A small writer of SVG: the few elements that figures need, in points on the page, y downwards.
//!
//! Coordinates have two decimals, 0.01 pt, which is a twentieth of a pixel at 300 pixels per inch. There are
//! no ids, so any number of figures can share one page.

use std::{collections::BTreeSet, fmt::Write};

use crate::{
    font::{self, Characters},
    text::Text,
};

/// Replacement for a character missing in the font.
const LACKING: char = '\u{fffd}';

/// A place on the page (pt), y downwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PagePoint {
    pub(crate) x: f64,
    pub(crate) y: f64,
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke<'a> {
    pub(crate) colour: &'a str,
    pub(crate) width: f64,
}

/// Position of a text relative to its anchor point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// How a text is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TextStyle<'a> {
    pub(crate) size: f64,
    pub(crate) colour: &'a str,
    pub(crate) anchor: Anchor,
    /// Turned a quarter to the left, for the label of a vertical axis.
    pub(crate) upwards: bool,
}

/// An SVG document that is being written.
#[derive(Debug)]
pub(crate) struct SvgWriter {
    document: String,
    /// Position of the fonts in it (bytes).
    fonts_at: usize,
    characters: Characters,
    lacking: BTreeSet<char>,
}

/// An SVG document, and the fonts that it needs.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SvgDocument {
    /// The document without fonts.
    pub(crate) text: String,
    fonts_at: usize,
    /// Characters of its text.
    pub(crate) characters: Characters,
    /// Characters missing in the font, drawn as [`LACKING`].
    pub(crate) lacking: BTreeSet<char>,
}

impl SvgDocument {
    /// The document with the glyphs that it uses.
    pub(crate) fn with_fonts(&self) -> String {
        let (head, rest) = self.text.split_at(self.fonts_at);
        [head, &self.characters.style_element(), rest].concat()
    }
}

impl SvgWriter {
    /// Starts a document of a size on paper (mm), with a title and a description for readers that cannot see
    /// it.
    pub(crate) fn new(width_mm: f64, height_mm: f64, title: &str, description: &str) -> Self {
        let (width, height) = (number(points(width_mm)), number(points(height_mm)));
        let title =
            if title.is_empty() { String::new() } else { format!("<title>{}</title>\n", escape(title)) };
        let description = escape(description);
        let (width_mm, height_mm) = (number(width_mm), number(height_mm));
        // Else browsers round the advance of each glyph to pixels, and letters stand apart.
        let document = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width_mm}mm\" height=\"{height_mm}mm\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" text-rendering=\"geometricPrecision\" \
             font-family=\"{}\">\n{title}<desc>{description}</desc>\n",
            font::FAMILIES
        );
        let fonts_at = document.len();
        let (characters, lacking) = (Characters::default(), BTreeSet::new());
        let mut writer = Self { document, fonts_at, characters, lacking };
        writer.add(format_args!("<rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"));
        writer
    }

    /// A polyline with blunt ends.
    pub(crate) fn polyline(&mut self, points: &[PagePoint], stroke: Stroke<'_>) {
        self.polylines([(points, None)], stroke);
    }

    /// Polylines with blunt ends, each dashed or not, in one group.
    pub(crate) fn polylines<'p>(
        &mut self,
        lines: impl IntoIterator<Item = (&'p [PagePoint], Option<Dashes>)>,
        stroke: Stroke<'_>,
    ) {
        let (colour, width) = (stroke.colour, number(stroke.width));
        let mut lines = lines.into_iter().peekable();
        if lines.peek().is_none() {
            return;
        }
        self.add(format_args!(
            "<g fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\">\n"
        ));
        for (points, dashes) in lines {
            let dashes = dashes.map(Dashes::attributes).unwrap_or_default();
            self.add(format_args!("<path d=\"{}\"{dashes}/>\n", polyline_data(points)));
        }
        self.document.push_str("</g>\n");
    }

    /// A closed frame through two opposite corners.
    pub(crate) fn rectangle(&mut self, corner: PagePoint, opposite: PagePoint, stroke: Stroke<'_>) {
        let (x, y) = (number(opposite.x), number(opposite.y));
        let start = (number(corner.x), number(corner.y));
        self.path(&format!("M{} {}H{x}V{y}H{}z", start.0, start.1, start.0), "none", stroke);
    }

    /// A path given by its data, filled and stroked.
    pub(crate) fn path(&mut self, data: &str, fill: &str, stroke: Stroke<'_>) {
        self.add(format_args!(
            "<path d=\"{data}\" fill=\"{fill}\" stroke=\"{}\" stroke-width=\"{}\" \
             stroke-linejoin=\"miter\"/>\n",
            stroke.colour,
            number(stroke.width),
        ));
    }

    /// A line of text, its baseline through `at`.
    pub(crate) fn text(&mut self, at: PagePoint, text: &Text, style: TextStyle<'_>) {
        let anchor = match style.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y) = (number(at.x), number(at.y));
        let turn = if style.upwards { format!(" transform=\"rotate(-90 {x} {y})\"") } else { String::new() };
        self.add(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{anchor}\"{turn}>",
            number(style.size),
            style.colour,
        ));
        for span in &text.spans {
            let drawn: String = span.content.chars().map(|one| self.drawable(one, span.italic)).collect();
            let content = escape(&drawn);
            let Characters { upright, italic } = &mut self.characters;
            if span.italic { italic } else { upright }.extend(drawn.chars());
            match span.italic {
                true => self.add(format_args!("<tspan font-style=\"italic\">{content}</tspan>")),
                false => self.document.push_str(&content),
            }
        }
        self.document.push_str("</text>\n");
    }

    /// A character, or the replacement for one missing in the font, which is recorded.
    fn drawable(&mut self, character: char, italic: bool) -> char {
        if character.is_control() || font::has(if italic { font::ITALIC } else { font::UPRIGHT }, character) {
            return character;
        }
        self.lacking.insert(character);
        LACKING
    }

    /// What is drawn by a function, moved to the right (pt).
    pub(crate) fn moved(&mut self, right: f64, draw: impl FnOnce(&mut Self)) {
        self.add(format_args!("<g transform=\"translate({} 0)\">\n", number(right)));
        draw(self);
        self.document.push_str("</g>\n");
    }

    /// Ends the document.
    pub(crate) fn finish(mut self) -> SvgDocument {
        self.document.push_str("</svg>\n");
        let Self { document: text, fonts_at, characters, lacking } = self;
        SvgDocument { text, fonts_at, characters, lacking }
    }

    fn add(&mut self, arguments: std::fmt::Arguments<'_>) {
        self.document.write_fmt(arguments).expect("writing to a string does not fail");
    }
}

/// A pattern of dashes (pt).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Dashes {
    pub(crate) dash: f64,
    pub(crate) gap: f64,
    pub(crate) offset: f64,
}

impl Dashes {
    fn attributes(self) -> String {
        let (dash, gap, offset) = (precise(self.dash), precise(self.gap), precise(self.offset));
        format!(" stroke-dasharray=\"{dash} {gap}\" stroke-dashoffset=\"{offset}\"")
    }
}

/// Millimetres in points of 1/72 inch.
pub(crate) fn points(millimetres: f64) -> f64 {
    millimetres * 72.0 / 25.4
}

fn polyline_data(points: &[PagePoint]) -> String {
    let mut data = String::new();
    for (i, point) in points.iter().enumerate() {
        let command = if i == 0 { 'M' } else { 'L' };
        write!(data, "{command}{} {}", number(point.x), number(point.y))
            .expect("writing to a string does not fail");
    }
    data
}

/// A coordinate with two decimals, without zeros at its end.
pub(crate) fn number(value: f64) -> String {
    trimmed(format!("{value:.2}"))
}

/// A length with four decimals: errors of dash lengths add up along a line.
fn precise(value: f64) -> String {
    trimmed(format!("{value:.4}"))
}

fn trimmed(mut digits: String) -> String {
    digits.truncate(digits.trim_end_matches('0').trim_end_matches('.').len());
    if digits == "-0" { "0".to_owned() } else { digits }
}

/// Text escaped for XML; characters that XML does not allow become the replacement character.
pub(crate) fn escape(content: &str) -> String {
    let mut escaped = String::with_capacity(content.len());
    for character in content.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\t' | '\n' | '\r' => escaped.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short() {
        assert_eq!(number(12.0), "12");
        assert_eq!(number(100.0), "100");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(0.126), "0.13");
        assert_eq!(number(-3.5), "-3.5");
    }

    #[test]
    fn markup_in_a_text_is_only_text() {
        assert_eq!(escape("a<b> & \"c\"\u{0}\n"), "a&lt;b&gt; &amp; &quot;c&quot;\u{fffd} ");
    }

    /// Drawn as it is, every one of them would be the same empty box, which no reader of a PDF could search
    /// for.
    #[test]
    fn a_character_that_the_font_lacks_is_replaced_and_told() {
        let mut writer = SvgWriter::new(84.0, 20.0, "振動", "");
        let style = TextStyle { size: 7.0, colour: "#222222", anchor: Anchor::Start, upwards: false };
        writer.text(PagePoint { x: 5.0, y: 20.0 }, &Text::upright("Größe 振 🔨\tЖ").variable("梁x"), style);
        let document = writer.finish();
        assert_eq!(document.lacking, ['振', '梁', '🔨'].into());
        assert!(document.text.contains("Größe \u{fffd} \u{fffd} Ж<tspan font-style=\"italic\">\u{fffd}x<"));
        assert!(document.text.contains("<title>振動</title>"), "what is read and not drawn is left as it is");
    }

    #[test]
    fn an_inch_has_72_points() {
        assert_eq!(points(25.4), 72.0);
    }
}
