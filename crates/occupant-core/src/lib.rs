//! Occupant.
