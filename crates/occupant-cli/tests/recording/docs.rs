//! `docs/mcap.md` names every topic, schema and field that a file holds.

use occupant_cli::mcap::messages;
use occupant_core::model::Model;
use occupant_core::results::catalogue::touch;

use super::support::{model, read, record, setup};

const DOCS: &str = include_str!("../../docs/mcap.md");

#[test]
fn every_topic_is_documented() {
    let (bytes, _) = record(&model(), ());
    for topic in read(&bytes).keys() {
        let parents = ["/occupant/segment/", "/occupant/sphere/", "/occupant/joint/", "/belt/"];
        let parent = parents.iter().find(|p| topic.starts_with(*p));
        let name = parent.map_or(format!("`{topic}`"), |p| format!("`{p}<"));
        assert!(DOCS.contains(&name), "{name}");
    }
}

/// A model that has every message.
fn everything() -> Model {
    let mut setup = setup();
    setup.output.report_coordinates = true;
    Model::new(setup).expect("a model")
}

#[test]
fn every_field_is_documented() {
    for message in messages(&everything()) {
        assert!(DOCS.contains(&format!("`{}`", message.name)));
        for field in message.fields {
            assert!(DOCS.contains(&format!("`{}`", field.name)), "{}", field.name);
        }
    }
    for (_, name, _) in touch() {
        assert!(DOCS.contains(&format!("`{name}`")), "{name}");
    }
}

/// A number given twice would make two fields one.
#[test]
fn field_numbers_and_names_are_unique() {
    for message in messages(&everything()) {
        for (i, a) in message.fields.iter().enumerate() {
            for b in &message.fields[i + 1..] {
                assert!(a.number != b.number && a.name != b.name, "{}.{}", message.name, a.name);
            }
        }
    }
}
