//! `[drive.vehicles.NAME]`: a preset, what replaces its numbers, the load, the start.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use vehicle_motion::V3;
use vehicle_motion::car::{Car, Class};
use vehicle_motion::run::Start;

use super::super::builder::Builder;
use super::super::quantity::{NOT_NEGATIVE, POSITIVE, all_si, si_or};
use super::super::{Angle, AngularVelocity, Area, Inertia, Length, Mass, Ratio, Speed};
use super::crush::CrushSection;
use super::driver::{
    AfterImpact, BrakeSection, FollowSection, SpeedSection, SteerSection, ThrottleSection, WheelsSection,
};
use super::parts::{BrakesSection, SuspensionSection, TyresSection, put};
use super::{DrivenVehicle, People, warn_of_load};
use placed_text::{Problem, with_key};

/// A vehicle of `drive`. Keys that are absent take the value of the preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "x-at-most-one" = [["steer", "follow"], ["speed", "hold_speed"], ["speed", "brake"], ["speed", "drive"], ["hold_speed", "brake"], ["hold_speed", "drive"], ["payload", "load"]],
))]
pub(crate) struct DrivenSection {
    /// Vehicle class: "small" (MASH 1100C), "sedan", "suv", "van", "pickup" (MASH 2270P), "en900", "en1500" (EN 1317),
    /// or a measured car of the 1980s, "bmw-320i" or "vanagon".
    #[schemars(extend("enum" = ["small", "sedan", "suv", "van", "pickup", "en900", "en1500", "bmw-320i", "vanagon"]))]
    pub(crate) preset: String,
    /// Kerb mass, without occupants and load.
    pub(crate) mass: Option<Mass<POSITIVE>>,
    /// Wheelbase.
    pub(crate) wheelbase: Option<Length<POSITIVE>>,
    /// Distance of the centre of gravity behind the front axle.
    pub(crate) cg_behind_front_axle: Option<Length<POSITIVE>>,
    /// Height of the centre of gravity above the road.
    pub(crate) cg_height: Option<Length<POSITIVE>>,
    /// Track width of both axles.
    pub(crate) track: Option<Length<POSITIVE>>,
    /// Roll, pitch and yaw moments of inertia about the centre of gravity. If absent and mass, wheelbase or track is
    /// given, estimated from them.
    pub(crate) inertia: Option<[Inertia<POSITIVE>; 3]>,
    /// Frontal area times drag coefficient.
    pub(crate) drag_area: Option<Area<NOT_NEGATIVE>>,
    /// Front and rear suspension.
    pub(crate) suspension: Option<SuspensionSection>,
    /// Tyres.
    pub(crate) tyres: Option<TyresSection>,
    /// Brakes.
    pub(crate) brakes: Option<BrakesSection>,
    /// Distribution of the drive torque: left front, right front, left rear, right rear; front-wheel drive if absent.
    pub(crate) drive_shares: Option<[Ratio<NOT_NEGATIVE>; 4]>,
    /// Steering ratio: steering-wheel angle over front-wheel angle; 16 if absent.
    pub(crate) steering_ratio: Option<Ratio<POSITIVE>>,
    /// "from occupants": the occupants' mass is added to the vehicle, as if they were fixed in it. If absent the
    /// vehicle drives without their mass.
    #[schemars(extend("enum" = ["from occupants"]))]
    pub(crate) payload: Option<String>,
    /// A fixed load, instead of the occupants.
    pub(crate) load: Option<LoadSection>,
    /// Initial position and motion, on the ground.
    #[serde(default)]
    pub(crate) start: StartSection,
    /// Steering over time; straight ahead if neither this nor `follow` is given.
    pub(crate) steer: Option<SteerSection>,
    /// A path that the driver follows.
    pub(crate) follow: Option<FollowSection>,
    /// Brake over time.
    pub(crate) brake: Option<BrakeSection>,
    /// Drive torque over time.
    pub(crate) drive: Option<ThrottleSection>,
    /// Speed over time, which the driver follows by drive and brake.
    pub(crate) speed: Option<SpeedSection>,
    /// Speed that the driver holds by drive and brake.
    pub(crate) hold_speed: Option<Speed<NOT_NEGATIVE>>,
    /// Wheels that lock.
    pub(crate) wheels: Option<WheelsSection>,
    /// What the driver does after the first collision; "release" if absent. Unless it is "continue", the steering wheel
    /// is held.
    pub(crate) on_impact: Option<AfterImpact>,
    /// Crush stiffness.
    pub(crate) crush: Option<CrushSection>,
}

/// A load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LoadSection {
    /// Mass.
    pub(crate) mass: Mass<POSITIVE>,
    /// [x, z] of its centre from the vehicle's unladen centre of gravity, vehicle axes; [0, 0] if absent.
    pub(crate) at: Option<[Length; 2]>,
}

/// A start.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct StartSection {
    /// x of the centre of gravity; 0 if absent.
    pub(crate) x: Option<Length>,
    /// y of the centre of gravity, to the right; 0 if absent.
    pub(crate) y: Option<Length>,
    /// Heading, to the right of x; 0 if absent.
    pub(crate) yaw: Option<Angle>,
    /// Speed along the ground; 0 if absent.
    pub(crate) speed: Option<Speed<NOT_NEGATIVE>>,
    /// Sideslip: direction of travel to the right of the heading; 0 if absent.
    pub(crate) sideslip: Option<Angle>,
    /// Yaw rate, to the right; 0 if absent.
    pub(crate) yaw_rate: Option<AngularVelocity>,
    /// True: the wheels start locked, without spin. False if absent: they roll.
    pub(crate) wheels_stand: Option<bool>,
}

