//! Tables of force elements, a row for each element of a kind.

use occupant_core::forces::table::{Cell, Column, Holds, Table as Elements, Tables};
use occupant_core::results::summary::word;

use super::summary::{Marks, ms};
use crate::base::Units;
use crate::base::text_table::Align::{Left, Right};
use crate::base::text_table::{NONE, table};

/// A table for each kind of element present.
pub(crate) fn texts(tables: &Tables, marks: &Marks, units: Units) -> impl Iterator<Item = String> {
    let there = tables.iter().filter(|(_, elements)| !elements.rows.is_empty());
    there.map(move |(of, elements)| text(of, elements, marks, units))
}

fn text(of: &str, Elements { columns, rows }: &Elements, marks: &Marks, units: Units) -> String {
    let align = |column: &Column| if column.holds == Holds::Text { Left } else { Right };
    let words: Vec<String> = columns.iter().map(|column| units.heading(column.heading)).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let heads: Vec<_> = columns.iter().map(align).zip(words.iter().map(std::slice::from_ref)).collect();
    let rows = rows.iter().map(|row| {
        let name = word(row.values().next().and_then(Cell::text).unwrap_or_default());
        let mark = |(column, cell): (&Column, &Cell)| match column.measure {
            Some((measure, _)) => marks.put(&format!("{of}.{name}.{measure}"), printed(column, cell, units)),
            None => printed(column, cell, units),
        };
        columns.iter().zip(row.values()).map(mark).collect::<Vec<_>>()
    });
    table(&heads, rows)
}

fn printed(column: &Column, cell: &Cell, units: Units) -> String {
    match (cell, column.holds) {
        (Cell::Text(text), _) => text.clone(),
        (Cell::Number(None), _) => NONE.to_owned(),
        (Cell::Number(Some(time_s)), Holds::Time) => ms(*time_s),
        (Cell::Number(Some(value)), _) => units.below(column.heading, value * column.scale, column.decimals),
    }
}
