//! `[bags]` and `[gases]`: their keys, converted to [`Bag`]s.

use indexmap::IndexMap;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::builder::Builder;
use super::quantity::{FRACTION, NOT_NEGATIVE, POSITIVE, all_si, point, si_or};
use super::triggers::Triggers;
use super::{
    Area, HeatTransfer, Length, Mass, MassFlow, MolarMass, Pressure, Quantity, Ratio, Scenario, SpecificHeat,
    SpecificHeatSlope, Speed, Temperature, Time, Volume,
};
use occupant_core::body::Body;
use occupant_core::forces::bag::{AMBIENT, Bag, GAS_CONSTANT_J_MOL_K, Gas, Inflator, Leakage, Shape, Vent};
use occupant_core::forces::chain::NEVER;
use occupant_core::forces::contact::material::DEFAULT_FRICTION_SPEED_M_S;
use occupant_core::forces::contact::surface::Frame;
use placed_text::with_key;

/// An ideal gas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GasSection {
    /// Molar mass.
    pub(crate) molar_mass: MolarMass<POSITIVE>,
    /// Specific heat at constant pressure. If it rises with temperature, its value extrapolated to 0 K.
    pub(crate) cp: SpecificHeat<POSITIVE>,
    /// Rise of the specific heat per kelvin; 0 if absent.
    pub(crate) cp_slope: Option<SpecificHeatSlope<NOT_NEGATIVE>>,
}

/// An air bag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["dome", "sphere", "capsule"], ["leakage", "permeability"]],
))]
pub(crate) struct BagSection {
    /// Name of a bag of the library. It gives every absent key except `trigger`, `mount` and, for a curtain or side
    /// bag, `capsule`. Its numbers are invented.
    #[schemars(extend("enum" = ["driver", "passenger", "curtain", "side"]))]
    pub(crate) library: Option<String>,
    /// Name of the trigger that fires it, by time or by the vehicle's motion.
    pub(crate) trigger: String,
    /// Time from the trigger until it fires; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Time from firing until it is unfolded; its volume grows linearly from 2 %.
    pub(crate) deploy: Option<Time<POSITIVE>>,
    /// What it is fixed to: "vehicle", or the name of a frame of the first vehicle, such as a column; "vehicle" if absent.
    pub(crate) frame: Option<String>,
    /// Mounting point, from which it unfolds, axes of its frame.
    pub(crate) mount: [Length; 3],
    /// A driver bag: a cylinder from its mount with a spherical face.
    pub(crate) dome: Option<DomeSection>,
    /// A sphere.
    pub(crate) sphere: Option<BallSection>,
    /// A passenger, side or curtain bag: everything within a radius of a straight line.
    pub(crate) capsule: Option<BagCapsuleSection>,
    /// Full volume; that of the shape if absent. It must be within 30 % of the volume of the shape.
    pub(crate) volume: Option<Volume<POSITIVE>>,
    /// Inflators: one, or two stages.
    pub(crate) inflators: Option<Vec<InflatorSection>>,
    /// Vents, at most four.
    pub(crate) vents: Option<Vec<VentSection>>,
    /// Fraction of the fabric that leaks like an opening; 0 if absent.
    pub(crate) leakage: Option<Ratio<FRACTION>>,
    /// Fabric permeability: gas speed over gauge pressure.
    pub(crate) permeability: Option<PermeabilitySection>,
    /// Heat transfer through the fabric; 0 if absent.
    pub(crate) heat_transfer: Option<HeatTransfer<NOT_NEGATIVE>>,
    /// Friction of the body on the fabric; 0 if absent.
    pub(crate) friction: Option<Ratio<NOT_NEGATIVE>>,
    /// Sliding speed at which friction reaches 71 % of its full value, as for a material.
    pub(crate) friction_speed: Option<Speed<POSITIVE>>,
    /// Names of the body parts or spheres that it touches, at most 20 spheres. Overlapping volume counts once.
    pub(crate) spheres: Option<Vec<String>>,
    /// With several occupants, the one that it touches; all in the first vehicle if absent.
    pub(crate) occupant: Option<String>,
    /// Factor on the contact area of a part or sphere that represents a larger body region; for a part, it applies to
    /// the first sphere, to which the others add. 1 if absent.
    #[serde(default, skip_serializing_if = "IndexMap::is_empty")]
    pub(crate) reach: IndexMap<String, Ratio<POSITIVE>>,
    /// Mass of cover and fabric thrown forward as the bag unfolds, which strikes a body in its path. 0 if absent.
    pub(crate) cover: Option<Mass<NOT_NEGATIVE>>,
    /// The air around it.
    pub(crate) ambient: Option<AmbientSection>,
}

