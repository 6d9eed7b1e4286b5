//! Histories for other programs: the content of CSV and Parquet files. Names and writes no file.

mod about;
mod csv;
mod parquet;

pub(crate) use about::{About, ColumnAbout};
pub(crate) use csv::{csv, metadata};
pub(crate) use parquet::parquet;
