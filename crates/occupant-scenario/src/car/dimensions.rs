//! The distances of a car: what its class, its years and its own words come to.

use serde::Serialize;

use super::classes::{H61_ADDS_M, H61_LEANS_RAD};
use super::seats::Seat;
use super::{CAR, Car, Rider, cars, ride, riders};
use crate::check::check_parts;
use crate::sections::{AnchorSection, CarBelt, CarClass, CarSection, schema, si_or};
use occupant_units::trig::sin_cos;
use placed_text::{Document, Node, Sources};
use serde::Deserialize;

/// A distance or an angle of a car, or what else it is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Dimension {
    /// The vehicle, none for the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub vehicle: Option<String>,
    /// Its key, or a description.
    pub name: String,
    /// Its name in SAE J1100, if it has one.
    #[serde(skip_serializing_if = "str::is_empty")]
    pub code: &'static str,
    /// Distance, m, or angle from the vertical, rad.
    #[serde(flatten)]
    pub size: Size,
    /// Ends of its line, vehicle axes, m.
    pub ends_m: [[f64; 3]; 2],
}

/// A choice as a scenario writes it.
fn word(choice: impl Serialize) -> Size {
    let written = serde_json::to_value(choice).ok();
    Size::Word(written.as_ref().and_then(|value| value.as_str()).unwrap_or_default().to_owned())
}

/// Size of a dimension.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Size {
    /// A distance, m.
    #[serde(rename = "distance_m")]
    Distance(f64),
    /// An angle, rad.
    #[serde(rename = "angle_rad")]
    Angle(f64),
    /// A force, N.
    #[serde(rename = "force_n")]
    Force(f64),
    /// A moment, N·m.
    #[serde(rename = "moment_n_m")]
    Moment(f64),
    /// No size: what was chosen.
    #[serde(rename = "is")]
    Word(String),
}

/// Dimensions of all cars of a scenario; none if their text is invalid.
pub(crate) fn dimensions(sources: &Sources, root: &Node) -> Vec<Dimension> {
    let mut read = Document { sources: sources.clone(), main: root.span.source, root: root.clone() };
    if cars(root).next().is_none() || check_parts(&mut read, schema(), &CAR).has_errors() {
        return Vec::new();
    }
    check_parts(&mut read, schema(), &super::BODIES);
    let all: Vec<Rider> = cars(&read.root).flat_map(|(vehicle, _)| riders(&read.root, vehicle)).collect();
    let of = |(vehicle, car)| {
        let section = CarSection::deserialize(car).ok()?;
        let riders: Vec<&Rider> = all.iter().filter(|rider| rider.vehicle.as_deref() == vehicle).collect();
        Some(Car::of(vehicle, &section, all.len()).dimensions(&riders))
    };
    cars(&read.root).filter_map(of).flatten().collect()
}

