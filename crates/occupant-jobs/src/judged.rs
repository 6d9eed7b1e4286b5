//! By which limits a body is judged: those for the direction of its impact.
//!
//! The direction is that of the delta-v, the sum of the changes of velocity in axes of the vehicle, when it is largest in
//! the horizontal plane: from the front or from behind up to 45° beside the longitudinal axis, else from the
//! side. A vehicle that tilts by more than 45° rolls over, whatever the delta-v. A body whose own frame does not move, and
//! which is thrown, was struck on foot. Risks from frontal tests are left out in other impacts.

use crash_measures::injury::{self, Judgement, Options, RULES};
use crash_measures::measure::{Blow, Dummy, Grade, LIMITS, Limit, Quantity};
use nalgebra::{Matrix3, Vector3};
use occupant_core::model::Model;
use occupant_core::results::recorder::{Flow, Recorder, RecorderError};
use occupant_core::results::sample::Sample;
use occupant_core::results::summary::Summary;
use occupant_units::trig;

use crate::base::Units;

/// Delta-v below which there is no impact, m/s.
const LEAST_M_S: f64 = 1.0;
/// Half of the sectors of frontal and rear impacts.
const SECTOR_DEG: f64 = 45.0;
/// Tilt of a vehicle that rolls over.
const TILT_DEG: f64 = 45.0;

/// Direction of the impact on the vehicle of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the front, the side or behind, or on foot.
    Blow(Blow),
    /// The vehicle rolls over.
    Rollover,
    /// No impact: the vehicle keeps its velocity.
    None,
}

/// Motion of the vehicle that carries a body.
#[derive(Clone, Copy, Debug)]
struct Carried {
    start: Matrix3<f64>,
    velocity_m_s: Vector3<f64>,
    /// Delta-v in vehicle axes, and its largest horizontal value.
    now_m_s: Vector3<f64>,
    delta_v_m_s: Vector3<f64>,
    /// Least cosine of the tilt.
    upright: f64,
    /// When the body was struck on foot, s.
    struck_s: Option<f64>,
}

/// Watches the vehicles of all bodies during a run.
#[derive(Clone, Debug, Default)]
pub struct Impact {
    bodies: Vec<Option<Carried>>,
}

impl Carried {
    fn see(&mut self, rotation: &Matrix3<f64>, velocity_m_s: Vector3<f64>) {
        self.now_m_s += rotation.tr_mul(&(velocity_m_s - self.velocity_m_s));
        self.velocity_m_s = velocity_m_s;
        if self.now_m_s.xy().norm() > self.delta_v_m_s.xy().norm() {
            self.delta_v_m_s = self.now_m_s;
        }
        self.upright = self.upright.min(rotation.column(2).dot(&self.start.column(2)));
    }

    fn tilt_deg(&self) -> f64 {
        trig::atan2((1.0 - self.upright * self.upright).max(0.0).sqrt(), self.upright).to_degrees()
    }

    /// Angle of the impact from straight ahead: that of the opposite of the delta-v.
    fn angle_deg(&self) -> f64 {
        trig::atan2(self.delta_v_m_s.y.abs(), -self.delta_v_m_s.x).to_degrees()
    }

    fn direction(&self) -> Direction {
        if self.tilt_deg() > TILT_DEG {
            return Direction::Rollover;
        }
        if self.delta_v_m_s.xy().norm() < LEAST_M_S {
            return self.struck_s.map_or(Direction::None, |_| Direction::Blow(Blow::OnFoot));
        }
        match self.angle_deg() {
            angle if angle <= SECTOR_DEG => Direction::Blow(Blow::Front),
            angle if angle < 180.0 - SECTOR_DEG => Direction::Blow(Blow::Side),
            _ => Direction::Blow(Blow::Rear),
        }
    }

    /// The direction, and why.
    fn reason(&self, units: Units) -> String {
        let speed = units.say(self.delta_v_m_s.xy().norm(), "m/s", 1);
        let side = if self.delta_v_m_s.y > 0.0 { "left" } else { "right" };
        let angle = self.angle_deg();
        let beside = if !(0.5..179.5).contains(&angle) { String::new() } else { format!(" to the {side}") };
        let why = format!("delta-v of the vehicle {speed}, struck {angle:.0}° from straight ahead{beside}");
        match self.direction() {
            Direction::Rollover => {
                format!("Rollover: the vehicle tilts by {:.0}°. Limits of crash tests do not apply", self.tilt_deg())
            }
            Direction::None => {
                format!("No impact on the vehicle: its velocity changes by {speed}. Limits are of frontal tests")
            }
            Direction::Blow(Blow::Front) => format!("Frontal impact: {why}"),
            Direction::Blow(Blow::Side) => format!("Side impact from the {side}: {why}"),
            Direction::Blow(Blow::Rear) => format!("Rear impact: {why}"),
            Direction::Blow(Blow::OnFoot) => format!(
                "Struck on foot at {:.1} ms: limits are those of headforms on the fronts of cars",
                1e3 * self.struck_s.unwrap_or_default()
            ),
        }
    }
}

