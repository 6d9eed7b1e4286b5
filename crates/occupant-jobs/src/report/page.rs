//! Assembles the HTML file. No user text can break out of its place: the title is escaped, and so is every `<` in the
//! data, so that no `</script>` ends them early.

use super::data::Report;
use crate::base::Failure;
use occupant_pictures::html::about;
use occupant_pictures::svg::escape;

const PAGE: &str = include_str!("../../assets/viewer/src/page.html");
const SCRIPT: &str = include_str!("../../assets/viewer/dist/viewer.js");
const LICENSES: &str = include_str!("../../assets/viewer/LICENSES.md");
const STYLE: &str = include_str!("../../assets/viewer/dist/viewer.css");

/// The complete file; `vehicles` is HTML below the drawings of the script.
///
/// # Errors
/// Data that are no JSON, which those of a report always are.
pub fn fill(report: &Report, vehicles: String) -> Result<String, Failure> {
    let data =
        serde_json::to_string(report).map_err(|e| Failure::plain(format!("the report's data are not JSON: {e}")))?;
    let parts = [
        ("about", about(&report.subject())),
        ("title", escape(&report.title())),
        ("style", STYLE.trim_end().to_owned()),
        ("vehicles", vehicles),
        ("data", harmless(&data)),
        ("licenses", LICENSES.trim_end().to_owned()),
        ("script", SCRIPT.trim_end().to_owned()),
    ];
    Ok(replace(PAGE, &parts))
}

/// JSON for a script element: `<`, which occurs in strings only, is escaped.
fn harmless(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// Replaces each `{{name}}` by its part, once and in order; parts themselves are not searched.
fn replace(page: &str, parts: &[(&str, String)]) -> String {
    let mut out = String::with_capacity(page.len() + parts.iter().map(|p| p.1.len()).sum::<usize>());
    let mut rest = page;
    while let Some((before, after)) = rest.split_once("{{") {
        out.push_str(before);
        let Some((name, left)) = after.split_once("}}") else {
            break;
        };
        if let Some((_, part)) = parts.iter().find(|p| p.0 == name) {
            out.push_str(part);
        }
        rest = left;
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_cannot_end_their_element() {
        let json = serde_json::to_string("</script><!-- <b>").unwrap();
        let text = harmless(&json);
        assert!(!text.contains('<'));
        let back: String = serde_json::from_str(&text).unwrap();
        assert_eq!(back, "</script><!-- <b>");
    }

    #[test]
    fn a_part_is_never_searched() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "x".to_owned())];
        assert_eq!(replace("1{{a}}2{{b}}3", &parts), "1{{b}}2x3");
    }

    #[test]
    fn the_bundle_can_stand_in_a_page() {
        assert!(!SCRIPT.contains("</script") && !SCRIPT.contains("<!--"));
        assert!(!LICENSES.contains("</script") && !LICENSES.contains("<!--"));
        assert!(!STYLE.contains("</style") && !STYLE.contains("url("));
    }
}
