//! HTML element by element. Texts are escaped where they are put, so that nothing a user named can leave its place.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::svg::escape;
use occupant_files::base::program;

/// Meta data of a page: the program and the subject.
pub fn about(subject: &str) -> String {
    format!("<meta name=\"generator\" content=\"{}\">\n{}", escape(&program()), described(subject))
}

fn described(subject: &str) -> String {
    format!("<meta name=\"description\" content=\"{}\">", escape(subject))
}

/// Largest length of a head up to its style, bytes.
const HEAD: u64 = 4096;

/// Whether a file is a page of the same subject made by any version of this program.
pub fn is_page_of(path: &Path, subject: &str) -> bool {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    let head = String::from_utf8_lossy(&head);
    read.is_ok() && head.contains("<meta name=\"generator\" content=\"occupant ") && head.contains(&described(subject))
}

/// A part of a page.
#[derive(Clone, Debug, Default)]
pub struct Html(String);

/// A cell of a table.
#[derive(Clone, Debug)]
pub enum Cell {
    /// Text, left-aligned.
    Words(String),
    /// A number, right-aligned.
    Number(String),
    /// A number with a mark, and its reason.
    Marked(String, String),
    /// A number, with the reason of its mark if it has one, on a shade from 1 to 5.
    Shaded(String, Option<String>, usize),
}

impl Html {
    /// An element with text; `tag` may include trusted attributes.
    pub fn text(&mut self, tag: &str, text: &str) {
        let name = tag.split(' ').next().unwrap_or(tag);
        self.0.push_str(&format!("<{tag}>{}</{name}>\n", escape(text)));
    }

    /// Inserts HTML unchanged.
    pub fn raw(&mut self, html: &str) {
        self.0.push_str(html);
    }

    /// A table of two text columns.
    pub fn facts(&mut self, facts: &[(&str, String)]) {
        self.raw("<div class=\"scroll\"><table>\n");
        for (name, text) in facts {
            let (name, text) = (escape(name), escape(text));
            self.raw(&format!("<tr><th scope=\"row\">{name}</th><td class=\"wrap\">{text}</td></tr>\n"));
        }
        self.raw("</table></div>\n");
    }

    /// Starts a folded section with this heading.
    pub fn fold(&mut self, line: &str) {
        self.raw(&format!("<details>\n<summary>{}</summary>\n", escape(line)));
    }

    /// Ends the folded section.
    pub fn unfold(&mut self) {
        self.raw("</details>\n");
    }

    /// Adds a table.
    pub fn table(&mut self, head: &[&str], rows: &[Vec<Cell>]) {
        self.table_under(&head.iter().map(|name| escape(name)).collect::<Vec<_>>(), rows);
    }

    /// A table whose headings are HTML.
    pub fn table_under(&mut self, head: &[String], rows: &[Vec<Cell>]) {
        self.raw("<div class=\"scroll\"><table>\n<tr>");
        for (i, name) in head.iter().enumerate() {
            let numbers = rows.first().and_then(|r| r.get(i)).is_some_and(|c| !matches!(c, Cell::Words(_)));
            let class = if numbers { " class=\"number\"" } else { "" };
            self.raw(&format!("<th{class}>{name}</th>"));
        }
        self.raw("</tr>\n");
        for row in rows {
            self.raw("<tr>");
            row.iter().for_each(|cell| self.raw(&cell.html()));
            self.raw("</tr>\n");
        }
        self.raw("</table></div>\n");
    }

    /// The page.
    pub fn finish(self) -> String {
        self.0
    }
}

fn marked(text: &str, why: &str, classes: &str) -> String {
    format!("<td class=\"number marked{classes}\" title=\"{}\">{}\u{a0}†</td>", escape(why), escape(text))
}

impl Cell {
    fn html(&self) -> String {
        match self {
            Cell::Words(text) => format!("<td>{}</td>", escape(text)),
            Cell::Number(text) => format!("<td class=\"number\">{}</td>", escape(text)),
            Cell::Shaded(text, None, shade) => {
                format!("<td class=\"number shade-{shade}\">{}</td>", escape(text))
            }
            Cell::Shaded(text, Some(why), shade) => marked(text, why, &format!(" shade-{shade}")),
            Cell::Marked(text, why) => marked(text, why, ""),
        }
    }

    /// A number, with a mark if there is one.
    pub fn of(text: String, mark: Option<String>) -> Cell {
        match mark {
            Some(why) => Cell::Marked(text, why),
            None => Cell::Number(text),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_stays_a_text() {
        let mut html = Html::default();
        html.text("h2 id=\"r0\"", "</h2><script>");
        html.facts(&[("<b>", "a & b".to_owned())]);
        html.table(&["<i>"], &[vec![Cell::Marked("1".to_owned(), "\" onclick=\"".to_owned())]]);
        let text = html.finish();
        assert!(!text.contains("<script>") && !text.contains("<b>") && !text.contains("<i>"));
        assert!(!text.contains("\" onclick"), "{text}");
    }
}
