//! Tables of a TrueType font.

/// Start of a table of the font.
pub(crate) fn table(face: &[u8], tag: &[u8; 4]) -> Option<usize> {
    let tables = usize::from(read_u16(face, 4)?);
    let record = face.get(12..12 + 16 * tables)?.chunks_exact(16).find(|record| &record[..4] == tag)?;
    Some(u32::from_be_bytes(record[8..12].try_into().ok()?) as usize)
}

/// Glyph of a character of the basic plane, by the format-4 subtable of `cmap`; 0 (missing) gives `None`.
pub(crate) fn glyph_index(face: &[u8], code: u16) -> Option<u16> {
    let cmap = table(face, b"cmap")?;
    let subtables = usize::from(read_u16(face, cmap + 2)?);
    let map = (0..subtables)
        .filter_map(|i| Some(cmap + read_u32(face, cmap + 8 + 8 * i)? as usize))
        .find(|&start| read_u16(face, start) == Some(4))?;
    let doubled = usize::from(read_u16(face, map + 6)?);
    let (ends, starts) = (map + 14, map + 16 + doubled);
    let segment =
        (0..doubled).step_by(2).find(|i| read_u16(face, ends + i).is_some_and(|end| end >= code))?;
    let offset_into_segment = code.checked_sub(read_u16(face, starts + segment)?)?;
    let delta = read_u16(face, starts + doubled + segment)?;
    let range_at = starts + 2 * doubled + segment;
    let glyph = match read_u16(face, range_at)? {
        0 => code.wrapping_add(delta),
        range => {
            match read_u16(face, range_at + usize::from(range) + 2 * usize::from(offset_into_segment))? {
                0 => 0,
                glyph => glyph.wrapping_add(delta),
            }
        }
    };
    (glyph != 0).then_some(glyph)
}

/// A number of two bytes.
pub(crate) fn read_u16(face: &[u8], at: usize) -> Option<u16> {
    Some(u16::from_be_bytes(face.get(at..at + 2)?.try_into().ok()?))
}

/// A number of four bytes.
pub(super) fn read_u32(face: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_be_bytes(face.get(at..at + 4)?.try_into().ok()?))
}
