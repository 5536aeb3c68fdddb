//! Opaque pixels as a PNG file (ISO/IEC 15948).
//!
//! Most pixels of a figure equal those above them, and many figures have at most 256 colours, including
//! smoothed edges. Then a pixel is one byte, the index of its colour in a palette; else it is three bytes.
//! Rows are written without filters: deflate finds repeated rows as well, in files a fifth smaller than with
//! differences of rows.

use png::{BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter, PixelDimensions, Unit};

/// Compression level of deflate, from 1 to 9.
///
/// Of the 104 figures of a beam, 3 makes 9.1 MB in two thirds of the time of 6, which makes 8.7 MB; 1 makes
/// 15.3 MB in half of that.
const EFFORT: u8 = 3;
/// Colours of a palette at most.
const PALETTE: usize = 256;

/// An image as a file.
///
/// * `pixels`: red, green, blue, alpha, row by row from the top; alpha is taken to be full.
///
/// # Errors
/// Never, since it writes into memory; the writer that it uses may.
pub(super) fn encode(pixels: &[u8], width: u32, pixels_per_inch: f64) -> Result<Vec<u8>, EncodingError> {
    let height = (pixels.len() / 4) as u32 / width;
    let mut file = Vec::new();
    let mut encoder = Encoder::new(&mut file, width, height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_filter(Filter::NoFilter);
    encoder.set_deflate_compression(DeflateCompression::Level(EFFORT));
    let pixels_per_metre = (pixels_per_inch / 0.0254).round() as u32;
    let dimensions = PixelDimensions { xppu: pixels_per_metre, yppu: pixels_per_metre, unit: Unit::Meter };
    encoder.set_pixel_dims(Some(dimensions));
    let mut image = Vec::with_capacity(pixels.len() / 4);
    if let Some(palette) = Palette::of(pixels) {
        encoder.set_color(ColorType::Indexed);
        encoder.set_palette(palette.colours.concat());
        palette.write_places(pixels, &mut image);
    } else {
        encoder.set_color(ColorType::Rgb);
        image.extend(pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]));
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&image)?;
    writer.finish()?;
    Ok(file)
}

/// The colours of an image, in the order in which they come.
struct Palette {
    /// Each colour once, where its hash has put it; with its place in the order.
    slots: Vec<Option<([u8; 3], u8)>>,
    colours: Vec<[u8; 3]>,
}

/// Slots of a palette, four for each colour.
const SLOTS: usize = 4 * PALETTE;

impl Palette {
    /// The palette of an image; `None` for too many colours.
    fn of(pixels: &[u8]) -> Option<Self> {
        let mut palette = Self { slots: vec![None; SLOTS], colours: Vec::new() };
        let mut last = None;
        for pixel in pixels.chunks_exact(4) {
            if last == Some(pixel) {
                continue;
            }
            last = Some(pixel);
            let colour = [pixel[0], pixel[1], pixel[2]];
            let slot = palette.slot(colour);
            if palette.slots[slot].is_none() {
                if palette.colours.len() == PALETTE {
                    return None;
                }
                palette.slots[slot] = Some((colour, palette.colours.len() as u8));
                palette.colours.push(colour);
            }
        }
        Some(palette)
    }

    /// Slot of a colour, present or not.
    fn slot(&self, colour: [u8; 3]) -> usize {
        let [red, green, blue] = colour.map(u32::from);
        let mut slot = (red << 16 | green << 8 | blue).wrapping_mul(0x9e37_79b1) as usize >> 22;
        while self.slots[slot].is_some_and(|(other, _)| other != colour) {
            slot = (slot + 1) % SLOTS;
        }
        slot
    }

    /// Writes the place of the colour of each pixel.
    fn write_places(&self, pixels: &[u8], image: &mut Vec<u8>) {
        let (mut last, mut place) = (None, 0);
        for pixel in pixels.chunks_exact(4) {
            // Most pixels are like the one before.
            if last != Some(pixel) {
                let slot = self.slot([pixel[0], pixel[1], pixel[2]]);
                place = self.slots[slot].map_or(0, |(_, place)| place);
                last = Some(pixel);
            }
            image.push(place);
        }
    }
}

#[cfg(test)]
mod tests {
    use resvg::tiny_skia::Pixmap;

    use super::*;

    /// An image of so many colours, in which colours repeat, and whose file another decoder reads as the same
    /// pixels.
    fn assert_kept(colours: u32, kind: u8) {
        const WIDTH: u32 = 61;
        let colour = |k: u32| [k % 16 * 16, k / 16 % 16 * 16, k / 256 * 16].map(|part| part as u8);
        let pixel = |k: u32| [&colour(k * k % 977 % colours)[..], &[255]].concat();
        let every = (0..colours).map(|k| [&colour(k)[..], &[255]].concat());
        let pixels: Vec<u8> = every.chain((colours..WIDTH * 40).map(pixel)).flatten().collect();
        let file = encode(&pixels, WIDTH, 300.0).unwrap();
        assert_eq!(file[25], kind, "{colours} colours");
        let decoded = Pixmap::decode_png(&file).unwrap();
        assert_eq!([decoded.width(), decoded.height()], [WIDTH, 40]);
        assert!(decoded.data() == pixels, "{colours} colours");
    }

    #[test]
    fn up_to_256_colours_are_a_palette_and_every_pixel_is_kept() {
        for colours in [1, 2, 255, 256] {
            assert_kept(colours, 3);
        }
        for colours in [257, 900] {
            assert_kept(colours, 2);
        }
    }

    /// 300 pixels per inch are 11811 per metre; the empty last chunk has the sum that every PNG file ends
    /// with.
    #[test]
    fn resolution_and_sums_stand_where_the_standard_has_them() {
        let file = encode(&[255; 16], 2, 300.0).unwrap();
        assert_eq!(file[37..41], *b"pHYs");
        assert_eq!(file[41..50], [0, 0, 0x2e, 0x23, 0, 0, 0x2e, 0x23, 1]);
        assert!(file.ends_with(b"\0\0\0\0IEND\xae\x42\x60\x82"));
    }
}
