//! Measures of what only some bodies and tests read ([`Special`]). They are listed where those signals are.

use super::definition::{Definition, Finding, Lack, Make, at, measure, whole};
use super::readings::Readings;
use super::signals::Ribs;
use super::special::{ChestPoint, Special, TibiaLoad, TibiaSite};
use crate::measure::risk::Severity::{Ais2, Ais3};
use crate::measure::risk::{
    BrokenRibs, abdomen_force_risk, chest_deflection_risk, combined_thoracic_risk, even_odds_compression,
    pelvis_force_risk, rib_deflection_risk,
};
use crate::measure::{
    Blow, ChestSize, FourPoints, Peak, Quantity, ThoracicIntercepts, TibiaCriticals, combined_thoracic_index,
    compression, deepest_rib, deflection_rate, force_sum, maximum, pc_score, peak_towards, three_ms_cumulative,
    tibia_index, viscous_criterion,
};
use crate::signal::ChannelClass::{Cfc180, Cfc600};
use crate::signal::resultant;
use occupant_units::unit::Unit::{Metre, MetrePerSecond, MetrePerSecondSquared, Newton, One};

/// Measures of a deformable chest.
pub(super) const CHEST_PARTS: &[Definition] = &[
    measure("chest_deflection", "chest deflection", Metre, Cfc180, Readings::chest_deflection)
        .or_say("the thorax is rigid: it has no deflection and no viscous criterion")
        .brief()
        .limited(Quantity::ChestDeflection)
        .risks(&[("chest AIS3+", Ais3)], |deflection_m, _, dummy| chest_deflection_risk(deflection_m, dummy)),
    measure("chest_compression", "chest deflection over depth", One, Cfc180, Readings::chest_compression),
    measure("deflection_rate", "chest deflection, rate", MetrePerSecond, Cfc180, |r| {
        r.worst_of_chest(deflection_rate).map(at)
    })
    .limited(Quantity::DeflectionRate),
    measure("viscous_criterion", "viscous criterion", MetrePerSecond, Cfc180, Readings::viscous)
        .limited(Quantity::ViscousCriterion),
    measure("cti", "combined thoracic index", One, Cfc180, Readings::combined)
        .risks(&[("chest AIS3+", Ais3)], |index, _, _| Some(combined_thoracic_risk(index))),
    measure("pc_score", "PC score", One, Cfc180, Readings::pc_score),
];

/// Measures of a side impact.
pub(super) const SIDE: &[Definition] = &[
    measure("rib_deflection", "deepest rib", Metre, Cfc180, |r| {
        r.deepest(&r.several(3, Special::Rib)?).map(|found| r.of_sides(found))
    })
    .brief()
    .limited(Quantity::RibDeflection)
    .risks(&[("chest AIS3+", Ais3)], |deflection_m, _, dummy| rib_deflection_risk(deflection_m, dummy)),
    measure("rib_viscous_criterion", "viscous criterion of a rib", MetrePerSecond, Cfc180, |r| {
        r.rib_viscous(Special::Rib, 3)
    })
    .brief()
    .limited(Quantity::RibViscousCriterion),
    measure("abdomen_rib_deflection", "deepest rib of the abdomen", Metre, Cfc180, |r| {
        r.deepest(&r.several(2, Special::AbdomenRib)?)
    })
    .limited(Quantity::AbdomenRibDeflection),
    measure("abdomen_rib_viscous_criterion", "viscous criterion of the abdomen", MetrePerSecond, Cfc180, |r| {
        r.rib_viscous(Special::AbdomenRib, 2)
    })
    .limited(Quantity::RibViscousCriterion),
    measure("shoulder_force", "shoulder force", Newton, Cfc600, |r| r.force(&[r.special(Special::Shoulder)?]))
        .limited(Quantity::ShoulderForce),
    measure("abdomen_force", "abdomen force", Newton, Cfc600, |r| {
        r.force(&r.several(3, Special::Abdomen)?).map(|found| r.of_sides(found))
    })
    .brief()
    .limited(Quantity::AbdomenForce)
    .risks(&[("abdomen AIS3+", Ais3)], |force_n, _, dummy| abdomen_force_risk(force_n, dummy)),
    measure("lower_spine_peak", "lower spine, peak", MetrePerSecondSquared, Cfc180, |r| {
        Ok(at(maximum(&r.lower_spine()?, r.interval_s)?))
    })
    .limited(Quantity::LowerSpinePeak),
    measure("lower_spine_3ms_cumulative", "lower spine, 3 ms in total", MetrePerSecondSquared, Cfc180, |r| {
        let level = three_ms_cumulative(&r.lower_spine()?, r.interval_s)?;
        Ok(Finding { from_s: Some(level.start_s), to_s: Some(level.end_s), ..whole(level.level_mps2) })
    })
    .limited(Quantity::LowerSpineThreeMsCumulative),
    measure("pubic_force", "pubic symphysis force", Newton, Cfc600, Readings::pubic)
        .brief()
        .limited(Quantity::PubicForce)
        .risks(&[("pelvis AIS3+", Ais3)], pelvis_force_risk),
    measure("pelvis_force", "acetabulum and ilium force", Newton, Cfc600, Readings::pelvis)
        .brief()
        .limited(Quantity::PelvisForce)
        .risks(&[("pelvis AIS2+", Ais2)], pelvis_force_risk),
];

