//! A text that has been read, and bytes as texts.

use std::sync::Arc;

use serde::de::DeserializeOwned;

use crate::diagnostic::{Diagnostic, Diagnostics};
use crate::encoding::decoded;
use crate::node::{Format, Node};
use crate::path::locate;
use crate::problem::Problem;
use crate::source::{SourceId, Sources};
use crate::{json, toml};

/// A parsed text: its tree, and the texts that positions in the tree refer to.
#[derive(Clone, Debug)]
pub struct Document {
    /// All texts that positions refer to.
    pub sources: Sources,
    /// The text itself.
    pub main: SourceId,
    /// Its tree.
    pub root: Node,
}

impl Document {
    /// Reads a text; `name` is its name in messages, such as its file name.
    ///
    /// # Errors
    /// Everything that is wrong with its syntax.
    pub fn read(text: &str, format: Format, name: &str) -> Result<Document, Diagnostics> {
        let mut sources = Sources::new();
        let main = sources.add(name, text);
        let root = match format {
            Format::Toml => toml::parse(&sources, main)?,
            Format::Json => json::parse(&sources, main)?,
        };
        Ok(Document { sources, main, root })
    }

    /// Parses the bytes of a file that another text refers to, of which messages quote no line; [`Format::of_text`]
    /// detects the format.
    ///
    /// # Errors
    /// The place of the first byte that is not UTF-8; else everything that is wrong with its syntax.
    pub fn read_named(bytes: &[u8], name: &str) -> Result<Document, Diagnostics> {
        let text = text_of(bytes, name)?;
        let mut sources = Sources::new();
        let main = sources.add_named(name, text);
        let root = match Format::of_text(text) {
            Format::Toml => toml::parse(&sources, main)?,
            Format::Json => json::parse(&sources, main)?,
        };
        Ok(Document { sources, main, root })
    }

    /// Reads bytes of UTF-8 text; [`Format::of_text`] detects the format unless it is given.
    ///
    /// # Errors
    /// The place of the first byte that is not UTF-8; else as [`Document::read`].
    pub fn read_bytes(bytes: &[u8], format: Option<Format>, name: &str) -> Result<Document, Diagnostics> {
        let text = text_of(bytes, name)?;
        Document::read(text, format.unwrap_or_else(|| Format::of_text(text)), name)
    }

    /// The text it was read from.
    pub fn text(&self) -> &str {
        self.sources.text(self.main)
    }

    /// The same, shared.
    pub fn shared(&self) -> Arc<str> {
        self.sources.shared(self.main)
    }

    /// Whether its root has this key.
    pub fn has(&self, key: &str) -> bool {
        self.root.get(key).is_some()
    }

    /// A problem at the position of its path.
    pub fn place(&self, problem: Problem) -> Diagnostic {
        match locate(&self.root, &problem.path) {
            Some(span) => Diagnostic::at(&self.sources, span, problem),
            None => Diagnostic::of(self.sources.name(self.main), problem),
        }
    }

    /// Its sections after a successful check; `what` is its name in messages. A mismatch of check and sections is
    /// reported, not a panic.
    ///
    /// # Errors
    /// The first such difference.
    pub fn sections<T: DeserializeOwned>(&self, what: &str) -> Result<T, Diagnostics> {
        T::deserialize(&self.root).map_err(|error| {
            let found = format!("the {what} cannot be read: {error}");
            refuse(self.sources.name(self.main), found, &format!("a {what}"))
        })
    }
}

/// Bytes as text; `name` is their name in messages.
///
/// # Errors
/// The line of the first byte that is not UTF-8.
pub fn text_of<'a>(bytes: &'a [u8], name: &str) -> Result<&'a str, Diagnostics> {
    std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = before.iter().filter(|b| **b == b'\n').count() + 1;
        let byte = bytes.get(before.len()).copied().unwrap_or(0);
        let found = format!("byte 0x{byte:02x} in line {line} is not UTF-8");
        refuse(name, found, "a text in UTF-8")
    })
}

/// Bytes of a table as text, as [`decoded`]; `name` is their name in messages.
///
/// # Errors
/// Bytes that are no text.
pub fn table_text(bytes: &[u8], name: &str) -> Result<String, Diagnostics> {
    decoded(bytes).map(|(text, _)| text).map_err(|found| refuse(name, found, "a text table"))
}

/// One problem of a text as a whole.
pub fn refuse(source: &str, found: String, expected: &str) -> Diagnostics {
    Diagnostic::of(source, Problem::error("", found, expected)).into()
}
