//! From SVG to PDF: paths, and text in the bundled faces, of which the used glyphs are embedded.
//!
//! The SVG is parsed by the renderer of the PNG, so both show the same. The file does not depend on date or
//! machine: equal figures give equal files, byte for byte. Only the elements of our figures are supported,
//! opaque paths and text; others are refused.

mod face;
mod stream;

use pdf_writer::{
    Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr,
    types::{LineCapStyle, LineJoinStyle},
};
use resvg::{
    tiny_skia::PathSegment,
    usvg::{
        BlendMode, Color, Fill, FillRule, FontStyle, Group, LineCap, LineJoin, Node, Paint, Path, Stroke,
        Text, TextAnchor, TextChunk, Transform,
    },
};

use crate::{
    error::FigureError,
    font::{self, Characters},
    png,
    svg::points,
};

use face::Face;
use stream::deflated;

/// Numbers of the objects of a file, before the objects of the faces.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const ABOUT: Ref = Ref::new(5);
const FIRST_OF_FACES: i32 = 6;

/// Draws an SVG of a size (mm) as a PDF of one page.
///
/// * `characters`: the characters of its text.
/// * `title`: description of the figure.
///
/// # Errors
/// [`FigureError::Rendering`] if the SVG is invalid or has unsupported elements.
pub(crate) fn pdf(
    svg: &str,
    characters: &Characters,
    title: &str,
    size_mm: [f64; 2],
) -> Result<Vec<u8>, FigureError> {
    let tree = png::tree(svg)?;
    let faces = Faces::of(characters)?;
    let [width, height] = size_mm.map(|side| points(side) as f32);
    let mut page = PdfPage { content: Content::new(), faces: &faces };
    let scale = width / tree.size().width();
    page.content.transform([scale, 0.0, 0.0, -scale, 0.0, height]);
    page.draw_group(tree.root())?;
    let content = deflated(&page.content.finish());
    let mut pdf = Pdf::new();
    pdf.catalog(CATALOG).pages(PAGES);
    pdf.pages(PAGES).kids([PAGE]).count(1);
    let mut leaf = pdf.page(PAGE);
    leaf.parent(PAGES).media_box(Rect::new(0.0, 0.0, width, height)).contents(CONTENT);
    let mut resources = leaf.resources();
    let mut fonts = resources.fonts();
    for face in faces.used() {
        fonts.pair(Name(face.resource.as_bytes()), face.first_object);
    }
    fonts.finish();
    resources.finish();
    leaf.finish();
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    pdf.document_info(ABOUT).title(TextStr(title)).creator(TextStr("hammerbeam"));
    for face in faces.used() {
        face.write(&mut pdf);
    }
    Ok(pdf.finish())
}

fn unknown(what: &str) -> FigureError {
    FigureError::Rendering { reason: format!("a PDF is not made of {what}") }
}

/// The upright and the slanted face, each with the characters that are used.
struct Faces {
    upright: Face,
    italic: Face,
}

impl Faces {
    fn of(characters: &Characters) -> Result<Self, FigureError> {
        let face = |whole, characters, name, first| {
            Face::of(whole, characters, name, first).ok_or_else(|| unknown("a face that cannot be read"))
        };
        Ok(Self {
            upright: face(font::UPRIGHT, &characters.upright, "Regular", FIRST_OF_FACES)?,
            italic: face(font::ITALIC, &characters.italic, "Italic", FIRST_OF_FACES + Face::OBJECTS)?,
        })
    }

    fn used(&self) -> impl Iterator<Item = &Face> {
        [&self.upright, &self.italic].into_iter().filter(|face| !face.is_empty())
    }
}

/// A page that is being drawn.
struct PdfPage<'a> {
    content: Content,
    faces: &'a Faces,
}