/// Measures of the lower legs.
pub(super) const LEGS: &[Definition] = &[
    tibia("right_tibia_index", "right tibia index", |r| r.tibia_index(&TibiaSite::ALL[..2])),
    tibia_force("right_tibia_compression", "right tibia compression", |r| r.tibia_force(&TibiaSite::ALL[..2])),
    tibia("left_tibia_index", "left tibia index", |r| r.tibia_index(&TibiaSite::ALL[2..])),
    tibia_force("left_tibia_compression", "left tibia compression", |r| r.tibia_force(&TibiaSite::ALL[2..])),
];

const fn tibia(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, One, Cfc600, of).limited(Quantity::TibiaIndex)
}

const fn tibia_force(name: &'static str, label: &'static str, of: Make) -> Definition {
    measure(name, label, Newton, Cfc600, of).limited(Quantity::TibiaAxial)
}

/// Signals, filtered.
type Several = Vec<Vec<f64>>;

impl Readings {
    /// Signals of a kind, up to `most`; at least one.
    pub(super) fn several(&self, most: u8, of: fn(u8) -> Special) -> Result<Several, Lack> {
        present((0..most).map(|i| self.special(of(i))))
    }

    /// The sternum, or the measuring points of a chest.
    fn chest_points(&self) -> Result<Several, Lack> {
        let points = ChestPoint::ALL.into_iter().map(Special::ChestPoint);
        present([Special::ChestDeflection].into_iter().chain(points).map(|which| self.special(which)))
    }

    /// The worst result of all points of the chest.
    fn worst_of_chest(
        &self,
        of: impl Fn(&[f64], f64) -> Result<Peak, crate::signal::SignalError>,
    ) -> Result<Peak, Lack> {
        self.worst_of(&self.chest_points()?, of)
    }

    fn worst_of(
        &self,
        points: &Several,
        of: impl Fn(&[f64], f64) -> Result<Peak, crate::signal::SignalError>,
    ) -> Result<Peak, Lack> {
        let peaks = points.iter().map(|own| of(own, self.interval_s)).collect::<Result<Vec<_>, _>>()?;
        peaks.into_iter().reduce(|a, b| if b.value > a.value { b } else { a }).ok_or(Lack::Absent)
    }

