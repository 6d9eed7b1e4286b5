//! Tables of the printout: a title with the units, a head, rows; names are cut where a line has no room for them.

use super::page::cut;
use super::{COLUMNS, Pages};

/// Blanks between columns.
const GAP: usize = 2;
/// Smallest width of names.
const SHORTEST: usize = 6;

/// A table under construction.
#[derive(Debug)]
pub(crate) struct Table {
    title: String,
    /// By column: whether it is text, aligned to the left.
    words: Vec<bool>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table; headings are separated by `|`, and those of text columns begin with `<`.
    pub(crate) fn new(title: impl Into<String>, heads: &str) -> Self {
        Table {
            title: title.into(),
            words: heads.split('|').map(|h| h.starts_with('<')).collect(),
            rows: vec![heads.split('|').map(|h| h.trim_start_matches('<').to_owned()).collect()],
        }
    }

    /// Adds a row; cells missing at its end are blank.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// Adds a row that is made of several parts.
    pub(crate) fn row_of(&mut self, parts: &[&[String]]) {
        self.rows.push(parts.concat());
    }

    /// Writes it, or `lines` instead if it has no rows.
    pub(crate) fn write_or(&self, pages: &mut Pages, lines: &[&str]) {
        match self.rows.len() {
            1 => pages.block(&lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>(), 0),
            _ => self.write(pages),
        }
    }

    /// Writes it; title and headings are repeated on continuation pages. Columns of numbers that do not fit on a line
    /// follow below the others.
    pub(crate) fn write(&self, pages: &mut Pages) {
        let widths = self.widths();
        let fit = (1..=widths.len()).rev().find(|count| taken(&widths[..*count]) <= COLUMNS).unwrap_or(1);
        if fit < widths.len() && !self.words.contains(&true) {
            let parts = |from: usize, to: usize| Table {
                title: self.title.clone(),
                words: self.words[from..to].to_vec(),
                rows: self.rows.iter().map(|row| row.iter().take(to).skip(from).cloned().collect()).collect(),
            };
            parts(0, fit).write(pages);
            return parts(fit, widths.len()).write(pages);
        }
        let mut lines = vec![self.title.clone()];
        lines.extend(self.rows.iter().map(|row| self.line(row, &widths)));
        pages.block(&lines, 2);
    }

    fn widths(&self) -> Vec<usize> {
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let mut widths: Vec<usize> = (0..self.words.len()).map(width).collect();
        let mut excess = taken(&widths).saturating_sub(COLUMNS);
        while excess > 0 {
            let names = widths.iter_mut().zip(&self.words).filter(|(_, words)| **words);
            match names.map(|(w, _)| w).max() {
                Some(widest) if *widest > SHORTEST => *widest -= 1,
                _ => break,
            }
            excess -= 1;
        }
        widths
    }

    fn line(&self, row: &[String], widths: &[usize]) -> String {
        let cells = row.iter().zip(widths).zip(&self.words);
        let set = cells.map(
            |((cell, &width), &words)| {
                if words { format!("{:<width$}", cut(cell, width)) } else { format!("{cell:>width$}") }
            },
        );
        set.collect::<Vec<String>>().join("  ")
    }
}

/// Width of a line with cells of these widths.
fn taken(widths: &[usize]) -> usize {
    widths.iter().sum::<usize>() + GAP * widths.len().saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_without_room_stand_below_the_others() {
        let mut table = Table::new("T", &["LONG HEAD"; 30].join("|"));
        table.row((0..30).map(|i| i.to_string()));
        let mut pages = Pages::new(["A".to_owned(), "B".to_owned()]);
        pages.begin("S");
        table.write(&mut pages);
        let text = pages.text();
        assert!(text.lines().all(|line| line.chars().count() <= COLUMNS && !line.contains('~')));
        assert!((0..30).all(|i| text.split_whitespace().any(|word| word == i.to_string())));
    }

    #[test]
    fn names_give_way_to_numbers() {
        let mut table = Table::new("T", "<NAME|X");
        table.row(["n".repeat(200), "12345.678".to_owned()]);
        let widths = table.widths();
        assert_eq!(widths, [COLUMNS - GAP - 9, 9]);
        let line = table.line(&table.rows[1], &widths);
        assert_eq!(line.chars().count(), COLUMNS);
        assert!(line.ends_with("n~  12345.678"));
    }
}
