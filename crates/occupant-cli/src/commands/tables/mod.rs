//! The tables that commands print, as text. Nothing is printed here.

pub(crate) mod check;
mod elements;
pub(crate) mod measures;
pub(crate) mod summary;
mod throws;