impl PdfPage<'_> {
    fn draw_group(&mut self, group: &Group) -> Result<(), FigureError> {
        if group.clip_path().is_some() || group.mask().is_some() || !group.filters().is_empty() {
            return Err(unknown("clips, masks and filters"));
        }
        if group.opacity().get() != 1.0 || group.blend_mode() != BlendMode::Normal {
            return Err(unknown("groups that are seen through or blended"));
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.draw_group(group)?,
                Node::Path(path) => self.draw_path(path)?,
                Node::Text(text) => self.draw_text(text)?,
                Node::Image(_) => return Err(unknown("images")),
            }
        }
        Ok(())
    }

    fn draw_path(&mut self, path: &Path) -> Result<(), FigureError> {
        self.content.save_state().transform(matrix(path.abs_transform()));
        if let Some(fill) = path.fill() {
            let [red, green, blue] = rgb(fill.paint(), fill.opacity().get())?;
            self.content.set_fill_rgb(red, green, blue);
        }
        if let Some(stroke) = path.stroke() {
            self.set_stroke(stroke)?;
        }
        self.outline(path);
        let content = &mut self.content;
        match (path.fill().map(Fill::rule), path.stroke().is_some()) {
            (None, false) => content.end_path(),
            (None, true) => content.stroke(),
            (Some(FillRule::NonZero), false) => content.fill_nonzero(),
            (Some(FillRule::NonZero), true) => content.fill_nonzero_and_stroke(),
            (Some(FillRule::EvenOdd), false) => content.fill_even_odd(),
            (Some(FillRule::EvenOdd), true) => content.fill_even_odd_and_stroke(),
        };
        content.restore_state();
        Ok(())
    }

    fn set_stroke(&mut self, stroke: &Stroke) -> Result<(), FigureError> {
        let [red, green, blue] = rgb(stroke.paint(), stroke.opacity().get())?;
        let cap = match stroke.linecap() {
            LineCap::Butt => LineCapStyle::ButtCap,
            LineCap::Round => LineCapStyle::RoundCap,
            LineCap::Square => LineCapStyle::ProjectingSquareCap,
        };
        let join = match stroke.linejoin() {
            LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
            LineJoin::Round => LineJoinStyle::RoundJoin,
            LineJoin::Bevel => LineJoinStyle::BevelJoin,
        };
        let content = &mut self.content;
        content.set_stroke_rgb(red, green, blue).set_line_width(stroke.width().get());
        content.set_line_cap(cap).set_line_join(join).set_miter_limit(stroke.miterlimit().get());
        if let Some(dashes) = stroke.dasharray() {
            content.set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        }
        Ok(())
    }

    fn outline(&mut self, path: &Path) {
        let content = &mut self.content;
        let mut last = (0.0, 0.0);
        for segment in path.data().segments() {
            match segment {
                PathSegment::MoveTo(to) => content.move_to(to.x, to.y),
                PathSegment::LineTo(to) => content.line_to(to.x, to.y),
                // A quadratic curve as a cubic one.
                PathSegment::QuadTo(by, to) => {
                    let third = |end: f32, by: f32| end + (by - end) * 2.0 / 3.0;
                    let (from_x, from_y) = last;
                    let first = (third(from_x, by.x), third(from_y, by.y));
                    content.cubic_to(first.0, first.1, third(to.x, by.x), third(to.y, by.y), to.x, to.y)
                }
                PathSegment::CubicTo(one, two, to) => {
                    content.cubic_to(one.x, one.y, two.x, two.y, to.x, to.y)
                }
                PathSegment::Close => content.close_path(),
            };
            last = match segment {
                PathSegment::MoveTo(to) | PathSegment::LineTo(to) => (to.x, to.y),
                PathSegment::QuadTo(_, to) | PathSegment::CubicTo(_, _, to) => (to.x, to.y),
                PathSegment::Close => last,
            };
        }
    }

    fn draw_text(&mut self, text: &Text) -> Result<(), FigureError> {
        text.chunks().iter().try_for_each(|chunk| self.draw_line(chunk, text.abs_transform()))
    }

    /// A line of text, part by part, each starting at the end of the previous one.
    fn draw_line(&mut self, line: &TextChunk, transform: Transform) -> Result<(), FigureError> {
        let (upright, italic) = (&self.faces.upright, &self.faces.italic);
        let parts = line.spans().iter().map(|span| {
            let face = if span.font().style() == FontStyle::Normal { upright } else { italic };
            (span, face, &line.text()[span.start()..span.end()])
        });
        let length: f32 =
            parts.clone().map(|(span, face, text)| span.font_size().get() * face.width(text)).sum();
        let share = match line.anchor() {
            TextAnchor::Start => 0.0,
            TextAnchor::Middle => 0.5,
            TextAnchor::End => 1.0,
        };
        let start = (line.x().unwrap_or(0.0) - share * length, line.y().unwrap_or(0.0));
        // The y axis of the page points downwards, so letters are mirrored back.
        let placed = transform.pre_translate(start.0, start.1).pre_scale(1.0, -1.0);
        self.content.begin_text().set_text_matrix(matrix(placed));
        for (span, face, text) in parts {
            if let Some(fill) = span.fill() {
                let [red, green, blue] = rgb(fill.paint(), fill.opacity().get())?;
                self.content.set_fill_rgb(red, green, blue);
            }
            self.content.set_font(Name(face.resource.as_bytes()), span.font_size().get());
            self.content.show(Str(&face.encode(text)));
        }
        self.content.end_text();
        Ok(())
    }
}

fn matrix(transform: Transform) -> [f32; 6] {
    [transform.sx, transform.ky, transform.kx, transform.sy, transform.tx, transform.ty]
}

fn rgb(paint: &Paint, opacity: f32) -> Result<[f32; 3], FigureError> {
    match paint {
        Paint::Color(Color { red, green, blue }) if opacity == 1.0 => {
            Ok([*red, *green, *blue].map(|part| f32::from(part) / 255.0))
        }
        _ => Err(unknown("gradients, patterns and what is seen through")),
    }
}

#[cfg(test)]
mod tests;
