//! Results of a column.

use occupant_units::unit::Unit::{
    Joule, Metre, MetrePerSecond, Newton, NewtonMetre, One, Radian, RadianPerSecond, Second,
};

use super::law::Now;
use super::past::ColumnPast;
use super::{Column, Giving};
use crate::forces::element::Element;
use crate::forces::shown::{Named, OneOf, Reported, Shown, Tracked, Tracker};
use crate::forces::stored::Archive;
use crate::forces::table::{Cell, Column as TableColumn, Table};
use crate::motion::scalar::Scalar;
use crate::quantity::{FieldWords, Quantity};

/// Action of one column at one instant.
#[derive(Clone, Copy, Debug)]
pub struct ColumnAction<S> {
    /// x, m, and ẋ, m/s.
    pub(crate) stroke: S,
    speed: S,
    /// S, and Q·â of bodies and bags, N.
    force: S,
    push: S,
    /// Absorbed, stored and dissipated energy since the start, J.
    taken: S,
    stored: S,
    lost: S,
    /// Permanent stroke, m.
    set: S,
    /// 1 beyond the end of its stroke.
    bottoms: S,
    /// Largest residual of its energy balance, relative to the largest absorbed work.
    residual: S,
}

impl<S: Scalar> ColumnAction<S> {
    /// Action while the body is being positioned.
    #[inline(always)]
    pub(super) fn idle() -> Self {
        let o = S::zero();
        ColumnAction {
            stroke: o,
            speed: o,
            force: o,
            push: o,
            taken: o,
            stored: o,
            lost: o,
            set: o,
            bottoms: o,
            residual: o,
        }
    }

    #[inline(always)]
    pub(super) fn new(now: &Now<S>, push: S, past: &ColumnPast<S>) -> Self {
        let [stroke, speed, taken] = now.own;
        ColumnAction {
            stroke,
            speed,
            force: now.force,
            push,
            taken,
            stored: now.stored,
            lost: now.lost,
            set: now.set,
            bottoms: now.bottoms,
            residual: past.residual / past.taken.max(S::of(LEAST_J)),
        }
    }
}

/// Least reference work for the residual of the energy balance, J.
const LEAST_J: f64 = 1e-3;
/// Least permanent stroke above rounding, m.
const GIVEN_M: f64 = 1e-6;

type Of<const TURNS: bool> = Quantity<OneOf<Giving<TURNS>>>;

const fn peak(column: TableColumn) -> Tracked {
    Tracked { column, time: None, at_least_zero: true }
}

/// With the time of the peak, under these names in JSON and among the measures.
const fn timed(column: TableColumn, key: &'static str, measure: &'static str) -> Tracked {
    Tracked { time: Some(TableColumn::time(key).measure(measure, Second)), ..peak(column) }
}

const fn scaled(scale: f64, column: TableColumn) -> TableColumn {
    TableColumn { scale, ..column }
}

impl<const TURNS: bool> Giving<TURNS> {
    #[rustfmt::skip]
    const ALONG: &'static [Of<TURNS>] = &[
        Of::number(Metre, |c| c.stroke).channel("stroke", "stroke of the {}").field(2, "stroke", "way along its axis since the start"),
        Of::number(MetrePerSecond, |c| c.speed).channel("speed", "speed of stroke of the {}").field(3, "speed", "speed along its axis"),
        Of::number(Newton, |c| c.force).channel("force", "force that holds the {}").field(4, "force", "force that holds it, against the stroke"),
        Of::number(Newton, |c| c.push).channel("push", "push of bodies and bags on the {}").field(5, "push", "forces of bodies and bags on it, along its axis"),
        Of::number(Joule, |c| c.taken).channel("work", "work taken up by the {}").field(6, "work", "work absorbed since the start"),
        Of::number(Joule, |c| c.stored).channel("stored", "energy of the {}").field(7, "stored", "kinetic energy of its stroke and its recoverable energy"),
        Of::number(Joule, |c| c.lost).channel("lost", "energy lost in the {}").field(8, "lost", "energy that it does not return"),
    ];

    #[rustfmt::skip]
    const ABOUT: &'static [Of<TURNS>] = &[
        Of::number(Radian, |c| c.stroke).channel("angle", "turn of the {}").field(2, "angle", "turn about its axis since the start"),
        Of::number(RadianPerSecond, |c| c.speed).channel("rate", "rate of turn of the {}").field(3, "rate", "rate of turn about its axis"),
        Of::number(NewtonMetre, |c| c.force).channel("moment", "moment that holds the {}").field(4, "moment", "moment that holds it, against the turn"),
        Of::number(NewtonMetre, |c| c.push).channel("push", "moment of bodies and bags on the {}").field(5, "push", "moments of bodies and bags on it, about its axis"),
        Of::number(Joule, |c| c.taken).channel("work", "work taken up by the {}").field(6, "work", "work absorbed since the start"),
        Of::number(Joule, |c| c.stored).channel("stored", "energy of the {}").field(7, "stored", "kinetic energy of its rotation and its recoverable energy"),
        Of::number(Joule, |c| c.lost).channel("lost", "energy lost in the {}").field(8, "lost", "energy that it does not return"),
    ];

    #[rustfmt::skip]
    const PEAKS_ALONG: &'static [Tracked] = &[
        timed(scaled(1e3, TableColumn::number("stroke_max_m", "stroke, mm", 1)).measure("stroke_max", Metre), "stroke_max_time_s", "stroke_max_time"),
        timed(scaled(1e-3, TableColumn::number("peak_n", "force, kN", 2)).measure("peak", Newton), "peak_time_s", "peak_time"),
        peak(TableColumn::number("energy_j", "work, J", 1).measure("energy", Joule)),
        timed(TableColumn::number("bottomed", "bottomed", 0), "bottomed_time_s", "bottomed_time"),
        peak(scaled(1e6, TableColumn::number("book_error", "energy error, 1e-6", 1)).measure("book_error", One)),
    ];

    #[rustfmt::skip]
    const PEAKS_ABOUT: &'static [Tracked] = &[
        timed(scaled(DEGREES, TableColumn::number("angle_max_rad", "turn, °", 1)).measure("angle_max", Radian), "angle_max_time_s", "angle_max_time"),
        timed(TableColumn::number("peak_n_m", "moment, N·m", 0).measure("peak", NewtonMetre), "peak_time_s", "peak_time"),
        peak(TableColumn::number("energy_j", "work, J", 1).measure("energy", Joule)),
        timed(TableColumn::number("bottomed", "bottomed", 0), "bottomed_time_s", "bottomed_time"),
        peak(scaled(1e6, TableColumn::number("book_error", "energy error, 1e-6", 1)).measure("book_error", One)),
    ];
}

