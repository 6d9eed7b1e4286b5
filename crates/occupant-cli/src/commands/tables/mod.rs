//! The tables that commands print.

pub(crate) mod check;
pub(crate) mod measures;
pub(crate) mod summary;
