//! What jobs say of the files that they open, and the folders of studies.

pub mod history;
pub mod scenario;
pub mod study_folder;
