//! Vehicles by class, and how far each of their numbers can be trusted.
//!
//! Masses and sizes are typical of a class, not measurements of a car. There are also two measured cars of the 1980s.

use crate::body::{Body, Crush, Stiffness};
use crate::car::{Axle, Car, Class, RIDE};
use crate::{GRAVITY_M_S2, V3};
use nalgebra::Matrix3;

/// Reliability of a number, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Evidence {
    /// Published for this vehicle.
    Published,
    /// Regression or median of published tests.
    Fitted,
    /// Follows by rule from other numbers.
    Rule,
    /// Typical of the class; no source is quoted.
    Typical,
    /// A guess of the right size.
    Guess,
}

impl Evidence {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Evidence::Published => "published",
            Evidence::Fitted => "fitted to published tests",
            Evidence::Rule => "by rule",
            Evidence::Typical => "typical",
            Evidence::Guess => "a guess",
        }
    }
}

/// A preset: sizes in m, masses in kg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// Its class.
    pub class: Class,
    /// Its name in scenarios.
    pub name: &'static str,
    /// Mass.
    pub mass_kg: f64,
    /// Wheelbase.
    pub wheelbase_m: f64,
    /// Distance of the centre of gravity behind the front axle.
    pub behind_front_m: f64,
    /// Track width.
    pub track_m: f64,
    /// Height of the centre of gravity over the road.
    pub height_m: f64,
    /// Length, width, height.
    pub size_m: [f64; 3],
    /// Front axle to front bumper.
    pub overhang_m: f64,
    /// Impact speed per metre of residual crush, 1/s.
    pub crush_per_s: f64,
}

/// All presets.
pub const PRESETS: [Preset; 9] = [
    preset(Class::Small, "small", 1100.0, [2.50, 1.000, 1.43, 0.53], [4.20, 1.67, 1.45], 0.90, 26.9),
    preset(Class::Sedan, "sedan", 1500.0, [2.70, 1.100, 1.54, 0.55], [4.70, 1.82, 1.45], 0.95, 27.7),
    preset(Class::Suv, "suv", 2000.0, [2.75, 1.250, 1.58, 0.67], [4.70, 1.88, 1.72], 0.92, 26.5),
    preset(Class::Van, "van", 2150.0, [3.05, 1.350, 1.66, 0.70], [5.10, 1.98, 1.78], 0.95, 27.2),
    preset(Class::Pickup, "pickup", 2270.0, [3.57, 1.575, 1.70, 0.71], [5.80, 1.98, 1.88], 1.00, 25.0),
    preset(Class::En900, "en900", 900.0, [2.35, 0.900, 1.35, 0.49], [3.80, 1.60, 1.40], 0.80, 26.9),
    preset(Class::En1500, "en1500", 1500.0, [2.65, 1.240, 1.50, 0.53], [4.60, 1.75, 1.43], 0.90, 27.7),
    preset(Class::Bmw320i, "bmw-320i", 1093.0, [2.579, 1.156, 1.387, 0.575], [4.51, 1.61, 1.38], 0.76, 26.9),
    preset(Class::Vanagon, "vanagon", 1479.0, [2.472, 1.151, 1.574, 0.748], [4.57, 1.84, 1.96], 0.90, 27.2),
];

const fn preset(
    class: Class,
    name: &'static str,
    mass_kg: f64,
    [wheelbase_m, behind_front_m, track_m, height_m]: [f64; 4],
    size_m: [f64; 3],
    overhang_m: f64,
    crush_per_s: f64,
) -> Preset {
    Preset { class, name, mass_kg, wheelbase_m, behind_front_m, track_m, height_m, size_m, overhang_m, crush_per_s }
}

/// Springs, dampers, bars, wheel mass, tyre stiffness and inertias of a measured car; front and rear, SI.
struct Measured {
    rates: [f64; 2],
    damping: [f64; 2],
    bars_n_m_per_rad: [f64; 2],
    tracks_m: [f64; 2],
    wheel_kg: f64,
    tyre_n_per_m: f64,
    /// Roll of the sprung body; pitch and yaw of the whole.
    inertia_kg_m2: [f64; 3],
}

