//! Picture files: their kind, by their ending, and their bytes. A PNG is rendered from the SVG with our own fonts, on a white
//! ground.
//!
//! A text becomes the outlines of its letters before the drawing is rendered: no text shaping is needed, and no font of
//! the machine is used.

use std::fmt::Display;
use std::ops::Range;
use std::path::Path;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::roxmltree::{Document, Node};
use resvg::usvg::{Options, Tree};

use super::font::{self, Weight};
use super::svg::escape;
use occupant_files::base::{Failure, by_ending};

/// Kinds of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Format {
    /// Scalable vector graphics
    Svg,
    /// Pixels
    Png,
}

impl Format {
    /// The kind for the file's extension; none for another.
    pub fn of(path: &Path) -> Option<Self> {
        by_ending(path, &[("svg", Format::Svg), ("png", Format::Png)])
    }

    /// The kind of a requested picture.
    ///
    /// # Errors
    /// Another ending.
    pub fn of_output(path: &Path) -> Result<Self, Failure> {
        Format::of(path).ok_or_else(|| Failure::ending(path, ".svg or .png"))
    }

    /// Its extension.
    pub const fn ending(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
        }
    }

    /// Bytes of the file for an SVG drawing; `pixels` is the number of pixels per user unit (PNG only).
    ///
    /// # Errors
    /// A drawing that is too large to render.
    pub fn encode(self, svg: &str, pixels: f64) -> Result<Vec<u8>, String> {
        match self {
            Format::Svg => Ok(svg.as_bytes().to_vec()),
            Format::Png => png(svg, pixels),
        }
    }
}

/// Largest number of pixels: it takes 1 GB.
const MOST_PIXELS: f64 = 250e6;

fn png(svg: &str, pixels: f64) -> Result<Vec<u8>, String> {
    render(svg, pixels)?.encode_png().map_err(|e| format!("the picture cannot be written as PNG: {e}"))
}

/// Renders a drawing with `pixels` pixels per user unit.
///
/// # Errors
/// Text that is no SVG; a picture without or with too many pixels.
pub(super) fn render(svg: &str, pixels: f64) -> Result<Pixmap, String> {
    let tree = tree(svg)?;
    let size = tree.size();
    let width = (f64::from(size.width()) * pixels).round();
    let height = (f64::from(size.height()) * pixels).round();
    let fits = width >= 1.0 && height >= 1.0 && width * height <= MOST_PIXELS;
    let pixmap = fits.then(|| Pixmap::new(width as u32, height as u32)).flatten();
    let mut pixmap = pixmap.ok_or_else(|| {
        let most = format!("at least 1 and at most {MOST_PIXELS:.0} in all can be made");
        format!("the picture would have {width:.0} × {height:.0} pixels; {most}")
    })?;
    pixmap.fill(Color::WHITE);
    lay(&tree, &mut pixmap);
    Ok(pixmap)
}

/// Draws over a picture, stretched to its size.
///
/// # Errors
/// Text that is no SVG.
pub(super) fn overlay(svg: &str, pixmap: &mut Pixmap) -> Result<(), String> {
    lay(&tree(svg)?, pixmap);
    Ok(())
}

fn tree(svg: &str) -> Result<Tree, String> {
    let unread = |e: &dyn Display| format!("the drawing cannot be rendered: {e}");
    let document = Document::parse(svg).map_err(|e| unread(&e))?;
    Tree::from_str(&with_outlines(svg, &document), &Options::default()).map_err(|e| unread(&e))
}

fn lay(tree: &Tree, pixmap: &mut Pixmap) {
    let size = tree.size();
    let scale = Transform::from_scale(pixmap.width() as f32 / size.width(), pixmap.height() as f32 / size.height());
    resvg::render(tree, scale, &mut pixmap.as_mut());
}

/// The drawing with each text replaced by its outlines.
fn with_outlines(svg: &str, document: &Document<'_>) -> String {
    let mut out = String::with_capacity(2 * svg.len());
    let mut rest = 0;
    for text in document.descendants().filter(|n| n.has_tag_name("text")) {
        let Range { start, end } = text.range();
        out.push_str(&svg[rest..start]);
        out.push_str(&as_path(text));
        rest = end;
    }
    out.push_str(&svg[rest..]);
    out
}

