//! Seats of a car: cushion, pan, back, frame and head restraint.

use super::{Car, Rider, SEATS, classes, list, m, prism};
use crate::sections::{CarClass, CarSeatSection, si_or};

/// A seat in its place.
pub(super) struct Seat {
    pub(super) name: &'static str,
    pub(super) row: usize,
    /// Its H-point x, y, z, vehicle axes, m.
    pub(super) h: [f64; 3],
    pub(super) recline_deg: f64,
    /// Left or right half, m.
    half_width: f64,
    pub(super) own: CarSeatSection,
    /// Somebody sits in it.
    taken: bool,
}

/// How far the face of a seat's back lies behind the H-point, across its lean, m; ours: a body's back with its flesh.
const BACK_BEHIND_M: f64 = 0.105;
/// Back of the head of an average man who sits so, ahead of the line of the back through the H-point, m.
const HEAD_BACK_M: f64 = -0.02;
/// Lean of backs in the front and behind, degrees; ours.
const RECLINE_DEG: [f64; 3] = [20.0, 24.0, 24.0];
/// Height of the H-points of the rows over that of the front, m; ours.
const RISES_M: [f64; 3] = [0.0, 0.02, 0.04];

impl Car<'_> {
    /// The seats that somebody sits in or the scenario names, and those of the front row before and beside them.
    pub(super) fn seats(&self, riders: &[Rider]) -> Vec<Seat> {
        let is_sled = self.section.class == Some(CarClass::Sled);
        let rider = |name: &str| riders.iter().find(|rider| rider.seat == name);
        let is_there = |(name, row, _): &&(&str, usize, f64)| {
            let is_ahead = *row == 0 && !is_sled;
            is_ahead || rider(name).is_some() || self.section.seats.contains_key(*name)
        };
        SEATS.iter().filter(is_there).map(|(name, row, side)| self.placed(name, *row, *side, rider(name))).collect()
    }

    /// The seat of this name.
    pub(super) fn placed(&self, name: &'static str, row: usize, side: f64, rider: Option<&Rider>) -> Seat {
        let own = self.seat(name);
        let by_stature = |rider: &Rider| classes::TRACK_PER_STATURE * (rider.stature_m - classes::MEAN_STATURE_M);
        let usual = rider.filter(|_| name == "driver").map_or(0.0, by_stature);
        let m = &self.measures;
        let lateral = if row == 0 { side * self.drivers_side() } else { side };
        let y = si_or(&own.y, lateral * m.seat_offset);
        let x = -(row as f64) * m.couple - si_or(&own.track, usual);
        let z = -RISES_M[row] - si_or(&own.height, 0.0);
        let recline_deg = own.recline.as_ref().map_or(RECLINE_DEG[row], |angle| angle.si().to_degrees());
        let half_width = if row == 0 { 0.25 } else { m.seat_offset / 2.0 };
        Seat { name, row, h: [x, y, z], recline_deg, half_width, own, taken: rider.is_some() }
    }
}

