//! Interior round the seats of a car: wheel, bags, panel, glass, doors, floor and roof.

use std::fmt::Write as _;

use super::ride::SOLE_M;
use super::seats::Seat;
use super::{Car, frame_line, list, m, points};
use crate::sections::{CarClass, IntrusionSection, si_or};
use occupant_units::trig::sin_cos;

/// Distance of a curtain's middle below the roof, m: beside the heads.
const CURTAIN_UP_M: f64 = 0.30;
/// Thickness of a door.
const DOOR_M: f64 = 0.20;

impl Car<'_> {
    /// Triggers of belts and bags.
    fn triggers(&self) -> String {
        let of = |name: &str, more: &str| {
            let (name, vehicle) = (self.name(name), self.frame());
            format!(
                "[triggers.{name}]\nkind = \"vehicle_acceleration\"\nvehicle = \"{vehicle}\"\nthreshold = {more}\n\n"
            )
        };
        let front = "\"3 g\"\nfor = \"2 ms\"\ndirection = [-1, 0, 0]";
        of("sensor", "\"0.45 g\"") + &of("crash", "\"3 g\"\nfor = \"2 ms\"") + &of("front", front)
    }

    /// Half the width between the doors, m.
    fn half_width(&self) -> f64 {
        self.measures.shoulder_room / 2.0
    }

    /// Height of the floor.
    fn floor_z(&self) -> f64 {
        self.measures.seat_height + SOLE_M
    }

    /// Toe board and floor.
    pub(super) fn foot_rest(&self) -> String {
        let (toe, floor, w) = (self.measures.heels, self.floor_z(), self.half_width());
        let board = [
            [toe + 0.05, floor + 0.04],
            [toe + 0.17, floor - 0.30],
            [toe + 0.29, floor - 0.30],
            [toe + 0.17, floor + 0.04],
        ];
        let back = -2.0 * self.measures.couple - 0.6;
        let ground = [[back, floor], [toe + 0.11, floor], [toe + 0.11, floor + 0.10], [back, floor + 0.10]];
        let sides = [0.0, w];
        let text = self.prism("toe_board", "floor", &board, sides, &self.moved("front"))
            + &self.prism("floor", "floor", &ground, sides, "");
        self.triggers() + &text
    }

    /// Frame of a side that may intrude.
    fn moved(&self, side: &str) -> String {
        match self.intrusion(side) {
            Some(_) => format!("frame = \"{}\"\n", self.name(&format!("{side}_intrusion"))),
            None => frame_line(self.vehicle),
        }
    }

    fn intrusion(&self, side: &str) -> Option<&IntrusionSection> {
        let all = &self.section.intrusion;
        match side {
            "left" => all.left.as_ref(),
            "right" => all.right.as_ref(),
            _ => all.front.as_ref(),
        }
    }

    /// Intrusion of the sides: speed rises during a fifth of the time, then falls.
    pub(super) fn intrusions(&self) -> String {
        let mut text = String::new();
        for (side, way) in [("left", "y"), ("right", "y"), ("front", "x")] {
            let Some(own) = self.intrusion(side) else { continue };
            let sign = if side == "left" { 1.0 } else { -1.0 };
            let (begins, lasts) = (si_or(&own.begins, 0.005), si_or(&own.lasts, 0.060));
            let row = |i: u32| {
                let share = f64::from(i) / 20.0;
                let way = if share <= 0.2 { share * share / 0.2 } else { 1.0 - (1.0 - share).powi(2) / 0.8 };
                format!("[{}, {}]", begins + share * lasts, sign * own.depth.si() * way)
            };
            let still = if begins > 0.0 { "[0, 0], " } else { "" };
            let rows = (0..=20).map(row).collect::<Vec<_>>().join(", ");
            let (name, parent) = (self.name(&format!("{side}_intrusion")), self.frame());
            _ = write!(
                text,
                "[frames.{name}]\nparent = \"{parent}\"\npath = {{ kind = \"table\", interpolation = \"linear\", after = \"hold\", \
                 columns = [\"t[s]\", \"{way}[m]\"], rows = [{still}{rows}] }}\n\n",
            );
        }
        text
    }

    /// Everything except seats and wheel.
    pub(super) fn shell(&self, seats: &[Seat]) -> String {
        let last = seats.iter().map(|seat| seat.row).max().unwrap_or(0).max(1) as f64;
        let rear = -last * self.measures.couple - 0.75;
        let drives = seats.iter().any(|seat| seat.name == "driver" && seat.is_taken());
        let wheel = if drives { self.wheel() } else { String::new() };
        self.intrusions()
            + &self.foot_rest()
            + &self.console()
            + &self.ahead()
            + &self.around(rear)
            + &wheel
            + &self.bags(seats)
    }

    /// Console between the front seats.
    fn console(&self) -> String {
        let class = self.section.class.unwrap_or_default();
        if !self.section.console.unwrap_or(!matches!(class, CarClass::Van | CarClass::Pickup)) {
            return String::new();
        }
        let (b, floor) = (self.measures.bolster, self.floor_z());
        let block = [[-0.10, -0.02], [b, -0.02], [b, floor], [-0.10, floor]];
        let half_width = (self.measures.seat_offset - 0.26).max(0.03);
        self.prism("console", "padding", &block, [0.0, half_width], "rounding = \"0.02 m\"\n")
    }

    /// Bolster, panel and windscreen.
    fn ahead(&self) -> String {
        let ([a, above], b, w) = (self.measures.panel, self.measures.bolster, self.half_width());
        let sides = [0.0, w];
        let top = -above;
        // below the knees it recedes, along the shins of a driver
        let bolster = [[b - 0.02, -0.19], [b + 0.01, -0.05], [b + 0.11, 0.05], [b + 0.22, 0.05], [b + 0.18, -0.19]];
        let panel = [[a + 0.03, top + 0.03], [a, -0.18], [a + 0.45, -0.18], [a + 0.45, top + 0.08], [a + 0.10, top]];
        let (base, head) = ([a + 0.46, top + 0.10], [0.45, -self.measures.roof]);
        let screen = [base, head, [head[0] + 0.04, head[1] - 0.04], [base[0] + 0.04, base[1] - 0.04]];
        let stiffness = self.section.panel.bolster_stiffness.as_ref().map(|stiffness| stiffness.si());
        let stiffness = stiffness.or(self.years.bolster_n_m);
        let own = stiffness.map_or_else(String::new, |k| {
            format!(
                "[materials.{}]\nk1 = \"{k} N/m\"\ndelta_b = \"50 mm\"\nk2 = \"{} N/m\"\nmu1 = 0.2\nfriction = 0.4\n\n",
                self.name("knee_bolster"),
                3.0 * k
            )
        });
        let material = if stiffness.is_some() { self.name("knee_bolster") } else { "bolster".to_owned() };
        let front = self.moved("front");
        own + &self.prism("knee_bolster", &material, &bolster, sides, &format!("{front}rounding = \"0.02 m\"\n"))
            + &self.prism("instrument_panel", "padding", &panel, sides, &format!("{front}rounding = \"0.03 m\"\n"))
            + &self.prism("windscreen", "windscreen", &screen, [0.0, w - 0.02], "")
    }

    /// Roof, doors, windows, pillars and rear wall.
    fn around(&self, rear: f64) -> String {
        let (w, roof, floor) = (self.half_width(), self.measures.roof, self.floor_z());
        let [a, above] = self.measures.panel;
        let (top, base) = ([0.45, -roof], a + 0.46);
        let sheet = [[top[0], top[1]], [rear, top[1]], [rear, top[1] - 0.06], [top[0], top[1] - 0.06]];
        let wall = [[rear, top[1]], [rear, floor + 0.10], [rear - 0.10, floor + 0.10], [rear - 0.10, top[1]]];
        let mut text = self.prism("roof", "padding", &sheet, [0.0, w - 0.09], "");
        text += &self.prism("rear_end", "padding", &wall, [0.0, w + 0.05], "");
        // the sill of the windows, and how far they lean in
        let (sill, lean) = (-0.44, 0.10);
        for (side, y) in [("left", -1.0), ("right", 1.0)] {
            let middle = [(rear + base) / 2.0, y * (w + DOOR_M / 2.0), (sill + floor) / 2.0];
            _ = write!(
                text,
                "[solids.{}]\n{}kind = \"box\"\nmaterial = \"frame\"\ncentre = {}\nlengths = {}\nrounding = \"0.02 m\"\n\n",
                self.name(&format!("{side}_door")),
                self.moved(side),
                list(&middle),
                list(&[base - rear, DOOR_M, floor - sill]),
            );
            let (low, high) = (y * (w + 0.03), y * (w + 0.03 - lean));
            let window = [[base, low, sill], [top[0], high, top[1]], [rear, high, top[1]], [rear, low, sill]];
            _ = write!(
                text,
                "[solids.{}]\n{}kind = \"prism\"\nmaterial = \"window\"\npoints = {}\nhalf_width = \"0.01 m\"\n\n",
                self.name(&format!("{side}_window")),
                frame_line(self.vehicle),
                points(&window),
            );
            let front = [[base, low * 0.99, -above + 0.02], [top[0], high, top[1] + 0.02]];
            let middle = [[-0.30, low, floor], [-0.38, high, top[1] + 0.02]];
            for (name, ends, radius) in [("front", front, 0.04), ("middle", middle, 0.05)] {
                _ = write!(
                    text,
                    "[solids.{}]\n{}kind = \"capsule\"\nmaterial = \"padding\"\nends = {}\nradius = {}\n\n",
                    self.name(&format!("{side}_{name}_pillar")),
                    frame_line(self.vehicle),
                    points(&ends),
                    m(radius),
                );
            }
        }
        text
    }

    /// Centre of the rim, and direction of the column away from the driver.
    fn rim(&self) -> ([f64; 3], [f64; 3]) {
        let [ahead, above] = self.measures.wheel;
        let (sin, cos) = sin_cos(self.measures.wheel_angle_deg.to_radians());
        let y = si_or(&self.seat("driver", 0, false).y, self.drivers_side() * self.measures.seat_offset);
        ([ahead, y, -above], [cos, 0.0, sin])
    }

    /// Rim, hub and column.
    fn wheel(&self) -> String {
        let (centre, along) = self.rim();
        let (force, stroke) =
            (si_or(&self.section.wheel.column_force, 2500.0), si_or(&self.section.wheel.column_stroke, 0.1));
        let beyond = |by: f64| [0, 1, 2].map(|i| centre[i] + by * along[i]);
        let (tilt, column) = (self.measures.wheel_angle_deg, self.name("column"));
        format!(
            "[frames.{column}]\nkind = \"column\"\nparent = \"{}\"\naxis = [{}, 0, {}]\norigin = {}\nmass = \"3 kg\"\n\
             stroke = [\"0 m\", \"1 mm\", \"3 mm\", \"{stroke} m\", \"{} m\", \"{} m\"]\nforce = [\"0 N\", \"{} N\", \"{force} N\", \"{force} N\", \"{} N\", \"{} N\"]\n\n\
             [solids.{}]\nkind = \"rim\"\nframe = \"{column}\"\nmaterial = \"wheel\"\ncentre = {}\ntilt = \"{tilt} deg\"\nradius = {}\ntube_radius = \"0.015 m\"\n\n\
             [solids.{}]\nkind = \"disc\"\nframe = \"{column}\"\nmaterial = \"wheel\"\ncentre = {}\ntilt = \"{tilt} deg\"\nradius = \"0.10 m\"\n\
             thickness = \"0.20 m\"\nrounding = \"0.02 m\"\n\n",
            self.frame(),
            along[0],
            along[2],
            list(&beyond(0.04)),
            stroke + 0.01,
            stroke + 0.06,
            1.2 * force,
            force + 10_000.0,
            force + 60_000.0,
            self.name("wheel_rim"),
            list(&centre),
            m(self.measures.wheel_diameter / 2.0),
            self.name("wheel_hub"),
            list(&beyond(0.13)),
        )
    }

    /// Bags of the front occupants, in the first vehicle only.
    fn bags(&self, seats: &[Seat]) -> String {
        let bags = &self.section.bags;
        if self.vehicle.is_some() {
            return String::new();
        }
        let taken = |name: &str| seats.iter().find(|seat| seat.name == name && seat.is_taken());
        let mut text = String::new();
        if let Some(seat) = taken("driver")
            && bags.driver.unwrap_or(self.years.bags)
        {
            let (centre, along) = self.rim();
            let mount = [0, 1, 2].map(|i| centre[i] - 0.01 * along[i]);
            text +=
                &self.bag(seat, "frame = \"column\"\n", mount, [-along[0], 0.0, -along[2]], [80.0, 0.30, 0.33, 0.55]);
        }
        if let Some(seat) = taken("passenger")
            && bags.passenger.unwrap_or(self.years.bags)
        {
            let [a, above] = self.measures.panel;
            let mount = [a + 0.08, seat.h[1], -above];
            text += &self.bag(seat, "", mount, [-0.94, 0.0, -0.342], [120.0, 0.45, 0.33, 0.60]);
        }
        if !text.is_empty() {
            text.insert_str(0, "[gases.generator]\nmolar_mass = \"33 kg/kmol\"\ncp = \"1070 J/(kg K)\"\n\n");
        }
        text + &self.bags_beside(seats)
    }

    /// Curtains, from the front pillar to behind the last heads, and side bags between doors and occupants.
    fn bags_beside(&self, seats: &[Seat]) -> String {
        let (bags, w, roof) = (&self.section.bags, self.half_width(), self.measures.roof);
        let mut text = String::new();
        let sides = [bags.curtain, bags.side].map(Option::unwrap_or_default);
        // what pushes the car away from a side struck that side
        for (side, y) in sides[0].with(sides[1]).each() {
            _ = write!(
                text,
                "[triggers.{side}_side]\nkind = \"vehicle_acceleration\"\nthreshold = \"3 g\"\nfor = \"2 ms\"\ndirection = [0, {}, 0]\n\n",
                -y
            );
        }
        for (side, y) in bags.curtain.unwrap_or_default().each() {
            let rear = seats.iter().filter(|seat| seat.is_taken()).map(|seat| seat.h[0]).fold(0.0, f64::min) - 0.55;
            let at = |x: f64| [x, y * (w - 0.125), CURTAIN_UP_M - roof];
            let mount = [0.5 * (rear + 0.25), y * (w - 0.08), 0.05 - roof];
            text += &self.bag_beside(
                [&format!("{side}_curtain"), ""],
                ("curtain", side),
                mount,
                [at(0.25), at(rear)],
                0.08,
            );
        }
        for (side, y) in bags.side.unwrap_or_default().each() {
            for seat in seats.iter().filter(|seat| seat.is_taken() && seat.h[1] * y > 0.1) {
                let at = |up: f64, ahead: f64| {
                    let [x, z] = seat.along([up, ahead]);
                    [x, y * (w - 0.085), z]
                };
                let ends = [at(0.12, 0.02), at(0.42, 0.06)];
                let names = [format!("{}_side", seat.name), seat.met()];
                text += &self.bag_beside(
                    names.each_ref().map(String::as_str),
                    ("side", side),
                    at(0.30, -0.10),
                    ends,
                    0.075,
                );
            }
        }
        text
    }

    /// A library bag around a line, with gas in proportion to its volume; `more` are further lines.
    fn bag_beside(
        &self,
        [name, more]: [&str; 2],
        (of, side): (&str, &str),
        mount: [f64; 3],
        ends: [[f64; 3]; 2],
        radius: f64,
    ) -> String {
        let long = (0..3).map(|i| (ends[1][i] - ends[0][i]).powi(2)).sum::<f64>().sqrt();
        let litres = 1e3 * std::f64::consts::PI * radius * radius * (long + 4.0 / 3.0 * radius);
        let (times, flow) = match of {
            "curtain" => ("[\"0 ms\", \"3 ms\", \"18 ms\"]", 5.0 / 26.5 * litres),
            _ => ("[\"0 ms\", \"2 ms\", \"10 ms\"]", 4.5 / 10.7 * litres),
        };
        let delay = si_or(&self.section.bags.delay, 0.004);
        format!(
            "[bags.{name}]\n{more}library = \"{of}\"\ntrigger = \"{side}_side\"\ndelay = \"{delay} s\"\nmount = {}\n\
             capsule = {{ ends = {}, radius = {} }}\ninflators = [{{ gas = {{ argon = 0.95, helium = 0.05 }}, times = {times}, \
             flow = [\"0 kg/s\", \"{flow} kg/s\", \"0 kg/s\"], temperature = [\"330 K\", \"330 K\", \"300 K\"] }}]\n\n",
            list(&mount),
            points(&ends),
            m(radius),
        )
    }

    /// A bag in front of a seat: volume in litres, depth, radius and face radius, m.
    fn bag(
        &self,
        seat: &Seat,
        frame: &str,
        mount: [f64; 3],
        axis: [f64; 3],
        [litres, depth, radius, face]: [f64; 4],
    ) -> String {
        let bags = &self.section.bags;
        let (delay, vent) = (si_or(&bags.delay, 0.009), 1800.0 * litres / 80.0 * si_or(&bags.vent, 1.0));
        let flow = [4.0, 2.5].map(|flow| flow * litres / 80.0);
        let name = seat.name;
        format!(
            "[bags.{name}]\n{frame}trigger = \"front\"\ndelay = \"{delay} s\"\ndeploy = \"25 ms\"\nmount = {}\n\
             dome = {{ axis = [{}, {}, {}], depth = {}, radius = {}, face_radius = {}, edge = \"0.08 m\" }}\nvolume = \"{litres} l\"\n\
             vents = [{{ area = \"{vent} mm^2\", discharge = 0.7, opens_at = \"20 kPa\" }}]\nleakage = 0.001\nfriction = 0.3\ncover = \"0.3 kg\"\n\
             {}spheres = [\"head\", \"chest\", \"left_shoulder\", \"right_shoulder\"]\n\
             reach = {{ chest = 1.6 }}\n\n[[bags.{name}.inflators]]\ngas = {{ generator = 1 }}\n\
             times = [\"0 ms\", \"4 ms\", \"20 ms\", \"45 ms\"]\nflow = [\"0 kg/s\", \"{} kg/s\", \"{} kg/s\", \"0 kg/s\"]\n\
             temperature = [\"700 K\", \"700 K\", \"600 K\", \"500 K\"]\n\n",
            list(&mount),
            axis[0],
            axis[1],
            axis[2],
            m(depth),
            m(radius),
            m(face),
            seat.met(),
            flow[0],
            flow[1],
        )
    }
}
