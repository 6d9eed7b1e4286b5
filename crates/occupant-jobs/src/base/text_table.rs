//! Text tables: columns as wide as their widest cell, numbers aligned right, headings and texts over several lines if
//! the terminal is narrow.

use std::sync::atomic::{AtomicUsize, Ordering};

/// Alignment of a column.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Text.
    Left,
    /// Numbers.
    Right,
}

/// A table: a head and rows of cells.
#[derive(Clone, Debug)]
pub struct Table {
    columns: Vec<Align>,
    rows: Vec<Vec<String>>,
}

/// Blanks between columns, fewer if space is short.
const GAPS: [usize; 3] = [3, 2, 1];
/// Width of a table, characters, if standard output is no terminal.
const PLAIN: usize = 80;
/// Least width of a text column.
const LEAST: usize = 10;
/// Shown where there is no value.
pub const NONE: &str = "–";

impl Table {
    /// A table with lists of headings of the same alignment.
    pub fn new(heads: &[(Align, &[&str])]) -> Self {
        let names = || heads.iter().flat_map(|(align, names)| names.iter().map(move |name| (*align, *name)));
        Table {
            columns: names().map(|(align, _)| align).collect(),
            rows: vec![names().map(|(_, name)| name.to_owned()).collect()],
        }
    }

    /// Adds a row; cells that are missing at its end are blank.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The text, each line ended, without trailing blanks, at most as wide as the terminal.
    pub fn text(&self) -> String {
        let (room, is_terminal) = room();
        self.within(room, is_terminal)
    }

    /// The text within a number of characters; for human readers, names are broken before it becomes wider.
    fn within(&self, room: usize, breaks_names: bool) -> String {
        let whole = self.widths(length);
        let fits = |widths: &[usize], gap: &&usize| {
            widths.iter().sum::<usize>() + **gap * widths.len().saturating_sub(1) <= room
        };
        if let Some(gap) = GAPS[..2].iter().find(|gap| fits(&whole, gap)) {
            return self.set(&whole, *gap);
        }
        // heads over several lines
        let longest_word = |cell: &str| cell.split(' ').map(length).max().unwrap_or(0);
        let mut widths = self.body_widths();
        let heads = self.rows.first().into_iter().flatten();
        widths.iter_mut().zip(heads).for_each(|(width, head)| *width = (*width).max(longest_word(head)));
        if let Some(gap) = GAPS.iter().find(|gap| fits(&widths, gap)) {
            return self.set(&widths, *gap);
        }
        // words too
        let part = |cell: &str| pieces(cell).map(length).max().unwrap_or(0);
        let narrowest = if breaks_names { self.widths(part) } else { self.widths(longest_word) };
        let can = |widths: &[usize], i: usize| self.columns[i] == Align::Left && widths[i] > narrowest[i].max(LEAST);
        while !fits(&widths, &&GAPS[2])
            && let Some(widest) = (0..widths.len()).filter(|i| can(&widths, *i)).max_by_key(|i| widths[*i])
        {
            widths[widest] -= 1;
        }
        self.set(&widths, GAPS[2])
    }

    fn widths(&self, of: impl Fn(&str) -> usize) -> Vec<usize> {
        let width = |column: usize| self.rows.iter().filter_map(|row| row.get(column)).map(|cell| of(cell)).max();
        (0..self.columns.len()).map(|column| width(column).unwrap_or(0)).collect()
    }

    /// Widths of the body columns.
    fn body_widths(&self) -> Vec<usize> {
        let body = Table { columns: self.columns.clone(), rows: self.rows.iter().skip(1).cloned().collect() };
        body.widths(length)
    }

    /// The text with columns of these widths.
    fn set(&self, widths: &[usize], gap: usize) -> String {
        let mut text = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            let cells: Vec<Vec<String>> = row.iter().zip(widths).map(|(cell, width)| wrapped(cell, *width)).collect();
            let lines = cells.iter().map(Vec::len).max().unwrap_or(0);
            for line in 0..lines {
                // heads stand on the numbers below them
                let at = |cell: &Vec<String>| if i == 0 { (line + cell.len()).checked_sub(lines) } else { Some(line) };
                let words = |cell: &Vec<String>| at(cell).and_then(|at| cell.get(at).cloned()).unwrap_or_default();
                let set = cells.iter().zip(widths).zip(&self.columns).map(|((cell, &width), align)| match align {
                    Align::Left => format!("{:<width$}", words(cell)),
                    Align::Right => format!("{:>width$}", words(cell)),
                });
                text.push_str(set.collect::<Vec<String>>().join(&" ".repeat(gap)).trim_end());
                text.push('\n');
            }
        }
        text
    }
}

/// Width of the terminal, characters; 0 without one.
static TERMINAL: AtomicUsize = AtomicUsize::new(0);

