//! Ride-down of the parts of a body with the vehicle, and the energy that belts and surfaces absorb.
//!
//! A part (chest, pelvis) is slowed from the time at which its speed along the vehicle's first velocity has fallen by
//! [`SLOWED`] of that velocity, to the time of its largest excursion ahead in the vehicle, when it has the vehicle's
//! speed. Its stopping distance between the two is the *ride-down distance*, which the vehicle travels in that time,
//! plus its own forward travel in the vehicle.
//!
//! The work absorbed by a surface is ∫F dΔ of the normal force and ∫|friction| v dt of the slip, pair by pair; that of
//! a loop is ∫F dL over its length; straps give their stored and lost energy. Each is the maximum over time; energy
//! returned later is not subtracted. Integrals are sums of trapezoids over the outputs. The energy ride-down is exact:
//! the work of the moving vehicle on the body, of the ledger, over the kinetic energy at the start.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use occupant_core::body::Segment;
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;

/// Relative loss of speed from which a part counts as decelerated.
const SLOWED: f64 = 0.02;
/// Least speed of a vehicle with ride-down, m/s.
const LEAST_M_S: f64 = 0.5;

/// A part of a body during ride-down.
#[derive(Clone, Debug)]
struct Part {
    name: String,
    segment: Segment,
    /// Travel of the vehicle, and of the part in it, when it began to decelerate, m.
    slowed: Option<[f64; 2]>,
    /// The same at its largest excursion since.
    ahead: [f64; 2],
}

/// Stopping distances of a part, m.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// The part of the body.
    pub part: String,
    /// Travel while decelerating, m.
    pub ride_down_m: f64,
    /// Travel relative to the vehicle, m.
    pub in_vehicle_m: f64,
}

/// A sum over time, with its maximum.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    now: f64,
    greatest: f64,
}

impl Sum {
    fn add(&mut self, more: f64) {
        self.now += more;
        self.greatest = self.greatest.max(self.now);
    }
}

/// Computes ride-down and work during a run.
#[derive(Debug, Default)]
pub struct RideDown {
    began: bool,
    parts: Vec<Part>,
    /// Initial direction of travel, and initial position of the vehicle.
    along: Option<Vector3<f64>>,
    start_m: f64,
    speed_m_s: f64,
    kinetic_j: f64,
    /// By surface: absorbed work.
    surfaces: BTreeMap<usize, Sum>,
    /// By sphere and surface at the last output: normal force, depth, friction power.
    touching: BTreeMap<(usize, usize), [f64; 3]>,
    /// By belt or strap.
    belts: Vec<(String, Sum, [f64; 2])>,
    names: Vec<String>,
    time_s: f64,
    vehicle_work_j: f64,
}

impl RideDown {
    /// Parts that were decelerated to the vehicle's speed.
    pub fn stopped(&self) -> Vec<Stopped> {
        let of = |part: &Part| {
            let [vehicle_m, own_m] = part.slowed?;
            Some(Stopped {
                part: part.name.clone(),
                ride_down_m: part.ahead[0] - vehicle_m,
                in_vehicle_m: part.ahead[1] - own_m,
            })
        };
        self.parts.iter().filter_map(of).collect()
    }

    /// Share of the initial kinetic energy absorbed by the moving vehicle; none if it hardly moved.
    pub fn share(&self) -> Option<f64> {
        (self.speed_m_s > LEAST_M_S && self.kinetic_j > 0.0).then(|| -self.vehicle_work_j / self.kinetic_j)
    }

    /// Largest work absorbed by each belt and surface, J, if any; the largest first.
    pub fn works_j(&self) -> Vec<(String, f64)> {
        let belts = self.belts.iter().map(|(name, sum, _)| (format!("belt {name}"), sum.greatest));
        let name = |surface: &usize| self.names.get(*surface).cloned().unwrap_or_default();
        let surfaces = self.surfaces.iter().map(|(surface, sum)| (name(surface), sum.greatest));
        let mut all: Vec<_> = belts.chain(surfaces).filter(|(_, work_j)| *work_j > 0.05).collect();
        all.sort_by(|a, b| b.1.total_cmp(&a.1));
        all
    }

    fn begin_with(&mut self, s: &Sample<'_>) {
        let velocity = s.vehicle.velocity_m_s;
        self.speed_m_s = velocity.norm();
        self.along = (self.speed_m_s > LEAST_M_S).then(|| velocity / self.speed_m_s);
        self.start_m = self.along.map_or(0.0, |along| along.dot(&s.vehicle.origin_m));
        self.kinetic_j = s.energy.kinetic_j;
    }

    fn ride(&mut self, s: &Sample<'_>) {
        let Some(along) = self.along else { return };
        let vehicle_m = along.dot(&s.vehicle.origin_m) - self.start_m;
        for part in &mut self.parts {
            let place = s.vehicle.vector_to_space(s.seen_by_vehicle().cg_m(part.segment).coords);
            let own_m = along.dot(&place);
            if part.slowed.is_none() {
                let speed_m_s = along.dot(&s.cg_velocity_m_s(part.segment));
                if speed_m_s >= (1.0 - SLOWED) * self.speed_m_s {
                    continue;
                }
                part.slowed = Some([vehicle_m, own_m]);
                part.ahead = [vehicle_m, own_m];
            }
            if own_m > part.ahead[1] {
                part.ahead = [vehicle_m, own_m];
            }
        }
    }