    /// Size of a person's chest, or of a dummy for this direction of impact.
    fn chest_size(&self, blow: Blow) -> Result<ChestSize, Lack> {
        let of_person = match (blow, self.sides) {
            (Blow::Side, Some(Ribs::Dummy)) => None,
            (Blow::Side, Some(Ribs::Person { half_breadth_m })) => Some(half_breadth_m),
            _ => self.person.map(|person| person.chest_depth_m),
        };
        let of_person = of_person.map(ChestSize::of_person);
        let of_dummy = || ChestSize::of(self.options.dummy).filter(|_| self.options.dummy.blow() == blow);
        of_person.or_else(of_dummy).ok_or(Lack::NotOfDummy)
    }

    /// Without limits and risks of dummies if the ribs to the side are a person's.
    fn of_sides(&self, finding: Finding) -> Finding {
        Finding { is_of_dummy: finding.is_of_dummy && !matches!(self.sides, Some(Ribs::Person { .. })), ..finding }
    }

    /// Force of acetabulum and ilium; of a person that between the flesh of the struck side and the pelvis.
    fn pelvis(&self) -> Result<Finding, Lack> {
        let found = self.of_sides(self.force(&self.several(2, Special::Pelvis)?)?);
        let of_person = matches!(self.sides, Some(Ribs::Person { .. }));
        let remark = of_person.then(|| "between the flesh of the struck side and the pelvis".to_owned());
        Ok(Finding { remark: remark.or(found.remark.clone()), ..found })
    }

    /// Force of the pubic symphysis, which only a dummy's load cell feels.
    fn pubic(&self) -> Result<Finding, Lack> {
        let instead = "no load cell at the pubic symphysis: of a person see the force of acetabulum and ilium";
        match self.special(Special::Pubic) {
            Err(Lack::Absent) if self.sides.is_some() => Err(Lack::Without(instead)),
            force => self.force(&[force?]),
        }
    }

    /// Without limits and risks of dummies if the chest is a person's.
    fn of_chest(&self, finding: Finding) -> Finding {
        match self.person {
            None => finding,
            Some(_) => Finding { is_of_dummy: false, ..finding },
        }
    }

    fn chest_deflection(&self) -> Result<Finding, Lack> {
        let deflection = self.worst_of_chest(|own, dt_s| peak_towards(1.0, own, dt_s))?;
        Ok(self.of_chest(at(deflection)))
    }

    fn chest_compression(&self) -> Result<Finding, Lack> {
        let points = self.chest_points()?;
        let depth_m = self.chest_size(Blow::Front)?.depth_m;
        let deflection = self.worst_of(&points, |own, dt_s| compression(own, dt_s, depth_m).map(|c| c.deflection))?;
        let age_years = self.person.and_then(|person| person.age_years);
        let remark = age_years.and_then(|age| {
            let [any, many] =
                [BrokenRibs::Any, BrokenRibs::MoreThanSix].map(|ribs| Some(100.0 * even_odds_compression(ribs, age)?));
            let (any, many) = any.zip(many)?;
            Some(format!(
                "at age {age:.0}, half of all people have a broken rib at {any:.0} %, and more than six at {many:.0} %: one point of a risk curve, not a risk"
            ))
        });
        let of_deflection = at(deflection);
        Ok(Finding { value: deflection.value / depth_m, remark, ..self.of_chest(of_deflection) })
    }

    fn viscous(&self) -> Result<Finding, Lack> {
        let points = self.chest_points()?;
        let size = self.chest_size(Blow::Front)?;
        let worst = self.worst_of(&points, |own, dt_s| viscous_criterion(own, dt_s, size))?;
        Ok(self.of_chest(at(worst)))
    }

    fn combined(&self) -> Result<Finding, Lack> {
        let deflection = self.worst_of_chest(|own, dt_s| peak_towards(1.0, own, dt_s))?;
        let intercepts = ThoracicIntercepts::of(self.options.dummy).ok_or(Lack::NotOfDummy)?;
        let level = self.chest.three_ms_cumulative.clone()?;
        let index = combined_thoracic_index(level.level_mps2, deflection.value, &intercepts)?;
        Ok(self.yardstick(whole(index)))
    }

