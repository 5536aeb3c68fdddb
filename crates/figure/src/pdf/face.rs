//! A face in a PDF: a font of numbered glyphs with the outlines of the characters that are used, their
//! widths, and what characters they are, so that text can be searched and copied. ISO 32000-1, section 9.7.

use std::collections::BTreeSet;

use pdf_writer::{
    Filter, Finish, Name, Pdf, Rect, Ref, Str,
    types::{CidFontType, FontFlags, SystemInfo, UnicodeCmap},
};

use super::stream::deflated;
use crate::font::{self, CAPITAL_HEIGHT, glyph_index, read_u16, table};

/// Character codes equal to glyph numbers.
const IDENTITY: SystemInfo<'_> =
    SystemInfo { registry: Str(b"Adobe"), ordering: Str(b"Identity"), supplement: 0 };
/// Width of upright stems over the em, about the width of the letter l.
const STEM: f32 = 0.09;

/// A face with some characters.
pub(super) struct Face {
    /// Its name in the page.
    pub(super) resource: String,
    /// Number of its first object, the font.
    pub(super) first_object: Ref,
    /// Its name, with a prefix of six letters derived from its characters.
    name: String,
    italic: bool,
    characters: Vec<char>,
    /// A TrueType file.
    file: Vec<u8>,
    /// Advances of its glyphs over the em.
    advances: Vec<f32>,
    metrics: Metrics,
}

/// Sizes over the em.
struct Metrics {
    bounds: [f32; 4],
    ascent: f32,
    descent: f32,
    /// In degrees, to the right negative.
    italic_angle: f32,
}

impl Face {
    /// Number of its objects.
    pub(super) const OBJECTS: i32 = 5;

    /// The characters of a face; `None` where the tables of the face cannot be read.
    pub(super) fn of(whole: &[u8], characters: &BTreeSet<char>, style: &str, first: i32) -> Option<Self> {
        let file = font::with_characters(whole, characters, style)?;
        let units = f32::from(read_u16(&file, table(&file, b"head")? + 18)?);
        let (hmtx, glyphs) =
            (table(&file, b"hmtx")?, usize::from(read_u16(&file, table(&file, b"maxp")? + 4)?));
        let advances = (0..glyphs).map(|glyph| Some(f32::from(read_u16(&file, hmtx + 4 * glyph)?) / units));
        Some(Self {
            resource: format!("F{style}"),
            first_object: Ref::new(first),
            name: format!("{}+{}-{style}", tag(characters), font::BUNDLED_FAMILY),
            italic: style == "Italic",
            characters: characters.iter().copied().collect(),
            advances: advances.collect::<Option<_>>()?,
            metrics: Metrics::of(&file, units)?,
            file,
        })
    }

    pub(super) fn is_empty(&self) -> bool {
        self.characters.is_empty()
    }

    fn glyph(&self, character: char) -> u16 {
        let code = u16::try_from(u32::from(character)).ok();
        code.and_then(|code| glyph_index(&self.file, code)).unwrap_or(0)
    }

    /// Codes of a text: two bytes for each character.
    pub(super) fn encode(&self, text: &str) -> Vec<u8> {
        text.chars().flat_map(|character| self.glyph(character).to_be_bytes()).collect()
    }

    /// Width of a text over the font size.
    pub(super) fn width(&self, text: &str) -> f32 {
        let advance =
            |character| self.advances.get(usize::from(self.glyph(character))).copied().unwrap_or(0.0);
        text.chars().map(advance).sum()
    }