/// Outlines of a text as a path. Paint attributes are kept; size, weight and anchor may be inherited from a group.
fn as_path(text: Node<'_, '_>) -> String {
    let inherited = |name| text.ancestors().find_map(|n| n.attribute(name));
    let size = inherited("font-size").and_then(|s| s.parse().ok()).unwrap_or(12.0);
    let weight = if inherited("font-weight") == Some("bold") { Weight::Bold } else { Weight::Regular };
    let words: Vec<&str> = text.text().unwrap_or_default().split(' ').filter(|w| !w.is_empty()).collect();
    let (path, width) = font::outline(&words.join(" "), size, weight);
    let before = match inherited("text-anchor") {
        Some("middle") => width / 2.0,
        Some("end") => width,
        _ => 0.0,
    };
    let place = |name| text.attribute(name).and_then(|x| x.parse::<f64>().ok()).unwrap_or(0.0);
    let (x, y) = (place("x") - before, place("y"));
    let turned = text.attribute("transform").unwrap_or_default();
    let mut path = format!("<path transform=\"{} translate({x} {y})\" d=\"{}\"", escape(turned), path);
    for a in text.attributes().filter(|a| !["x", "y", "transform"].contains(&a.name())) {
        path += &format!(" {}=\"{}\"", a.name(), escape(a.value()));
    }
    path + "/>"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(svg: &str) -> Pixmap {
        Pixmap::decode_png(&png(svg, 2.0).unwrap()).unwrap()
    }

    fn dark(picture: &Pixmap) -> usize {
        picture.pixels().iter().filter(|p| p.red() < 128).count()
    }

    #[test]
    fn a_square_has_its_place_and_its_ground_is_white() {
        let picture = pixels(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="10"><rect x="5" y="2" width="4" height="3"/></svg>"#,
        );
        assert_eq!((picture.width(), picture.height()), (40, 20));
        assert_eq!(dark(&picture), 48);
        let at = |x, y| picture.pixel(x, y).unwrap();
        assert_eq!((at(10, 4).red(), at(17, 9).red()), (0, 0));
        assert_eq!((at(9, 4).red(), at(9, 4).alpha()), (255, 255));
    }

    #[test]
    fn text_shows_whatever_its_family() {
        for family in [font::FAMILY, "Nonexistent", "serif", "monospace"] {
            let text = format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="20"><text x="2" y="15" font-size="12" font-family="{family}">t = 0.1 s²</text></svg>"#
            );
            let ink = dark(&pixels(&text));
            // 391 pixels
            assert!((300..500).contains(&ink), "{family}: {ink}");
        }
    }

    /// Left, right, top and bottom of the dark area.
    fn extent(body: &str) -> [u32; 4] {
        let svg = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="200">{body}</svg>"#);
        let picture = pixels(&svg);
        let places = (0..picture.height()).flat_map(|y| (0..picture.width()).map(move |x| (x, y)));
        let all = places.filter(|(x, y)| picture.pixel(*x, *y).unwrap().red() < 128);
        all.fold([u32::MAX, 0, u32::MAX, 0], |[l, r, t, b], (x, y)| [l.min(x), r.max(x), t.min(y), b.max(y)])
    }

    /// `H` of DejaVu Sans: 1540 of 2048 units wide, its stems from 201 to 1339, 1493 high; two pixels a unit here.
    #[test]
    fn letters_stand_where_the_text_says() {
        let near = |body: &str, place: [f64; 4]| {
            let found = extent(body).map(f64::from);
            let off = found.iter().zip(place).map(|(a, b)| (a - 2.0 * b).abs());
            assert!(off.fold(0.0, f64::max) <= 1.5, "{body}: {found:?}, 2 × {place:?}");
        };
        let em = |units: f64| units / 2048.0 * 40.0;
        let (left, right, top) = (em(201.0), em(1339.0), em(1493.0));
        let text = |more: &str| format!(r#"<text x="100" y="100" font-size="40" {more}> H </text>"#);
        near(&text(""), [100.0 + left, 100.0 + right, 100.0 - top, 100.0]);
        let half = em(1540.0) / 2.0;
        near(&text(r#"text-anchor="middle""#), [100.0 + left - half, 100.0 + right - half, 100.0 - top, 100.0]);
        near(&text(r#"text-anchor="end""#), [100.0 - right, 100.0 - left, 100.0 - top, 100.0]);
        near(&text(r#"transform="rotate(-90 100 100)""#), [100.0 - top, 100.0, 100.0 - right, 100.0 - left]);
        // of the group: bold is wider
        let bold = extent(&format!(r#"<g font-weight="bold">{}</g>"#, text("")));
        assert!(bold[1] > extent(&text(""))[1]);
    }

    #[test]
    fn a_picture_too_large_or_broken_is_an_error() {
        let huge = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100000" height="100000"/>"#;
        let refused = |svg, pixels| png(svg, pixels).unwrap_err();
        assert!(refused(huge, 1.0).contains("100000 × 100000 pixels"));
        assert!(refused(huge, f64::NAN).contains("at least 1"));
        assert!(refused("<svg", 1.0).contains("cannot be rendered"));
    }

    #[test]
    fn the_ending_decides_in_any_case() {
        let of = |name: &str| Format::of(Path::new(name));
        assert_eq!(of("a.b/x.SVG"), Some(Format::Svg));
        assert_eq!(of("x.png"), Some(Format::Png));
        assert_eq!(of("x.pdf"), None);
        assert_eq!(of("png"), None);
    }
}
