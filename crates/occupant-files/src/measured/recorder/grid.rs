//! The layout of a report: its lines as cells, its tables with headings, units and rows, and the lines of words between them.

use std::collections::BTreeMap;

use occupant_scenario::{column_in, column_named, folded, speed_named};
use placed_text::{is_missing, name_and_unit};

use super::words::{self, has};
use crate::signals::{scale_of, seconds_in};

/// Longest report; longer files are records of a laboratory.
const MOST_LINES: usize = 20_000;
/// Lines of headings above a table.
const MOST_HEADS: usize = 3;
/// Lines between two pages of a table.
const BETWEEN_PAGES: usize = 12;

/// A line: its cells, and the places where they begin, in characters.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// Number from 1.
    pub(super) number: usize,
    pub(super) cells: Vec<String>,
    starts: Vec<usize>,
    /// As written, where runs of blanks separate its cells.
    blanks: Option<String>,
}

impl Line {
    pub(super) fn filled(&self) -> usize {
        self.cells.iter().filter(|cell| !cell.is_empty()).count()
    }

    fn first(&self) -> &str {
        self.cells.first().map_or("", String::as_str)
    }

    /// Its cells as one text, folded.
    pub(super) fn words(&self) -> String {
        folded(&self.cells.iter().filter(|cell| !cell.is_empty()).cloned().collect::<Vec<_>>().join(" "))
    }
}

/// A table of a report.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// Headings with the units of the line below.
    pub(super) heads: Vec<String>,
    /// Line of the headings, or of the first row.
    pub(super) line: usize,
    /// Rows with their lines.
    pub(super) rows: Vec<(usize, Vec<String>)>,
    /// Lines of words directly above, folded.
    pub(super) title: String,
    /// Index of its first line, for what stands before it.
    pub(super) at: usize,
}

/// A report.
#[derive(Clone, Debug, Default)]
pub(super) struct Grid {
    pub(super) tables: Vec<Table>,
    /// Lines that belong to no table, with their index.
    pub(super) words: Vec<(usize, Line)>,
}

impl Grid {
    /// The tables of a text; none if it is too long for a report.
    pub(super) fn of(text: &str) -> Option<Grid> {
        let lines = lines(text)?;
        let mut grid = Grid::default();
        let (mut i, mut free) = (0, 0);
        while i < lines.len() {
            let Some((heads, table, end)) = table(&lines, free, i) else {
                i += 1;
                continue;
            };
            grid.words.extend((free..heads).map(|at| (at, lines[at].clone())));
            grid.tables.extend(beside(table));
            (i, free) = (end, end);
        }
        grid.words.extend((free..lines.len()).map(|at| (at, lines[at].clone())));
        Some(grid)
    }
}

/// Tables that stand side by side, each with its own times.
fn beside(table: Table) -> Vec<Table> {
    let times: Vec<usize> = (0..table.heads.len()).filter(|i| column_of(&table.heads[*i]) == Some("t")).collect();
    if times.len() < 2 || times[0] != 0 {
        return vec![table];
    }
    let ends = times.iter().skip(1).copied().chain([table.heads.len()]);
    let part = |(from, to): (&usize, usize)| {
        let cut =
            |cells: &Vec<String>| (*from..to).map(|i| cells.get(i).cloned().unwrap_or_default()).collect::<Vec<_>>();
        let rows = table.rows.iter().map(|(line, cells)| (*line, cut(cells)));
        Table {
            heads: cut(&table.heads),
            rows: rows.filter(|(_, cells)| number(&cells[0]).is_some()).collect(),
            ..table.clone()
        }
    };
    times.iter().zip(ends).map(part).collect()
}

/// How cells are separated.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Sign(char),
    Blanks,
}