    /// Writes its objects.
    pub(super) fn write(&self, pdf: &mut Pdf) {
        let object = |k: i32| Ref::new(self.first_object.get() + k);
        let [font, glyphs, descriptor, file, map] = [0, 1, 2, 3, 4].map(object);
        let name = Name(self.name.as_bytes());
        pdf.type0_font(font)
            .base_font(name)
            .encoding_predefined(Name(b"Identity-H"))
            .descendant_font(glyphs)
            .to_unicode(map);
        let mut cid = pdf.cid_font(glyphs);
        cid.subtype(CidFontType::Type2).base_font(name).system_info(IDENTITY).font_descriptor(descriptor);
        cid.cid_to_gid_map_predefined(Name(b"Identity")).default_width(0.0);
        cid.widths().consecutive(0, self.advances.iter().map(|advance| 1e3 * advance));
        cid.finish();
        let Metrics { bounds, ascent, descent, italic_angle } = self.metrics;
        let [left, bottom, right, top] = bounds.map(|side| 1e3 * side);
        let slant = if self.italic { FontFlags::ITALIC } else { FontFlags::empty() };
        pdf.font_descriptor(descriptor)
            .name(name)
            .flags(FontFlags::SYMBOLIC | slant)
            .bbox(Rect::new(left, bottom, right, top))
            .italic_angle(italic_angle)
            .ascent(1e3 * ascent)
            .descent(1e3 * descent)
            .cap_height(1e3 * CAPITAL_HEIGHT as f32)
            .stem_v(1e3 * STEM)
            .font_file2(file);
        pdf.stream(file, &deflated(&self.file)).filter(Filter::FlateDecode);
        let mut characters = UnicodeCmap::new(Name(b"Characters"), IDENTITY);
        for &character in self.characters.iter().filter(|character| self.glyph(**character) != 0) {
            characters.pair(self.glyph(character), character);
        }
        pdf.cmap(map, &characters.finish());
    }
}

impl Metrics {
    fn of(file: &[u8], units: f32) -> Option<Self> {
        let signed = |at: usize| Some(f32::from(read_u16(file, at)?.cast_signed()) / units);
        let (head, hhea, post) = (table(file, b"head")?, table(file, b"hhea")?, table(file, b"post")?);
        let side = |k: usize| signed(head + 36 + 2 * k);
        Some(Self {
            bounds: [side(0)?, side(1)?, side(2)?, side(3)?],
            ascent: signed(hhea + 4)?,
            descent: signed(hhea + 6)?,
            // The whole degrees of a fixed-point number with 16 fractional bits.
            italic_angle: f32::from(read_u16(file, post + 4)?.cast_signed()),
        })
    }
}

/// Six letters for a set of characters, so that faces with different characters have different names (hash of
/// Fowler, Noll and Vo).
fn tag(characters: &BTreeSet<char>) -> String {
    let hash = characters.iter().fold(0xcbf2_9ce4_8422_2325_u64, |hash, character| {
        (hash ^ u64::from(u32::from(*character))).wrapping_mul(0x0100_0000_01b3)
    });
    (0..6).map(|k| char::from(b'A' + (hash / 26_u64.pow(k) % 26) as u8)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits are 1139 of 2048 units wide in every face with the metrics of Arial.
    #[test]
    fn a_text_is_as_wide_as_its_characters_and_coded_by_glyphs_of_the_file() {
        let characters: BTreeSet<char> = "Poincaré 7".chars().collect();
        for (whole, style) in [(font::UPRIGHT, "Regular"), (font::ITALIC, "Italic")] {
            let face = Face::of(whole, &characters, style, 6).unwrap();
            assert!((face.width("777") - 3.0 * 1139.0 / 2048.0).abs() < 1e-6);
            let text = "Poincaré";
            let wanted: f64 = text.chars().map(|character| font::character_width(whole, character)).sum();
            assert!((f64::from(face.width(text)) - wanted).abs() < 1e-6);
            let codes = face.encode(text);
            assert_eq!(codes.len(), 16);
            assert!(codes.chunks(2).all(|code| usize::from(code[1]) < face.advances.len() && code != [0, 0]));
            assert_eq!(face.encode("漢"), [0, 0], "the glyph of what is missing");
            assert_eq!(face.italic, face.metrics.italic_angle < 0.0);
        }
    }

    #[test]
    fn other_characters_have_another_tag() {
        let set = |text: &str| tag(&text.chars().collect());
        assert!(set("ab") != set("ac") && set("ab") == set("ba"));
        assert!(set("").chars().chain(set("é").chars()).all(|letter| letter.is_ascii_uppercase()));
    }
}
