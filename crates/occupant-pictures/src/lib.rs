//! Everything that is drawn: SVG and PNG, plots of time histories, views of the body, the elements of a page.
//!
//! Takes what files hold; writes no file, starts no run and knows no command. Films may go through an encoder of the machine. A drawing is written once, as SVG. Its PNG is
//! that SVG rendered with the fonts of this program, so that it looks the same on every machine, fonts installed or not.
//!
//! ```
//! let mut svg = occupant_pictures::Svg::new(200.0, 100.0, "A ramp");
//! svg.polyline(&[[0.0, 100.0], [200.0, 0.0]], "fill=\"none\" stroke=\"black\"");
//! assert!(svg.finish().contains("<polyline"));
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod body;
pub mod film;
pub mod font;
pub mod format;
pub mod gltf;
pub mod html;
mod mesh;
pub mod plot;
pub mod scene;
pub mod svg;
pub mod view;

pub use format::Format;
pub use svg::{Anchor, Svg, Text};
