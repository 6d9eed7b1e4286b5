//! Results for other programs: CSV, Parquet, ISO-MME.

mod about;
mod csv;
mod parquet;

pub use about::{About, ColumnAbout};
pub use csv::{csv, metadata};
pub use parquet::parquet;
