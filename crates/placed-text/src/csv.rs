//! Lines and cells of a text table, with their places: numbers and the names of columns.

use crate::shown::shortened;
use crate::source::{SourceId, Sources, Span};

/// A cell: its text and position.
#[derive(Clone, Copy)]
pub struct Cell<'a> {
    /// Its text, trimmed.
    pub text: &'a str,
    /// Its position.
    pub span: Span,
}

/// Largest number of cells of a line; a line with more is refused.
pub const MOST_CELLS: usize = 10_000;

/// Characters of a cell shown in messages.
pub const CELL: usize = 40;

/// `x[m]` or `x (m)` → `x` and `m`.
pub fn name_and_unit(text: &str) -> (&str, Option<&str>) {
    let text = text.trim();
    for (open, close) in [('[', ']'), ('(', ')')] {
        if let Some((name, unit)) = text.strip_suffix(close).and_then(|t| t.rsplit_once(open)) {
            return (name.trim(), Some(unit.trim()));
        }
    }
    (text, None)
}

/// Separator of a text's cells: semicolon, tab, comma, or blanks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Separator(char);

impl Separator {
    /// Separator of a text whose first line is `line`.
    pub fn of(line: &str) -> Self {
        let used = |sign: &char| line.trim_end().contains(*sign);
        Separator([';', '\t', ','].into_iter().find(used).unwrap_or(' '))
    }

    /// Separator of a line of numbers: blanks where they separate numbers and commas do not, as with decimal commas.
    fn of_numbers(line: &str) -> Self {
        let usual = Separator::of(line);
        let all = |separator: Separator| {
            let is_value = |text: &str| is_missing(text) || separator.is_number(text);
            separator.pieces(line).iter().all(|(_, piece)| is_value(piece.trim().trim_matches('"')))
        };
        if usual.0 == ',' && !all(usual) && all(Separator(' ')) { Separator(' ') } else { usual }
    }

    fn is_number(self, text: &str) -> bool {
        self.value(text).is_some()
    }

    /// A finite number; a typographic minus and the D exponent of Fortran are allowed.
    fn value(self, text: &str) -> Option<f64> {
        let point = if self.0 == ',' { text.to_owned() } else { text.replace(',', ".") };
        let point = point.replace(['\u{2212}', '\u{2013}'], "-");
        let exponent = || point.replacen(['D', 'd'], "E", 1).parse().ok();
        point.parse().ok().or_else(exponent).filter(|x: &f64| x.is_finite())
    }

    /// Pieces of a line with their start positions. Separators in double quotes do not count, nor does a blank between
    /// a name and its unit.
    fn pieces(self, line: &str) -> Vec<(usize, &str)> {
        let (mut pieces, mut start, mut quoted) = (Vec::new(), 0, false);
        for (at, sign) in line.char_indices() {
            quoted ^= sign == '"';
            let separates = match self.0 {
                ' ' => sign.is_whitespace() && !line[at..].trim_start().starts_with(['[', '(']),
                separator => sign == separator,
            };
            if separates && !quoted {
                pieces.push((start, &line[start..at]));
                start = at + sign.len_utf8();
            }
        }
        pieces.push((start, &line[start..]));
        pieces.retain(|(_, piece)| self.0 != ' ' || !piece.is_empty());
        pieces
    }

    /// Cells of a line, trimmed and unquoted. A byte-order mark is skipped.
    pub fn cells(self, sources: &Sources, line: Span) -> Vec<Cell<'_>> {
        let text = sources.slice(line);
        let padding = |c: char| c.is_whitespace() || c == '"' || c == '\u{feff}';
        let cell = |(from, piece): (usize, &'_ str)| {
            let from = line.start + from;
            let lead = piece.len() - piece.trim_start_matches(padding).len();
            let text = piece.trim_matches(padding).len();
            let (start, end) = if text == 0 { (from, from + piece.len()) } else { (from + lead, from + lead + text) };
            let span = Span { source: line.source, start, end };
            Cell { text: if text == 0 { "" } else { sources.slice(span) }, span }
        };
        self.pieces(text).into_iter().take(MOST_CELLS + 1).map(cell).collect()
    }

    /// Number in a cell; a decimal comma is allowed if commas do not separate cells.
    ///
    /// # Errors
    /// What was found instead of a finite number.
    pub fn number(self, cell: &Cell) -> Result<f64, String> {
        self.value(cell.text).ok_or_else(|| match cell.text {
            "" => "an empty cell".to_owned(),
            text => format!("`{}`", shortened(text, CELL)),
        })
    }
}