fn lines(text: &str) -> Option<Vec<Line>> {
    let all: Vec<&str> = text.lines().collect();
    if all.len() > MOST_LINES {
        return None;
    }
    let has_commas = is_comma_separated(&all);
    let line = |(i, line): (usize, &&str)| {
        let is_blank = |c: char| ['\u{a0}', '\u{202f}', '\u{2009}'].contains(&c) || c.is_control() && c != '\t';
        let line = line.replace(is_blank, " ").replace('\u{feff}', "");
        // dots that lead from a key to its value
        let line = if line.contains("...") || line.contains('…') { without_leaders(&line) } else { line };
        let bare = line.trim();
        if bare.is_empty() || bare.starts_with('#') {
            return None;
        }
        let form = match () {
            () if line.contains('\t') => Form::Sign('\t'),
            () if line.contains(';') => Form::Sign(';'),
            () if line.matches('|').count() > 1 => Form::Sign('|'),
            () if has_commas && line.contains(',') => Form::Sign(','),
            () => Form::Blanks,
        };
        // a rule between the headings and the rows of a table
        if bare.chars().all(|c| "-=_|+: ".contains(c)) && bare.len() > 2 {
            return None;
        }
        let line = if form == Form::Sign('|') { bare.trim_matches('|').to_owned() } else { line };
        let (starts, cells) = split(&line, form).into_iter().unzip();
        let blanks = (form == Form::Blanks).then(|| line.clone());
        Some(Line { number: i + 1, cells, starts, blanks })
    };
    Some(all.iter().enumerate().filter_map(line).collect())
}

fn without_leaders(line: &str) -> String {
    let mut text = line.replace('…', "...");
    while let Some(at) = text.find("...") {
        let length = text[at..].chars().take_while(|c| *c == '.').count();
        text.replace_range(at..at + length, "   ");
    }
    text
}

/// Whether commas separate cells: most lines that begin with a number have only numbers or words between their commas; without such
/// lines, commas stand without a blank behind them.
fn is_comma_separated(lines: &[&str]) -> bool {
    let (mut yes, mut no, mut tight) = (0, 0, 0);
    for line in lines.iter().filter(|line| line.contains(',') && !line.contains(['\t', ';'])) {
        let pieces = split(line, Form::Sign(','));
        let numbers = pieces.iter().filter(|(_, piece)| number(piece).is_some()).count();
        let sound = |(_, piece): &(usize, String)| {
            is_missing(piece) || number(piece).is_some() || !piece.contains(|c: char| c.is_ascii_digit())
        };
        let is_sound = numbers > 0 && pieces.len() > 1 && pieces.iter().all(sound);
        tight += usize::from(!line.contains(", ") || line.contains('"'));
        let first = line.trim_start().trim_start_matches('"');
        if first.starts_with(|c: char| c.is_ascii_digit() || "-+.,\u{2212}".contains(c)) {
            if is_sound { yes += 1 } else { no += 1 }
        } else if is_sound && numbers > 2 {
            // times may stand across
            yes += 1;
        }
    }
    yes > no || (yes == 0 && no == 0 && tight > 1)
}

/// Cells of a line with the characters at which they begin.
fn split(line: &str, form: Form) -> Vec<(usize, String)> {
    let clean = |cell: &str| cell.trim().trim_matches('"').trim().replace("\"\"", "\"");
    let (mut cells, mut cell, mut start, mut quoted, mut blank) = (Vec::new(), String::new(), 0, false, 0);
    for (at, c) in line.chars().enumerate() {
        quoted ^= c == '"' && form != Form::Blanks;
        match form {
            Form::Sign(sign) if c == sign && !quoted => {
                cells.push((start, clean(&cell)));
                cell.clear();
                start = at + 1;
            }
            Form::Blanks if c.is_whitespace() => blank += 1,
            Form::Blanks => {
                if blank > 1 && !cell.trim().is_empty() {
                    cells.push((start, clean(&cell)));
                    cell.clear();
                }
                if cell.is_empty() {
                    start = at;
                } else if blank == 1 {
                    cell.push(' ');
                }
                blank = 0;
                cell.push(c);
            }
            Form::Sign(_) => cell.push(c),
        }
    }
    cells.push((start, clean(&cell)));
    cells
}

