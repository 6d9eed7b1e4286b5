//! Scenes: what a viewer draws, as `foxglove.SceneUpdate` messages.
//!
//! What does not change shape is written once, locked to its frame, and moved by the transforms. What changes is replaced
//! whole in every message, so that a viewer that jumps in time and reads only the last message shows the right thing.

pub mod body;
pub mod compartment;
pub mod forces;
pub mod labels;
pub mod lines;
pub(super) mod primitive;

use super::wire::Wire;

/// Red, green, blue and opacity, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Color(pub f64, pub f64, pub f64, pub f64);

impl Color {
    /// Red, green, blue, opacity.
    pub const fn parts(self) -> [f64; 4] {
        [self.0, self.1, self.2, self.3]
    }

    /// The same with another opacity.
    pub(super) const fn with_opacity(self, opacity: f64) -> Self {
        Color(self.0, self.1, self.2, opacity)
    }
}

/// A message that replaces everything shown on the topic.
pub fn replace(wire: &mut Wire, ns: u64, content: impl FnOnce(&mut Wire)) {
    const ALL: u64 = 1;
    wire.message(1, |w| {
        w.time(1, ns);
        w.count(2, ALL);
        w.text(3, "");
    });
    content(wire);
}

/// An entity that is drawn until it is replaced and that moves with `frame`.
pub(super) fn entity(wire: &mut Wire, ns: u64, frame: &str, id: &str, content: impl FnOnce(&mut Wire)) {
    const FOR_EVER: u64 = 0;
    wire.message(2, |w| {
        w.time(1, ns);
        w.text(2, frame);
        w.text(3, id);
        w.time(4, FOR_EVER);
        w.flag(5, true);
        content(w);
    });
}