    fn pc_score(&self) -> Result<Finding, Lack> {
        let [a, b, c, d] = ChestPoint::ALL.map(|point| self.special(Special::ChestPoint(point)));
        let (upper_left_m, upper_right_m, lower_left_m, lower_right_m) = (&a?, &b?, &c?, &d?);
        let score =
            pc_score(&FourPoints { upper_left_m, upper_right_m, lower_left_m, lower_right_m }, self.interval_s)?;
        Ok(self.yardstick(at(score)))
    }

    /// A criterion defined for dummies only: for a person it compares runs and implies no injury.
    fn yardstick(&self, finding: Finding) -> Finding {
        let words = "a criterion for dummies: for a person, use it only to compare runs";
        let remark = self.person.map(|_| words.to_owned()).or(finding.remark.clone());
        Finding { remark, ..self.of_chest(finding) }
    }

    fn deepest(&self, ribs: &Several) -> Result<Finding, Lack> {
        let all: Vec<&[f64]> = ribs.iter().map(Vec::as_slice).collect();
        let deepest = deepest_rib(&all, self.interval_s)?;
        let remark = (all.len() > 1).then(|| format!("rib {} of {} from above", deepest.rib + 1, all.len()));
        Ok(Finding { remark, ..at(deepest.deflection) })
    }

    fn rib_viscous(&self, of: fn(u8) -> Special, most: u8) -> Result<Finding, Lack> {
        let ribs = self.several(most, of)?;
        let size = self.chest_size(Blow::Side)?;
        let worst = at(self.worst_of(&ribs, |own, dt_s| viscous_criterion(own, dt_s, size))?);
        Ok(if self.sides.is_some() { self.of_sides(worst) } else { self.of_chest(worst) })
    }

    fn force(&self, cells: &[Vec<f64>]) -> Result<Finding, Lack> {
        let all: Vec<&[f64]> = cells.iter().map(Vec::as_slice).collect();
        Ok(at(force_sum(&all, self.interval_s)?))
    }

    fn lower_spine(&self) -> Result<Vec<f64>, Lack> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.special(Special::LowerSpine(axis)));
        Ok(resultant(&x?, &y?, &z?)?)
    }

    /// The larger index of the load cells of a leg.
    fn tibia_index(&self, sites: &[TibiaSite]) -> Result<Finding, Lack> {
        let loads = |site: &TibiaSite| {
            let of = |load| self.special(Special::Tibia(*site, load));
            Ok([of(TibiaLoad::MomentX)?, of(TibiaLoad::MomentY)?, of(TibiaLoad::ForceZ)?])
        };
        let all = present(sites.iter().map(loads))?;
        let critical = TibiaCriticals::of(self.options.dummy).ok_or(Lack::NotOfDummy)?;
        let indices = all.iter().map(|[x, y, z]| tibia_index(x, y, z, self.interval_s, &critical));
        let indices = indices.collect::<Result<Vec<_>, _>>()?;
        indices.into_iter().reduce(|a, b| if b.value > a.value { b } else { a }).map(at).ok_or(Lack::Absent)
    }

    fn tibia_force(&self, sites: &[TibiaSite]) -> Result<Finding, Lack> {
        let forces = present(sites.iter().map(|site| self.special(Special::Tibia(*site, TibiaLoad::ForceZ))))?;
        self.worst_of(&forces, |own, dt_s| peak_towards(-1.0, own, dt_s)).map(at)
    }
}

/// The values that are there; at least one.
fn present<T>(all: impl Iterator<Item = Result<T, Lack>>) -> Result<Vec<T>, Lack> {
    let found = all.filter(|one| !matches!(one, Err(Lack::Absent))).collect::<Result<Vec<T>, Lack>>()?;
    if found.is_empty() { Err(Lack::Absent) } else { Ok(found) }
}