/// A cylinder that ends in the face of a ball.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DomeSection {
    /// Direction towards the occupant, axes of its frame; any length.
    pub(crate) axis: [Ratio; 3],
    /// Distance from the mount to the centre of the face.
    pub(crate) depth: Length<POSITIVE>,
    /// Radius of the cylinder.
    pub(crate) radius: Length<POSITIVE>,
    /// Radius of the sphere that the face is part of; more than the depth.
    pub(crate) face_radius: Length<POSITIVE>,
    /// Radius of the edge of the face; 0 if absent.
    pub(crate) edge: Option<Length<NOT_NEGATIVE>>,
}

/// A sphere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BallSection {
    /// Its centre, axes of its frame.
    pub(crate) centre: [Length; 3],
    /// Its radius.
    pub(crate) radius: Length<POSITIVE>,
}

/// Everything within a radius of a straight line.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BagCapsuleSection {
    /// Ends of the line, axes of its frame.
    pub(crate) ends: [[Length; 3]; 2],
    /// Radius about that line.
    pub(crate) radius: Length<POSITIVE>,
}

/// A source of gas for a bag: its flow over time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct InflatorSection {
    /// Mass fractions by the names of gases; their sum is 1.
    pub(crate) gas: IndexMap<String, Ratio<FRACTION>>,
    /// Name of its own trigger, such as that of a second stage; that of the bag if absent.
    pub(crate) trigger: Option<String>,
    /// Time from trigger to ignition. If absent, that of the bag, or 0 with its own trigger.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
    /// Times since ignition.
    pub(crate) times: Vec<Time<NOT_NEGATIVE>>,
    /// Mass flow at each time; none before the first and after the last.
    pub(crate) flow: Vec<MassFlow<NOT_NEGATIVE>>,
    /// Temperature of the gas at each time.
    pub(crate) temperature: Vec<Temperature<POSITIVE>>,
    /// Closed-tank test, to check the table.
    pub(crate) tank: Option<TankSection>,
}

/// A closed tank of air that an inflator was fired into.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TankSection {
    /// Its volume.
    pub(crate) volume: Volume<POSITIVE>,
    /// Peak gauge pressure in it.
    pub(crate) pressure: Pressure<POSITIVE>,
}

/// A hole. It is open from the start if nothing opens it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VentSection {
    /// Its area.
    pub(crate) area: Area<NOT_NEGATIVE>,
    /// Its discharge coefficient.
    pub(crate) discharge: Ratio<POSITIVE>,
    /// Gauge pressure that opens it for good.
    pub(crate) opens_at: Option<Pressure<NOT_NEGATIVE>>,
    /// Name of the trigger that opens it.
    pub(crate) trigger: Option<String>,
    /// Time from the trigger until it opens; 0 if absent.
    pub(crate) delay: Option<Time<NOT_NEGATIVE>>,
}

/// Speed of gas through fabric.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PermeabilitySection {
    /// Gauge pressures, from 0.
    pub(crate) pressure: Vec<Pressure<NOT_NEGATIVE>>,
    /// Gas speed at each pressure, from 0; must not fall.
    pub(crate) speed: Vec<Speed<NOT_NEGATIVE>>,
}

/// The air around a bag.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct AmbientSection {
    /// Its pressure; 101 325 Pa if absent.
    pub(crate) pressure: Option<Pressure<POSITIVE>>,
    /// Its temperature; 293.15 K if absent.
    pub(crate) temperature: Option<Temperature<POSITIVE>>,
}

/// All bags, in the order written.
pub(super) fn bags(b: &mut Builder, scenario: &Scenario, body: &Body, triggers: &Triggers<'_>) -> Vec<Bag> {
    let parts = Parts { scenario, triggers };
    scenario.bags.iter().filter_map(|(name, section)| parts.bag(b, name, section, body)).collect()
}

/// Objects that bags refer to.
struct Parts<'a> {
    scenario: &'a Scenario,
    triggers: &'a Triggers<'a>,
}

