//! Legacy decks.
