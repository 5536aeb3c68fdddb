//! The bundled font: its bytes, its name in an SVG, and the widths of its glyphs.
//!
//! Widths place legends and margins. They are read straight from the `cmap` (format 4) and `hmtx` tables of
//! the font; kerning is left out, which is good to about 1 % of a line.

mod subset;
mod tables;

pub(crate) use tables::{glyph_index, read_u16, table};

use std::collections::BTreeSet;

use crate::base64;

/// Font families of every text, best first. All but the last have glyphs of equal widths.
pub(crate) const FAMILIES: &str = "Arimo, 'Liberation Sans', Arial, Helvetica, sans-serif";
/// Name of the bundled family.
pub(crate) const BUNDLED_FAMILY: &str = "Arimo";
/// The upright face.
pub(crate) const UPRIGHT: &[u8] = include_bytes!("../fonts/Arimo-Regular.ttf");
/// The slanted face, for variables.
pub(crate) const ITALIC: &[u8] = include_bytes!("../fonts/Arimo-Italic.ttf");

/// Height of a capital letter over the font size.
pub(crate) const CAPITAL_HEIGHT: f64 = 0.716;

/// Width of a glyph that the font does not have, over the font size.
const UNKNOWN_WIDTH: f64 = 0.75;

/// Characters of a document in the upright and in the slanted face.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Characters {
    pub(crate) upright: BTreeSet<char>,
    pub(crate) italic: BTreeSet<char>,
}

impl Characters {
    /// The faces with these characters as an element of an SVG; may be empty.
    pub(crate) fn style_element(&self) -> String {
        let faces =
            [(UPRIGHT, &self.upright, "Regular", ""), (ITALIC, &self.italic, "Italic", ";font-style:italic")];
        let rule = |(face, characters, name, slant): (&[u8], &BTreeSet<char>, &str, &str)| {
            let subset = with_characters(face, characters, name);
            let bytes = base64::encode(&subset.filter(|_| !characters.is_empty())?);
            Some(format!(
                "@font-face{{font-family:{BUNDLED_FAMILY}{slant};src:url(data:font/ttf;base64,{bytes})}}"
            ))
        };
        let rules: String = faces.into_iter().filter_map(rule).collect();
        if rules.is_empty() { rules } else { format!("<style>{rules}</style>\n") }
    }
}

/// A face with these characters only; `None` if its tables cannot be read.
///
/// * `style`: the part of its name after the family.
pub(crate) fn with_characters(face: &[u8], characters: &BTreeSet<char>, style: &str) -> Option<Vec<u8>> {
    subset::subset(face, characters, [BUNDLED_FAMILY, style, &format!("{BUNDLED_FAMILY}-{style}")])
}

/// Width of a character over the font size.
pub(crate) fn character_width(face: &[u8], character: char) -> f64 {
    advance(face, character).unwrap_or(UNKNOWN_WIDTH)
}

/// Whether a face has a character.
pub(crate) fn has(face: &[u8], character: char) -> bool {
    advance(face, character).is_some()
}

fn advance(face: &[u8], character: char) -> Option<f64> {
    let units_per_em = read_u16(face, table(face, b"head")? + 18)?;
    let wide_glyphs = read_u16(face, table(face, b"hhea")? + 34)?;
    let glyph = glyph_index(face, u16::try_from(u32::from(character)).ok()?)?;
    let entry = glyph.min(wide_glyphs.checked_sub(1)?);
    let advance = read_u16(face, table(face, b"hmtx")? + 4 * usize::from(entry))?;
    Some(f64::from(advance) / f64::from(units_per_em))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digits of every face with the metrics of Arial are 1139 of 2048 units wide, a space 569.
    #[test]
    fn digits_have_the_width_of_arial() {
        for face in [UPRIGHT, ITALIC] {
            assert_eq!(character_width(face, '7'), 1139.0 / 2048.0);
            assert_eq!(character_width(face, ' '), 569.0 / 2048.0);
        }
    }

    #[test]
    fn every_character_of_our_labels_is_in_the_font() {
        for character in "max |yÿ|(mm/s²)−×\u{2009}⁰¹²³⁴⁵⁶⁷⁸⁹⁻½–".chars() {
            assert!(advance(UPRIGHT, character).is_some(), "{character:?}");
        }
    }

    /// Rendered with the embedded faces only, each glyph is the same to the pixel.
    #[test]
    fn embedded_faces_have_the_glyphs_of_the_bundled_ones() {
        let text = "max |yÿ|(mm/s²)−×\u{2009}⁰¹²³⁴⁵⁶⁷⁸⁹⁻½–é Poincaré";
        let characters = Characters { upright: text.chars().collect(), italic: text.chars().collect() };
        let style = characters.style_element();
        assert!(style.len() < 40_000, "{}", style.len());
        let faces: Vec<Vec<u8>> =
            style.split("base64,").skip(1).map(|rest| decoded(rest.split(')').next().unwrap())).collect();
        assert_eq!(faces.len(), 2);
        for italic in ["normal", "italic"] {
            for character in text.chars() {
                let svg = format!(
                    "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='40' font-family='Arimo'>\
                     <text x='5' y='30' font-size='28' font-style='{italic}'>{character}</text></svg>"
                );
                let [whole, subset] =
                    [vec![UPRIGHT.to_vec(), ITALIC.to_vec()], faces.clone()].map(|faces| drawn(&svg, faces));
                assert!(whole == subset, "{character:?} {italic}");
                assert!(character.is_whitespace() || whole.iter().any(|byte| *byte != 0), "{character:?}");
            }
        }
    }

    fn drawn(svg: &str, faces: Vec<Vec<u8>>) -> Vec<u8> {
        use resvg::{tiny_skia, usvg};
        let mut options = usvg::Options::default();
        for face in faces {
            options.fontdb_mut().load_font_data(face);
        }
        assert_eq!(options.fontdb.len(), 2);
        let tree = usvg::Tree::from_str(svg, &options).unwrap();
        let mut pixels = tiny_skia::Pixmap::new(40, 40).unwrap();
        resvg::render(&tree, tiny_skia::Transform::identity(), &mut pixels.as_mut());
        pixels.data().to_vec()
    }

    fn decoded(text: &str) -> Vec<u8> {
        let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let digits = text.trim_end_matches('=').chars().map(|letter| letters.find(letter).unwrap() as u32);
        let digits: Vec<u32> = digits.collect();
        let group = |four: &[u32]| {
            let bits = four.iter().enumerate().fold(0, |bits, (k, digit)| bits | digit << (18 - 6 * k));
            bits.to_be_bytes()[1..four.len()].to_vec()
        };
        digits.chunks(4).flat_map(group).collect()
    }

    #[test]
    fn unknown_characters_have_a_width_too() {
        assert_eq!(character_width(UPRIGHT, '漢'), UNKNOWN_WIDTH);
        assert_eq!(character_width(UPRIGHT, '🔨'), UNKNOWN_WIDTH);
    }
}
