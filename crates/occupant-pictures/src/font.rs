//! The fonts of all pictures: DejaVu Sans, regular and bold, cut down to European scripts and the signs of mathematics.

use std::fmt::Write as _;

use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Font family: ours first, then fallbacks of browsers.
pub const FAMILY: &str = "DejaVu Sans, Verdana, Arial, sans-serif";
const REGULAR: &[u8] = include_bytes!("../assets/fonts/DejaVuSans.ttf");
const BOLD: &[u8] = include_bytes!("../assets/fonts/DejaVuSans-Bold.ttf");

/// Weight of a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weight {
    /// Regular.
    #[default]
    Regular,
    /// Bold.
    Bold,
}

impl Weight {
    fn face(self) -> Option<Face<'static>> {
        let file = match self {
            Weight::Regular => REGULAR,
            Weight::Bold => BOLD,
        };
        Face::parse(file, 0).ok()
    }
}

/// Width of a text of this font size, both in user units, without kerning; unknown letters count as wide ones.
pub fn width(text: &str, size: f64, weight: Weight) -> f64 {
    let Some(face) = weight.face() else {
        return size * text.chars().count() as f64;
    };
    let advance = |letter| Some(scaled(face.glyph_hor_advance(face.glyph_index(letter)?)?, size, face.units_per_em()));
    text.chars().map(|c| advance(c).unwrap_or(size)).sum()
}

/// A length of font units at a font size, in fixed point (16.16), rounded as FreeType does.
fn scaled(units: u16, size: f64, units_per_em: u16) -> f64 {
    let em = u64::from(units_per_em);
    let size_26_6 = (size as f32 * 64.0) as u64;
    let scale_16_16 = ((size_26_6 << 16) + em / 2) / em;
    f64::from(((u64::from(units) * scale_16_16 + 32) / 64) as f32 / 65536.0)
}

/// Outlines of a text, left to right, without kerning, as SVG path data starting at 0 on the base line, and the
/// position after the last letter. A missing letter shows as an empty box.
pub fn outline(text: &str, size: f64, weight: Weight) -> (String, f64) {
    let mut pen = Pen { path: String::new(), x: 0.0, scale: 0.0 };
    if let Some(face) = weight.face() {
        pen.scale = size / f64::from(face.units_per_em());
        for letter in text.chars() {
            let glyph = face.glyph_index(letter).unwrap_or(GlyphId(0));
            face.outline_glyph(glyph, &mut pen);
            pen.x += pen.scale * f64::from(face.glyph_hor_advance(glyph).unwrap_or(0));
        }
    }
    (pen.path, pen.x)
}

/// Writes outlines in font units (y up) as path data.
struct Pen {
    path: String,
    /// Start of the present letter.
    x: f64,
    /// User units per font unit.
    scale: f64,
}

impl Pen {
    fn put(&mut self, command: char, points: &[(f32, f32)]) {
        self.path.push(command);
        for (x, y) in points {
            let (x, y) = (self.x + self.scale * f64::from(*x), -self.scale * f64::from(*y));
            let _ = write!(self.path, "{x:.3} {y:.3} ");
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.put('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.put('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.put('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.put('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.path.push('Z');
    }
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
            let face = Face::parse(file, 0).unwrap();
            for sign in "°²³·×−–…µΔΣΩαβγ′√≤≥≈±→←↑↓ÄÖÜäöüßéñçłščЖя✓".chars()
            {
                assert!(face.glyph_index(sign).is_some(), "{sign}");
            }
        }
    }
}
