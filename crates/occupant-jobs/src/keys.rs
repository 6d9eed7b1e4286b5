//! Keys of scenarios and studies, read off their JSON Schema.

use occupant_core::results::channel::matches;
use occupant_scenario::kind::UnitSystem;
use occupant_scenario::{Draft, schema};
use placed_text::{Node, Step, Value, children, to_text};
use serde_json::Value as Json;

/// A value of a scenario with its key.
#[derive(Clone, Debug, PartialEq)]
pub struct Described {
    /// Its path.
    pub path: String,
    /// The value, as written in the scenario or its presets.
    pub value: Value,
    /// Unit of a bare number there; empty for a value that has none.
    pub unit: String,
    /// What the key means, and what holds if it is absent.
    pub meaning: String,
}

/// All values of a scenario, presets included, whose paths match a pattern in which `*` stands for any characters.
pub fn values(draft: &Draft, pattern: &str) -> Vec<Described> {
    let root = draft.without(&|_, _| false).root;
    let system = match draft.units() {
        UnitSystem::Si => "si",
        UnitSystem::InchPound => "in-lbf-s",
    };
    let (pieces, keys) = (pattern.split('*').collect::<Vec<_>>(), Key::root(schema()).all());
    let mut all = Vec::new();
    leaves(&root, &mut Vec::new(), &mut |steps, node| all.push((to_text(steps), node)));
    let of = |path: &str| all.iter().find(|(own, _)| own == path).and_then(|(_, node)| node.as_str());
    let described = |(path, node): &(String, &Node)| {
        let key = key_of(&keys, path, &|kind, word| of(kind) == Some(word));
        let unit = key.map(|key| key.bare_unit(system));
        let (path, value, meaning) = (path.clone(), node.value.clone(), key.map(Key::meaning));
        Described { path, value, unit: unit.unwrap_or_default(), meaning: meaning.unwrap_or_default() }
    };
    all.iter().filter(|(path, _)| matches(path, &pieces)).map(described).collect()
}

/// Every value that is no table and no list of tables; a list of plain values is one value.
fn leaves<'n>(node: &'n Node, path: &mut Vec<Step>, see: &mut impl FnMut(&[Step], &'n Node)) {
    let below = children(node);
    if node.as_table().is_none() && !below.iter().any(|(_, item)| item.as_table().is_some()) {
        return see(path, node);
    }
    for (step, below) in below {
        path.push(step);
        leaves(below, path, see);
        path.pop();
    }
}

/// The key at a path; of the keys that kinds of a section share, that of the kind that is set: `is_set` is asked for the
/// path of the kind and its word.
pub fn key_of<'k, 's>(keys: &'k [Key<'s>], path: &str, is_set: &dyn Fn(&str, &str) -> bool) -> Option<&'k Key<'s>> {
    let section = path.rsplit_once('.').map_or(String::new(), |(section, _)| format!("{section}."));
    let fits = |key: &&&Key<'_>| {
        let kind = key.variant.as_deref().and_then(|variant| variant.split_once(" = "));
        kind.is_none_or(|(of, word)| is_set(&format!("{section}{of}"), word.trim_matches('"')))
    };
    let own: Vec<&Key<'_>> = keys.iter().filter(|key| key.is_at(path)).collect();
    own.iter().find(fits).or(own.first()).copied()
}

/// A key of the schema.
#[derive(Clone)]
pub struct Key<'a> {
    /// Its path, with NAME for names of the user and `[]` for items.
    pub path: String,
    /// Variant of its section that it belongs to, such as `kind = "pulse"`.
    pub variant: Option<String>,
    /// Whether it must be given.
    pub needed: bool,
    root: &'a Json,
    /// Its own schema entry.
    own: &'a Json,
    /// Schema of the table that contains it.
    table: &'a Json,
}

impl<'a> Key<'a> {
    /// The whole file.
    pub fn root(schema: &'a Json) -> Self {
        Key { path: String::new(), variant: None, needed: true, root: schema, own: schema, table: schema }
    }

    /// Its schema, with references resolved.
    pub fn schema(&self) -> &'a Json {
        let name = self.own["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/"));
        name.map_or(self.own, |name| &self.root["$defs"][name])
    }

    /// Its description in one line; for a variant, that of the table.
    pub fn meaning(&self) -> String {
        let words = |schema: &'a Json| schema["description"].as_str();
        let of_kind = || words(self.table).filter(|_| self.own.get("const").is_some());
        words(self.own).or_else(|| words(self.schema())).or_else(of_kind).unwrap_or_default().replace('\n', " ")
    }

    /// Unit of a bare number, or of bare numbers in a list, in a system of units; empty if it holds none.
    fn bare_unit(&self, system: &str) -> String {
        let unit = |schema: &'a Json| schema["x-bare-unit"][system].as_str();
        let of_item = || unit(self.item().schema());
        unit(self.schema()).or_else(of_item).unwrap_or_default().to_owned()
    }

    /// Tables that it may hold, each with the key that distinguishes it: one, unless the section has variants.
    fn tables(&self) -> Vec<(Option<String>, &'a Json)> {
        let schema = self.schema();
        let Some(kinds) = schema["oneOf"].as_array() else {
            return vec![(None, schema)];
        };
        let kind = |table: &'a Json| {
            let (key, of) = table["properties"].as_object()?.iter().find(|(_, of)| of.get("const").is_some())?;
            Some((Some(format!("{key} = {}", of["const"])), table))
        };
        kinds.iter().filter_map(kind).collect()
    }

    /// The keys below it.
    pub fn below(&self) -> Vec<Key<'a>> {
        let join = |key: &str| if self.path.is_empty() { key.to_owned() } else { format!("{}.{key}", self.path) };
        let mut keys = Vec::new();
        for (variant, table) in self.tables() {
            let needed = |key: &str| table["required"].as_array().is_some_and(|keys| keys.iter().any(|k| k == key));
            for (key, own) in table["properties"].as_object().into_iter().flatten() {
                let variant = variant.clone();
                keys.push(Key { path: join(key), variant, needed: needed(key), root: self.root, own, table });
            }
            if table["additionalProperties"].is_object() {
                let own = &table["additionalProperties"];
                keys.push(Key { path: join("NAME"), variant, needed: false, root: self.root, own, table });
            }
        }
        let items = &self.schema()["items"];
        if items.is_object() {
            let item = Key { path: format!("{}[]", self.path), own: items, ..self.clone() };
            keys.extend(item.below());
        }
        keys
    }

    /// What an item of its list may be.
    pub fn item(&self) -> Key<'a> {
        Key { path: format!("{}[]", self.path), own: &self.schema()["items"], ..self.clone() }
    }

    /// All keys, each before those below it.
    pub fn all(&self) -> Vec<Key<'a>> {
        let below = self.below();
        below.iter().flat_map(|key| std::iter::once(key.clone()).chain(key.all())).collect()
    }

    /// Whether it is the key at a path, where NAME matches the user's own names.
    pub fn is_at(&self, path: &str) -> bool {
        let (own, wanted) = (self.path.split('.').map(bare), path.split('.').map(bare));
        own.clone().count() == wanted.clone().count() && own.zip(wanted).all(|(own, word)| own == word || own == "NAME")
    }

    /// Its last word.
    pub fn name(&self) -> &str {
        bare(self.path.rsplit('.').next().unwrap_or_default())
    }
}

/// A step of a path without its index.
fn bare(step: &str) -> &str {
    step.split('[').next().unwrap_or(step)
}
