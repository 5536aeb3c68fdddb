//! A face with the glyphs of some characters only, for embedding: an SVG looks the same wherever it is
//! opened.
//!
//! The subset of a TrueType face keeps the outlines of these glyphs and of their components, their widths and
//! the map from characters; hints, kerning and names are left out. Tables follow the OpenType specification,
//! version 1.9.

use std::collections::{BTreeMap, BTreeSet};

use super::tables::{glyph_index, read_u16, read_u32, table};

/// Flags of a component of a glyph.
const ARE_WORDS: u16 = 0x0001;
const HAS_SCALE: u16 = 0x0008;
const MORE_COMPONENTS: u16 = 0x0020;
const HAS_TWO_SCALES: u16 = 0x0040;
const HAS_TWO_BY_TWO: u16 = 0x0080;
const HAS_INSTRUCTIONS: u16 = 0x0100;

/// The face with these characters, as far as it has them; `None` where its tables cannot be read.
pub(super) fn subset(face: &[u8], characters: &BTreeSet<char>, names: [&str; 3]) -> Option<Vec<u8>> {
    let known = characters.iter().filter_map(|&character| {
        let code = u16::try_from(u32::from(character)).ok()?;
        Some((code, glyph_index(face, code)?))
    });
    let mut map: BTreeMap<u16, u16> = known.collect();
    let mut glyphs = vec![0];
    for glyph in map.values_mut() {
        *glyph = place(&mut glyphs, *glyph);
    }
    let (mut outlines, mut offsets, mut widths) = (Vec::new(), vec![0], Vec::new());
    let mut next = 0;
    while let Some(&glyph) = glyphs.get(next) {
        outlines.extend(outline(face, glyph, &mut glyphs)?);
        outlines.resize(outlines.len().next_multiple_of(4), 0);
        offsets.push(u16::try_from(outlines.len() / 2).ok()?);
        widths.extend(width(face, glyph)?);
        next += 1;
    }
    let count = u16::try_from(glyphs.len()).ok()?.to_be_bytes();
    let whole = |tag: &[u8; 4], length: usize| Some(face.get(table(face, tag)?..)?.get(..length)?.to_vec());
    let mut head = whole(b"head", 54)?;
    head[8..12].fill(0); // the checksum of the file, set at the end
    head[50..52].fill(0); // offsets of glyphs are halves of them
    let mut hhea = whole(b"hhea", 36)?;
    hhea[34..36].copy_from_slice(&count);
    let mut maxp = whole(b"maxp", 32)?;
    maxp[4..6].copy_from_slice(&count);
    let mut post = whole(b"post", 32)?;
    post[..4].copy_from_slice(&0x0003_0000_u32.to_be_bytes()); // without names of glyphs
    Some(file(&[
        (*b"OS/2", whole(b"OS/2", 78)?.into_iter().enumerate().map(of_version_0).collect()),
        (*b"cmap", character_map(&map)),
        (*b"glyf", outlines),
        (*b"head", head),
        (*b"hhea", hhea),
        (*b"hmtx", widths),
        (*b"loca", offsets.iter().flat_map(|offset| offset.to_be_bytes()).collect()),
        (*b"maxp", maxp),
        (*b"name", name_table(names)),
        (*b"post", post),
    ]))
}

/// A byte of the table `OS/2` cut to its first version.
fn of_version_0((place, byte): (usize, u8)) -> u8 {
    if place < 2 { 0 } else { byte }
}

/// Number of a glyph of the face among those that are kept.
fn place(glyphs: &mut Vec<u16>, glyph: u16) -> u16 {
    let found = glyphs.iter().position(|other| *other == glyph).unwrap_or_else(|| {
        glyphs.push(glyph);
        glyphs.len() - 1
    });
    found as u16
}

/// The outline of a glyph without its instructions; its component glyphs are added to those that are kept.
fn outline(face: &[u8], glyph: u16, glyphs: &mut Vec<u16>) -> Option<Vec<u8>> {
    let (loca, glyph) = (table(face, b"loca")?, usize::from(glyph));
    let is_long = read_u16(face, table(face, b"head")? + 50)? == 1;
    let offset = |k: usize| match is_long {
        true => read_u32(face, loca + 4 * k).map(|offset| offset as usize),
        false => read_u16(face, loca + 2 * k).map(|half| 2 * usize::from(half)),
    };
    let glyf = table(face, b"glyf")?;
    let mut data = face.get(glyf + offset(glyph)?..glyf + offset(glyph + 1)?)?.to_vec();
    if data.is_empty() {
        return Some(data); // a space
    }
    let contours = read_u16(&data, 0)?.cast_signed();
    if let Ok(contours) = usize::try_from(contours) {
        let at = 10 + 2 * contours;
        let end = at + 2 + usize::from(read_u16(&data, at)?);
        data[at..at + 2].fill(0);
        data.drain(at + 2..end);
        return Some(data);
    }
    let mut at = 10;
    loop {
        let flags = read_u16(&data, at)?;
        let component = place(glyphs, read_u16(&data, at + 2)?);
        data[at..at + 2].copy_from_slice(&(flags & !HAS_INSTRUCTIONS).to_be_bytes());
        data[at + 2..at + 4].copy_from_slice(&component.to_be_bytes());
        at += if flags & ARE_WORDS != 0 { 8 } else { 6 };
        let scales = [(HAS_SCALE, 2), (HAS_TWO_SCALES, 4), (HAS_TWO_BY_TWO, 8)];
        at += scales.iter().filter(|(flag, _)| flags & flag != 0).map(|(_, length)| length).sum::<usize>();
        if flags & MORE_COMPONENTS == 0 {
            data.truncate(at);
            return Some(data);
        }
    }
}

