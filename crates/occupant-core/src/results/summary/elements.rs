//! Peaks of force elements.

use super::Peak;
use crate::forces::shown::{Reported, Tracked};
use crate::forces::table::{Cell, Table, Tables};
use crate::forces::{Listed, Visitor, visit_kinds};
use crate::model::Model;

/// Elements of the kinds with peaks, in the order of [`Peaks`](crate::results::peaks::Peaks).
#[derive(Clone, Debug, Default)]
pub(super) struct Elements(Vec<OfKind>);

#[derive(Clone, Debug)]
struct OfKind {
    of: &'static str,
    /// Names; empty for a kind whose table is not shown.
    names: Vec<String>,
    count: usize,
    /// Number of peaks of each element.
    each: usize,
    /// Whether the summary shows the kind.
    is_shown: bool,
    table: fn(&[String], &[Peak]) -> Table,
}

impl Elements {
    pub(super) fn new(model: &Model) -> Self {
        let mut begin = Begin(model, Vec::new());
        visit_kinds(&mut begin);
        Elements(begin.1)
    }

    /// Number of peaks of all elements.
    pub(super) fn count(&self) -> usize {
        self.0.iter().map(|kind| kind.count * kind.each).sum()
    }

    /// Peaks of one kind among those of all, by element.
    pub(super) fn of<'p>(&self, kind: &str, peaks: &'p [Peak]) -> impl Iterator<Item = &'p [Peak]> + use<'p> {
        let before = self.0.iter().take_while(|own| own.of != kind).map(|own| own.count * own.each).sum();
        let own = self.0.iter().find(|own| own.of == kind);
        let (count, each) = own.map_or((0, 1), |own| (own.count * own.each, own.each));
        peaks.get(before..before + count).unwrap_or_default().chunks(each)
    }

    /// Tables of `peaks` of all elements.
    pub(super) fn tables(&self, peaks: &[Peak]) -> Tables {
        let mut rest = peaks;
        let mut tables = Tables::new();
        for kind in &self.0 {
            let (own, others) = rest.split_at(rest.len().min(kind.count * kind.each));
            rest = others;
            if kind.is_shown {
                tables.insert(kind.of, (kind.table)(&kind.names, own));
            }
        }
        tables
    }
}

struct Begin<'a>(&'a Model, Vec<OfKind>);

impl Visitor for Begin<'_> {
    fn visit<E: Listed>(&mut self) {
        let ([one, of], each) = (E::NAMES, E::PEAKS.len());
        let names: Vec<String> = self.0.named(one).into_iter().map(|element| element.name.to_owned()).collect();
        let is_shown = E::SHOWS_PEAKS && (!E::OPTIONAL || !names.is_empty());
        let count = E::most_actions(E::law(&self.0.system().forces));
        if each > 0 {
            self.1.push(OfKind { of, names, count, each, is_shown, table: table::<E> });
        }
    }
}

fn table<E: Reported>(names: &[String], peaks: &[Peak]) -> Table {
    let columns: Vec<_> = E::PEAKS.iter().flat_map(|tracked| [Some(tracked.column), tracked.time]).flatten().collect();
    let row = |(name, peaks): (&String, &[Peak])| {
        (name.clone(), E::PEAKS.iter().zip(peaks).flat_map(|(tracked, peak)| cells(tracked, peak)).collect())
    };
    Table::new(E::NAMES[0], &columns, names.iter().zip(peaks.chunks(E::PEAKS.len())).map(row))
}

/// Cell of a peak and, if there is a column for it, of its time.
fn cells(tracked: &Tracked, peak: &Peak) -> impl Iterator<Item = Cell> + use<> {
    let value = if tracked.at_least_zero { peak.value.max(0.0) } else { peak.value };
    let time_s = (peak.value > 0.0).then_some(peak.time_s);
    let time = tracked.time.map(|_| Cell::Number(time_s));
    [Cell::Number(Some(value))].into_iter().chain(time)
}
