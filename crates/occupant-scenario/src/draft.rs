//! A scenario text that has been read but not yet checked. Overrides are applied here.

use std::sync::Arc;

use super::car::{self, Usual, WrittenOut};
use super::check::{check_parts, check_words, references, units_of};
use super::expand::{expand, written_out};
use super::kind::UnitSystem;
use super::loaded::{Loaded, Resolver};
use super::overrides::{needs_explicit, put};
use super::ready::{Ready, shares};
use super::sections::schema;
use occupant_core::body::shape;
use occupant_core::body::tti12::TTI12;
use placed_text::{
    Diagnostics, Document, Entry, Format, Node, SourceId, Step, Value, follow, parse_path, parse_value, refuse,
    targets, to_text,
};

/// Paths at which a scenario names files.
const FILES: [&str; 4] = ["path.file", "vehicles.*.path.file", "frames.*.path.file", "materials.*.file"];

/// Whether a scenario names a file at this path.
pub fn names_file(path: &str) -> bool {
    let steps: Vec<&str> = path.split('.').collect();
    let fits = |pattern: &&str| {
        let pattern = pattern.split('.');
        pattern.clone().count() == steps.len() && pattern.zip(&steps).all(|(of, step)| of == "*" || of == *step)
    };
    FILES.iter().any(fits)
}

/// A scenario text that has been read but not yet checked.
#[derive(Clone, Debug)]
pub struct Draft {
    pub(super) document: Document,
    /// Its state before the changes, if known.
    ready: Option<Arc<Ready>>,
}

impl Draft {
    /// Reads a text; `name` is its name in messages, such as a file name.
    ///
    /// # Errors
    /// All syntax errors.
    pub fn read(text: &str, format: Format, name: &str) -> Result<Draft, Diagnostics> {
        Document::read(text, format, name).map(Draft::of)
    }

    /// Reads bytes of UTF-8 text; [`Format::of_text`] detects the format unless it is given.
    ///
    /// # Errors
    /// The position of the first byte that is not UTF-8; otherwise as [`Draft::read`].
    pub fn read_bytes(bytes: &[u8], format: Option<Format>, name: &str) -> Result<Draft, Diagnostics> {
        Document::read_bytes(bytes, format, name).map(Draft::of)
    }

    fn of(document: Document) -> Draft {
        Draft { document, ready: None }
    }

    /// Prepares the draft so that copies with a few other values are checked and read in a fraction of the time. An
    /// invalid draft stays unchanged.
    #[must_use]
    pub fn prepared(mut self) -> Draft {
        if let Ok(ready) = self.clone().into_ready() {
            (self.document.root, self.document.sources) = (ready.root.clone(), ready.sources.clone());
            self.ready = Some(Arc::new(ready));
        }
        self
    }

    /// The scenario checked and expanded.
    ///
    /// # Errors
    /// All problems of the scenario.
    pub(super) fn into_ready(mut self) -> Result<Ready, Diagnostics> {
        let Document { sources, root, .. } = &self.document;
        let mut read = self.ready.as_ref().map_or_else(Vec::new, |ready| ready.read.clone());
        if let Some(ready) = self.ready.as_ref().and_then(|ready| ready.with(sources, root, &mut read)) {
            return Ok(ready);
        }
        let (whole, problems) = self.checked(&mut read);
        if problems.has_errors() { Err(problems) } else { Ready::of(self.document.root, whole, read) }
    }

    /// Applies `path.to.key=value` from a command line. The value is read as TOML; anything else is a text, so
    /// `path.speed=20 mph` needs no quotes.
    ///
    /// # Errors
    /// No `=`, an invalid path, or a path that does not exist.
    pub fn set(&mut self, assignment: &str) -> Result<(), Diagnostics> {
        match assignment.split_once('=') {
            Some((path, value)) => self.set_value(path.trim(), value.trim()),
            None => Err(refuse("override", format!("`{assignment}` has no `=`"), "path.to.key=value")),
        }
    }

    /// Applies one value, given as text, at every place that the path matches.
    ///
    /// # Errors
    /// An invalid path, or a path that does not exist.
    pub fn set_value(&mut self, path: &str, value: &str) -> Result<(), Diagnostics> {
        let name = format!("override of {path}");
        let steps = parse_path(path).map_err(|found| refuse(&name, found, "a path such as belts.lap.anchors[1]"))?;
        let id = self.document.sources.add(name.as_str(), value);
        let value = self.value(id);
        let explicit = needs_explicit(&self.document.root, &steps).then(|| self.explicit());
        let places = targets(explicit.as_ref().unwrap_or(&self.document.root), &steps);
        if places.is_empty() {
            return Err(leads_nowhere(&name, path));
        }
        for place in places {
            put(&mut self.document.root, explicit.as_ref(), &place, value.clone())
                .map_err(|found| refuse(&name, found, "the path of an existing key"))?;
        }
        Ok(())
    }

    /// The values that a path matches, including presets, as texts: `("joints.neck.damping", "20 in lbf s/rad")`.
    ///
    /// # Errors
    /// An invalid path, or a path that does not exist.
    pub fn get(&mut self, path: &str) -> Result<Vec<(String, Value)>, Diagnostics> {
        let steps = parse_path(path).map_err(|found| refuse(path, found, "a path such as belts.lap.slack"))?;
        let explicit = self.explicit();
        let value = |place: &Vec<Step>| Some((to_text(place), follow(&explicit, place)?.value.clone()));
        let found: Vec<_> = targets(&explicit, &steps).iter().filter_map(value).collect();
        if found.is_empty() { Err(leads_nowhere(path, path)) } else { Ok(found) }
    }