/// Words of a line with the characters at which they begin; a number and its second unit in brackets are one.
fn single(line: &str) -> Vec<(usize, String)> {
    let mut cells: Vec<(usize, String)> = Vec::new();
    let mut start = 0;
    for piece in line.split(' ') {
        let length = piece.chars().count();
        if !piece.is_empty() {
            match cells.last_mut().filter(|_| piece.starts_with(['[', '(']) && piece.ends_with([']', ')'])) {
                Some((_, before)) => *before = format!("{before} {piece}"),
                None => cells.push((start, piece.to_owned())),
            }
        }
        start += length + 1;
    }
    cells
}

/// A number as recorders print it: decimal comma, any minus, a unit or a second unit behind it.
pub(super) fn number(cell: &str) -> Option<f64> {
    number_and_unit(cell).map(|(value, _)| value)
}

/// The number of a cell and the text behind it.
pub(super) fn number_and_unit(cell: &str) -> Option<(f64, String)> {
    let plain = cell.trim().replace(['\u{2212}', '\u{2013}', '\u{2011}'], "-");
    let plain = plain.strip_prefix('+').unwrap_or(&plain);
    // as accounts write losses
    if let Some((value, rest)) = plain.strip_prefix('(').and_then(|p| p.strip_suffix(')')).and_then(number_and_unit) {
        return rest.is_empty().then_some((0.0 - value, rest));
    }
    let is_part = |c: char| c.is_ascii_digit() || ".,-".contains(c);
    let end = plain.char_indices().find(|(_, c)| !is_part(*c)).map_or(plain.len(), |(at, _)| at);
    let exponent =
        || plain.parse::<f64>().ok().filter(|x| x.is_finite() && plain.contains(|c: char| c.is_ascii_digit()));
    let parsed = plain[..end].replace(',', ".").parse::<f64>().ok();
    let rest = plain[end..].trim();
    match parsed {
        Some(value) if rest.is_empty() || rest.starts_with(['[', '(']) => Some((value, rest.to_owned())),
        Some(value) if scale_of(rest).is_some() => Some((value, rest.to_owned())),
        _ => exponent().map(|value| (value, String::new())),
    }
}

/// The second number of `-12.4 [-20]`.
pub(super) fn second(cell: &str) -> Option<f64> {
    let (_, rest) = number_and_unit(cell)?;
    number(rest.strip_prefix(['[', '('])?.strip_suffix([']', ')'])?)
}

fn is_value(cell: &str) -> bool {
    number(cell).is_some() || is_missing(cell) || words::state(cell).is_some()
}

/// Whether a line is a row of numbers: it begins with one.
fn is_row(line: &Line) -> bool {
    let cells = row_cells(line);
    let [(_, time), rest @ ..] = &cells[..] else { return false };
    number(time).is_some()
        && !time.ends_with(['.', ','])
        && !rest.is_empty()
        && rest.iter().any(|(_, cell)| is_value(cell))
        && !is_date(time)
}

fn is_date(cell: &str) -> bool {
    cell.matches(['.', '/', '-']).count() > 2
}

/// Cells of a row; single blanks separate them where runs of blanks do not.
fn row_cells(line: &Line) -> Vec<(usize, String)> {
    match &line.blanks {
        Some(text)
            if line.cells.len() < 2 || line.cells.iter().any(|cell| number(cell).is_none() && is_numbers(cell)) =>
        {
            single(text)
        }
        _ => line.starts.iter().copied().zip(line.cells.iter().cloned()).collect(),
    }
}

/// `-0.6 0.1`: cells that one blank separates.
fn is_numbers(cell: &str) -> bool {
    let pieces = single(cell);
    pieces.len() > 1 && pieces.iter().all(|(_, piece)| number(piece).is_some())
}

