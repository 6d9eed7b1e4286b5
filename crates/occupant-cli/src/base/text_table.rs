//! Text tables: columns as wide as their widest cell, numbers to the right.

/// How a column is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Align {
    /// Words.
    Left,
    /// Numbers.
    Right,
}

/// A table: a head and rows of cells.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    columns: Vec<Align>,
    rows: Vec<Vec<String>>,
}

/// Blanks between columns.
const GAP: &str = "   ";
/// Stands where there is no figure.
pub(crate) const NONE: &str = "–";

impl Table {
    /// A table whose head is made of lists of names that are set alike.
    pub(crate) fn new(heads: &[(Align, &[&str])]) -> Self {
        let names = || heads.iter().flat_map(|(align, names)| names.iter().map(move |name| (*align, *name)));
        Table {
            columns: names().map(|(align, _)| align).collect(),
            rows: vec![names().map(|(_, name)| name.to_owned()).collect()],
        }
    }

    /// Adds a row; cells that are missing at its end are blank.
    pub(crate) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }

    /// The text, each line ended, no blanks at line ends.
    pub(crate) fn text(&self) -> String {
        let width = |column: usize| {
            let cells = self.rows.iter().filter_map(|row| row.get(column));
            cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.columns.len()).map(width).collect();
        let mut text = String::new();
        for row in &self.rows {
            let cells = row.iter().zip(&widths).zip(&self.columns);
            let set = cells.map(|((cell, &width), align)| match align {
                Align::Left => format!("{cell:<width$}"),
                Align::Right => format!("{cell:>width$}"),
            });
            let line = set.collect::<Vec<String>>().join(GAP);
            text.push_str(line.trim_end());
            text.push('\n');
        }
        text
    }
}

/// The text of a table with these rows.
pub(crate) fn table<R: IntoIterator<Item = String>>(
    heads: &[(Align, &[&str])],
    rows: impl IntoIterator<Item = R>,
) -> String {
    let mut table = Table::new(heads);
    rows.into_iter().for_each(|row| table.row(row));
    table.text()
}

/// A number with so many decimals; one that no column holds, with an exponent.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    let digits = if value.abs() < 1e6 { format!("{value:.decimals$}") } else { format!("{value:.2e}") };
    let is_nothing = digits.bytes().all(|digit| b"-0.".contains(&digit));
    if is_nothing { digits.replace('-', "") } else { digits }
}

/// A number with so many decimals at most: without the zeros at its end.
pub(crate) fn trimmed(value: f64, decimals: usize) -> String {
    without_zeros(&format!("{value:.decimals$}")).to_owned()
}

/// The digits of a number with decimals without the zeros at their end.
pub(crate) fn without_zeros(digits: &str) -> &str {
    digits.trim_end_matches('0').trim_end_matches('.')
}

/// Two columns of words without a head: a name and its description.
pub(crate) fn facts(facts: &[(&str, String)]) -> String {
    let width = facts.iter().map(|(name, _)| name.chars().count()).max();
    let width = width.unwrap_or(0);
    let lines = facts.iter().map(|(name, words)| format!("{name:<width$}{GAP}{words}\n"));
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
    fn numbers_that_fit_no_column_get_an_exponent() {
        assert_eq!(number(-12.345, 1), "-12.3");
        assert_eq!(number(4.6e34, 1), "4.60e34");
        assert_eq!(number(f64::INFINITY, 0), "inf");
    }

    #[test]
    fn facts_line_up() {
        let text = facts(&[("a", "one".to_owned()), ("longer", "two".to_owned())]);
        assert_eq!(text, "a        one\nlonger   two\n");
    }
}
