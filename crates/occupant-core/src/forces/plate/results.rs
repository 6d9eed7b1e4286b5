//! Results of a plate.

use occupant_units::unit::Unit::{Metre, MetrePerSecond, Newton, Second};

use super::{BandPast, Plates};
use crate::forces::element::Element;
use crate::forces::shown::{Named, OneOf, Reported, Shown, Tracked, Tracker};
use crate::forces::stored::Archive;
use crate::forces::table::{Cell, Column, Table};
use crate::motion::scalar::Scalar;
use crate::quantity::{FieldWords, Quantity};

/// State of one plate at one instant.
#[derive(Clone, Copy, Debug)]
pub struct PlateAction<S> {
    /// s, m, and ṡ, m/s, inward positive.
    pub(crate) deflection: S,
    pub(crate) speed: S,
    /// S, N.
    pub(crate) force: S,
    /// Recoverable energy, J.
    pub(super) stored: S,
    /// 1 where the deflection exceeds the range of all tests.
    pub(super) deep: S,
}

impl<S: Copy> PlateAction<S> {
    /// s, m, inward positive.
    pub fn deflection_m(&self) -> S {
        self.deflection
    }

    /// Force of springs and dampers that resists it, N.
    pub fn force_n(&self) -> S {
        self.force
    }
}

type Of = Quantity<OneOf<Plates>>;

const DEEP: &str = "is deeper than 0.45 of the chest: no data reach there";

const fn timed(column: Column, key: &'static str, measure: &'static str) -> Tracked {
    Tracked { column, time: Some(Column::time(key).measure(measure, Second)), at_least_zero: true }
}

const fn scaled(scale: f64, column: Column) -> Column {
    Column { scale, ..column }
}

impl Reported for Plates {
    const MESSAGE: &'static str = "Plate";
    const TELLS: bool = true;

    #[rustfmt::skip]
    const QUANTITIES: &'static [Of] = &[
        Of::number(Metre, |p| p.deflection).channel("deflection", "deflection of the {}, inward positive").field(2, "deflection", "how far it has given way, inward positive"),
        Of::number(MetrePerSecond, |p| p.speed).channel("speed", "speed of deflection of the {}").field(3, "speed", "speed of its deflection, inward positive"),
        Of::number(Newton, |p| p.force).channel("force", "force that resists the {}").field(4, "force", "force of springs and dampers that resists it"),
    ];

    #[rustfmt::skip]
    const PEAKS: &'static [Tracked] = &[
        timed(scaled(1e3, Column::number("deflection_max_m", "deflection, mm", 1)).measure("deflection_max", Metre), "deflection_max_time_s", "deflection_max_time"),
        timed(Column::number("speed_max_m_s", "speed, m/s", 2).measure("speed_max", MetrePerSecond), "speed_max_time_s", "speed_max_time"),
        timed(scaled(1e-3, Column::number("force_max_n", "force, kN", 2)).measure("force_max", Newton), "force_max_time_s", "force_max_time"),
        timed(Column::number("deep", "bottomed out", 0), "deep_time_s", "deep_time"),
    ];

    #[inline(always)]
    fn track<S: Scalar>(p: &PlateAction<S>, tracker: &mut impl Tracker<S>) {
        tracker.numbers(&[p.deflection, p.speed, p.force, p.deep]);
    }

    fn keep(past: &mut Vec<BandPast<f64>>, like: Option<&[BandPast<f64>]>, file: &mut dyn Archive) {
        let number = if like.is_some() { 71 } else { 70 };
        let meaning = "of each spring of plates and of their links: greatest inward, then outward deflection that it remembers, m";
        let list = past.iter().flat_map(|band| band.greatest).collect();
        let list = file.numbers(FieldWords { number, stem: "plates", meaning }, list);
        let (bands, []) = list.as_chunks::<{ BandPast::<f64>::SIZE }>() else {
            return file.refuse("a list of plates with parts missing");
        };
        *past = bands.iter().map(|greatest| BandPast { greatest: *greatest }).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.plates.iter().map(|plate| Named { name: &plate.name, sphere: None }).collect()
    }

    fn start_table(shown: &Shown<'_, Self>) -> Option<Table> {
        if shown.data.plates.is_empty() {
            return None;
        }
        let columns =
            [Column::number("mass_kg", "mass, kg", 2), scaled(1e3, Column::number("depth_m", "depth, mm", 0))];
        let cell = |number| Cell::Number(number);
        let rows = shown.data.plates.iter();
        let rows = rows.map(|plate| (plate.name.clone(), vec![cell(Some(plate.mass_kg)), cell(plate.depth_m)]));
        Some(Table::new(Self::NAMES[0], &columns, rows))
    }

    const BY_STEPS: &'static [&'static str] = &[DEEP];

    fn told(before: &[f64], now: &[f64], show: &mut dyn FnMut(&'static str)) {
        if before[3] <= 0.5 && now[3] > 0.5 {
            show(DEEP);
        }
    }

    fn event<S: Scalar>(before: &PlateAction<S>, now: &PlateAction<S>) -> Option<(&'static str, Option<S>)> {
        let is_deep = |plate: &PlateAction<S>| S::any(plate.deep.gt(S::of(0.5)));
        (!is_deep(before) && is_deep(now)).then_some((DEEP, None))
    }
}
