//! Pictures: drawings as SVG text, and SVG as PNG.
//!
//! A drawing is written once, as SVG. Its PNG is that SVG rendered with the fonts of this program, so that it looks the
//! same on every machine, fonts installed or not.

pub mod font;
pub mod format;
pub mod png;
pub mod svg;

pub use format::Format;
pub use png::PngError;
pub use svg::{Anchor, Svg, Text};
