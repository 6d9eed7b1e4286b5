//! Histories for other programs: the content of CSV and Parquet files. Names and writes no file.

mod about;
mod table;

pub(crate) use about::{About, ColumnAbout};
pub(crate) use table::{metadata, table};
