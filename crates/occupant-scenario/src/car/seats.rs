//! Seats of a car: cushion, pan, back, frame and head restraint.

use super::years::HARDENS;
use super::{Car, Rider, SEATS, classes, frame_line, list, m, prism};
use crate::sections::{CarClass, CarSeatSection, si_or};

/// A positioned seat.
pub(super) struct Seat {
    pub(super) name: &'static str,
    /// Its name, prefixed with the vehicle's unless it is the first.
    pub(super) id: String,
    /// Frame name of the vehicle; none for the first.
    vehicle: Option<String>,
    pub(super) row: usize,
    /// Its H-point x, y, z, vehicle axes, m, and its distance behind the design position.
    pub(super) h: [f64; 3],
    pub(super) track: f64,
    pub(super) recline_deg: f64,
    /// Left or right half, m.
    half_width: f64,
    pub(super) own: CarSeatSection,
    /// Its occupant's name: empty for a single unnamed occupant, none for an empty seat.
    rider: Option<String>,
}

/// Distance of the back's face behind the H-point, across its lean, m; ours: a body's back with its flesh.
const BACK_BEHIND_M: f64 = 0.105;
/// Back of an average man's head, forward of the line of the back through the H-point, m.
const HEAD_BACK_M: f64 = -0.02;
/// Recliner and centre of the back's mass: along the back's line through the H-point and forward of it, m; ours.
const RECLINER_M: [f64; 2] = [-0.08, -0.15];
const BACK_MIDDLE_M: [f64; 2] = [0.32, -0.20];
/// Lean of backs in the front and behind, degrees; ours. The backs of SAE's manikin lean by 20 to 24 and 19 to 27 (A40).
const RECLINE_DEG: [f64; 3] = [20.0, 24.0, 24.0];
/// Height of the H-points of the rows over that of the front, m; ours.
const RISES_M: [f64; 3] = [0.0, 0.02, 0.04];

impl Car<'_> {
    /// Occupied or named seats, and the other front seats.
    pub(super) fn seats(&self, riders: &[&Rider]) -> Vec<Seat> {
        let is_sled = self.section.class == Some(CarClass::Sled);
        let rider = |name: &str| riders.iter().copied().find(|rider| rider.seat == name);
        let is_there = |(name, row, _): &&(&str, usize, f64)| {
            let is_ahead = *row == 0 && !is_sled;
            is_ahead || rider(name).is_some() || self.section.seats.contains_key(*name)
        };
        SEATS.iter().filter(is_there).map(|(name, row, side)| self.placed(name, *row, *side, rider(name))).collect()
    }

    /// The seat of this name.
    pub(super) fn placed(&self, name: &'static str, row: usize, side: f64, rider: Option<&Rider>) -> Seat {
        let own = self.seat(name, row, rider.is_some());
        let usual = rider.filter(|_| row == 0).map_or(0.0, classes::usual_track_m);
        let m = &self.measures;
        let lateral = if row == 0 { side * self.drivers_side() } else { side };
        let y = si_or(&own.y, lateral * m.seat_offset);
        let track = si_or(&own.track, usual);
        let x = -(row as f64) * m.couple - track;
        let z = -RISES_M[row] - si_or(&own.height, 0.0);
        let recline_deg = own.recline.as_ref().map_or(RECLINE_DEG[row], |angle| angle.si().to_degrees());
        let half_width = if row == 0 { 0.25 } else { m.seat_offset / 2.0 };
        Seat {
            name,
            id: self.name(name),
            vehicle: self.vehicle.map(str::to_owned),
            row,
            h: [x, y, z],
            track,
            recline_deg,
            half_width,
            own,
            rider: rider.map(|rider| rider.name().to_owned()),
        }
    }
}

impl Seat {
    pub(super) fn is_taken(&self) -> bool {
        self.rider.is_some()
    }

    /// The occupant touched by a bag in front of the seat or beside it.
    pub(super) fn met(&self) -> String {
        let rider = self.rider.as_deref().filter(|rider| !rider.is_empty());
        rider.map_or_else(String::new, |rider| format!("occupant = \"{rider}\"\n"))
    }

