//! The schema and the model stay in step.

use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::super::{Scenario, schema};
use super::{SHORT, load};

/// A value that a schema allows, with every key it knows; of several cases the one at `case`, if there is one.
fn sample(root: &Value, schema: &Value, case: usize) -> Value {
    if let Some(pointer) = schema.get("$ref").and_then(Value::as_str) {
        return sample(root, root.pointer(&pointer[1..]).unwrap(), case);
    }
    if let Some(value) = schema.get("const") {
        return value.clone();
    }
    for word in ["oneOf", "enum"] {
        if let Some(cases) = schema.get(word).and_then(Value::as_array) {
            let chosen = &cases[case.min(cases.len() - 1)];
            return if word == "enum" { chosen.clone() } else { sample(root, chosen, case) };
        }
    }
    match schema["type"].as_str() {
        Some("object") => {
            let mut object = Map::new();
            for (key, property) in schema["properties"].as_object().into_iter().flatten() {
                object.insert(key.clone(), sample(root, property, case));
            }
            if let Some(each) = schema.get("additionalProperties").filter(|a| a.is_object()) {
                object.insert("name".into(), sample(root, each, case));
            }
            Value::Object(object)
        }
        Some("array") => {
            let count = schema.get("minItems").and_then(Value::as_u64).unwrap_or(1);
            (0..count).map(|_| sample(root, &schema["items"], case)).collect()
        }
        Some("string") => json!("text"),
        Some("boolean") => json!(true),
        Some("number") => json!(0.5),
        _ => json!(1),
    }
}

#[test]
fn the_model_reads_every_key_the_schema_knows() {
    for case in 0..6 {
        let value = sample(schema(), schema(), case);
        Scenario::deserialize(&value).unwrap_or_else(|e| panic!("{e}\n{value:#}"));
        // … and writes it back: nothing was ignored.
        let scenario = Scenario::deserialize(&value).unwrap();
        assert_eq!(serde_json::to_value(scenario).unwrap(), value);
    }
}

#[test]
fn every_key_is_described() {
    fn visit(value: &Value, place: &str, count: &mut usize) {
        if let Some(properties) = value.get("properties").and_then(Value::as_object) {
            for (key, property) in properties {
                *count += 1;
                let described = property.get("description").is_some() || key == "kind";
                assert!(described, "{place}.{key} has no description");
            }
        }
        match value {
            Value::Object(object) => object.iter().for_each(|(k, v)| visit(v, k, count)),
            Value::Array(items) => items.iter().for_each(|v| visit(v, place, count)),
            _ => {}
        }
    }
    let mut count = 0;
    visit(schema(), "scenario", &mut count);
    assert!(count > 120, "{count}");
}

#[test]
fn it_is_2020_12_and_knows_no_null() {
    assert_eq!(schema()["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert!(!schema().to_string().contains("\"null\""));
}

#[test]
fn what_the_schema_calls_exclusive_is_so() {
    let both = SHORT.replace("k1 = \"70 kN/m\"", "k1 = \"70 kN/m\"\nslack = 0\nlength = 1");
    let problems = load(&both).unwrap_err();
    assert_eq!(problems.len(), 1, "{problems}");
    let rules = schema()["$defs"]["BeltSection"]["allOf"].as_array().unwrap();
    let excluded = json!(["slack", "length"]).to_string();
    assert!(rules.iter().any(|rule| rule["not"].to_string().contains(&excluded)), "{rules:?}");
}