impl StartSection {
    pub(super) fn start(&self) -> Start {
        Start {
            x_m: si_or(&self.x, 0.0),
            y_m: si_or(&self.y, 0.0),
            yaw_rad: si_or(&self.yaw, 0.0),
            speed_m_s: si_or(&self.speed, 0.0),
            sideslip_rad: si_or(&self.sideslip, 0.0),
            yaw_rate_rad_s: si_or(&self.yaw_rate, 0.0),
            wheels_stand: self.wheels_stand == Some(true),
        }
    }
}

impl DrivenSection {
    /// Whether its load depends on its occupants.
    pub(super) fn takes_people(&self) -> bool {
        self.payload.is_some()
    }

    /// The vehicle on a road with this friction; mistakes are reported.
    pub(super) fn vehicle(
        &self,
        b: &mut Builder,
        at: &str,
        name: &str,
        friction: f64,
        (people, carries, passes): (Option<&People>, bool, bool),
    ) -> Option<DrivenVehicle> {
        let preset = Class::named(&self.preset)?.preset();
        let mut sized = *preset;
        put(&mut sized.mass_kg, &self.mass);
        put(&mut sized.wheelbase_m, &self.wheelbase);
        put(&mut sized.behind_front_m, &self.cg_behind_front_axle);
        put(&mut sized.height_m, &self.cg_height);
        put(&mut sized.track_m, &self.track);
        if sized.behind_front_m >= sized.wheelbase_m {
            let found = format!("a centre of gravity {} m behind the front axle", sized.behind_front_m);
            let expected = format!("between the axles, which are {} m apart", sized.wheelbase_m);
            b.error(&with_key(at, "cg_behind_front_axle"), found, expected);
            return None;
        }
        let mut car = sized.car();
        if let Some(inertia) = &self.inertia {
            car.inertia_kg_m2 = nalgebra::Matrix3::from_diagonal(&V3::from(all_si(inertia)));
        }
        if let Some(area) = &self.drag_area {
            car.drag_n_s2_per_m2 = 0.5 * AIR_KG_M3 * area.si();
        }
        let suspension = self.suspension.as_ref();
        let loads_n = car.static_loads_n();
        if let Some(front) = suspension.and_then(|own| own.front.as_ref()) {
            front.fit(&mut car.front, loads_n[0]);
        }
        if let Some(rear) = suspension.and_then(|own| own.rear.as_ref()) {
            rear.fit(&mut car.rear, loads_n[1]);
        }
        car.tyre.friction = friction;
        if let Some(tyres) = &self.tyres {
            tyres.fit(&mut car);
        }
        if let Some(shares) = self.brakes.as_ref().and_then(|brakes| brakes.shares.as_ref()) {
            car.brake_share = all_si(shares);
        }
        if let Some(shares) = &self.drive_shares {
            car.drive_share = all_si(shares);
        }
        self.crush.clone().unwrap_or_default().fit(b, &with_key(at, "crush"), &mut car, carries);
        if let Err(error) = car.check() {
            b.error(at, error.to_string(), "a vehicle that can stand on its wheels");
            return None;
        }
        self.warn(b, at, &car);
        let load = self.load.as_ref().map(|load| {
            let [x, z] = load.at.as_ref().map_or([0.0; 2], all_si);
            (load.mass.si(), V3::new(x, 0.0, z))
        });
        let unladen = car.clone();
        let mut origin_m = V3::zeros();
        let people = people.filter(|_| self.takes_people()).map(|people| (people.mass_kg, people.centre_m));
        if let Some((load_kg, centre_m)) = load.or(people) {
            let are_people = self.load.is_none();
            if !(are_people && passes) {
                warn_of_load(b, at, load_kg, car.mass_kg, are_people);
            }
            // wheels stand symmetrically: a load to one side would need springs that level it
            let (loaded, shift_m) = car.with_load(load_kg, V3::new(centre_m.x, 0.0, centre_m.z));
            (car, origin_m) = (loaded, -shift_m);
        }
        Some(DrivenVehicle { name: name.to_owned(), preset, unladen, car, origin_m, given: self.given() })
    }

    /// Keys that replace numbers of the preset.
    fn given(&self) -> Vec<&'static str> {
        let keys = [
            ("mass", self.mass.is_some()),
            ("wheelbase", self.wheelbase.is_some()),
            ("cg_behind_front_axle", self.cg_behind_front_axle.is_some()),
            ("cg_height", self.cg_height.is_some()),
            ("track", self.track.is_some()),
            ("inertia", self.inertia.is_some()),
            ("drag_area", self.drag_area.is_some()),
            ("suspension", self.suspension.is_some()),
            ("tyres", self.tyres.is_some()),
            ("brakes", self.brakes.is_some()),
            ("crush", self.crush.is_some()),
        ];
        keys.into_iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key).collect()
    }

    fn warn(&self, b: &mut Builder, at: &str, car: &Car) {
        if car.stability() < 1.0 {
            let found = format!("a stability factor T/2h of {:.2}", car.stability());
            let expected = "at least 1: below that it tips before it slides on a road with friction 1";
            b.report(Problem::warning(at, found, expected));
        }
        for (key, axle) in [("front", &car.front), ("rear", &car.rear)] {
            if axle.jounce_n_s_per_m + axle.rebound_n_s_per_m == 0.0 {
                let at = with_key(&with_key(at, "suspension"), key);
                b.report(Problem::warning(at, "wheels that hop without damping", "dampers"));
            }
        }
    }
}

const AIR_KG_M3: f64 = 1.2;
