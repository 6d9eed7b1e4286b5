//! Columns and plates pushed beyond the last points of their forces, and chests deeper than any test.

use super::caveat::Caveat;
use super::peak::Peak;
use crate::body::Plate;
use crate::forces::column::Column;
use crate::forces::plate::{Band, DEEP};
use crate::model::Model;
use crate::results::sample::Sample;

/// By column, then by hinge: its name, the last point of its force, m or rad, and the largest stroke beyond it. By
/// plate: its name, its known range, and the largest deflection, m.
#[derive(Clone, Debug, Default)]
pub(super) struct Strokes(Vec<(Beyond, f64, Peak)>, Vec<(String, Known, Peak)>);

/// A column or a hinge by its name.
#[derive(Clone, Debug)]
pub(super) struct Beyond {
    pub(super) name: String,
    pub(super) turns: bool,
}

impl Beyond {
    fn of(column: &Column) -> Self {
        Beyond { name: column.name.clone(), turns: column.turns() }
    }
}

/// Known range of a plate.
#[derive(Clone, Copy, Debug)]
pub(super) enum Known {
    /// A fraction of the depth behind it, m.
    Depth(f64),
    /// The last point of its force, m.
    Last(f64),
}

impl Known {
    fn of(i: usize, plate: &Plate, bands: &[Band]) -> Self {
        let own = bands.iter().find(|band| band.of[..] == [(i, 1.0)] && band.spring.greatest_n() > 0.0);
        let last = own.map_or(f64::INFINITY, |band| band.spring.end());
        plate.depth_m.map_or(Known::Last(last), Known::Depth)
    }

    fn most_m(self) -> f64 {
        match self {
            Known::Depth(depth_m) => DEEP * depth_m,
            Known::Last(last_m) => last_m,
        }
    }
}

impl Strokes {
    pub(super) fn new(model: &Model) -> Self {
        let columns = |turn: bool| model.setup().columns.iter().filter(move |column| column.turns() == turn);
        let plates = model.body().plates.iter().enumerate();
        let bands = &model.setup().bands;
        let plate = |(i, plate): (usize, &Plate)| (plate.name.clone(), Known::of(i, plate, bands), Peak::NONE);
        let columns = columns(false).chain(columns(true));
        let columns = columns.map(|column| (Beyond::of(column), column.force.end(), Peak::NONE));
        Strokes(columns.collect(), plates.map(plate).collect())
    }

    pub(super) fn see(&mut self, sample: &Sample<'_>) {
        for ((_, last_m, beyond), action) in
            self.0.iter_mut().zip(sample.actions.columns.iter().chain(&sample.actions.hinges))
        {
            beyond.see(action.stroke - *last_m, sample.time_s);
        }
        for ((.., most), action) in self.1.iter_mut().zip(&sample.actions.plates) {
            most.see(action.deflection, sample.time_s);
        }
    }

    /// Takes the largest strokes of steps.
    pub(super) fn see_steps<'p>(&mut self, peaks: impl Iterator<Item = &'p [Peak]>) {
        for ((_, last_m, beyond), own) in self.0.iter_mut().zip(peaks) {
            beyond.see(own[0].value - *last_m, own[0].time_s);
        }
    }

    /// The same for plates.
    pub(super) fn see_plates<'p>(&mut self, peaks: impl Iterator<Item = &'p [Peak]>) {
        for ((.., most), own) in self.1.iter_mut().zip(peaks) {
            most.see(own[0].value, own[0].time_s);
        }
    }

    /// Caveats of columns and chests.
    pub(super) fn caveats(&self) -> impl Iterator<Item = Caveat> {
        let beyond = self.0.iter().filter(|(.., beyond)| beyond.value > 0.0);
        let deep = self.1.iter().filter(|(_, known, most)| most.value > known.most_m());
        let deep = deep.map(|(name, known, most)| Caveat::pressed(name, *most, *known));
        beyond.map(|(of, last, beyond)| Caveat::stroked(of, *beyond, *last)).chain(deep)
    }
}
