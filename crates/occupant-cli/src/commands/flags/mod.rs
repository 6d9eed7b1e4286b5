//! Flags that several commands share, and what they mean. They start nothing.

pub(crate) mod ensemble;
pub(crate) mod history;
pub(crate) mod sweep;
