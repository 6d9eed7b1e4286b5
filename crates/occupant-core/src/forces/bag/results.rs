//! Results of a bag.

use nalgebra::Point3;
use occupant_units::unit::Unit::{
    Joule, Kelvin, Kilogram, KilogramPerSecond, MetreCubed, MetreSquared, Newton, One, Pascal, Second,
};

use super::data::{Bag, FOLDED};
use super::inflator::Outflow;
use super::law::{Flows, Now};
use super::past::BagPast;
use super::{BagLaw, Bags, MOST_SPHERES, MOST_VENTS, Pushes, outline};
use crate::forces::element::{Element, Instant};
use crate::forces::shown::{Named, OneOf, Pull, Reported, Section, Shown, Tracked, Tracker};
use crate::forces::sphere::Use;
use crate::forces::stored::Archive;
use crate::forces::table::{Cell, Column, Table};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use crate::quantity::{Axes, FieldWords, Quantity};

/// Action of one bag at one instant.
#[derive(Clone, Copy, Debug)]
pub struct BagAction<S> {
    /// p − p_a, Pa.
    pub pressure: S,
    /// T, K.
    pub(crate) temperature: S,
    /// Of the gas, m³ and kg.
    pub(crate) volume: S,
    pub(crate) mass: S,
    /// From inflators, kg/s.
    inwards: S,
    out: Outflow<S>,
    /// Mass vented since the start, kg.
    vented: S,
    /// Area of the envelope covered by spheres, m², and volume displaced by them, m³.
    covered: S,
    taken: S,
    /// Work of the body on it since the start, J.
    pub(super) work: S,
    /// Largest residual of the gas balance, relative to its largest energy.
    pub(super) residual: S,
    /// 1 once it has fired, g, and λ.
    pub(crate) fired: S,
    pub(crate) share: S,
    scale: S,
    /// Vents opened by the pressure.
    opened: S,
    /// Bit sets 2^i of the spheres i that have reached the mount plane or the centre, and of those within when it
    /// fired.
    pub(crate) bottoms: S,
    pub(crate) caught: S,
    /// Force on its mount, vehicle axes, N.
    pub(super) force: V3<S>,
    /// On its spheres, in their order, vehicle axes, N.
    pub(crate) pushes: [V3<S>; MOST_SPHERES],
}

impl<S: Scalar> BagAction<S> {
    /// Action of a bag before firing.
    #[inline(always)]
    pub(super) fn idle(law: &BagLaw<S>) -> Self {
        let (o, none) = (S::zero(), V3::zero());
        let [temperature, volume, mass] = law.folded();
        let folded = S::of(FOLDED_SCALE);
        BagAction {
            pressure: o,
            temperature,
            volume,
            mass,
            inwards: o,
            out: Outflow { vents: o, fabric: o },
            vented: o,
            covered: o,
            taken: o,
            work: o,
            residual: o,
            fired: o,
            share: S::of(FOLDED),
            scale: folded,
            opened: o,
            bottoms: o,
            caught: o,
            force: none,
            pushes: [none; MOST_SPHERES],
        }
    }

    #[inline(always)]
    pub(super) fn new(
        law: &BagLaw<S>,
        at: &Instant<'_, S>,
        (now, past): (&Now<'_, S>, &BagPast<S>),
        pushes: &Pushes<S>,
        flows: &Flows<S>,
    ) -> Self {
        let o = S::zero();
        let axes = &at.frames[crate::motion::frame::VEHICLE].axes;
        let [work, vented] = law.sums(at);
        let pushes = pushes.forces.map(|force| axes.into_frame(force));
        BagAction {
            pressure: now.gas.gauge,
            temperature: now.gas.temperature,
            volume: now.gas.volume,
            mass: now.gas.mass,
            inwards: flows.inwards,
            out: flows.out,
            vented,
            covered: now.envelope.covered,
            taken: now.envelope.taken,
            work,
            residual: past.residual / past.greatest.max(S::of(1e-12)),
            fired: past.fired,
            share: now.unfolded.share,
            scale: now.unfolded.scale,
            opened: past.open.iter().fold(o, |sum, open| sum + *open),
            bottoms: now.envelope.bottoms,
            caught: past.caught,
            force: pushes.iter().fold(V3::zero(), |sum, push| sum - *push),
            pushes,
        }
    }
}

/// λ of a folded bag: the cube root of its relative volume.
const FOLDED_SCALE: f64 = 0.271_441_761_659_490_7;

type Of = Quantity<OneOf<Bags>>;

const fn peak(column: Column) -> Tracked {
    Tracked { column, time: None, at_least_zero: true }
}

/// With the time of the peak, under these names in JSON and among the measures.
const fn timed(column: Column, key: &'static str, measure: &'static str) -> Tracked {
    Tracked { time: Some(Column::time(key).measure(measure, Second)), ..peak(column) }
}

const fn scaled(scale: f64, column: Column) -> Column {
    Column { scale, ..column }
}

impl Reported for Bags {
    const MESSAGE: &'static str = "Bag";
    const TELLS: bool = true;

