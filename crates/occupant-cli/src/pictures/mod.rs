//! Everything that is drawn: SVG and PNG, plots of time histories, views of the body, the elements of a page.
//!
//! Takes what files hold; writes no file, starts no run and knows no command. Films may go through an encoder of the machine. A drawing is written once, as SVG. Its PNG is
//! that SVG rendered with the fonts of this program, so that it looks the same on every machine, fonts installed or not.

pub(crate) mod body;
pub(crate) mod film;
pub(crate) mod font;
mod format;
pub(crate) mod gltf;
pub(crate) mod html;
pub(crate) mod plot;
pub(crate) mod svg;
pub(crate) mod view;

pub(crate) use format::Format;
pub(crate) use svg::{Anchor, Svg, Text};