/// Words for a missing value.
const MISSING: [&str; 32] = [
    "",
    "-",
    "--",
    "---",
    "***",
    "nan",
    "novalue",
    "n/a",
    "#n/a",
    "na",
    "sna",
    "null",
    "none",
    "invalid",
    "not available",
    "data not available",
    "not recorded",
    "unknown",
    "–",
    "—",
    "\u{2212}",
    "n.a.",
    "n.v.",
    "n.d.",
    "k.a.",
    "s/d",
    "n/d",
    "unbekannt",
    "nicht verfügbar",
    "non disponible",
    "no disponible",
    "fumei",
];

/// Whether a cell marks a missing value.
pub fn is_missing(text: &str) -> bool {
    MISSING.contains(&text.trim().to_lowercase().as_str())
}

/// A text table: headings, optional units below them, and lines of cells.
pub struct TextTable<'a> {
    /// Separator of its cells.
    pub separator: Separator,
    /// Its first line.
    pub first: Span,
    /// Its headings; none if it starts with numbers.
    pub headings: Vec<Cell<'a>>,
    /// Units from a separate line below the headings; none if there is no such line.
    pub units: Vec<Cell<'a>>,
    /// The lines below.
    pub lines: Vec<Span>,
    /// Number of text lines before it.
    pub before: usize,
    /// The first line after it that does not belong to it.
    pub behind: Option<Span>,
}

impl<'a> TextTable<'a> {
    /// The table in a text, none in an empty one; `is_unit` recognises a unit without brackets. Text may surround it;
    /// of several tables the longest is used.
    pub fn of(sources: &'a Sources, id: SourceId, is_unit: impl Fn(&str) -> bool) -> Option<Self> {
        let lines: Vec<Span> = lines(sources, id).collect();
        let Some(body) = Body::longest(sources, &lines) else { return Self::at_first(sources, lines, is_unit) };
        let Body { separator, first, .. } = body;
        let cells = |line: usize| separator.cells(sources, lines[line]);
        let names_units = |cell: &Cell| matches!(cell.text, "" | "-") || is_unit(bare(cell.text));
        let is_head = |line: usize| line == 0 || cells(line).len() > 1;
        let above = |line: usize| line.checked_sub(1).filter(|line| is_head(*line));
        let (heads, units) = match above(first) {
            // units may stand below the headings
            Some(last) => match above(last).filter(|_| cells(last).iter().all(names_units)) {
                Some(heads) if cells(heads).len() == cells(last).len() => (Some(heads), Some(last)),
                _ => (Some(last), None),
            },
            None => (None, None),
        };
        let start = heads.unwrap_or(first);
        let (start, numbers, end) = pages(sources, &lines, &body, start);
        Some(TextTable {
            separator,
            first: lines[start],
            headings: heads.map(cells).unwrap_or_default(),
            units: units.map(cells).unwrap_or_default(),
            lines: numbers,
            before: start,
            behind: lines.get(end).copied(),
        })
    }

    /// The table that starts with the first line, if no two lines of numbers match.
    fn at_first(sources: &'a Sources, lines: Vec<Span>, is_unit: impl Fn(&str) -> bool) -> Option<Self> {
        let mut lines = lines.into_iter().peekable();
        let first = lines.peek().copied()?;
        let separator = Separator::of(sources.slice(first));
        let cells = |line: Span| separator.cells(sources, line);
        let has_number = |line: Span| cells(line).iter().any(|cell| separator.number(cell).is_ok());
        let headings = lines.next_if(|line| !has_number(*line)).map(cells);
        let names_units = |cell: &Cell| matches!(cell.text, "" | "-") || is_unit(bare(cell.text));
        let units =
            lines.next_if(|line| headings.is_some() && !has_number(*line) && cells(*line).iter().all(names_units));
        let (headings, units) = (headings.unwrap_or_default(), units.map(cells).unwrap_or_default());
        Some(TextTable { separator, first, headings, units, lines: lines.collect(), before: 0, behind: None })
    }

    /// The unit of a column, from its heading or the line below, with its position; none if there is none.
    pub fn unit(&self, column: usize) -> Option<(&'a str, Span)> {
        let heading = self.headings.get(column)?;
        let below =
            || self.units.get(column).map(|cell| (bare(cell.text), cell.span)).filter(|(unit, _)| !unit.is_empty());
        name_and_unit(heading.text).1.map(|unit| (unit, heading.span)).or_else(below)
    }
}

/// Largest number of lines skipped between two pages of a printout: title, page number.
const BETWEEN_PAGES: usize = 12;

