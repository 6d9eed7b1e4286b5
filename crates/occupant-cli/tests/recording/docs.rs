//! `docs/mcap.md` names every topic, schema and field that a file holds.

use occupant_cli::mcap::{column, groups};

use crate::support::{model, read, record};

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

#[test]
fn every_field_is_documented() {
    for group in groups::ALL {
        assert!(DOCS.contains(&format!("`{}`", group.message)));
        for column in group.columns {
            assert!(DOCS.contains(&format!("`{}`", column.name)), "{}", column.name);
        }
    }
    for field in column::TOUCH {
        assert!(DOCS.contains(&format!("`{}`", field.name)), "{}", field.name);
    }
}

/// A number given twice would make two fields one.
#[test]
fn field_numbers_and_names_are_unique() {
    for group in groups::ALL {
        for (i, a) in group.columns.iter().enumerate() {
            for b in &group.columns[i + 1..] {
                assert!(a.number != b.number && a.name != b.name, "{}.{}", group.message, a.name);
            }
        }
    }
}
