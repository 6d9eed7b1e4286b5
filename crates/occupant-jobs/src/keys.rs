//! Keys of scenarios and studies, read off their JSON Schema.

use serde_json::Value as Json;

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