/// A table with headings repeated on every page: its first line, its lines of numbers, and one past its last line.
fn pages(sources: &Sources, lines: &[Span], body: &Body, start: usize) -> (usize, Vec<Span>, usize) {
    let words = |line: &Span| sources.slice(*line).split_whitespace().collect::<Vec<_>>();
    let heads: Vec<_> = lines[start..body.first].iter().map(words).collect();
    let page = |at: usize| {
        let same = lines.get(at..at + heads.len()).is_some_and(|own| own.iter().map(words).eq(heads.iter().cloned()));
        let from = (same && at + heads.len() < lines.len()).then_some(at + heads.len())?;
        Body::from(sources, lines, from).filter(|page| page.count == body.count)
    };
    // a page continues with the times; another table of the same headings begins anew
    let time =
        |line: usize| body.separator.cells(sources, lines[line]).first().and_then(|c| body.separator.value(c.text));
    let goes_on = |end: usize, page: &Body| time(page.first) > time(end - 1);
    let follow = |first: usize, end: usize| {
        let (mut end, mut all) = (end, lines[first..end].to_vec());
        while let Some(next) = (end..end + BETWEEN_PAGES).find_map(page).filter(|next| goes_on(end, next)) {
            all.extend_from_slice(&lines[next.first..next.end]);
            end = next.end;
        }
        (all, end)
    };
    let earlier = (0..start).filter(|_| !heads.is_empty()).find_map(|at| {
        let first = page(at)?;
        let (all, end) = follow(first.first, first.end);
        (end >= body.end).then_some((at, all, end))
    });
    earlier.unwrap_or_else(|| match heads.is_empty() {
        true => (start, lines[body.first..body.end].to_vec(), body.end),
        false => {
            let (all, end) = follow(body.first, body.end);
            (start, all, end)
        }
    })
}

/// Lines of numbers of a table.
struct Body {
    separator: Separator,
    /// Its first line.
    first: usize,
    /// One past its last.
    end: usize,
    /// Cells per line.
    count: usize,
}

impl Body {
    /// The longest table among the lines.
    fn longest(sources: &Sources, lines: &[Span]) -> Option<Body> {
        let (mut best, mut i): (Option<Body>, usize) = (None, 0);
        while i < lines.len() {
            let Some(body) = Body::from(sources, lines, i) else {
                i += 1;
                continue;
            };
            i = body.end;
            if best.as_ref().is_none_or(|best| body.end - body.first > best.end - best.first) {
                best = Some(body);
            }
        }
        best
    }

    /// The table whose numbers start at a line: two matching lines, or one at the end of the text.
    fn from(sources: &Sources, lines: &[Span], first: usize) -> Option<Body> {
        let separator = Separator::of_numbers(sources.slice(lines[first]));
        let count = numbers(sources, separator, lines[first])?;
        let mut body = Body { separator, first, end: first + 1, count };
        let mut agree = 1;
        for (i, line) in lines.iter().enumerate().skip(first + 1) {
            match numbers(sources, separator, *line) {
                Some(count) if count == body.count => (body.end, agree) = (i + 1, agree + 1),
                // a wrong line within a table has numbers, a heading or a title has none
                _ if has_number(sources, separator, *line) && agree > 1 => {}
                _ => break,
            }
        }
        // what is wrong at the end is a part of the table too
        let wrong =
            |line: &&Span| has_number(sources, separator, **line) && numbers(sources, separator, **line) != Some(count);
        let after = lines[body.end..].iter().take_while(wrong).count();
        if body.end + after == lines.len() {
            body.end = lines.len();
        }
        let stands_alone = first == 0 || !has_number(sources, separator, lines[first - 1]);
        (agree > 1 || (first + 1 == lines.len() && stands_alone)).then_some(body)
    }
}

fn has_number(sources: &Sources, separator: Separator, line: Span) -> bool {
    separator.cells(sources, line).iter().any(|cell| separator.number(cell).is_ok())
}

/// Number of cells of a line, if most nonempty ones are numbers. A separator at the end opens no cell.
fn numbers(sources: &Sources, separator: Separator, line: Span) -> Option<usize> {
    let cells = separator.cells(sources, line);
    let told = cells.iter().filter(|cell| !is_missing(cell.text)).count();
    let numbers = cells.iter().filter(|cell| separator.number(cell).is_ok()).count();
    (2 * numbers > told).then_some(cells.len())
}

/// A unit without its brackets.
fn bare(unit: &str) -> &str {
    unit.trim_matches(['[', ']', '(', ')'])
}

/// The nonempty lines of a text.
pub fn lines(sources: &Sources, id: SourceId) -> impl Iterator<Item = Span> {
    let mut start = 0;
    sources
        .text(id)
        .split_inclusive('\n')
        .map(move |line| {
            let from = start;
            start += line.len();
            (line, from)
        })
        .filter(|(line, _)| {
            let line = line.trim_start_matches('\u{feff}').trim();
            !line.is_empty() && !line.starts_with('#')
        })
        .map(move |(line, from)| Span { source: id, start: from, end: from + line.trim_end().len() })
}