impl Class {
    /// Its numbers.
    pub fn preset(self) -> &'static Preset {
        &PRESETS[self as usize]
    }

    /// The class of a preset's name.
    pub fn named(name: &str) -> Option<Class> {
        PRESETS.iter().find(|preset| preset.name == name).map(|preset| preset.class)
    }

    fn measured(self) -> Option<Measured> {
        match self {
            Class::Bmw320i => Some(Measured {
                rates: [24_445.0, 19_629.0],
                damping: [1786.0, 1649.0],
                bars_n_m_per_rad: [6915.0, 2644.0],
                tracks_m: [1.387, 1.364],
                wheel_kg: 31.9,
                tyre_n_per_m: 158e3,
                inertia_kg_m2: [207.0, 1566.0, 1792.0],
            }),
            Class::Vanagon => Some(Measured {
                rates: [33_566.0, 39_112.0],
                damping: [2406.0, 2770.0],
                bars_n_m_per_rad: [33_948.0, 7731.0],
                tracks_m: [1.574, 1.544],
                wheel_kg: 40.6,
                tyre_n_per_m: 212.6e3,
                inertia_kg_m2: [480.0, 2204.0, 2473.0],
            }),
            _ => None,
        }
    }
}

impl Preset {
    /// Sources of its numbers: the number, how well it is known, the source.
    pub fn evidence(&self) -> [(&'static str, Evidence, &'static str); 7] {
        let measured = self.class.measured().is_some();
        let of_car = |else_is| if measured { Evidence::Published } else { else_is };
        let model = "CommonRoad vehicle models, from tests of the US Department of Transportation";
        let by_rule = if measured { model } else { "I_z = Mab, I_y = 0.9 I_z, I_x = M(0.38 T)²: eight measured cars" };
        let ride = if measured { model } else { "ride frequencies 1.25 and 1.4 Hz, roll of 5° per g" };
        [
            (
                "mass, axles, height of the centre of gravity",
                of_car(Evidence::Typical),
                if measured { model } else { "" },
            ),
            ("inertia", of_car(Evidence::Rule), by_rule),
            ("springs, dampers, anti-roll", of_car(Evidence::Rule), ride),
            (
                "crush.front",
                Evidence::Fitted,
                "residual crush of 51 full-width wall tests, model years 2004 to 2025; 10 to 90 % within a quarter",
            ),
            ("crush.side", Evidence::Guess, "0.6 A and 0.8 B of the front"),
            ("crush.rear", Evidence::Guess, "0.9 A and 0.6 B of the front"),
            (
                "hull",
                Evidence::Guess,
                "spheres of a sedan scaled by length, width and height; roof strength as the roof tests ask",
            ),
        ]
    }

    /// Front, side and rear stiffness by rule.
    pub fn stiffness(&self) -> [Stiffness; 3] {
        let front = Stiffness::by_speed(self.mass_kg, self.size_m[1], self.crush_per_s);
        [front, front.scaled(0.6, 0.8), front.scaled(0.9, 0.6)]
    }

    /// The vehicle.
    pub fn car(&self) -> Car {
        let Preset { mass_kg, wheelbase_m, behind_front_m: a, track_m, height_m, .. } = *self;
        let b = wheelbase_m - a;
        let yaw = mass_kg * a * b;
        let roll = mass_kg * (0.38 * track_m) * (0.38 * track_m);
        let mut car = Car::with_ride(mass_kg, [a, b], track_m, height_m);
        car.inertia_kg_m2 = Matrix3::from_diagonal(&V3::new(roll, 0.9 * yaw, yaw));
        let [front, side, rear] = self.stiffness();
        car.body = Body::sized(self.size_m, a + self.overhang_m, Crush::of_faces(front, side, rear));
        if let Some(measured) = self.class.measured() {
            measured.fit(&mut car);
        }
        car
    }
}

