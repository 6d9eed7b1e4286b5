//! Files as the library of files has them, what the command says of them, and the folders of studies.

pub(crate) mod history;
pub(crate) mod scenario;
pub(crate) mod study_folder;

pub(crate) use occupant_files::{export, mcap, measured, mme, results, signals, steps, table};
