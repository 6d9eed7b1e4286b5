//! Cases as text.

use std::fmt;

use occupant_core::model::setup::Setup;
use occupant_scenario::{Diagnostics, Draft, Format, Loaded};
use placed_text::{Problem, Severity, Value};

use crate::{Error, ErrorKind};

/// The text of a case: values are read and set by path, with units.
///
/// ```
/// # fn main() -> Result<(), occupant::Error> {
/// let mut text = occupant::Scenario::from_toml(
///     r#"title = "Stop"
///        path = { kind = "pulse", speed = "30 mph", shape = "half_sine", delta_v = "30 mph", duration = "80 ms" }"#,
/// )?;
/// text.set("path.speed", "25 mph")?;
/// assert_eq!(text.get("path.speed")?, "25 mph");
/// assert!(text.set("paht.speed", "25 mph").is_err());
/// # Ok(())
/// # }
/// ```
#[derive(Clone)]
pub struct Scenario {
    draft: Draft,
    /// Files that it refers to, by name.
    files: Vec<(String, Vec<u8>)>,
}

impl fmt::Debug for Scenario {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Scenario")
    }
}

impl Scenario {
    /// Parses TOML; completeness is checked when the scenario is used.
    ///
    /// # Errors
    /// All syntax errors.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        Ok(Scenario { draft: Draft::read(text, Format::Toml, "scenario")?, files: Vec::new() })
    }

    /// Reads JSON, as [`Scenario::from_toml`].
    ///
    /// # Errors
    /// All syntax errors.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Ok(Scenario { draft: Draft::read(text, Format::Json, "scenario")?, files: Vec::new() })
    }

    /// The scenario with the bytes of a file that it refers to, such as the table of its path; they replace earlier
    /// ones of that name.
    #[must_use]
    pub fn with_file(mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        let name = name.into();
        self.files.retain(|(own, _)| *own != name);
        self.files.push((name, bytes.into()));
        self
    }

    /// The value at a path, as text: `joints.neck.damping`, presets included.
    ///
    /// # Errors
    /// A path that matches nothing, or several values.
    pub fn get(&self, path: &str) -> Result<String, Error> {
        let mut found = self.draft.clone().get(path)?;
        match (found.pop(), found.is_empty()) {
            (Some((_, value)), true) => written(&value).ok_or_else(|| {
                Error::new(ErrorKind::Name, format!("`{path}` is {}; expected a single value", value.kind()))
            }),
            _ => Err(Error::new(ErrorKind::Name, format!("`{path}` matches several values; expected one"))),
        }
    }

    /// Sets a value, as text with its unit: `set("path.speed", "25 mph")`.
    ///
    /// # Errors
    /// A path that matches nothing, an unknown key, or an invalid value. The text then stays unchanged.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), Error> {
        let mut changed = self.draft.clone();
        changed.set_value(path, value)?;
        let count = |found: &Diagnostics| found.iter().filter(|one| one.problem.severity == Severity::Error).count();
        let found = changed.check();
        if count(&found) > count(&self.draft.check()) {
            return Err(found.into());
        }
        self.draft = changed;
        Ok(())
    }

    /// The scenario as TOML, with all changes.
    ///
    /// # Errors
    /// All problems of the scenario.
    pub fn to_toml(&self) -> Result<String, Error> {
        let loaded = self.loaded()?;
        loaded.scenario.to_toml().map_err(|error| Error::new(ErrorKind::Text, error))
    }

    fn loaded(&self) -> Result<Loaded, Error> {
        let file = |name: &str| {
            let known = self.files.iter().find(|(own, _)| own == name).map(|(_, bytes)| bytes.clone());
            known.ok_or_else(|| format!("no file `{name}` was given: `Scenario::with_file`"))
        };
        Ok(self.draft.clone().load(&file)?)
    }

    /// Plain data, triggers that need the path in advance, and warnings.
    pub(crate) fn build(&self) -> Result<(Setup, Vec<String>, Vec<Problem>), Error> {
        let loaded = self.loaded()?;
        let (setup, warnings) = loaded.build()?;
        let warnings = warnings.iter().map(|diagnostic| diagnostic.problem.clone()).collect();
        Ok((setup, loaded.triggers_of_path(), warnings))
    }
}

/// A value as text; none for a list of lists or a table.
fn written(value: &Value) -> Option<String> {
    match value {
        Value::Bool(is) => Some(is.to_string()),
        Value::Integer(whole) => Some(whole.to_string()),
        Value::Float(number) => Some(placed_text::number(*number)),
        Value::String(text) => Some(text.clone()),
        Value::Array(items) => {
            let items = items.iter().map(|item| written(&item.value)).collect::<Option<Vec<_>>>()?;
            Some(format!("[{}]", items.join(", ")))
        }
        _ => None,
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for Scenario {
    /// Its TOML text.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.to_toml().map_err(serde::ser::Error::custom)?)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for Scenario {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Scenario::from_toml(&String::deserialize(deserializer)?).map_err(serde::de::Error::custom)
    }
}
