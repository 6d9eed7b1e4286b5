//! Scenarios as the library of files opens them, and what is said of them.

use placed_text::Diagnostics;

pub(crate) use occupant_files::scenario::*;

use crate::base::say;

/// Says what a deck was taken to mean, and warnings.
pub(crate) fn warn_of(opened: &Opened) {
    opened.deck.iter().for_each(|deck| say(&deck.words));
    warn(&opened.warnings);
}

/// Says warnings, with a blank line behind.
pub(crate) fn warn(warnings: &Diagnostics) {
    if !warnings.is_empty() {
        say(&format!("{warnings}\n"));
    }
}
