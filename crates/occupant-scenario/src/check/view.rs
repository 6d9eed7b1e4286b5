//! A node of the schema, with the keywords beside a `$ref` merged over its target.

use serde_json::{Map, Value as Json};

use crate::kind::Kind;
use placed_text::one_of;

/// A node of the schema.
#[derive(Clone, Copy)]
pub(crate) struct View {
    own: &'static Map<String, Json>,
    base: Option<&'static Map<String, Json>>,
}

impl View {
    /// The view of a schema that may refer to a definition in `root`.
    pub(crate) fn of(root: &'static Json, schema: &'static Json) -> Option<View> {
        let own = schema.as_object()?;
        let name = own.get("$ref").and_then(Json::as_str);
        let base =
            name.and_then(|r| r.strip_prefix('#')).and_then(|pointer| root.pointer(pointer)).and_then(Json::as_object);
        Some(View { own, base })
    }

    /// A keyword of the schema.
    pub(crate) fn get(&self, word: &str) -> Option<&'static Json> {
        self.own.get(word).or_else(|| self.base.and_then(|b| b.get(word)))
    }

    /// The kind of quantity, if it is one.
    pub(crate) fn kind(&self) -> Option<&'static Kind> {
        Kind::named(self.get("x-dimension")?.as_str()?)
    }

    /// The names to choose from, if it is such a choice.
    pub(crate) fn names(&self) -> Option<Vec<&'static str>> {
        if let Some(values) = self.get("enum").and_then(Json::as_array) {
            return Some(values.iter().filter_map(Json::as_str).collect());
        }
        let cases = self.get("oneOf")?.as_array()?;
        cases.iter().map(|c| c.get("const")?.as_str()).collect()
    }

    /// The cases of a table with a `kind`: the value of `kind` and the contents of the table.
    pub(crate) fn cases(&self, root: &'static Json) -> Option<Vec<(&'static str, View)>> {
        let cases = self.get("oneOf")?.as_array()?;
        cases
            .iter()
            .map(|case| {
                let name = case.pointer("/properties/kind/const")?.as_str()?;
                Some((name, View::of(root, case)?))
            })
            .collect()
    }

    /// `object`, `array`, `string`, …
    pub(crate) fn type_name(&self) -> &'static str {
        self.get("type").and_then(Json::as_str).unwrap_or("")
    }

    /// Whether several types of value are allowed here; another part of the document decides among them.
    pub(crate) fn is_open(&self) -> bool {
        self.get("type").is_some_and(Json::is_array)
    }

    /// Whether such a node allows this type of value.
    pub(crate) fn may_be(&self, name: &str) -> bool {
        let types = self.get("type").and_then(Json::as_array);
        types.is_some_and(|types| types.iter().any(|t| t.as_str() == Some(name)))
    }

    /// The value of a table under a key.
    pub(crate) fn property(&self, root: &'static Json, key: &str) -> Option<View> {
        let named = self.get("properties").and_then(|p| p.get(key));
        View::of(root, named.or_else(|| self.get("additionalProperties"))?)
    }

    /// The keys a table may have.
    pub(crate) fn keys(&self) -> Vec<&'static str> {
        let properties = self.get("properties").and_then(Json::as_object);
        properties.into_iter().flat_map(|p| p.keys().map(String::as_str)).collect()
    }

    /// The keys a table must have.
    pub(crate) fn required(&self) -> impl Iterator<Item = &'static str> {
        let list = self.get("required").and_then(Json::as_array);
        list.into_iter().flatten().filter_map(Json::as_str)
    }

    /// The items of a list.
    pub(crate) fn items(&self, root: &'static Json) -> Option<View> {
        View::of(root, self.get("items")?)
    }

    /// The layer that contains rules about groups of keys.
    pub(crate) fn object_with_groups(&self) -> Option<&'static Map<String, Json>> {
        let has = |object: &Map<String, Json>| {
            ["x-exactly-one", "x-at-most-one", "x-together"].iter().any(|word| object.contains_key(*word))
        };
        [Some(self.own), self.base].into_iter().flatten().find(|o| has(o))
    }

    /// The expected value in two or three words.
    pub(crate) fn noun(&self) -> &'static str {
        match (self.kind(), self.type_name()) {
            (Some(kind), _) => kind.noun,
            (None, "array") => "a list",
            (None, "string") => "a text",
            (None, "boolean") => "true or false",
            (None, "number") => "a number",
            (None, "integer") => "a whole number",
            _ if self.is_open() => "a value",
            _ => "a table",
        }
    }

    /// The expected value, with examples.
    pub(crate) fn wanted(&self) -> String {
        if let Some(kind) = self.kind() {
            return kind.expected();
        }
        if let Some(names) = self.names() {
            return one_of(&names, '"');
        }
        let count = |word: &str| self.get(word).and_then(Json::as_u64);
        match (self.type_name(), count("minItems"), count("maxItems")) {
            ("array", Some(least), Some(most)) if least == most => format!("a list of {least}"),
            ("array", Some(least), _) => format!("a list of at least {least}"),
            ("string", ..) => "a text in quotes".to_owned(),
            _ if self.is_open() => self.open_example().to_owned(),
            _ => self.noun().to_owned(),
        }
    }

    /// Permitted notation of a value of the node.
    fn open_example(&self) -> &'static str {
        let example = self.get("x-example").and_then(Json::as_str);
        example.unwrap_or("a number, or a text in quotes")
    }
}