impl Impact {
    fn carried(&self, body: usize) -> Option<&Carried> {
        self.bodies.get(body)?.as_ref()
    }

    /// Direction of the impact on the vehicle of a body (index).
    pub fn direction(&self, body: usize) -> Direction {
        self.carried(body).map_or(Direction::None, Carried::direction)
    }

    /// The directions and their reasons in words, each once.
    pub fn reasons(&self, units: Units) -> Vec<String> {
        let mut all: Vec<String> = self.bodies.iter().flatten().map(|carried| carried.reason(units)).collect();
        all.dedup();
        all
    }

    /// Judges all bodies by the rules for their impacts. Rules without a direction hold for all.
    pub fn judge(&mut self, summary: &mut Summary, model: &Model) {
        for (body, carried) in model.body().tree.bodies().iter().zip(&mut self.bodies) {
            let struck_s = summary.throws.get(body.name).map(|throw| throw.struck_s);
            carried.iter_mut().for_each(|own| own.struck_s = struck_s);
        }
        let (name, dummy, measures) = (summary.occupant, &mut summary.dummy, &mut summary.measures);
        self.judge_one(name, dummy, measures, model);
        let others = summary.others.iter().map(|(name, person)| {
            let mut person = person.clone();
            self.judge_one(name, &mut person.dummy, &mut person.measures, model);
            (*name, person)
        });
        summary.others = others.collect();
    }

    fn judge_one(&self, name: &str, dummy: &mut &'static str, measures: &mut [injury::Measure], model: &Model) {
        let tree = model.body().tree;
        let Some(body) = tree.bodies().iter().position(|row| row.name == name) else { return };
        let direction = self.direction(body);
        if ![Direction::None, Direction::Blow(Blow::Front)].contains(&direction) {
            measures.iter_mut().filter(|own| FRONTAL_RISKS.contains(&own.name)).for_each(|own| own.risks.clear());
        }
        match direction {
            Direction::None => {}
            Direction::Blow(Blow::OnFoot) => {
                let options = Options::default();
                measures.iter_mut().for_each(|own| judge_by(own, Blow::OnFoot, &options));
            }
            Direction::Blow(Blow::Side) => {
                let own = tree.segments().filter(|one| tree.body_of(*one) == body);
                let options = Options::default().for_side(own.map(|one| model.body().segment(one).mass_kg).sum());
                *dummy = options.dummy.name();
                measures.iter_mut().for_each(|own| judge_by(own, Blow::Side, &options));
            }
            direction => measures.iter_mut().for_each(|m| m.limits.retain(|limit| fits(limit.rule, direction))),
        }
    }
}

/// Whether a rule, by its name, is for impacts of this direction.
fn fits(rule: &str, direction: Direction) -> bool {
    let blow = LIMITS.iter().find(|limit| limit.rule.name() == rule).and_then(|limit| limit.rule.blow());
    blow.is_none_or(|blow| Direction::Blow(blow) == direction)
}

/// Measures whose risks are from frontal tests.
const FRONTAL_RISKS: [&str; 8] = [
    "nij",
    "neck_tension",
    "neck_compression",
    "chest_3ms_cumulative",
    "chest_deflection",
    "cti",
    "right_femur",
    "left_femur",
];

/// Quantities that rules for other impacts limit and that every body has, by the names of their measures.
const OF_ALL: [(&str, Quantity); 3] =
    [("hic15", Quantity::Hic15), ("hic36", Quantity::Hic36), ("head_3ms_cumulative", Quantity::HeadThreeMsCumulative)];

/// Leaves the limits of rules for an impact. Measures of every body that have none get those of a dummy.
fn judge_by(measure: &mut injury::Measure, blow: Blow, options: &Options) {
    measure.limits.retain(|limit| fits(limit.rule, Direction::Blow(blow)));
    let is_judged =
        measure.limits.iter().any(|limit| RULES.iter().any(|r| r.name() == limit.rule && r.blow().is_some()));
    let known = OF_ALL.iter().find(|(name, _)| *name == measure.name).filter(|_| !is_judged);
    if let (Some((_, quantity)), Some(value)) = (known, measure.value) {
        measure.limits.extend(limits(*quantity, blow, options.dummy).map(|limit| Judgement::of(limit, value)));
    }
}