/// The table whose first row is a line, with the index of its headings, and one past its end.
fn table(lines: &[Line], free: usize, first: usize) -> Option<(usize, Table, usize)> {
    if let Some(found) = across(lines, free, first) {
        return Some(found);
    }
    if !is_row(&lines[first]) {
        return None;
    }
    let mut rows = Vec::new();
    let mut end = first;
    while end < lines.len() && (is_row(&lines[end]) || is_timeless(&lines[end], !rows.is_empty())) {
        rows.push(end);
        end += 1;
    }
    let count = usual_count(lines, &rows);
    let (at, heads) = headings(lines, free, first, count);
    let heads_words: Vec<String> = lines[at..first].iter().map(Line::words).collect();
    // pages of a printout
    let time = |i: usize| row_cells(&lines[i]).first().and_then(|(_, cell)| number(cell));
    while let Some((from, to)) = next_page(lines, end, &heads_words) {
        if time(from) <= time(end - 1) {
            break;
        }
        rows.extend(from..to);
        end = to;
    }
    if rows.len() < 2 && heads.is_empty() {
        return None;
    }
    let width = if heads.is_empty() { count } else { heads.len() };
    let starts: Vec<usize> = heads.iter().map(|(start, _)| *start).collect();
    let row = |i: &usize| (lines[*i].number, fitted(&lines[*i], width, &starts));
    let table = Table {
        line: lines[at].number,
        rows: rows.iter().map(row).collect(),
        title: title(lines, free, at),
        heads: heads.into_iter().map(|(_, head)| head).collect(),
        at,
    };
    Some((at, table, end))
}

/// A row without a time, within a table.
fn is_timeless(line: &Line, within: bool) -> bool {
    within
        && line.blanks.is_none()
        && line.cells.len() > 1
        && is_missing(line.first())
        && line.cells.iter().any(|cell| number(cell).is_some())
}

/// The number of cells that most rows have.
fn usual_count(lines: &[Line], rows: &[usize]) -> usize {
    let mut times: BTreeMap<usize, usize> = BTreeMap::new();
    rows.iter().for_each(|&i| *times.entry(row_cells(&lines[i]).len()).or_default() += 1);
    times.into_iter().max_by_key(|&(count, times)| (times, count)).map_or(0, |(count, _)| count)
}

/// Rows behind repeated headings or a page's foot, from and to.
fn next_page(lines: &[Line], end: usize, heads: &[String]) -> Option<(usize, usize)> {
    let from = (end..lines.len().min(end + BETWEEN_PAGES)).find(|&i| is_row(&lines[i]))?;
    let between = &lines[end..from];
    let repeats = !heads.is_empty()
        && between.len() >= heads.len()
        && between.windows(heads.len()).any(|part| part.iter().map(Line::words).eq(heads.iter().cloned()));
    let is_foot = between.iter().all(|line| line.filled() < 3 && !has(&line.words(), PAGE_ENDS));
    if !(repeats || is_foot && between.iter().any(|line| has(&line.words(), &["page", "seite", "pagina", "p."]))) {
        return None;
    }
    let to = (from..lines.len()).find(|&i| !is_row(&lines[i])).unwrap_or(lines.len());
    Some((from, to))
}

/// What opens another part of a report.
const PAGE_ENDS: words::Stems =
    &["event", "record", "pre-crash", "crash pulse", "delta-v", "ereignis", "evento", "evenement"];

/// Cells of a row, as many as there are headings: by their places where blanks separate them and some are empty.
fn fitted(line: &Line, width: usize, starts: &[usize]) -> Vec<String> {
    let cells: Vec<(usize, String)> = line.starts.iter().copied().zip(line.cells.iter().cloned()).collect();
    let Some(text) = &line.blanks else { return cells.into_iter().map(|(_, cell)| cell).collect() };
    let narrow = single(text);
    let chosen = [cells, narrow.clone()].into_iter().find(|cells| cells.len() == width);
    if let Some(cells) = chosen {
        return cells.into_iter().map(|(_, cell)| cell).collect();
    }
    if narrow.len() > width || starts.len() != width {
        return narrow.into_iter().map(|(_, cell)| cell).collect();
    }
    let mut row = vec![String::new(); width];
    for (start, cell) in narrow {
        let near = (0..width).filter(|&i| row[i].is_empty()).min_by_key(|&i| starts[i].abs_diff(start));
        if let Some(i) = near {
            row[i] = cell;
        }
    }
    row
}