impl Seat {
    pub(super) fn is_taken(&self) -> bool {
        self.taken
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
        let name = self.name;
        let across = [self.h[1], self.half_width];
        let steel = [self.h[1], self.half_width - 0.02];
        // rows behind the front are benches, met without seams
        let group = |part: &str| {
            if self.row == 0 { String::new() } else { format!("group = \"row_{}_{part}\"\n", self.row + 1) }
        };
        let rounded = |part: &str, radius: f64| format!("{}rounding = {}\n", group(part), m(radius));
        let leaning = |part: &str, radius: f64| rounded(part, radius) + &self.rides();
        let all = |points: &[[f64; 2]]| points.iter().map(|point| self.at(*point)).collect::<Vec<_>>();
        let back = |points: &[[f64; 2]]| points.iter().map(|point| self.along(*point)).collect::<Vec<_>>();
        let foam = all(&[[-0.11, 0.12], [0.35, 0.08], [0.35, 0.28], [-0.11, 0.32]]);
        let b = -BACK_BEHIND_M;
        let cover = back(&[[-0.14, b], [0.56, b], [0.56, b - 0.17], [-0.14, b - 0.17]]);
        let mut text = prism(&format!("{name}_foam"), &self.foam(), &foam, across, &rounded("foam", 0.02));
        text += &prism(&format!("{name}_back"), &self.foam(), &cover, across, &leaning("back", 0.02));
        if self.taken {
            let pan = all(&[[-0.09, 0.17], [0.33, 0.133], [0.33, 0.27], [-0.09, 0.31]]);
            let ramp = all(&[[0.13, 0.16], [0.28, 0.12], [0.33, 0.12], [0.33, 0.26], [0.13, 0.28]]);
            let of_pan = format!("group = \"{name}_pan\"\nrounding = \"0.01 m\"\n");
            text += &prism(&format!("{name}_pan"), "pan", &pan, steel, &of_pan);
            text += &prism(&format!("{name}_ramp"), "pan", &ramp, steel, &of_pan);
        }
        let frame = back(&[[-0.12, b - 0.07], [0.54, b - 0.07], [0.54, b - 0.16], [-0.12, b - 0.16]]);
        text += &prism(&format!("{name}_frame"), "frame", &frame, steel, &leaning("frame", 0.01));
        text + &self.recliner() + &self.head_restraint() + &self.place()
    }

    /// The foam's material: that of all, or a stiffer or softer one of its own.
    fn foam(&self) -> String {
        if self.own.foam.is_some() { format!("{}_foam", self.name) } else { "foam".to_owned() }
    }

    /// The line that lets a part of the back go with its hinge, where it has one.
    fn rides(&self) -> String {
        if self.own.back_moment.is_some() { format!("frame = \"{}_recliner\"\n", self.name) } else { String::new() }
    }

    /// The hinge of a back that yields backwards.
    fn recliner(&self) -> String {
        let Some(moment) = self.own.back_moment.as_ref().map(|moment| moment.si()) else { return String::new() };
        let place = |[x, z]: [f64; 2]| list(&[x, self.h[1], z]);
        format!(
            "[frames.{}_recliner]\nkind = \"hinge\"\naxis = [0, 1, 0]\norigin = {}\nmass = \"12 kg\"\ncentre = {}\ninertia = \"0.5 kg m^2\"\n\
             angle = [\"0 deg\", \"3 deg\", \"45 deg\", \"55 deg\"]\nmoment = [\"0 N m\", \"{moment} N m\", \"{moment} N m\", \"{} N m\"]\n\n",
            self.name,
            place(self.along([-0.08, -0.12])),
            place(self.along([0.30, -0.19])),
            8.0 * moment,
        )
    }

    fn head_restraint(&self) -> String {
        let front = HEAD_BACK_M - si_or(&self.own.head_gap, 0.05);
        let top = si_or(&self.own.head_height, 0.80);
        let [x, z] = self.along([top - 0.10, front - 0.05]);
        format!(
            "[solids.{}_head_restraint]\nkind = \"box\"\nmaterial = \"padding\"\ncentre = {}\nlengths = [\"0.10 m\", \"0.26 m\", \"0.20 m\"]\n\
             pitch = \"{} deg\"\nrounding = \"0.03 m\"\n{}\n",
            self.name,
            list(&[x, self.h[1], z]),
            self.recline_deg / 2.0,
            self.rides(),
        )
    }

    /// The seat's own words, and its foam where that is another.
    fn place(&self) -> String {
        let name = self.name;
        let mut text =
            format!("[seats.{name}]\ncushion = \"{name}_foam\"\nback = \"{name}_back\"\ny = {}\n\n", m(self.h[1]));
        if let Some(factor) = self.own.foam.as_ref().map(|factor| factor.si()) {
            text += &format!(
                "[materials.{name}_foam]\nk1 = \"{} kN/m\"\ndelta_b = \"45 mm\"\nk2 = \"{} kN/m\"\nmu1 = 0.3\nfriction = 0.8\n\
                 friction_speed = \"0.3 m/s\"\n\n",
                12.0 * factor,
                100.0 * factor,
            );
        }
        text
    }
}
