//! The decks as a user meets them, a module each subject, in one binary.

mod any_bytes;
mod damaged;
mod decks;
mod fields;
mod round_trips;
mod scenarios;
mod support;
mod tables;
mod wrong_decks;