/// Whether a cell names a unit alone.
fn is_unit(cell: &str) -> bool {
    let bare = cell.trim_matches(['[', ']', '(', ')', ' ']);
    cell.is_empty() || cell == "-" || cell == "%" || scale_of(bare.split('[').next().unwrap_or(bare)).is_some()
}

/// Index of the first line of headings, and the headings with their places. None are the lines of another table.
fn headings(lines: &[Line], free: usize, first: usize, count: usize) -> (usize, Vec<(usize, String)>) {
    let mut found: Vec<(usize, String)> = Vec::new();
    let mut at = first;
    while at > free && first - at < MOST_HEADS {
        let own = head_cells(&lines[at - 1], count);
        let filled = own.iter().filter(|(_, cell)| !cell.is_empty()).count();
        let is_known = |head: &str| column_of(head).is_some();
        // the unit of one column alone
        let is_lone = filled == 1
            && found.is_empty()
            && own.iter().all(|(_, cell)| is_unit(cell))
            && lines[at - 1].blanks.is_some();
        if filled < 2 && !is_lone || own.iter().filter(|(_, cell)| number(cell).is_some()).count() > 0 {
            break;
        }
        let is_whole = !found.is_empty()
            && found.iter().any(|(_, head)| is_known(head))
            && found.iter().filter(|(_, head)| !is_unit(head)).count() > 1;
        if is_whole || !found.is_empty() && filled == 2 && (count > 2 || is_key(&lines[at - 1])) {
            break;
        }
        found = if found.is_empty() { own } else { joined(own, found) };
        at -= 1;
    }
    (at, found)
}

/// A line of a key and its value.
fn is_key(line: &Line) -> bool {
    line.cells.len() == 2 && line.cells[0].ends_with(':')
        || line.cells.get(1).is_some_and(|cell| words::state(cell).is_some())
}

/// Cells of a line of headings; where single blanks separate them, each ends with its unit.
fn head_cells(line: &Line, count: usize) -> Vec<(usize, String)> {
    let own: Vec<(usize, String)> = line.starts.iter().copied().zip(line.cells.iter().cloned()).collect();
    let Some(text) = line.blanks.as_ref().filter(|_| own.len() < count) else { return own };
    let mut cells: Vec<(usize, String)> = Vec::new();
    let (mut cell, mut start) = (String::new(), 0);
    for (at, piece) in single_words(text) {
        if cell.is_empty() {
            start = at;
        } else {
            cell.push(' ');
        }
        cell.push_str(&piece);
        if piece.ends_with([')', ']']) {
            cells.push((start, std::mem::take(&mut cell)));
        }
    }
    if !cell.is_empty() {
        cells.push((start, cell));
    }
    let narrow = single_words(text);
    [cells, narrow].into_iter().find(|cells| cells.len() == count).unwrap_or(own)
}

fn single_words(text: &str) -> Vec<(usize, String)> {
    let mut start = 0;
    let mut all = Vec::new();
    for piece in text.split(' ') {
        if !piece.is_empty() {
            all.push((start, piece.to_owned()));
        }
        start += piece.chars().count() + 1;
    }
    all
}

/// Headings over two lines: by columns, or by places.
fn joined(above: Vec<(usize, String)>, below: Vec<(usize, String)>) -> Vec<(usize, String)> {
    let units = below.iter().all(|(_, cell)| is_unit(cell));
    let both = |above: &str, below: &str| match () {
        () if below.is_empty() || below == "-" => above.to_owned(),
        () if above.is_empty() => below.to_owned(),
        () if units && name_and_unit(above).1.is_some() => above.to_owned(),
        () if units && below.starts_with(['[', '(']) => format!("{above} {below}"),
        () if units => format!("{above} [{}]", below.trim_matches(['[', ']', '(', ')', ' '])),
        () => format!("{above} {below}"),
    };
    if above.len() == below.len() {
        return above.iter().zip(&below).map(|((at, a), (_, b))| (*at, both(a, b))).collect();
    }
    let (mut wide, narrow, is_below) = match above.len() > below.len() {
        true => (above, below, true),
        false => (below, above, false),
    };
    let places: Vec<usize> = wide.iter().map(|(at, _)| *at).collect();
    for (at, cell) in narrow {
        let Some(i) = (0..places.len()).min_by_key(|&i| places[i].abs_diff(at)) else { continue };
        wide[i].1 = if is_below { both(&wide[i].1, &cell) } else { both(&cell, &wide[i].1) };
    }
    wide
}