impl Parts<'_> {
    fn bag(&self, b: &mut Builder, name: &str, s: &BagSection, body: &Body) -> Option<Bag> {
        let path = with_key("bags", name);
        let shape = said(b, &path, "`dome`, `sphere` or `capsule`", shape(s))?;
        let deploy_s = said(b, &path, "`deploy`", s.deploy.as_ref())?.si();
        let inflators = said(b, &path, "`inflators`", s.inflators.as_ref())?;
        let names = said(b, &path, "`spheres`", s.spheres.as_ref())?;
        let fires_s = self.due_s(b, &path, &s.trigger, &s.delay);
        let inflators = inflators.iter().enumerate();
        let inflators = inflators.map(|(i, one)| self.inflator(b, &format!("{path}.inflators[{i}]"), one, s)).collect();
        let vents = s.vents.iter().flatten().enumerate();
        let vents = vents.map(|(i, vent)| self.vent(b, &format!("{path}.vents[{i}]"), vent)).collect();
        let air = s.ambient.as_ref();
        let ambient = [
            air.map_or(AMBIENT[0], |air| si_or(&air.pressure, AMBIENT[0])),
            air.map_or(AMBIENT[1], |air| si_or(&air.temperature, AMBIENT[1])),
        ];
        Some(Bag {
            name: name.to_owned(),
            frame: self.frame(b, &path, s),
            mount_m: point(&s.mount),
            shape,
            volume_m3: si_or(&s.volume, shape.volume_m3()),
            fires_s,
            deploy_s,
            ambient,
            inflators,
            vents,
            leakage: leakage(b, &path, s),
            cover_kg: si_or(&s.cover, 0.0),
            heat_w_m2_k: si_or(&s.heat_transfer, 0.0),
            friction: si_or(&s.friction, 0.0),
            friction_speed_m_s: si_or(&s.friction_speed, DEFAULT_FRICTION_SPEED_M_S),
            spheres: spheres(b, &path, (s, names), body),
        })
    }

    /// Its frame.
    fn frame(&self, b: &mut Builder, path: &str, s: &BagSection) -> Frame {
        let at = with_key(path, "frame");
        let frame = b.frame(self.scenario, &at, s.frame.as_deref());
        if self.scenario.vehicle_of(frame) != Some(Frame::Vehicle) {
            let found =
                format!("`{}`, which does not move with the first vehicle", s.frame.as_deref().unwrap_or_default());
            b.error(&at, found, "\"vehicle\", or a frame that moves with it; air bags elsewhere are not supported");
        }
        frame
    }

    /// Time of an event triggered by a trigger.
    fn due_s(&self, b: &mut Builder, path: &str, trigger: &str, delay: &Option<Time<NOT_NEGATIVE>>) -> f64 {
        let at = self.triggers.time_s(b, &format!("{path}.trigger"), trigger);
        at.map_or(NEVER, |at_s| at_s + si_or(delay, 0.0))
    }

    fn inflator(&self, b: &mut Builder, path: &str, s: &InflatorSection, bag: &BagSection) -> Inflator {
        let due_s = match &s.trigger {
            Some(trigger) => self.due_s(b, path, trigger, &s.delay),
            None => self.due_s(b, path, &bag.trigger, if s.delay.is_some() { &s.delay } else { &bag.delay }),
        };
        let counts = [s.times.len(), s.flow.len(), s.temperature.len()];
        if counts.iter().any(|count| *count != counts[0]) {
            let found = format!("{} times, {} flows and {} temperatures", counts[0], counts[1], counts[2]);
            b.error(path, found, "the same number of each");
        }
        let rows = s.times.iter().zip(&s.flow).zip(&s.temperature);
        Inflator {
            gas: self.gas(b, path, s),
            due_s,
            rows: rows.map(|((time, flow), temperature)| [time.si(), flow.si(), temperature.si()]).collect(),
            tank: s.tank.as_ref().map(|tank| [tank.volume.si(), tank.pressure.si()]),
        }
    }

    fn gas(&self, b: &mut Builder, path: &str, s: &InflatorSection) -> Gas {
        let path = format!("{path}.gas");
        let sum: f64 = s.gas.values().map(Quantity::si).sum();
        if sum.is_nan() || (sum - 1.0).abs() > 1e-6 {
            b.error(&path, format!("mass fractions with the sum {sum}"), "fractions with the sum 1");
        }
        let mut parts = Vec::new();
        for (name, fraction) in &s.gas {
            match self.scenario.gases.get(name).map(gas).or_else(|| Gas::named(name)) {
                Some(gas) => parts.push((gas, fraction.si())),
                None => {
                    let own = self.scenario.gases.keys().map(String::as_str);
                    let names: Vec<&str> = own.chain(Gas::NAMES).collect();
                    b.unknown(&with_key(&path, name), "gas", name, &names);
                }
            }
        }
        Gas::mixed(parts)
    }

    fn vent(&self, b: &mut Builder, path: &str, s: &VentSection) -> Vent {
        let is_open = s.opens_at.is_none() && s.trigger.is_none();
        Vent {
            area_m2: s.area.si(),
            discharge: s.discharge.si(),
            opens_at_pa: si_or(&s.opens_at, if is_open { 0.0 } else { NEVER }),
            due_s: s.trigger.as_ref().map_or(NEVER, |trigger| self.due_s(b, path, trigger, &s.delay)),
        }
    }
}

fn gas(s: &GasSection) -> Gas {
    Gas { r_j_kg_k: GAS_CONSTANT_J_MOL_K / s.molar_mass.si(), a_j_kg_k: s.cp.si(), b_j_kg_k2: si_or(&s.cp_slope, 0.0) }
}