impl Car<'_> {
    fn dimensions(&self, riders: &[&Rider]) -> Vec<Dimension> {
        let seats = self.seats(riders);
        let chosen = |name: &str, word| self.dimension(name, "", word, [[0.0; 3]; 2]);
        let mut all = vec![
            chosen("class", word(self.section.class.unwrap_or_default())),
            chosen("years", word(self.section.years.unwrap_or_default())),
        ];
        if let Some(driver) = seats.iter().find(|seat| seat.name == "driver" && seat.is_taken()) {
            self.of_driver(driver.h[1], &mut all);
        }
        self.of_shell(&mut all);
        let mut row_before = 0;
        for seat in seats.iter().filter(|seat| seat.is_taken()) {
            if seat.row > row_before {
                let from = [seat.h[0] + self.measures.couple, seat.h[1], seat.h[2]];
                all.push(self.distance("couple", "L50", from, seat.h));
                row_before = seat.row;
            }
            let rider = riders.iter().find(|rider| rider.seat == seat.name);
            self.of_seat(seat, rider.map_or(super::classes::MEAN_STATURE_M, |rider| rider.stature_m), &mut all);
        }
        all
    }

    fn distance(&self, name: &str, code: &'static str, from: [f64; 3], to: [f64; 3]) -> Dimension {
        let square: f64 = (0..3).map(|i| (to[i] - from[i]).powi(2)).sum();
        self.dimension(name, code, Size::Distance(square.sqrt()), [from, to])
    }

    fn dimension(&self, name: &str, code: &'static str, size: Size, ends_m: [[f64; 3]; 2]) -> Dimension {
        Dimension { vehicle: self.vehicle.map(str::to_owned), name: name.to_owned(), code, size, ends_m }
    }

    /// Heels, wheel and parts in front, from the design H-point at the driver's lateral position.
    fn of_driver(&self, y: f64, all: &mut Vec<Dimension>) {
        let m = &self.measures;
        let (h30, [ahead, above]) = (m.seat_height, m.wheel);
        all.push(self.distance("seat_height", "H30", [m.heels, y, h30], [m.heels, y, 0.0]));
        if self.section.class == Some(CarClass::Sled) {
            return;
        }
        all.push(self.distance("wheel.ahead", "L11 to H", [0.0, y, -above], [ahead, y, -above]));
        all.push(self.distance("wheel.above", "H17 - H30", [ahead, y, 0.0], [ahead, y, -above]));
        let half = m.wheel_diameter / 2.0;
        let (sin, cos) = sin_cos(m.wheel_angle_deg.to_radians());
        let rim = [[ahead - half * sin, y, -above + half * cos], [ahead + half * sin, y, -above - half * cos]];
        all.push(self.distance("wheel.diameter", "W9", rim[0], rim[1]));
        all.push(self.dimension("wheel.angle", "A18", Size::Angle(m.wheel_angle_deg.to_radians()), rim));
        let [panel, top] = m.panel;
        all.push(self.distance("panel.ahead", "", [0.0, y, 0.05 - top], [panel, y, 0.05 - top]));
        all.push(self.distance("panel.above", "", [panel + 0.10, y, 0.0], [panel + 0.10, y, -top]));
        all.push(self.distance("panel.bolster", "", [0.0, y, -0.12], [m.bolster, y, -0.12]));
    }

    /// Roof and width, from the H-points of the front seats.
    fn of_shell(&self, all: &mut Vec<Dimension>) {
        let m = &self.measures;
        let y = self.drivers_side() * m.seat_offset;
        all.push(self.distance("seat_offset", "W20", [0.0, 0.0, 0.0], [0.0, y, 0.0]));
        if self.section.class == Some(CarClass::Sled) {
            return;
        }
        let w = m.shoulder_room / 2.0;
        all.push(self.distance("shoulder_room", "W3", [-0.15, -w, -0.40], [-0.15, w, -0.40]));
        all.push(self.distance("roof", "", [0.0, y, 0.0], [0.0, y, -m.roof]));
        let (sin, cos) = sin_cos(H61_LEANS_RAD);
        let back = -m.roof * sin / cos;
        let head_room = Size::Distance(m.roof / cos + H61_ADDS_M);
        all.push(self.dimension("head room", "H61", head_room, [[0.0, y, 0.0], [back, y, -m.roof]]));
    }

    /// Dimensions of an occupied seat.
    fn of_seat(&self, seat: &Seat, stature_m: f64, all: &mut Vec<Dimension>) {
        let [x, y, z] = seat.h;
        let name = |key: &str| format!("seats.{}.{key}", seat.name);
        let own = &seat.own;
        all.push(self.dimension(&name("track"), "", Size::Distance(seat.track), [[x + seat.track, y, z], seat.h]));
        let height = si_or(&own.height, 0.0);
        all.push(self.dimension(&name("height"), "", Size::Distance(height), [[x, y, z + height], seat.h]));
        let [bx, bz] = seat.along([0.56, 0.0]);
        all.push(self.dimension(
            &name("recline"),
            "A40",
            Size::Angle(seat.recline_deg.to_radians()),
            [seat.h, [bx, y, bz]],
        ));
        let belt = own.belt.unwrap_or_default();
        let other = |key: &str, size: Size| self.dimension(&name(key), "", size, [seat.h; 2]);
        let moment = own.back_moment.as_ref().map(|moment| Size::Moment(moment.si()));
        all.push(other("back_moment", moment.unwrap_or_else(|| word("fixed"))));
        all.push(other("belt", word(belt)));
        if belt == CarBelt::None {
            return;
        }
        let out = if y < 0.0 { -1.0 } else { 1.0 };
        let mut point = |part: &str, said: &AnchorSection, usual: [f64; 3]| {
            let [behind, outboard, above] = ride::placed_m(said, usual);
            let at = [x - behind, y + out * outboard, z - above];
            let keys = [("behind", behind, [x, at[1], at[2]]), ("outboard", outboard, [at[0], y, at[2]])];
            for (key, size, from) in keys.into_iter().chain([("above", above, [at[0], at[1], z])]) {
                all.push(self.dimension(&name(&format!("{part}.{key}")), "", Size::Distance(size), [from, at]));
            }
        };
        if belt != CarBelt::Lap {
            point("d_ring", &own.d_ring, ride::d_ring_m(stature_m, seat));
        }
        point("buckle", &own.buckle, ride::buckle_m(belt));
        point("anchor", &own.anchor, ride::ANCHOR_M);
        let amount = |key: &str, size: f64| other(key, Size::Distance(size));
        all.push(amount("slack", si_or(&own.slack, 0.0)));
        if belt != CarBelt::Lap {
            let limiter = own.limiter.as_ref().map(|limiter| Size::Force(limiter.si()));
            all.push(other("limiter", limiter.unwrap_or_else(|| word("none"))));
            all.push(amount("film", si_or(&own.film, ride::FILM_M)));
            all.push(amount("pretensioner", si_or(&own.pretensioner, 0.0)));
            all.push(amount("lap_above", si_or(&own.lap_above, 0.0)));
            all.push(other("locking_tongue", Size::Word((own.locking_tongue == Some(true)).to_string())));
        }
    }
}