/// Lines of words directly above a table, folded.
fn title(lines: &[Line], free: usize, at: usize) -> String {
    let own = lines[free..at].iter().rev().take(4).take_while(|line| line.filled() == 1);
    own.map(Line::words).collect::<Vec<_>>().join(" | ")
}

/// A table whose times stand in a line: `Time (ms), 0, 10, 20`, and a line for each quantity.
fn across(lines: &[Line], free: usize, first: usize) -> Option<(usize, Table, usize)> {
    let is_line = |line: &Line| {
        let cells: Vec<&String> = line.cells.iter().skip(1).filter(|cell| !cell.is_empty()).collect();
        let numbers = cells.iter().filter(|cell| number(cell).is_some()).count();
        numbers > 2 && cells.iter().all(|cell| is_value(cell)) && line.first().contains(char::is_alphabetic)
    };
    let time = &lines[first];
    if !is_line(time) || column_of(time.first()) != Some("t") {
        return None;
    }
    let is_other = |line: &&Line| {
        line.cells.len() > 2
            && line.first().contains(char::is_alphabetic)
            && column_of(line.first()) != Some("t")
            && line.cells.iter().skip(1).all(|cell| is_value(cell))
    };
    let others: Vec<&Line> = lines[first + 1..].iter().take_while(is_other).collect();
    if others.is_empty() {
        return None;
    }
    let all: Vec<&Line> = std::iter::once(time).chain(others.iter().copied()).collect();
    let cell = |line: &Line, i: usize| line.cells.get(i).cloned().unwrap_or_default();
    let rows = (1..time.cells.len()).map(|i| (time.number, all.iter().map(|line| cell(line, i)).collect()));
    let table = Table {
        heads: all.iter().map(|line| cell(line, 0)).collect(),
        line: time.number,
        rows: rows.collect(),
        title: title(lines, free, first),
        at: first,
    };
    Some((first, table, first + all.len()))
}

/// The column that a heading with or without a unit means, `v` for the vehicle's speed.
pub(super) fn column_of(head: &str) -> Option<&'static str> {
    let (name, unit) = parts(head);
    let scale = unit.as_deref().and_then(scale_of);
    let column = scale.map_or_else(|| column_named(&name), |scale| column_in(&name, scale.dimension));
    column.or_else(|| speed_named(&name).then_some("v"))
}

/// Name and unit of a heading, also of `Delta-V (MPH [km/h])`, `dV long MPH` and `msec`.
pub(super) fn parts(head: &str) -> (String, Option<String>) {
    let known = |unit: &str| scale_of(unit).is_some() && unit != "-";
    let (mut name, mut unit) = name_and_unit(head);
    // a direction in brackets, behind or before the unit
    let mut more = String::new();
    for _ in 0..2 {
        match unit {
            Some(text) if !known(text.split(['[', '(']).next().unwrap_or(text).trim()) => {
                more = format!("{more} ({text})");
                (name, unit) = name_and_unit(name);
            }
            _ => break,
        }
    }
    if let Some(text) = unit {
        let (before, second) = name_and_unit(name);
        // `Delta-V (mph) [km/h]`
        if second.is_some_and(known) {
            return (format!("{before}{more}"), second.map(str::to_owned));
        }
        let text = text.split(['[', '(']).next().unwrap_or(text).trim();
        return (format!("{name}{more}"), Some(text.to_owned()));
    }
    let whole = format!("{name}{more}");
    if seconds_in(&whole).is_some() && whole.len() > 1 {
        return ("t".to_owned(), Some(whole));
    }
    // `t/ms`
    let over = whole
        .split_once('/')
        .filter(|(name, unit)| column_named(name.trim()).is_some() && known(unit.trim()) && !name.trim().is_empty());
    if let Some((name, unit)) = over {
        return (name.trim().to_owned(), Some(unit.trim().to_owned()));
    }
    let last = whole.rsplit_once([' ', '_', ',']).filter(|(rest, unit)| {
        !rest.trim().is_empty() && (unit.len() > 1 || unit.eq_ignore_ascii_case("g")) && known(unit)
    });
    match last {
        // `Zeit in ms`
        Some((rest, unit)) => {
            let rest = rest.trim_end_matches([',', '_', ' ']);
            (rest.strip_suffix(" in").unwrap_or(rest).to_owned(), Some(unit.to_owned()))
        }
        None => (whole, None),
    }
}