    fn press(&mut self, s: &Sample<'_>, step_s: f64) {
        let mut now: BTreeMap<(usize, usize), [f64; 3]> = BTreeMap::new();
        for touch in s.contacts().filter(|touch| touch.surface < self.names.len()) {
            let power = touch.friction_n.norm() * touch.slip_m_s;
            let pair = now.entry((touch.sphere, touch.surface)).or_default();
            *pair = [pair[0] + touch.normal_force_n, pair[1].max(touch.depth_m), pair[2] + power];
        }
        let pairs = now.keys().chain(self.touching.keys().filter(|pair| !now.contains_key(*pair)));
        for pair in pairs {
            let [[force, depth, power], [before_n, before_m, before_w]] =
                [&now, &self.touching].map(|all| all.get(pair).copied().unwrap_or_default());
            let work_j = 0.5 * (force + before_n) * (depth - before_m) + 0.5 * (power + before_w) * step_s;
            self.surfaces.entry(pair.1).or_default().add(work_j);
        }
        self.touching = now;
    }

    fn pull(&mut self, s: &Sample<'_>, is_first: bool) {
        let loops = s.actions.belts.iter().map(|belt| [belt.loop_force, belt.length]);
        let straps = s.actions.chains.iter().map(|strap| [f64::NAN, strap.stored + strap.lost - strap.driven]);
        for ((_, sum, last), now) in self.belts.iter_mut().zip(loops.chain(straps)) {
            let work_j = if now[0].is_nan() { now[1] - last[1] } else { 0.5 * (now[0] + last[0]) * (now[1] - last[1]) };
            if !is_first {
                sum.add(work_j);
            }
            *last = now;
        }
    }
}

impl Recorder for RideDown {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        let tree = model.body().tree;
        *self = RideDown::default();
        for row in tree.bodies() {
            let parts = [("chest", row.landmarks.chest), ("pelvis", row.landmarks.pelvis)];
            self.parts.extend(parts.into_iter().filter_map(|(name, segment)| {
                let own = if row.name.is_empty() { name.to_owned() } else { format!("{}.{name}", row.name) };
                Some(Part { name: own, segment: segment?, slowed: None, ahead: [0.0; 2] })
            }));
        }
        let setup = model.setup();
        let count = setup.surfaces.len() + setup.solids.len();
        self.names = setup.surface_names().take(count).map(str::to_owned).collect();
        let name =
            |of: &str| model.named(of).into_iter().map(|one| (one.name.to_owned(), Sum::default(), [0.0; 2])).collect();
        let (mut belts, straps): (Vec<_>, Vec<_>) = (name("belt"), name("strap"));
        belts.extend(straps);
        self.belts = belts;
        Ok(())
    }

    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        let is_first = !std::mem::replace(&mut self.began, true);
        if is_first {
            self.begin_with(s);
        }
        self.ride(s);
        self.press(s, if is_first { 0.0 } else { s.time_s - self.time_s });
        self.pull(s, is_first);
        self.vehicle_work_j = s.energy.vehicle_work_j;
        self.time_s = s.time_s;
        Ok(Flow::Continue)
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use occupant_core::results::channel::{Series, matching};
    use occupant_core::run::simulate::simulate;

    use super::*;
    use crate::files::scenario::{ScenarioArgs, open};

    /// The energy absorbed by surfaces and belts equals that of contacts and belts in the ledger, for any division into parts.
    #[test]
    fn works_add_up_to_the_ledger() {
        for (name, overrides) in [
            ("cart-unbelted", vec![]),
            ("cart-lap-torso", vec!["output.interval=0.2 ms".to_owned()]),
            ("three-point", vec![]),
        ] {
            let scenario = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../scenarios/{name}.toml"));
            let opened = open(&ScenarioArgs { scenario, overrides }).unwrap_or_else(|e| panic!("{}", e.words()));
            let (mut ride, mut series) = (RideDown::default(), Series::new(matching(&opened.model, "energy.*")));
            simulate(&opened.model, (&mut ride, &mut series)).unwrap();
            let gained = |names: &[&str]| -> f64 {
                let of = |name: &&str| {
                    let values = series.of(&format!("energy.{name}"));
                    values.map_or(0.0, |values| values[values.len() - 1] - values[0])
                };
                names.iter().map(of).sum()
            };
            let contacts: f64 = ride.surfaces.values().map(|sum| sum.now).sum();
            let expected = gained(&["contacts", "lost_contacts", "lost_friction"]);
            assert!((contacts - expected).abs() < 0.03 * expected, "{name}: {contacts} for {expected}");
            let belts: f64 = ride.belts.iter().map(|(_, sum, _)| sum.now).sum();
            let expected = gained(&["belts", "lost_belts"]) - gained(&["pretensioners"]);
            assert!((belts - expected).abs() < 2.0, "{name}: {belts} for {expected}");
        }
    }
}