    /// The files that it names: paths of the keys, and names.
    pub fn files(&mut self) -> Vec<(String, String)> {
        let named = |(path, value)| match value {
            Value::String(name) => Some((path, name)),
            _ => None,
        };
        FILES.iter().flat_map(|path| self.get(path).unwrap_or_default()).filter_map(named).collect()
    }

    /// Built-in distribution for a path of a car or its occupants; none if there is none.
    pub fn usual(&self, path: &str) -> Option<Usual> {
        car::usual(&self.document.sources, &self.document.root, path)
    }

    /// The units of its bare numbers.
    pub fn units(&self) -> UnitSystem {
        units_of(&self.document)
    }

    /// All problems of the scenario in its present state.
    pub fn check(&self) -> Diagnostics {
        self.clone().checked(&mut Vec::new()).1
    }

    /// The scenario with its car expanded, and all its problems; converts every quantity to SI units. For `read` see
    /// [`car::whole`].
    fn checked(&mut self, read: &mut Vec<WrittenOut>) -> (Document, Diagnostics) {
        imply_error_control(&mut self.document.root);
        let written = &mut self.document;
        let mut problems =
            if car::is_there(&written.root) { check_parts(written, schema(), &car::CAR) } else { Diagnostics::new() };
        if !problems.has_errors() {
            problems.extend(car::check(written));
        }
        if problems.has_errors() {
            return (written.clone(), problems);
        }
        let mut whole = written.clone();
        whole.root = car::whole(&mut whole.sources, &written.root, read);
        problems.extend(check_words(&mut whole, schema(), "the scenario"));
        if !car::is_there(&written.root) {
            written.root = whole.root.clone();
        }
        // where the words are right, names are looked up when the plain data are built
        if problems.has_errors() {
            let root = written_out(&mut whole.sources, &whole.root);
            let unknown = references(&root, Some(&shape::names(&TTI12)));
            if !unknown.is_empty() {
                let whole = Document { root, ..whole.clone() };
                unknown.into_iter().for_each(|problem| problems.add(problem, |problem| whole.place(problem)));
            }
        }
        (whole, problems)
    }

    /// Checks the scenario and reads its tables.
    ///
    /// # Errors
    /// All problems of it.
    pub fn load(self, resolver: Resolver) -> Result<Loaded, Diagnostics> {
        Loaded::from_draft(self, resolver)
    }

    /// The explicit scenario without the written values that `is_left_out` chooses by path: what presets and the car give
    /// for them stands in their places.
    pub fn without(&self, is_left_out: &dyn Fn(&[Step], &Node) -> bool) -> Document {
        let Document { mut sources, main, mut root } = self.document.clone();
        leave_out(&mut root, &mut Vec::new(), is_left_out);
        Document { root: expand(&mut sources, &root), sources, main }
    }

    fn explicit(&mut self) -> Node {
        if let Some(ready) = self.ready.as_ref().filter(|ready| shares(&ready.root, &self.document.root)) {
            return ready.explicit_root.clone();
        }
        expand(&mut self.document.sources, &self.document.root)
    }

    /// The value of an override: TOML, a number such as `.2` that is not valid TOML, or otherwise the text itself.
    fn value(&self, id: SourceId) -> Node {
        let sources = &self.document.sources;
        parse_value(sources, id).unwrap_or_else(|_| {
            let text = sources.text(id);
            let mut span = sources.start_of(id);
            span.end = text.len();
            let number = text.trim().parse().ok().filter(|x: &f64| x.is_finite() && text.contains('.'));
            Node::new(span, number.map_or_else(|| Value::String(text.to_owned()), Value::Float))
        })
    }
}

/// An integrator with only an accuracy uses error control: `kind` is implied.
fn imply_error_control(root: &mut Node) {
    let integrator = root.as_table_mut().and_then(|root| root.get_mut("integrator"));
    let Some(table) = integrator.and_then(|entry| entry.node.as_table_mut()) else { return };
    if let (Some(Entry { key_span, .. }), false) = (table.get("accuracy"), table.contains_key("kind")) {
        let node = Node::new(*key_span, Value::String("adaptive".to_owned()));
        let kind = Entry { key_span: *key_span, node };
        table.insert("kind".to_owned(), kind);
    }
}

/// Removes the values below a table that `is_left_out` chooses; a list is one value.
fn leave_out(node: &mut Node, path: &mut Vec<Step>, is_left_out: &dyn Fn(&[Step], &Node) -> bool) {
    let Some(table) = node.as_table_mut() else { return };
    table.retain(|key, entry| {
        path.push(Step::Key(key.clone()));
        leave_out(&mut entry.node, path, is_left_out);
        let is_kept = entry.node.as_table().is_some() || !is_left_out(path, &entry.node);
        path.pop();
        is_kept
    });
}

fn leads_nowhere(source: &str, path: &str) -> Diagnostics {
    refuse(source, format!("this scenario has no `{path}`"), "the path of an existing key")
}