    #[rustfmt::skip]
    const QUANTITIES: &'static [Of] = &[
        Of::number(Pascal, |b| b.pressure).channel("pressure", "gauge pressure of the {}").field(2, "pressure", "gauge pressure"),
        Of::number(Kelvin, |b| b.temperature).channel("temperature", "temperature of the {}").field(3, "temperature", "temperature of its gas"),
        Of::number(MetreCubed, |b| b.volume).channel("volume", "volume of the {}").field(4, "volume", "volume of its gas"),
        Of::number(Kilogram, |b| b.mass).channel("mass", "mass of gas in the {}").field(5, "mass", "mass of its gas"),
        Of::number(KilogramPerSecond, |b| b.inwards).channel("flow_in", "flow of inflators into the {}").field(6, "flow_in", "mass flow of its inflators"),
        Of::number(KilogramPerSecond, |b| b.out.vents).channel("flow_out", "flow through vents of the {}").field(7, "flow_out", "mass flow through its vents"),
        Of::number(KilogramPerSecond, |b| b.out.fabric).channel("leak", "flow through fabric of the {}").field(8, "leak", "mass flow through its fabric"),
        Of::number(MetreSquared, |b| b.covered).channel("area", "area of the {} that bodies press").field(9, "area", "area that the body presses"),
        Of::vector(Newton, Axes::Vehicle, |b| b.force.to_vector()).channel("force", "force of the {} on its mount").field(10, "force", "force on its mount"),
        Of::number(Joule, |b| b.work).channel("work", "work of the body on the {}").field(11, "work", "work of the body on it since the start"),
    ];