    /// A point of the cushion, ahead of and below the H-point, in vehicle axes.
    fn at(&self, [ahead, down]: [f64; 2]) -> [f64; 2] {
        [self.h[0] + ahead, self.h[2] + down]
    }

    /// A point of the back, up along it and ahead of it from the H-point, in vehicle axes.
    pub(super) fn along(&self, [up, ahead]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = occupant_units::trig::sin_cos(self.recline_deg.to_radians());
        self.at([ahead * cos - up * sin, -ahead * sin - up * cos])
    }

    pub(super) fn words(&self) -> String {
        let id = &self.id;
        let across = [self.h[1], self.half_width];
        let steel = [self.h[1], self.half_width - 0.02];
        let (still, back) = (frame_line(self.vehicle.as_deref()), frame_line(self.back_frame().as_deref()));
        let rounded = |frame: &str, part: &str, radius: f64| {
            format!("{frame}{}rounding = {}\n", self.group(part, frame), m(radius))
        };
        let all = |points: &[[f64; 2]]| points.iter().map(|point| self.at(*point)).collect::<Vec<_>>();
        let along = |points: &[[f64; 2]]| points.iter().map(|point| self.along(*point)).collect::<Vec<_>>();
        let foam = all(&[[-0.11, 0.12], [0.35, 0.08], [0.35, 0.28], [-0.11, 0.32]]);
        let b = -BACK_BEHIND_M;
        let cover = along(&[[-0.14, b], [0.56, b], [0.56, b - 0.17], [-0.14, b - 0.17]]);
        let mut text = prism(&format!("{id}_foam"), &self.soft("foam"), &foam, across, &rounded(&still, "foam", 0.02));
        text += &prism(&format!("{id}_back"), &self.soft("back"), &cover, across, &rounded(&back, "back", 0.02));
        if self.is_taken() {
            let pan = all(&[[-0.09, 0.17], [0.33, 0.133], [0.33, 0.27], [-0.09, 0.31]]);
            let ramp = all(&[[0.13, 0.16], [0.28, 0.12], [0.33, 0.12], [0.33, 0.26], [0.13, 0.28]]);
            let of_pan = format!("{still}group = \"{id}_pan\"\nrounding = \"0.01 m\"\n");
            text += &prism(&format!("{id}_pan"), "pan", &pan, steel, &of_pan);
            text += &prism(&format!("{id}_ramp"), "pan", &ramp, steel, &of_pan);
        }
        let frame = along(&[[-0.12, b - 0.07], [0.54, b - 0.07], [0.54, b - 0.16], [-0.12, b - 0.16]]);
        text += &prism(&format!("{id}_frame"), "frame", &frame, steel, &rounded(&back, "frame", 0.01));
        self.hinge() + &text + &self.booster() + &self.head_restraint(&back) + &self.place()
    }

    /// Rear rows are benches: their parts form one group, unless they yield separately.
    fn group(&self, part: &str, frame: &str) -> String {
        let yields =
            self.back_frame().is_some_and(|own| frame_line(Some(&own)) == frame && self.own.back_moment.is_some());
        if self.row == 0 || yields {
            return String::new();
        }
        let prefix = self.id.strip_suffix(self.name).unwrap_or_default();
        format!("group = \"{prefix}row_{}_{part}\"\n", self.row + 1)
    }

    /// What the back is fixed to: the vehicle, none for the first, or its hinge.
    pub(super) fn back_frame(&self) -> Option<String> {
        if self.own.back_moment.is_some() { Some(format!("{}_recliner", self.id)) } else { self.vehicle.clone() }
    }

    /// A booster cushion on the foam.
    fn booster(&self) -> String {
        let Some(height) = self.own.booster.as_ref().map(|height| height.si()) else { return String::new() };
        let corners =
            [[-0.11, 0.12 - height], [0.27, 0.09 - height], [0.27, 0.12], [-0.11, 0.15]].map(|at| self.at(at));
        let more = frame_line(self.vehicle.as_deref()) + "rounding = \"0.03 m\"\n";
        prism(&format!("{}_booster", self.id), "pan", &corners, [self.h[1], 0.20], &more)
    }

