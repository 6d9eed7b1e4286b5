//! SVG to PNG with our own fonts, on a white ground.

use std::fmt;
use std::sync::Arc;

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::{Options, Tree, fontdb};

use super::font;

/// Most pixels of a picture: one more would need over 1 GB.
const MOST_PIXELS: f64 = 250e6;

/// Why a drawing cannot become a PNG.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum PngError {
    /// The SVG cannot be read, in the reader's words.
    Svg(String),
    /// It has too many pixels, or none.
    Size {
        /// Width in pixels.
        width: f64,
        /// Height in pixels.
        height: f64,
    },
    /// The encoder refuses, in its words.
    Encoding(String),
}

impl fmt::Display for PngError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            PngError::Svg(reason) => {
                write!(f, "the drawing is no SVG that can be rendered: {reason}")
            }
            PngError::Size { width, height } => write!(
                f,
                "the picture would have {width:.0} × {height:.0} pixels; at least 1 and at most {MOST_PIXELS:.0} in \
                 all can be made"
            ),
            PngError::Encoding(reason) => {
                write!(f, "the picture cannot be written as PNG: {reason}")
            }
        }
    }
}

impl std::error::Error for PngError {}

/// Renders a drawing with `pixels` pixels a user unit.
///
/// # Errors
/// Text that is no SVG; a picture without or with too many pixels.
pub(crate) fn png(svg: &str, pixels: f64) -> Result<Vec<u8>, PngError> {
    let tree = Tree::from_str(svg, &options()).map_err(|e| PngError::Svg(e.to_string()))?;
    let size = tree.size();
    let width = (f64::from(size.width()) * pixels).round();
    let height = (f64::from(size.height()) * pixels).round();
    let refused = PngError::Size { width, height };
    if !(width >= 1.0 && height >= 1.0 && width * height <= MOST_PIXELS) {
        return Err(refused);
    }
    let mut pixmap = Pixmap::new(width as u32, height as u32).ok_or(refused)?;
    pixmap.fill(Color::WHITE);
    let scale = Transform::from_scale(pixmap.width() as f32 / size.width(), pixmap.height() as f32 / size.height());
    resvg::render(&tree, scale, &mut pixmap.as_mut());
    pixmap.encode_png().map_err(|e| PngError::Encoding(e.to_string()))
}

/// Reads nothing but the text: no system fonts, and our font for every family.
fn options() -> Options<'static> {
    let mut fonts = fontdb::Database::new();
    fonts.load_font_data(font::REGULAR.to_vec());
    fonts.load_font_data(font::BOLD.to_vec());
    fonts.set_sans_serif_family(font::NAME);
    fonts.set_serif_family(font::NAME);
    fonts.set_monospace_family(font::NAME);
    Options { font_family: font::NAME.to_owned(), fontdb: Arc::new(fonts), ..Options::default() }
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

    #[test]
    fn a_picture_too_large_or_broken_is_an_error() {
        let huge = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100000" height="100000"/>"#;
        assert!(matches!(png(huge, 1.0), Err(PngError::Size { .. })));
        assert!(matches!(png(huge, f64::NAN), Err(PngError::Size { .. })));
        assert!(matches!(png("<svg", 1.0), Err(PngError::Svg(_))));
    }
}
