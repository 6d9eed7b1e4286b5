//! Sources and outlets of a bag's gas: inflators, vents, fabric.

use super::data::{Bag, Inflator, Leakage, Vent};
use super::gas::{GasLaw, Mixture};
use super::past::BagPast;
use super::unfold::later;
use crate::forces::element::{Instant, passes};
use crate::forces::function::steps::Steps;
use crate::motion::scalar::Scalar;

/// Gauge pressure below which the outflow is linearised, Pa: the square root's slope at 0 is unbounded.
const LINEAR_PA: f64 = 200.0;

/// Constants of an inflator.
#[derive(Clone, Debug)]
pub(super) struct InflatorLaw<S> {
    pub(super) gas: GasLaw<S>,
    due: S,
    begins: S,
    flow: Steps<S>,
    temperature: Steps<S>,
}

/// Constants of vents and fabric.
#[derive(Clone, Debug)]
pub(super) struct OutletLaw<S> {
    vents: Vec<VentLaw<S>>,
    /// C_d A of the fabric per area, and its gas speed per gauge pressure.
    part: S,
    speed: Steps<S>,
}

#[derive(Clone, Copy, Debug)]
struct VentLaw<S> {
    /// C_d A, m².
    area: S,
    opens_at: S,
    due: S,
}

/// Mass flow through vents and fabric, kg/s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outflow<S> {
    pub(super) vents: S,
    pub(super) fabric: S,
}

impl InflatorLaw<f64> {
    pub(super) fn new(inflator: &Inflator) -> Self {
        let column = |i: usize| inflator.rows.iter().map(|row| [row[0], row[i]]).collect::<Vec<_>>();
        InflatorLaw {
            gas: GasLaw::new(&inflator.gas),
            due: inflator.due_s,
            begins: inflator.rows.first().map_or(0.0, |row| row[0]),
            flow: Steps::new(&column(1)),
            temperature: Steps::new(&column(2)),
        }
    }
}

impl<S: Copy> InflatorLaw<S> {
    pub(super) fn rows(&self) -> usize {
        self.flow.len()
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &InflatorLaw<A>, f: &impl Fn(S, A) -> T) -> InflatorLaw<T> {
        InflatorLaw {
            gas: self.gas.zip(&other.gas, f),
            due: f(self.due, other.due),
            begins: f(self.begins, other.begins),
            flow: self.flow.zip(&other.flow, f),
            temperature: self.temperature.zip(&other.temperature, f),
        }
    }
}

impl<S: Scalar> InflatorLaw<S> {
    /// Mass flow, kg/s, and temperature, K.
    #[inline(always)]
    pub(super) fn at(&self, at: &Instant<'_, S>) -> [S; 2] {
        let burns = later(at, self.due + self.begins) & !later(at, self.due + self.flow.end());
        if !S::any(burns) {
            return [S::zero(), S::one()];
        }
        let since = at.frames.time - self.due;
        [S::select(burns, self.flow.at(since), S::zero()), self.temperature.at(since)]
    }
}

impl OutletLaw<f64> {
    pub(super) fn new(bag: &Bag) -> Self {
        let vent =
            |vent: &Vent| VentLaw { area: vent.discharge * vent.area_m2, opens_at: vent.opens_at_pa, due: vent.due_s };
        let (part, speed) = match &bag.leakage {
            Leakage::Fraction(part) => (*part, Steps::new(&[])),
            Leakage::Speed(rows) => (0.0, Steps::new(rows)),
        };
        OutletLaw { vents: bag.vents.iter().map(vent).collect(), part, speed }
    }
}

impl<S: Scalar<Mask = bool>> OutletLaw<S> {
    /// Fraction between two commits at which the first vent was due to open.
    pub(super) fn due(&self, before: &BagPast<S>, now: &BagPast<S>) -> Option<S> {
        let opens = before.open.iter().zip(&now.open).map(|(before, now)| before.lt(*now));
        let vents = self.vents.iter().zip(opens).filter(|(_, opens)| *opens);
        vents.map(|(vent, _)| passes(vent.opens_at, before.gauge, now.gauge)).reduce(S::min)
    }
}

impl<S: Copy> OutletLaw<S> {
    /// Numbers of vents and of rows.
    pub(super) fn shape(&self) -> [usize; 2] {
        [self.vents.len(), self.speed.len()]
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &OutletLaw<A>, f: &impl Fn(S, A) -> T) -> OutletLaw<T> {
        let vent = |(a, b): (&VentLaw<S>, &VentLaw<A>)| VentLaw {
            area: f(a.area, b.area),
            opens_at: f(a.opens_at, b.opens_at),
            due: f(a.due, b.due),
        };
        OutletLaw {
            vents: self.vents.iter().zip(&other.vents).map(vent).collect(),
            part: f(self.part, other.part),
            speed: self.speed.zip(&other.speed, f),
        }
    }
}

impl<S: Scalar> OutletLaw<S> {
    /// Opens vents by the gauge pressure.
    #[inline(always)]
    pub(super) fn commit(&self, fired: S::Mask, gauge: S, past: &mut BagPast<S>) {
        for (vent, open) in self.vents.iter().zip(&mut past.open) {
            *open = S::select(fired & !gauge.lt(vent.opens_at), S::one(), *open);
        }
    }

    /// Outflow, through fabric of this area.
    #[inline(always)]
    pub(super) fn at(
        &self,
        at: &Instant<'_, S>,
        gas: &Mixture<S>,
        ambient: S,
        fabric: S,
        past: &BagPast<S>,
    ) -> Outflow<S> {
        let (o, gauge) = (S::zero(), gas.gauge);
        if !S::any(gauge.gt(o)) {
            return Outflow { vents: o, fabric: o };
        }
        let mut holes = o;
        for (vent, open) in self.vents.iter().zip(&past.open) {
            let is_open = open.gt(o) | later(at, vent.due);
            holes += S::select(is_open, vent.area, o);
        }
        let linear = S::of(LINEAR_PA);
        let per_area = gas.outflow(ambient + gauge.max(linear), ambient) * (gauge / linear).min(S::one());
        let mut through = self.part * per_area;
        if self.speed.len() > 0 {
            through += gas.density() * self.speed.at(gauge);
        }
        Outflow { vents: holes * per_area, fabric: through * fabric }
    }
}
