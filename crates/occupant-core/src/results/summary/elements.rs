//! Peaks of force elements.

use super::Peak;
use crate::forces::shown::{Named, Reported, Tracked};
use crate::forces::table::{Cell, Table, Tables};
use crate::forces::{Listed, Visitor, visit_kinds};
use crate::model::Model;
use crate::results::sample::Sample;

/// Peaks of the elements of every kind.
#[derive(Clone, Debug, Default)]
pub(super) struct ElementPeaks(Vec<KindPeaks>);

#[derive(Clone, Debug)]
struct KindPeaks {
    of: &'static str,
    peaks: Vec<OfOne>,
    table: fn(&[OfOne]) -> Table,
}

/// An element's name and peaks.
type OfOne = (String, Vec<Peak>);

impl ElementPeaks {
    /// None seen yet.
    pub(super) fn new(model: &Model) -> Self {
        let mut begin = Begin(model, Vec::new());
        visit_kinds(&mut begin);
        ElementPeaks(begin.1)
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        visit_kinds(&mut See(sample, &mut self.0));
    }

    /// Of the kinds that have peaks.
    pub(super) fn tables(&self) -> Tables {
        self.0.iter().map(|kind| (kind.of, (kind.table)(&kind.peaks))).collect()
    }
}

struct Begin<'a>(&'a Model, Vec<KindPeaks>);

impl Visitor for Begin<'_> {
    fn visit<E: Listed>(&mut self) {
        let [one, of] = E::NAMES;
        let named = self.0.named(one);
        let is_shown = !E::OPTIONAL || !named.is_empty();
        if is_shown && !E::PEAKS.is_empty() {
            let new = |element: Named<'_>| (element.name.to_owned(), vec![Peak::NONE; E::PEAKS.len()]);
            let peaks = named.into_iter().map(new).collect();
            self.1.push(KindPeaks { of, peaks, table: table::<E> });
        }
    }
}

struct See<'s, 'a>(&'s Sample<'a>, &'s mut [KindPeaks]);

impl Visitor for See<'_, '_> {
    fn visit<E: Listed>(&mut self) {
        let own = self.1.iter_mut().filter(|kind| kind.of == E::NAMES[1]).flat_map(|kind| &mut kind.peaks);
        for ((_, peaks), action) in own.zip(E::actions(self.0.actions)) {
            for (peak, tracked) in peaks.iter_mut().zip(E::PEAKS) {
                peak.see((tracked.of)(action), self.0.time_s);
            }
        }
    }
}

fn table<E: Reported>(peaks: &[OfOne]) -> Table {
    let columns: Vec<_> = E::PEAKS.iter().flat_map(|tracked| [Some(tracked.column), tracked.time]).flatten().collect();
    let row = |(name, peaks): &OfOne| (name.clone(), E::PEAKS.iter().zip(peaks).flat_map(cells).collect());
    Table::new(E::NAMES[0], &columns, peaks.iter().map(row))
}

/// A peak and, where there is a column for it, its time.
fn cells<A>((tracked, peak): (&Tracked<A>, &Peak)) -> impl Iterator<Item = Cell> + use<A> {
    let value = if tracked.at_least_zero { peak.value.max(0.0) } else { peak.value };
    let time = tracked.time.map(|_| Cell::Number((peak.value > 0.0).then_some(peak.time_s)));
    [Cell::Number(Some(value))].into_iter().chain(time)
}
