//! Pages of a line printer: 132 columns, 60 lines, the titles and the page number on top, a form feed at the end.

use std::fmt::Display;

/// Columns of a line.
pub(crate) const COLUMNS: usize = 132;
/// Lines of a page, its head included.
pub(crate) const LINES: usize = 60;
/// Lines of the head: two titles, the section, a blank.
const HEAD: usize = 4;
/// Columns of the names of facts.
const MARGIN: usize = 15;
/// Indent of a continued line.
const INDENT: &str = "        ";

/// A printout under construction.
#[derive(Debug)]
pub(crate) struct Pages {
    titles: [String; 2],
    section: String,
    text: String,
    page: usize,
    /// Lines on the present page; 0 before the first.
    line: usize,
}

impl Pages {
    /// No page yet; `titles` are at the top of each.
    pub(crate) fn new(titles: [String; 2]) -> Self {
        Pages { titles, section: String::new(), text: String::new(), page: 0, line: 0 }
    }

    /// The text; every page ends in a form feed.
    pub(crate) fn text(mut self) -> String {
        self.end_page();
        self.text
    }

    /// Starts a page; `section` is below the titles of it and of its continuations.
    pub(crate) fn begin(&mut self, section: &str) {
        self.section = section.to_owned();
        self.turn();
    }

    /// A value, with its name in the margin.
    pub(crate) fn fact(&mut self, name: &str, words: impl Display) {
        self.say(&format!("{name:<MARGIN$}{words}"));
    }

    /// A line of text, folded if too long.
    pub(crate) fn say(&mut self, words: &str) {
        for line in folded(words) {
            if self.line >= LINES {
                self.turn();
            }
            self.put(&line);
        }
    }

    /// Lines that belong together, after a blank: on the next page if they do not fit on this one. Blocks longer than a
    /// page are continued, with the first `head` lines repeated.
    pub(crate) fn block(&mut self, lines: &[String], head: usize) {
        if self.line > HEAD {
            if self.line + 1 + lines.len() <= LINES || self.line + head + 3 < LINES && lines.len() > LINES - HEAD {
                self.put("")
            } else {
                self.turn()
            }
        }
        for (i, line) in lines.iter().enumerate() {
            if self.line >= LINES {
                self.turn();
                for again in lines.iter().take(head.min(i)) {
                    self.put(again);
                }
            }
            self.put(line);
        }
    }

    fn turn(&mut self) {
        self.end_page();
        self.page += 1;
        let number = format!("PAGE {:>4}", self.page);
        let [first, second] = self.titles.clone();
        let room = COLUMNS - number.len() - 2;
        self.put(&format!("{:<room$}  {number}", cut(&first, room)));
        self.put(&second);
        self.put(&self.section.clone());
        self.put("");
    }

    fn end_page(&mut self) {
        if self.page > 0 {
            self.text.push('\u{c}');
        }
        self.line = 0;
    }

    fn put(&mut self, line: &str) {
        self.text.push_str(cut(line, COLUMNS).trim_end());
        self.text.push('\n');
        self.line += 1;
    }
}

/// The first `width` characters; a shortened text ends in `~`. Control characters become blanks.
pub(crate) fn cut(text: &str, width: usize) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    if text.chars().count() > width {
        let kept = text.chars().take(width.saturating_sub(1)).map(plain);
        kept.chain(['~']).collect()
    } else {
        text.chars().map(plain).collect()
    }
}

/// Text folded into lines; continuations are indented.
fn folded(words: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    if words.is_empty() {
        lines.push(String::new());
    }
    for paragraph in words.lines() {
        let mut rest: Vec<char> = paragraph.chars().collect();
        while rest.len() > COLUMNS {
            let within = rest[INDENT.len() + 1..=COLUMNS].iter().rposition(|&c| c == ' ');
            let at = within.map_or(COLUMNS, |at| at + INDENT.len() + 1);
            lines.push(rest[..at].iter().collect());
            let left: String = rest[at..].iter().collect();
            rest = format!("{INDENT}{}", left.trim_start()).chars().collect();
        }
        lines.push(rest.into_iter().collect());
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pages() -> Pages {
        let mut pages = Pages::new(["FIRST".to_owned(), "SECOND".to_owned()]);
        pages.begin("SECTION");
        pages
    }

    fn rows(count: usize) -> Vec<String> {
        (0..count).map(|i| format!("row {i}")).collect()
    }

    #[test]
    fn a_block_that_does_not_fit_moves_to_the_next_page() {
        let mut pages = pages();
        pages.block(&rows(40), 1);
        pages.block(&rows(20), 1);
        let text = pages.text();
        let sheets: Vec<&str> = text.split_terminator('\u{c}').collect();
        assert_eq!(sheets.len(), 2);
        assert_eq!(sheets[0].lines().count(), 44);
        assert!(sheets[1].starts_with("FIRST"));
        assert!(sheets[1].contains("PAGE    2\nSECOND\nSECTION\n\nrow 0\n"));
    }

    #[test]
    fn a_block_longer_than_a_page_goes_on_below_its_head() {
        let mut pages = pages();
        pages.block(&rows(100), 1);
        let text = pages.text();
        let sheets: Vec<&str> = text.split_terminator('\u{c}').collect();
        assert_eq!(sheets.len(), 2);
        assert_eq!(sheets[0].lines().count(), LINES);
        assert!(sheets[1].contains("\n\nrow 0\nrow 56\n"), "{}", sheets[1]);
    }

    #[test]
    fn long_words_are_folded_and_nothing_is_lost() {
        let words = "a word ".repeat(60);
        let lines = folded(words.trim_end());
        assert!(lines.iter().all(|l| l.chars().count() <= COLUMNS));
        let joined: Vec<&str> = lines.iter().flat_map(|l| l.split_whitespace()).collect();
        assert_eq!(joined.join(" "), words.trim_end());
        let one = folded(&"x".repeat(300));
        assert!(one.iter().all(|l| l.chars().count() <= COLUMNS));
        assert_eq!(one.concat().matches('x').count(), 300);
    }

    #[test]
    fn no_words_are_a_blank_line() {
        assert_eq!(folded(""), [""]);
    }

    #[test]
    fn nothing_in_a_title_moves_the_paper() {
        assert_eq!(cut("a\u{c}b\nc", 10), "a b c");
        assert_eq!(cut("abcdef", 4), "abc~");
    }
}
