//! Messages about opened files, and the folders of studies.

pub mod edited;
pub mod history;
pub mod scenario;
pub mod store;
pub mod study_folder;