/// A value from the bag's own section or the library.
fn said<T>(b: &mut Builder, path: &str, key: &str, value: Option<T>) -> Option<T> {
    if value.is_none() {
        b.error(path, format!("a bag without {key}"), format!("{key}, or `library` with a bag that has it"));
    }
    value
}

/// The shape of a section; a dome of the library is replaced by the section's own.
fn shape(s: &BagSection) -> Option<Shape> {
    let dome = s.dome.as_ref().map(|dome| Shape::Dome {
        axis: Vector3::from(all_si(&dome.axis)),
        depth_m: dome.depth.si(),
        radius_m: dome.radius.si(),
        face_radius_m: dome.face_radius.si(),
        edge_m: si_or(&dome.edge, 0.0),
    });
    let sphere = s.sphere.as_ref();
    let sphere = sphere.map(|ball| Shape::Sphere { centre_m: point(&ball.centre), radius_m: ball.radius.si() });
    let capsule = s.capsule.as_ref();
    let capsule =
        capsule.map(|one| Shape::Capsule { ends_m: one.ends.each_ref().map(point), radius_m: one.radius.si() });
    capsule.or(sphere).or(dome)
}

fn leakage(b: &mut Builder, path: &str, s: &BagSection) -> Leakage {
    let Some(table) = &s.permeability else { return Leakage::Fraction(si_or(&s.leakage, 0.0)) };
    if table.pressure.len() != table.speed.len() {
        let found = format!("{} pressures and {} speeds", table.pressure.len(), table.speed.len());
        b.error(&format!("{path}.permeability"), found, "the same number of each");
    }
    Leakage::Speed(table.pressure.iter().zip(&table.speed).map(|(p, v)| [p.si(), v.si()]).collect())
}

/// Its spheres, each with the `reach` of its own name or of its part.
fn spheres(b: &mut Builder, path: &str, (s, names): (&BagSection, &[String]), body: &Body) -> Vec<(usize, f64)> {
    if names.is_empty() {
        b.error(&format!("{path}.spheres"), "0 spheres", "1 to 20 spheres that the bag can touch");
    }
    let list = b.spheres(&format!("{path}.spheres"), names, body);
    let reach = format!("{path}.reach");
    for name in s.reach.keys().filter(|name| !body.spheres_called(name).iter().any(|sphere| list.contains(sphere))) {
        b.error(&with_key(&reach, name), format!("\"{name}\", which is not one of its spheres"), "a name of `spheres`");
    }
    let reach_of = |sphere: usize| {
        let mut called = s.reach.iter().map(|(name, reach)| (body.spheres_called(name), reach.si()));
        let called = called.rfind(|(part, _)| part.contains(&sphere));
        called.map_or(1.0, |(part, reach)| if reach > 1.0 { (reach / widening(body, &part)).max(1.0) } else { reach })
    };
    list.into_iter().map(|sphere| (sphere, reach_of(sphere))).collect()
}

/// Sampling points over the width of a sphere when areas are counted.
const POINTS: i32 = 100;

/// Ratio of the frontal area covered by all spheres of a part to that of the first one.
fn widening(body: &Body, part: &[usize]) -> f64 {
    let Some(first) = part.first().map(|first| &body.spheres[*first]) else { return 1.0 };
    let own = part.iter().map(|sphere| &body.spheres[*sphere]).filter(|sphere| sphere.segment == first.segment);
    let discs: Vec<[f64; 3]> =
        own.map(|s| [s.centre_from_lower_end_m.y, s.centre_from_lower_end_m.z, s.radius_m]).collect();
    if discs.len() < 2 {
        return 1.0;
    }
    let ends = |i: usize| {
        let low = discs.iter().map(|disc| disc[i] - disc[2]).fold(f64::INFINITY, f64::min);
        let high = discs.iter().map(|disc| disc[i] + disc[2]).fold(f64::NEG_INFINITY, f64::max);
        [low, high]
    };
    let step = 2.0 * first.radius_m / f64::from(POINTS);
    let line = |[low, high]: [f64; 2]| {
        let count = ((high - low) / step).ceil().min(4e3) as usize;
        (0..count).map(move |i| low + (i as f64 + 0.5) * step)
    };
    let is_within =
        |y: f64, z: f64| discs.iter().any(|disc| (y - disc[0]).powi(2) + (z - disc[1]).powi(2) < disc[2].powi(2));
    let count: usize = line(ends(0)).map(|y| line(ends(1)).filter(|z| is_within(y, *z)).count()).sum();
    (count as f64 * step * step / (std::f64::consts::PI * first.radius_m.powi(2))).max(1.0)
}
