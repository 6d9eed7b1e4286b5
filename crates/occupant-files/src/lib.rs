//! Files that are read and written: results (MCAP), tables, workbooks, measured tests, ISO-MME.
//!
//! Draws no picture, starts no run of its own and knows no command.
//!
//! A run as an MCAP file, which [`results`] reads again:
//!
//! ```
//! use std::io::Cursor;
//!
//! use occupant_core::run::simulate::simulate;
//! use occupant_files::mcap::{About, Document, McapOptions, McapRecorder};
//! use occupant_scenario::{Format, Scenario};
//!
//! let text = r#"
//!     title = "Free fall"
//!     time = { end = 0.01 }
//!     path = { kind = "fixed" }
//!     body = { preset = "male50" }
//!     joints = { preset = "male50" }
//!
//!     [initial_state]
//!     q     = [0, 0, 2,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//!     rates = [0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0, 0,  0, 0,  0, 0, 0,  0, 0, 0,  0, 0]
//! "#;
//! let (model, _) = Scenario::from_text(text, Format::Toml, "fall.toml", &|file| Err(format!("no file {file}")))?.model()?;
//! let scenario = Document {
//!     name: "fall.toml".into(),
//!     media_type: "application/toml".into(),
//!     content: text.as_bytes().to_vec(),
//! };
//! let about = About { program: "mine 1.0".into(), scenario, resolved: None, notes: Default::default() };
//! let mut recorder = McapRecorder::new(Cursor::new(Vec::new()), about, McapOptions::default())?;
//! simulate(&model, &mut recorder)?;
//! let bytes = recorder.into_inner()?.into_inner();
//! assert!(bytes.starts_with(b"\x89MCAP0"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

pub mod base;
mod book;
mod channel_code;
pub mod deck;
pub mod export;
pub mod history;
pub mod mcap;
pub mod measured;
pub mod mme;
mod part;
pub mod results;
pub mod scenario;
pub mod signals;
pub mod steps;
pub mod table;
mod trouble;