impl Measured {
    fn fit(&self, car: &mut Car) {
        let [roll, pitch, yaw] = self.inertia_kg_m2;
        // the wheels at half the track are not in the sprung roll inertia
        let of_wheels: f64 = self.tracks_m.iter().map(|track| 0.5 * self.wheel_kg * track * track).sum();
        car.inertia_kg_m2 = Matrix3::from_diagonal(&V3::new(roll + of_wheels, pitch, yaw));
        car.tyre.stiffness_n_per_m = self.tyre_n_per_m;
        for (i, axle) in [&mut car.front, &mut car.rear].into_iter().enumerate() {
            let track = self.tracks_m[i];
            *axle = Axle {
                track_m: track,
                wheel_kg: self.wheel_kg,
                rate_n_per_m: self.rates[i],
                jounce_n_s_per_m: self.damping[i],
                rebound_n_s_per_m: self.damping[i],
                anti_roll_n_per_m: self.bars_n_m_per_rad[i] / (track * track),
                ..*axle
            };
        }
    }
}

impl Car {
    /// A car of these sizes whose springs, dampers and bars follow by rule from ride frequencies and roll; its inertia and body
    /// are to be given.
    fn with_ride(mass_kg: f64, [a, b]: [f64; 2], track_m: f64, height_m: f64) -> Self {
        let base_m = a + b;
        let shares = [b / base_m, a / base_m];
        let mean_m = 0.5 * (RIDE.roll_centres_m[0] + RIDE.roll_centres_m[1]);
        let moment_per_g = mass_kg * GRAVITY_M_S2 * (height_m - mean_m);
        let resisted = RIDE.roll_shares.map(|share| share * moment_per_g / RIDE.roll_rad_per_g);
        let axle = |i: usize| {
            let corner_kg = 0.5 * mass_kg * shares[i] - RIDE.wheel_kg;
            let pulse = 2.0 * core::f64::consts::PI * RIDE.hz[i];
            let rate = corner_kg * pulse * pulse;
            let damping = 2.0 * 0.3 * (rate * corner_kg).sqrt();
            // ½kT² of the springs and k_aT² of the bar resist roll
            let bar = (resisted[i] / (track_m * track_m) - 0.5 * rate).max(0.0);
            Axle {
                ahead_m: [a, -b][i],
                track_m,
                wheel_kg: RIDE.wheel_kg,
                rate_n_per_m: rate,
                jounce_n_s_per_m: 0.7 * damping,
                rebound_n_s_per_m: 1.3 * damping,
                anti_roll_n_per_m: bar,
                roll_centre_m: RIDE.roll_centres_m[i],
                is_steered: i == 0,
                ..Axle::usual()
            }
        };
        Car { mass_kg, height_m, front: axle(0), rear: axle(1), ..Car::usual() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_stand_in_the_order_of_their_classes() {
        for (class, preset) in Class::ALL.iter().zip(&PRESETS) {
            assert_eq!((*class, class.preset().name), (preset.class, preset.name));
            assert_eq!(Class::named(preset.name), Some(*class));
        }
    }

    /// Stiffnesses of fronts by class, kN/m and kN/m², rounded as published with the fit.
    #[test]
    fn fronts_are_those_of_the_wall_tests() {
        let table = [(39, 477), (51, 632), (63, 747), (66, 803), (64, 717), (34, 407), (53, 658)];
        for (preset, (a, b)) in PRESETS.iter().zip(table) {
            let [front, ..] = preset.stiffness();
            assert!((front.a_n_per_m / 1e3 - f64::from(a)).abs() < 0.6, "{}: {front:?}", preset.name);
            assert!((front.b_n_per_m2 / 1e3 - f64::from(b)).abs() < 1.0, "{}: {front:?}", preset.name);
        }
    }
}
