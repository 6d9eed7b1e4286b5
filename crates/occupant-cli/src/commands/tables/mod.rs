//! The tables that commands print, as text. Nothing is printed here.

pub(crate) mod check;
pub(crate) mod measures;
pub(crate) mod summary;
