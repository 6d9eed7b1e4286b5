//! The kind of a picture file, by its ending.

use std::path::Path;

use super::png::png;
use crate::base::{Failure, by_ending};

/// Kinds of picture files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Format {
    /// Scalable vector graphics
    Svg,
    /// Pixels
    Png,
}

impl Format {
    /// The kind that the file's ending asks for; none for another ending.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        by_ending(path, &[("svg", Format::Svg), ("png", Format::Png)])
    }

    /// The kind of the picture asked for.
    ///
    /// # Errors
    /// Another ending.
    pub(crate) fn of_output(path: &Path) -> Result<Self, Failure> {
        Format::of(path).ok_or_else(|| Failure::ending(path, ".svg or .png"))
    }

    /// The ending of such a file.
    pub(crate) const fn ending(self) -> &'static str {
        match self {
            Format::Svg => "svg",
            Format::Png => "png",
        }
    }

    /// The bytes of the file for a drawing in SVG; `pixels` is the number of pixels a user unit (for PNG alone).
    ///
    /// # Errors
    /// A drawing that is too large to render.
    pub(crate) fn encode(self, svg: &str, pixels: f64) -> Result<Vec<u8>, String> {
        match self {
            Format::Svg => Ok(svg.as_bytes().to_vec()),
            Format::Png => png(svg, pixels),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_decides_in_any_case() {
        let of = |name: &str| Format::of(Path::new(name));
        assert_eq!(of("a.b/x.SVG"), Some(Format::Svg));
        assert_eq!(of("x.png"), Some(Format::Png));
        assert_eq!(of("x.pdf"), None);
        assert_eq!(of("png"), None);
    }
}
