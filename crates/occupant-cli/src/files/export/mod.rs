//! Results for other programs: CSV, Parquet, ISO-MME.

mod about;
mod csv;
mod parquet;

pub(crate) use about::{About, ColumnAbout};
pub(crate) use csv::{csv, metadata};
pub(crate) use parquet::parquet;