/// The second unit of a heading, `km/h` of `(MPH [km/h])`.
pub(super) fn second_unit(head: &str) -> Option<String> {
    let units: Vec<&str> = head
        .split(['(', ')', '[', ']'])
        .map(str::trim)
        .filter(|unit| scale_of(unit).is_some() && *unit != "-")
        .collect();
    units.get(1).map(|unit| (*unit).to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_have_names_and_units() {
        for (head, name, unit) in [
            ("Delta-V, longitudinal (MPH [km/h])", "Delta-V, longitudinal", Some("MPH")),
            ("Delta-V (mph) [km/h]", "Delta-V", Some("mph")),
            ("Sokudo henka [km/h] (zengo)", "Sokudo henka (zengo)", Some("km/h")),
            ("dV long MPH", "dV long", Some("MPH")),
            ("msec", "t", Some("msec")),
            ("t/ms", "t", Some("ms")),
            ("dV long km/h", "dV long", Some("km/h")),
            ("Service Brake (On, Off)", "Service Brake (On, Off)", None),
        ] {
            assert_eq!(parts(head), (name.to_owned(), unit.map(str::to_owned)), "{head}");
        }
        assert_eq!(second_unit("Delta-V (MPH [km/h])").as_deref(), Some("km/h"));
    }

    #[test]
    fn numbers_of_recorders_are_read() {
        for (cell, value) in [
            ("-12.4 [-20]", -12.4),
            ("\u{2212}3,5", -3.5),
            ("(4.5)", -4.5),
            ("48 mph", 48.0),
            ("+2", 2.0),
            ("1e-3", 1e-3),
        ] {
            assert_eq!(number(cell), Some(value), "{cell}");
        }
        assert_eq!(second("-12.4 [-20]"), Some(-20.0));
        for none in ["", "Off", "N/A", "-", "1.2.3", "2nd", "inf", "nan"] {
            assert_eq!(number(none), None, "{none}");
        }
    }

    #[test]
    fn tables_of_blanks_are_split_by_their_headings() {
        let text = "Report\n\n Time      Delta-V,       Delta-V,\n (ms)      longitudinal   lateral\n           (km/h)         (km/h)\n  0          0.0            0.0\n 10                        -1.5\n 20 -5.0 -1.6\n\nPage 2 of 3\n 30   -6.0   -1.7\n";
        let grid = Grid::of(text).unwrap();
        let [table] = &grid.tables[..] else { panic!("{grid:?}") };
        assert_eq!(
            table.heads.iter().map(|head| column_of(head)).collect::<Vec<_>>(),
            [Some("t"), Some("dvx"), Some("dvy")],
            "{table:?}"
        );
        assert_eq!(table.rows.len(), 4, "{table:?}");
        assert_eq!(table.rows[1].1, ["10", "", "-1.5"]);
    }

    #[test]
    fn times_may_stand_across() {
        let text = "CRASH PULSE\nTime (ms),0,10,20\n\"Delta-V, longitudinal (km/h)\",0,-1,-5\nLateral Delta-V (km/h),0,N/A,1\n";
        let grid = Grid::of(text).unwrap();
        assert_eq!(grid.tables[0].heads.len(), 3);
        assert_eq!(grid.tables[0].rows[2].1, ["20", "-5", "1"]);
        assert_eq!(grid.tables[0].title, "crash pulse");
    }
}