/// Fits tables to a terminal of this width from now on.
pub fn fit_terminal(columns: u16) {
    TERMINAL.store(usize::from(columns).max(PLAIN / 2), Ordering::Relaxed);
}

/// Available width, and whether it is that of a terminal.
fn room() -> (usize, bool) {
    match TERMINAL.load(Ordering::Relaxed) {
        0 => (PLAIN, false),
        columns => (columns, true),
    }
}

fn length(cell: &str) -> usize {
    cell.chars().count()
}

/// Pieces into which a cell may be broken: words, and parts of names.
fn pieces(cell: &str) -> impl Iterator<Item = &str> {
    cell.split(' ').flat_map(|word| word.split_inclusive('_'))
}

/// Lines of a cell, broken at blanks, and within a name that is too wide alone.
fn wrapped(cell: &str, width: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut put = |gap: &str, piece: &str| match lines.last_mut() {
        Some(line) if line.is_empty() => line.push_str(piece),
        Some(line) if length(line) + length(gap) + length(piece) <= width => *line += &format!("{gap}{piece}"),
        _ => lines.push(piece.to_owned()),
    };
    if length(cell) <= width {
        return vec![cell.to_owned()];
    }
    for word in cell.split(' ') {
        let whole = length(word) <= width;
        let pieces = word.split_inclusive(|sign| sign == '_' && !whole).enumerate();
        pieces.for_each(|(i, piece)| put(if i == 0 { " " } else { "" }, piece));
    }
    lines
}

/// The text of a table with these rows.
pub fn table<R: IntoIterator<Item = String>>(heads: &[(Align, &[&str])], rows: impl IntoIterator<Item = R>) -> String {
    let mut table = Table::new(heads);
    rows.into_iter().for_each(|row| table.row(row));
    table.text()
}

pub use placed_text::{trimmed, without_zeros};

/// A number with this many decimals; with an exponent if it is too wide.
pub fn number(value: f64, decimals: usize) -> String {
    let digits = if value.abs() < 1e6 { format!("{value:.decimals$}") } else { format!("{value:.2e}") };
    let is_nothing = digits.bytes().all(|digit| b"-0.".contains(&digit));
    if is_nothing { digits.replace('-', "") } else { digits }
}

/// Two text columns without headings: names and descriptions, wrapped on narrow terminals.
pub fn facts(facts: &[(&str, String)]) -> String {
    let (room, is_terminal) = room();
    facts_within(facts, if is_terminal { room } else { usize::MAX })
}

fn facts_within(facts: &[(&str, String)], room: usize) -> String {
    let width = facts.iter().map(|(name, _)| length(name)).max().unwrap_or(0);
    let lines = facts.iter().map(|(name, words)| {
        let words = wrapped(words, room.saturating_sub(width + GAPS[0]).max(LEAST));
        format!("{name:<width$}   {}\n", words.join(&format!("\n{:width$}   ", "")))
    });
    lines.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_whatever_the_script() {
        let mut table = Table::new(&[(Align::Left, &["joint"]), (Align::Right, &["β, °"])]);
        table.row(["neck".to_owned(), "3.5".to_owned()]);
        table.row(["left_shoulder".to_owned(), "127.0".to_owned()]);
        table.row(["blank".to_owned()]);
        let expected = "joint            β, °\nneck              3.5\nleft_shoulder   127.0\nblank\n";
        assert_eq!(table.text(), expected);
    }

    #[test]
    fn a_narrow_terminal_breaks_heads_then_words() {
        let mut table =
            Table::new(&[(Align::Left, &["sphere", "stiffest material"]), (Align::Right, &["effective mass, kg"])]);
        table.row(["head".to_owned(), "windscreen of glass".to_owned(), "4.200".to_owned()]);
        let wide = table.within(80, true);
        assert_eq!(
            wide,
            "sphere   stiffest material     effective mass, kg\nhead     windscreen of glass                4.200\n"
        );
        let heads = "                               effective\nsphere   stiffest material      mass, kg\nhead     windscreen of glass       4.200\n";
        assert_eq!(table.within(40, true), heads);
        for room in 27..80 {
            assert!(
                table.within(room, true).lines().all(|line| length(line) <= room),
                "{room}: {}",
                table.within(room, true)
            );
        }
        assert!(table.within(5, true).contains("windscreen"), "what has no room is shown all the same");
    }

    #[test]
    fn numbers_that_fit_no_column_get_an_exponent() {
        assert_eq!(number(-12.345, 1), "-12.3");
        assert_eq!(number(4.6e34, 1), "4.60e34");
        assert_eq!(number(f64::INFINITY, 0), "inf");
    }

    #[test]
    fn facts_line_up() {
        let text = facts(&[("a", "one".to_owned()), ("longer", "two".to_owned())]);
        assert_eq!(text, "a        one\nlonger   two\n");
        let text = facts_within(&[("longer", "a long way to go".to_owned())], 20);
        assert_eq!(text, "longer   a long way\n         to go\n");
    }
}