fn limits(quantity: Quantity, blow: Blow, dummy: Dummy) -> impl Iterator<Item = &'static Limit> {
    let is_own = move |limit: &&Limit| limit.dummy.is_none_or(|own| own == dummy) && limit.quantity == quantity;
    let is_last = |limit: &&Limit| matches!(limit.grade, Grade::Maximum | Grade::LowerPerformance);
    LIMITS.iter().filter(move |limit| limit.rule.blow() == Some(blow)).filter(is_own).filter(is_last)
}

impl Recorder for Impact {
    fn begin(&mut self, model: &Model) -> Result<(), RecorderError> {
        self.bodies = vec![None; model.body().tree.bodies().len().max(1)];
        Ok(())
    }

    fn record(&mut self, s: &Sample<'_>) -> Result<Flow, RecorderError> {
        for (body, carried) in self.bodies.iter_mut().enumerate() {
            let home = s.homes.get(body).unwrap_or(s.vehicle);
            let new = || Carried {
                start: home.rotation,
                velocity_m_s: home.velocity_m_s,
                now_m_s: Vector3::zeros(),
                delta_v_m_s: Vector3::zeros(),
                upright: 1.0,
                struck_s: None,
            };
            carried.get_or_insert_with(new).see(&home.rotation, home.velocity_m_s);
        }
        Ok(Flow::Continue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A vehicle that turns by `turns` about its vertical axis while it is pushed by `push` in its own axes.
    fn pushed(push: [f64; 3], turns: f64) -> Carried {
        let (mut velocity, mut rotation) = (Vector3::new(10.0, 0.0, 0.0), Matrix3::identity());
        let new = |velocity_m_s| Carried {
            start: rotation,
            velocity_m_s,
            now_m_s: Vector3::zeros(),
            delta_v_m_s: Vector3::zeros(),
            upright: 1.0,
            struck_s: None,
        };
        let mut carried = new(velocity);
        for i in 0..=1000 {
            let (sin, cos) = (turns * f64::from(i) * 2e-3 * std::f64::consts::PI).sin_cos();
            rotation = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
            velocity += rotation * Vector3::from(push) * 1e-3;
            carried.see(&rotation, velocity);
        }
        carried
    }

    #[test]
    fn the_direction_is_that_of_the_delta_v_in_the_vehicle_however_it_turns() {
        use Direction::{Blow as By, None, Rollover};
        for (push, direction) in [
            ([-8.0, 0.0, 0.0], By(Blow::Front)),
            ([-8.0, 7.9, 0.0], By(Blow::Front)),
            ([-8.0, -8.1, 0.0], By(Blow::Side)),
            ([0.0, 8.0, 0.0], By(Blow::Side)),
            ([8.0, 7.9, 0.0], By(Blow::Rear)),
            ([0.9, 0.0, 30.0], None),
        ] {
            for turns in [0.0, 0.7] {
                assert_eq!(pushed(push, turns).direction(), direction, "{push:?} {turns}");
            }
        }
        let mut rolled = pushed([-8.0, 0.0, 0.0], 0.0);
        rolled.see(&Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.6, -0.8, 0.0, 0.8, 0.6), rolled.velocity_m_s);
        assert_eq!(rolled.direction(), Rollover);
        assert!((rolled.tilt_deg() - 53.13).abs() < 0.01);
        assert!(
            pushed([0.0, 8.0, 0.0], 0.0).reason(Units::default()).starts_with("Side impact from the left: delta-v")
        );
    }

    #[test]
    fn rules_hold_for_impacts_of_their_direction() {
        let side = Direction::Blow(Blow::Side);
        assert!(!fits("FMVSS 208", side) && fits("UN R95", side) && fits("severity index (historical)", side));
        assert!(!fits("FMVSS 208", Direction::Rollover) && fits("FMVSS 208", Direction::Blow(Blow::Front)));
        assert!(limits(Quantity::Hic36, Blow::Side, Dummy::Es2).count() > 0);
        let on_foot = Direction::Blow(Blow::OnFoot);
        assert!(fits("UN R127 (headform)", on_foot) && !fits("UN R127 (headform)", side) && !fits("UN R94", on_foot));
    }

    #[test]
    fn a_body_on_the_ground_that_is_thrown_was_struck_on_foot() {
        let mut still = pushed([0.0; 3], 0.0);
        assert_eq!(still.direction(), Direction::None);
        still.struck_s = Some(0.0738);
        assert_eq!(still.direction(), Direction::Blow(Blow::OnFoot));
        assert!(still.reason(Units::default()).contains("on foot at 73.8 ms"));
        // who is thrown out of a vehicle that is hit is judged by the impact on it
        let mut hit = pushed([-8.0, 0.0, 0.0], 0.0);
        hit.struck_s = Some(0.1);
        assert_eq!(hit.direction(), Direction::Blow(Blow::Front));
    }
}
