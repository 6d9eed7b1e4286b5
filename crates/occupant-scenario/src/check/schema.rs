//! The JSON Schema (2020-12) of a scenario: for editors, and for the checker.
//!
//! Beyond the standard it carries, for our own checker: `x-dimension`, `x-bare-unit`, `x-example` on every quantity, and
//! `x-exactly-one`, `x-at-most-one`, `x-together` (lists of groups of keys) on tables.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use serde_json::{Map, Value, json};

/// The schema of a kind of document.
pub fn schema_of<T: JsonSchema>(title: &str) -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| {
        s.transforms.push(Box::new(WithoutNull));
        s.transforms.push(Box::new(StandardGroups));
    });
    let mut schema = settings.into_generator().into_root_schema_for::<T>().to_value();
    if let Some(root) = schema.as_object_mut() {
        root.insert("title".into(), json!(title));
        root.insert("$id".into(), json!(format!("urn:{}", title.replace(' ', ":"))));
    }
    schema
}

/// Optional keys may be absent, but not null.
#[derive(Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut schemars::Schema) {
        if let Some(object) = schema.as_object_mut() {
            drop_null(object);
        }
        transform_subschemas(self, schema);
    }
}

fn drop_null(object: &mut Map<String, Value>) {
    if let Some(Value::Array(types)) = object.get_mut("type") {
        types.retain(|t| t != "null");
        if let [only] = types.as_slice() {
            let only = only.clone();
            object.insert("type".into(), only);
        }
    }
    if let Some(Value::Array(choices)) = object.get_mut("anyOf") {
        choices.retain(|c| c.get("type") != Some(&json!("null")));
        if let [Value::Object(only)] = choices.as_slice() {
            let only = only.clone();
            object.remove("anyOf");
            for (key, value) in only {
                object.entry(key).or_insert(value);
            }
        }
    }
    if let Some(Value::Array(values)) = object.get_mut("enum") {
        values.retain(|v| !v.is_null());
    }
    object.retain(|key, value| !(key == "default" && value.is_null()));
}

/// Adds `x-exactly-one` and the like in standard keywords too, so that editors check them.
#[derive(Clone)]
struct StandardGroups;

impl Transform for StandardGroups {
    fn transform(&mut self, schema: &mut schemars::Schema) {
        if let Some(object) = schema.as_object_mut() {
            let rules: Vec<Value> = [
                ("x-exactly-one", exactly_one as fn(&[&str]) -> Value),
                ("x-at-most-one", at_most_one),
                ("x-together", together),
            ]
            .into_iter()
            .flat_map(|(word, rule)| groups(object, word).into_iter().map(move |g| rule(&g)))
            .collect();
            if !rules.is_empty() {
                object.insert("allOf".into(), Value::Array(rules));
            }
        }
        transform_subschemas(self, schema);
    }
}

/// The groups of keys under an `x-` word of a schema.
pub(super) fn groups<'a>(object: &'a Map<String, Value>, word: &str) -> Vec<Vec<&'a str>> {
    let lists = object.get(word).and_then(Value::as_array);
    lists
        .into_iter()
        .flatten()
        .filter_map(Value::as_array)
        .map(|group| group.iter().filter_map(Value::as_str).collect())
        .collect()
}

fn exactly_one(keys: &[&str]) -> Value {
    let each: Vec<Value> = keys.iter().map(|k| json!({ "required": [k] })).collect();
    json!({ "oneOf": each })
}

fn at_most_one(keys: &[&str]) -> Value {
    let pairs = keys.iter().enumerate().flat_map(|(i, one)| keys[i + 1..].iter().map(move |other| [one, other]));
    let pairs: Vec<Value> = pairs.map(|pair| json!({ "required": pair })).collect();
    json!({ "not": { "anyOf": pairs } })
}

fn together(keys: &[&str]) -> Value {
    let each: Map<String, Value> = keys.iter().map(|k| ((*k).to_owned(), json!(keys))).collect();
    json!({ "dependentRequired": each })
}