    #[rustfmt::skip]
    const PEAKS: &'static [Tracked] = &[
        timed(scaled(1e-3, Column::number("peak_pressure_pa", "pressure, kPa", 1)).measure("peak_pressure", Pascal), "peak_pressure_time_s", "peak_pressure_time"),
        timed(scaled(1e2, Column::number("unfolded", "unfolded, %", 0)), "full_time_s", "full_time"),
        timed(Column::number("touched", "touched", 0), "contact_time_s", "contact_time"),
        peak(scaled(1e3, Column::number("displaced_m3", "displaced, l", 1)).measure("displaced", MetreCubed)),
        timed(Column::number("bottomed", "bottomed", 0), "bottomed_time_s", "bottomed_time"),
        peak(scaled(1e3, Column::number("vented_kg", "vented, g", 1)).measure("vented_mass", Kilogram)),
        peak(Column::number("energy_j", "work, J", 1).measure("energy", Joule)),
        peak(scaled(1e6, Column::number("gas_balance_error", "gas balance, 1e-6", 1)).measure("gas_balance_error", One)),
    ];

    #[inline(always)]
    fn track<S: Scalar>(b: &BagAction<S>, tracker: &mut impl Tracker<S>) {
        let (o, one) = (S::zero(), S::one());
        let covered = S::select(b.covered.gt(o), one, o);
        let bottoms = S::select(b.bottoms.gt(o), one, o);
        tracker.numbers(&[b.pressure, b.fired * b.share, covered, b.taken, bottoms, b.vented, b.work, b.residual]);
    }

    fn keep(past: &mut Vec<BagPast<f64>>, like: Option<&[BagPast<f64>]>, file: &mut dyn Archive) {
        let number = if like.is_some() { 54 } else { 53 };
        let meaning = "what each bag remembers: whether it has fired, its gas's book, of 4 vents, of 20 spheres";
        let mut list = Vec::new();
        for bag in &*past {
            bag.map(&mut |x| list.push(x));
        }
        let list = file.numbers(FieldWords { number, stem: "bags", meaning }, list);
        let size = 7 + MOST_VENTS + MOST_SPHERES;
        if list.len() % size != 0 {
            return file.refuse("a list of bags with parts missing");
        }
        let bag = |numbers: &[f64]| {
            let mut numbers = numbers.iter().copied();
            BagPast::<f64>::none().map(&mut |none| numbers.next().unwrap_or(none))
        };
        *past = list.chunks(size).map(bag).collect();
    }

    fn named<'a>(data: Self::Data<'a>) -> Vec<Named<'a>> {
        data.iter().map(|bag| Named { name: &bag.name, sphere: None }).collect()
    }

    fn start_table(shown: &Shown<'_, Self>) -> Option<Table> {
        if shown.data.is_empty() {
            return None;
        }
        let columns = [
            scaled(1e3, Column::time("fires_s")),
            scaled(1e3, Column::number("volume_m3", "volume, l", 1)),
            scaled(1e3, Column::number("gas_kg", "gas, g", 1)),
            scaled(1e3, Column::number("filled_m3", "volume without load, l", 1)),
        ];
        let row = |bag: &Bag| {
            let [mass, volume] = bag.filled();
            let fires_s = Some(bag.fires_s).filter(|fires_s| *fires_s < crate::forces::chain::NEVER);
            let numbers = [fires_s, Some(bag.volume_m3), Some(mass), Some(volume)];
            (bag.name.clone(), numbers.map(Cell::Number).to_vec())
        };
        Some(Table::new(Self::NAMES[0], &columns, shown.data.iter().map(row)))
    }

    fn sections(shown: &Shown<'_, Self>) -> Vec<Section> {
        let both = shown.data.iter().zip(shown.actions);
        let sections = both.flat_map(|(bag, action)| {
            let pressing = |(sphere, _): &(usize, f64)| {
                ((shown.centre_m)(*sphere, Use::Bag), shown.body.spheres[*sphere].radius_m)
            };
            let spheres: Vec<_> = bag.spheres.iter().filter(|_| action.fired > 0.0).map(pressing).collect();
            outline::sections(bag, action.scale, |point| (shown.place_m)(bag.frame, point), &spheres)
        });
        sections.collect()
    }

    fn pulls(shown: &Shown<'_, Self>, show: &mut dyn FnMut(&Pull<'_>)) {
        let [of, _] = Self::NAMES;
        for (bag, action) in shown.data.iter().zip(shown.actions) {
            for ((sphere, _), push) in bag.spheres.iter().zip(&action.pushes) {
                let force_n = push.to_vector();
                if force_n.norm() > 0.0 {
                    let point_m: Point3<f64> = (shown.centre_m)(*sphere, Use::Bag);
                    show(&Pull { of, name: &bag.name, sphere: *sphere, point_m, force_n });
                }
            }
        }
    }

    fn switched(
        _law: &Vec<BagLaw<f64>>,
        before: &[BagPast<f64>],
        now: &[BagPast<f64>],
        show: &mut dyn FnMut(usize, &'static str),
    ) {
        for (i, (before, now)) in before.iter().zip(now).enumerate() {
            if now.fired > before.fired {
                show(i, FIRES);
            }
            if now.open.iter().zip(&before.open).any(|(now, before)| now > before) {
                show(i, OPENS);
            }
        }
    }

    const BY_STEPS: &'static [&'static str] = &[FIRES, OPENS, BOTTOMS, TOUCHED, UNFOLDED, LEFT];

    /// Events from the order of [`Reported::track`]: unfolding, contact, bottoming out.
    fn told(before: &[f64], now: &[f64], show: &mut dyn FnMut(&'static str)) {
        for (at, from, what) in [(4, 0.0, BOTTOMS), (2, 0.0, TOUCHED), (1, WHOLE, UNFOLDED)] {
            if before[at] <= from && now[at] > from {
                show(what);
            }
        }
        if before[2] > 0.0 && now[2] <= 0.0 {
            show(LEFT);
        }
    }

    fn event<S: Scalar>(before: &BagAction<S>, now: &BagAction<S>) -> Option<(&'static str, Option<S>)> {
        let o = S::zero();
        let begins = |of: fn(&BagAction<S>) -> S| S::any(of(now).gt(o)) && !S::any(of(before).gt(o));
        let whole = S::of(WHOLE);
        if begins(|b| b.fired) {
            return Some((FIRES, None));
        }
        if begins(|b| b.bottoms) {
            return Some((BOTTOMS, None));
        }
        if S::any(now.opened.gt(before.opened)) {
            return Some((OPENS, None));
        }
        if begins(|b| b.covered) {
            return Some((TOUCHED, None));
        }
        if S::any(now.share.gt(whole)) && !S::any(before.share.gt(whole)) {
            return Some((UNFOLDED, None));
        }
        (S::any(before.covered.gt(o)) && !S::any(now.covered.gt(o))).then_some((LEFT, None))
    }
}

const FIRES: &str = "bag fires";
const OPENS: &str = "bag opens a vent";
const BOTTOMS: &str = "bag bottoms out at its mount or its middle";
const TOUCHED: &str = "bag is touched";
const UNFOLDED: &str = "bag is fully unfolded";
const LEFT: &str = "bag is no longer touched";
/// Unfolded share from which the bag counts as fully unfolded.
const WHOLE: f64 = 1.0 - 1e-9;
