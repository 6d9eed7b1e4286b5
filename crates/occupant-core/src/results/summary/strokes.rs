//! Columns that were pushed beyond the last points of their forces.

use super::caveat::Caveat;
use super::peak::Peak;
use crate::model::Model;
use crate::results::sample::Sample;

/// By column: its name, the last point of its force, m, and the greatest stroke beyond it, m.
#[derive(Clone, Debug, Default)]
pub(super) struct Strokes(Vec<(String, f64, Peak)>);

impl Strokes {
    pub(super) fn new(model: &Model) -> Self {
        let columns = model.setup().columns.iter();
        Strokes(columns.map(|column| (column.name.clone(), column.force.end(), Peak::NONE)).collect())
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        for ((_, last_m, beyond), action) in self.0.iter_mut().zip(&sample.actions.columns) {
            beyond.see(action.stroke - *last_m, sample.time_s);
        }
    }

    /// Takes over the greatest strokes of steps.
    pub(super) fn see_steps<'p>(&mut self, peaks: impl Iterator<Item = &'p [Peak]>) {
        for ((_, last_m, beyond), own) in self.0.iter_mut().zip(peaks) {
            beyond.see(own[0].value - *last_m, own[0].time_s);
        }
    }

    /// What to know of columns.
    pub(super) fn caveats(&self) -> impl Iterator<Item = Caveat> {
        let beyond = self.0.iter().filter(|(.., beyond)| beyond.value > 0.0);
        beyond.map(|(name, last_m, beyond)| Caveat::stroked(name, *beyond, *last_m))
    }
}
