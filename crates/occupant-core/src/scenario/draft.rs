//! A scenario text that has been read but not yet checked: the place to apply overrides.

use super::check::{check, units_of};
use super::diagnostic::{Diagnostic, Diagnostics};
use super::document::{self, Format, Node, Value};
use super::expand::expand;
use super::kind::UnitSystem;
use super::loaded::{Loaded, Resolver};
use super::overrides::{needs_explicit, put, targets};
use super::path_text::{self, to_text};
use super::quantity::scaled_text;
use super::source::{SourceId, Sources};
use super::toml_text;
use crate::problem::{Problem, Severity};

/// A scenario text that has been read but not yet checked.
#[derive(Clone, Debug)]
pub struct Draft {
    pub(super) sources: Sources,
    pub(super) main: SourceId,
    pub(super) root: Node,
}

impl Draft {
    /// Reads a text; `name` is what messages call it, such as its file name.
    ///
    /// # Errors
    /// Everything that is wrong with its syntax.
    pub fn read(text: &str, format: Format, name: &str) -> Result<Draft, Diagnostics> {
        let mut sources = Sources::new();
        let main = sources.add(name, text);
        let root = document::parse(&sources, main, format)?;
        Ok(Draft { sources, main, root })
    }

    /// Reads bytes that should be UTF-8 text; the format is told by [`Format::of_text`] unless given.
    ///
    /// # Errors
    /// The place of the first byte that is not UTF-8; else as [`Draft::read`].
    pub fn read_bytes(bytes: &[u8], format: Option<Format>, name: &str) -> Result<Draft, Diagnostics> {
        let text = text_of(bytes, name)?;
        Draft::read(text, format.unwrap_or_else(|| Format::of_text(text)), name)
    }

    /// Applies `path.to.key=value`, as a command line gives it. The value is read as TOML; what is not TOML is a text, so
    /// that `path.speed=20 mph` needs no quotes.
    ///
    /// # Errors
    /// No `=`, a path that cannot be read or leads nowhere.
    pub fn set(&mut self, assignment: &str) -> Result<(), Diagnostics> {
        match assignment.split_once('=') {
            Some((path, value)) => self.set_value(path.trim(), value.trim()),
            None => Err(refuse("override", format!("`{assignment}` has no `=`"), "path.to.key=value")),
        }
    }

    /// Applies one value, given as text, at every place the path leads to.
    ///
    /// # Errors
    /// A path that cannot be read or leads nowhere.
    pub fn set_value(&mut self, path: &str, value: &str) -> Result<(), Diagnostics> {
        let name = format!("override of {path}");
        let steps =
            path_text::parse(path).map_err(|found| refuse(&name, found, "a path such as belts.lap.anchors[1]"))?;
        let id = self.sources.add(&name, value);
        let value = self.value(id);
        let explicit = needs_explicit(&self.root, &steps).then(|| expand(&mut self.sources, &self.root));
        let places = targets(explicit.as_ref().unwrap_or(&self.root), &steps);
        if places.is_empty() {
            let found = format!("`{path}` leads to nothing in this scenario");
            return Err(refuse(&name, found, "a path to at least one place"));
        }
        for place in places {
            put(&mut self.root, explicit.as_ref(), &place, value.clone())
                .map_err(|found| refuse(&name, found, "a path that exists in the scenario"))?;
        }
        Ok(())
    }

    /// Multiplies the quantities that a path leads to, presets included, each in its own unit.
    ///
    /// # Errors
    /// A path that cannot be read, leads nowhere, or leads to something that is no number.
    pub fn scale(&mut self, path: &str, factor: f64) -> Result<(), Diagnostics> {
        for (place, value) in self.get(path)? {
            let scaled = match &value {
                Value::Integer(i) => Some((*i as f64 * factor).to_string()),
                Value::Float(x) => Some((x * factor).to_string()),
                Value::String(text) => scaled_text(text, factor),
                _ => None,
            };
            let Some(scaled) = scaled else {
                let found = format!("`{place}` is no number, so it cannot be multiplied");
                return Err(refuse(path, found, "a path to quantities"));
            };
            self.set_value(&place, &scaled)?;
        }
        Ok(())
    }

    /// The values a path leads to, presets included, as texts: `("joints.neck.damping", "20 in lbf s/rad")`.
    ///
    /// # Errors
    /// A path that cannot be read or leads nowhere.
    pub fn get(&mut self, path: &str) -> Result<Vec<(String, Value)>, Diagnostics> {
        let steps = path_text::parse(path).map_err(|found| refuse(path, found, "a path such as belts.lap.slack"))?;
        let explicit = expand(&mut self.sources, &self.root);
        let found: Vec<(String, Value)> = targets(&explicit, &steps)
            .iter()
            .filter_map(|place| {
                let node = place.iter().try_fold(&explicit, path_text::child_of)?;
                Some((to_text(place), node.value.clone()))
            })
            .collect();
        match found.is_empty() {
            true => {
                Err(refuse(path, format!("`{path}` leads to nothing in this scenario"), "a path to at least one place"))
            }
            false => Ok(found),
        }
    }

    /// The units of its bare numbers.
    pub fn units(&self) -> UnitSystem {
        units_of(&self.root)
    }

    /// All that is wrong with the words of the scenario as it stands.
    pub fn check(&self) -> Diagnostics {
        check(&self.sources, &self.root)
    }

    /// Checks the scenario and reads the tables it refers to.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn load(self, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        Loaded::from_draft(self, resolver)
    }

    /// An override's value: TOML, or else the text itself.
    fn value(&self, id: SourceId) -> Node {
        toml_text::parse_value(&self.sources, id).unwrap_or_else(|_| {
            let text = self.sources.text(id);
            let mut span = self.sources.start_of(id);
            span.end = text.len();
            Node { span, value: Value::String(text.to_owned()) }
        })
    }
}

/// Bytes as text.
pub fn text_of<'a>(bytes: &'a [u8], name: &str) -> Result<&'a str, Diagnostics> {
    std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = before.iter().filter(|b| **b == b'\n').count() + 1;
        let byte = bytes.get(before.len()).copied().unwrap_or(0);
        let found = format!("byte 0x{byte:02x} in line {line} is not UTF-8");
        refuse(name, found, "a text in UTF-8")
    })
}

/// One problem of a text as a whole.
pub fn refuse(source: &str, found: String, expected: &str) -> Diagnostics {
    let mut diagnostics = Diagnostics::new();
    diagnostics.push(Diagnostic::of(
        source,
        Problem { severity: Severity::Error, path: String::new(), found, expected: expected.to_owned(), hint: None },
    ));
    diagnostics
}