/// Advance and left side bearing of a glyph.
fn width(face: &[u8], glyph: u16) -> Option<[u8; 4]> {
    let (hmtx, glyph) = (table(face, b"hmtx")?, usize::from(glyph));
    let wide = usize::from(read_u16(face, table(face, b"hhea")? + 34)?);
    let last = glyph.min(wide.checked_sub(1)?);
    let advance = read_u16(face, hmtx + 4 * last)?;
    let bearing = match glyph.checked_sub(wide) {
        Some(behind) => read_u16(face, hmtx + 4 * wide + 2 * behind)?,
        None => read_u16(face, hmtx + 4 * glyph + 2)?,
    };
    let [[a, b], [c, d]] = [advance, bearing].map(u16::to_be_bytes);
    Some([a, b, c, d])
}

/// The table `cmap` with one subtable of format 4: stretches of characters whose glyphs follow each other.
fn character_map(map: &BTreeMap<u16, u16>) -> Vec<u8> {
    let mut stretches: Vec<[u16; 3]> = Vec::new(); // first, last, first glyph
    for (&code, &glyph) in map {
        match stretches.last_mut() {
            Some([first, last, of_first])
                if *last + 1 == code && glyph.wrapping_sub(*of_first) == code - *first =>
            {
                *last = code;
            }
            _ => stretches.push([code, code, glyph]),
        }
    }
    stretches.push([u16::MAX, u16::MAX, 0]);
    let count = stretches.len() as u16;
    let power = 1 << count.ilog2();
    let mut words = vec![2 * count, 2 * power, power.ilog2() as u16, 2 * (count - power)];
    words.extend(stretches.iter().map(|[_, last, _]| *last));
    words.push(0);
    words.extend(stretches.iter().map(|[first, ..]| *first));
    words.extend(stretches.iter().map(|[first, _, glyph]| glyph.wrapping_sub(*first)));
    words.extend(stretches.iter().map(|_| 0));
    let length = 6 + 2 * words.len() as u16;
    let head = [0, 1, 3, 1, 0, 12, 4, length, 0];
    head.into_iter().chain(words).flat_map(u16::to_be_bytes).collect()
}

/// The table `name` with the names of the family, of the face, and of both as one word.
fn name_table(names: [&str; 3]) -> Vec<u8> {
    let texts = names.map(|name| name.encode_utf16().flat_map(u16::to_be_bytes).collect::<Vec<u8>>());
    let mut words = vec![0, 3, 6 + 3 * 12];
    let mut begin = 0;
    for (number, text) in [1, 2, 6].into_iter().zip(&texts) {
        words.extend([3, 1, 0x0409, number, text.len() as u16, begin]);
        begin += text.len() as u16;
    }
    words.into_iter().flat_map(u16::to_be_bytes).chain(texts.concat()).collect()
}

/// A font file of tables in the order of their tags.
fn file(tables: &[([u8; 4], Vec<u8>)]) -> Vec<u8> {
    let count = tables.len() as u16;
    let power = 1 << count.ilog2();
    let head = [0x0001, 0x0000, count, 16 * power, power.ilog2() as u16, 16 * (count - power)];
    let mut file: Vec<u8> = head.into_iter().flat_map(u16::to_be_bytes).collect();
    let mut at = file.len() + 16 * tables.len();
    let mut adjusted = None;
    for (tag, data) in tables {
        if tag == b"head" {
            adjusted = Some(at + 8);
        }
        file.extend(tag);
        file.extend([checksum(data), at as u32, data.len() as u32].into_iter().flat_map(u32::to_be_bytes));
        at += data.len().next_multiple_of(4);
    }
    for (_, data) in tables {
        file.extend(data);
        file.resize(file.len().next_multiple_of(4), 0);
    }
    if let Some(at) = adjusted {
        let rest = 0xb1b0_afba_u32.wrapping_sub(checksum(&file));
        file[at..at + 4].copy_from_slice(&rest.to_be_bytes());
    }
    file
}

/// Sum of the words of a table.
fn checksum(data: &[u8]) -> u32 {
    let word =
        |bytes: &[u8]| (0..4).fold(0, |word, k| word << 8 | u32::from(bytes.get(k).copied().unwrap_or(0)));
    data.chunks(4).map(word).fold(0, u32::wrapping_add)
}