const DEGREES: f64 = 180.0 / std::f64::consts::PI;

impl<const TURNS: bool> Reported for Giving<TURNS> {
    const MESSAGE: &'static str = if TURNS { "Hinge" } else { "Column" };
    const TELLS: bool = true;
    const QUANTITIES: &'static [Of<TURNS>] = if TURNS { Self::ABOUT } else { Self::ALONG };
    const PEAKS: &'static [Tracked] = if TURNS { Self::PEAKS_ABOUT } else { Self::PEAKS_ALONG };

    #[inline(always)]
    fn track<S: Scalar>(c: &ColumnAction<S>, tracker: &mut impl Tracker<S>) {
        let force = if TURNS { c.force.abs() } else { c.force };
        tracker.numbers(&[c.stroke, force, c.taken, c.bottoms, c.residual]);
    }

    fn keep(past: &mut Vec<ColumnPast<f64>>, like: Option<&[ColumnPast<f64>]>, file: &mut dyn Archive) {
        let (first, stem, meaning) = match TURNS {
            false => (58, "columns", "what each column remembers: its greatest stroke, its book"),
            true => (72, "hinges", "what each hinge remembers: its greatest turn, its book"),
        };
        let number = if like.is_some() { first + 1 } else { first };
        let mut list = Vec::new();
        for column in &*past {
            column.map(&mut |x| list.push(x));
        }
        let list = file.numbers(FieldWords { number, stem, meaning }, list);
        if list.len() % ColumnPast::<f64>::SIZE != 0 {
            return file.refuse(&format!("a list of {stem} with parts missing"));
        }
        let column = |numbers: &[f64]| {
            let mut numbers = numbers.iter().copied();
            ColumnPast::<f64>::none().map(&mut |none| numbers.next().unwrap_or(none))
        };
        *past = list.chunks(ColumnPast::<f64>::SIZE).map(column).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.those(TURNS).map(|(_, column)| Named { name: &column.name, sphere: None }).collect()
    }

    fn start_table(shown: &Shown<'_, Self>) -> Option<Table> {
        shown.data.those(TURNS).next()?;
        let slides = [
            TableColumn::number("mass_kg", "mass, kg", 2),
            scaled(1e-3, TableColumn::number("most_n", "largest force, kN", 2)),
            scaled(1e3, TableColumn::number("end_m", "stroke, mm", 0)),
            scaled(1e-6, TableColumn::number("unload_n_per_m", "unloading, kN/mm", 2)),
        ];
        let turns = [
            TableColumn::number("inertia_kg_m2", "inertia, kg·m²", 2),
            TableColumn::number("most_n_m", "largest moment, N·m", 0),
            scaled(DEGREES, TableColumn::number("end_rad", "rotation, °", 0)),
            scaled(1e-3 / DEGREES, TableColumn::number("unload_n_m_per_rad", "unloading, kN·m/°", 3)),
        ];
        let columns = if TURNS { turns } else { slides };
        let row = |(_, column): (usize, &Column)| {
            let numbers = [column.inertia(), column.force.greatest_n(), column.end_m(), column.stiffness_n_per_m()];
            (column.name.clone(), numbers.map(|number| Cell::Number(Some(number))).to_vec())
        };
        Some(Table::new(Self::NAMES[0], &columns, shown.data.those(TURNS).map(row)))
    }

    const BY_STEPS: &'static [&'static str] = &[BOTTOMS];

    fn told(before: &[f64], now: &[f64], show: &mut dyn FnMut(&'static str)) {
        if before[3] <= 0.5 && now[3] > 0.5 {
            show(BOTTOMS);
        }
    }

    fn event<S: Scalar>(before: &ColumnAction<S>, now: &ColumnAction<S>) -> Option<(&'static str, Option<S>)> {
        let begins = |of: fn(&ColumnAction<S>) -> S, from: f64| {
            S::any(of(now).gt(S::of(from))) && !S::any(of(before).gt(S::of(from)))
        };
        if begins(|c| c.bottoms, 0.5) {
            return Some((BOTTOMS, None));
        }
        begins(|c| c.set, GIVEN_M).then_some(("yields", None))
    }
}

const BOTTOMS: &str = "is at the end of its stroke";
