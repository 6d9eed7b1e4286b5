//! The fonts of all pictures: DejaVu Sans, regular and bold, cut down to European scripts and the signs of mathematics.

use skrifa::instance::{LocationRef, Size};
use skrifa::{FontRef, MetadataProvider};

/// What a picture's `font-family` says: ours first, then what a browser has.
pub(crate) const FAMILY: &str = "DejaVu Sans, Verdana, Arial, sans-serif";
/// The family's name in the font files.
pub(crate) const NAME: &str = "DejaVu Sans";
pub(crate) const REGULAR: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans.ttf");
pub(crate) const BOLD: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans-Bold.ttf");

/// Weight of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Weight {
    #[default]
    Regular,
    Bold,
}

/// Width of a text of this font size, both in user units, without kerning; unknown letters count as wide ones.
pub(crate) fn width(text: &str, size: f64, weight: Weight) -> f64 {
    let file = match weight {
        Weight::Regular => REGULAR,
        Weight::Bold => BOLD,
    };
    let widest = size * text.chars().count() as f64;
    let Ok(font) = FontRef::new(file) else {
        return widest;
    };
    let letters = font.charmap();
    let metrics = font.glyph_metrics(Size::new(size as f32), LocationRef::default());
    let advance = |letter| {
        let glyph = letters.map(letter)?;
        metrics.advance_width(glyph).map(f64::from)
    };
    text.chars().map(|c| advance(c).unwrap_or(size)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// DejaVu Sans: 2048 units an em; `0` is 1303 wide, `i` 569; bold `0` is 1425.
    #[test]
    fn widths_are_those_of_the_font_file() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-4 * b, "{a} {b}");
        close(width("0", 2048.0, Weight::Regular), 1303.0);
        close(width("i0", 204.8, Weight::Regular), 187.2);
        close(width("0", 2048.0, Weight::Bold), 1425.0);
        assert_eq!(width("漢字", 10.0, Weight::Regular), 20.0);
    }

    #[test]
    fn the_signs_that_units_need_are_there() {
        for file in [REGULAR, BOLD] {
            let font = FontRef::new(file).unwrap();
            for sign in "°²³·×−–…µΔΣΩαβγ′√≤≥≈±→←↑↓ÄÖÜäöüßéñçłščЖя✓".chars()
            {
                assert!(font.charmap().map(sign).is_some(), "{sign}");
            }
        }
    }
}
