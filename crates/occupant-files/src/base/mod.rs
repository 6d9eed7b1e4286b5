//! Shared tools: results of file operations, names of files, default displays.

mod build;
#[cfg(feature = "clap")]
mod choice;
pub mod customary;
pub mod failure;
pub mod input_file;
pub mod names;
pub mod output_file;
mod sha256;

pub use build::build;
#[cfg(feature = "clap")]
pub use choice::one_of;
pub use failure::{Done, Failure};
pub use names::{by_ending, ending, escape, file_name, file_stem, is_page, program, quoted};
pub use output_file::{
    Existing, FileProblem, PartialFile, begun, is_at, partial_path, publish, refuse_input, remove_if_there,
    sync_folder, with_word, write_whole,
};
pub use sha256::{each_portion, sha256, sha256_of_file};