    /// Hinge of a yielding back: a few degrees of spring, then the moment; ours, as is the back's mass.
    fn hinge(&self) -> String {
        let Some(moment) = self.own.back_moment.as_ref().map(|moment| moment.si()) else { return String::new() };
        let ([x, z], [cx, cz]) = (self.along(RECLINER_M), self.along(BACK_MIDDLE_M));
        let (parent, y) = (self.vehicle.as_deref().unwrap_or("vehicle"), self.h[1]);
        format!(
            "[frames.{}_recliner]\nkind = \"hinge\"\nparent = \"{parent}\"\norigin = {}\naxis = [0, 1, 0]\nmass = \"14 kg\"\ncentre = {}\n\
             inertia = \"1 kg m^2\"\nangle = [\"0 deg\", \"6 deg\", \"40 deg\", \"45 deg\"]\n\
             moment = [\"0 N m\", \"{moment} N m\", \"{} N m\", \"{} N m\"]\n\n",
            self.id,
            list(&[x, y, z]),
            list(&[cx, y, cz]),
            HARDENS * moment,
            HARDENS * moment + 7000.0,
        )
    }

    /// Material of cushion ("foam") or back: the common one, or one scaled for this seat.
    fn soft(&self, part: &str) -> String {
        if self.own.foam.is_some() { format!("{}_{part}", self.id) } else { part.to_owned() }
    }

    fn head_restraint(&self, frame: &str) -> String {
        let front = HEAD_BACK_M - si_or(&self.own.head_gap, 0.05);
        let top = si_or(&self.own.head_height, 0.80);
        let [x, z] = self.along([top - 0.10, front - 0.05]);
        format!(
            "[solids.{}_head_restraint]\n{frame}kind = \"box\"\nmaterial = \"restraint\"\ncentre = {}\nlengths = [\"0.10 m\", \"0.26 m\", \"0.20 m\"]\n\
             pitch = \"{} deg\"\nrounding = \"0.03 m\"\n\n",
            self.id,
            list(&[x, self.h[1], z]),
            self.recline_deg / 2.0,
        )
    }

    /// The seat's own words, and its foam where that is another.
    fn place(&self) -> String {
        let name = &self.id;
        let cushion = if self.own.booster.is_some() { "booster" } else { "foam" };
        let mut text =
            format!("[seats.{name}]\ncushion = \"{name}_{cushion}\"\nback = \"{name}_back\"\ny = {}\n\n", m(self.h[1]));
        if let Some(factor) = self.own.foam.as_ref().map(|factor| factor.si()) {
            text += &["foam", "back"].map(|part| scaled(part, &format!("{name}_{part}"), factor)).concat();
        }
        text
    }
}

/// A material of cars under another name, with its forces multiplied.
fn scaled(material: &str, name: &str, factor: f64) -> String {
    let all: toml::Table = include_str!("materials.toml").parse().unwrap_or_default();
    let own = all.get("materials").and_then(|all| all.get(material)?.as_table().cloned());
    let mut own = own.unwrap_or_default();
    for key in ["k1", "k2", "force"] {
        own.get_mut(key).into_iter().for_each(|value| scale(value, factor));
    }
    format!("[materials.{name}]\n{own}\n")
}

/// Multiplies a quantity such as "12 kN/m", or each of a list.
fn scale(value: &mut toml::Value, factor: f64) {
    match value {
        toml::Value::Array(items) => items.iter_mut().for_each(|item| scale(item, factor)),
        toml::Value::String(text) => {
            let Some((number, unit)) = text.split_once(' ') else { return };
            let number = number.parse::<f64>().unwrap_or(f64::NAN);
            *text = format!("{} {unit}", number * factor);
        }
        _ => {}
    }
}
