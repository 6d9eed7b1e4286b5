//! What stands round the seats of a car: wheel, bags, panel, glass, doors, floor and roof.

use std::fmt::Write as _;

use super::ride::SOLE_M;
use super::seats::Seat;
use super::{Car, list, m, points, prism};
use crate::sections::si_or;
use occupant_units::trig::sin_cos;

/// Middle of a curtain below the roof, m: beside the heads.
const CURTAIN_UP_M: f64 = 0.30;
/// Thickness of a door.
const DOOR_M: f64 = 0.20;

impl Car<'_> {
    /// Triggers of belts and bags stand here, as every car has them.
    fn triggers() -> &'static str {
        "[triggers.sensor]\nkind = \"vehicle_acceleration\"\nthreshold = \"0.45 g\"\n\n\
         [triggers.crash]\nkind = \"vehicle_acceleration\"\nthreshold = \"3 g\"\nfor = \"2 ms\"\n\n"
    }

    /// Half the width between the doors, m.
    fn half_width(&self) -> f64 {
        self.measures.shoulder_room / 2.0
    }

    /// Where the floor is, m.
    fn floor_z(&self) -> f64 {
        self.measures.seat_height + SOLE_M
    }

    /// A slanted board before the feet and the floor under them.
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
        let text = prism("toe_board", "floor", &board, sides, "") + &prism("floor", "floor", &ground, sides, "");
        Self::triggers().to_owned() + &text
    }

    /// All but seats and wheel.
    pub(super) fn shell(&self, seats: &[Seat]) -> String {
        let last = seats.iter().map(|seat| seat.row).max().unwrap_or(0).max(1) as f64;
        let rear = -last * self.measures.couple - 0.75;
        let drives = seats.iter().any(|seat| seat.name == "driver" && seat.is_taken());
        let wheel = if drives { self.wheel() } else { String::new() };
        self.foot_rest() + &self.ahead() + &self.around(rear) + &wheel + &self.bags(seats)
    }

    /// Bolster, panel and windscreen.
    fn ahead(&self) -> String {
        let ([a, above], b, w) = (self.measures.panel, self.measures.bolster, self.half_width());
        let sides = [0.0, w];
        let top = -above;
        let bolster = [[b - 0.02, -0.19], [b + 0.05, 0.13], [b + 0.20, 0.13], [b + 0.18, -0.19]];
        let panel = [[a + 0.03, top + 0.03], [a, -0.18], [a + 0.45, -0.18], [a + 0.45, top + 0.08], [a + 0.10, top]];
        let (base, head) = ([a + 0.46, top + 0.10], [0.45, -self.measures.roof]);
        let screen = [base, head, [head[0] + 0.04, head[1] - 0.04], [base[0] + 0.04, base[1] - 0.04]];
        let stiffness = self.section.panel.bolster_stiffness.as_ref().map(|stiffness| stiffness.si());
        let own = stiffness.map_or_else(String::new, |k| {
            format!(
                "[materials.knee_bolster]\nk1 = \"{k} N/m\"\ndelta_b = \"50 mm\"\nk2 = \"{} N/m\"\nmu1 = 0.2\nfriction = 0.4\n\n",
                3.0 * k
            )
        });
        let material = if stiffness.is_some() { "knee_bolster" } else { "bolster" };
        own + &prism("knee_bolster", material, &bolster, sides, "rounding = \"0.02 m\"\n")
            + &prism("instrument_panel", "padding", &panel, sides, "rounding = \"0.03 m\"\n")
            + &prism("windscreen", "windscreen", &screen, [0.0, w - 0.02], "")
    }

    /// Roof, doors, windows, pillars and what is behind.
    fn around(&self, rear: f64) -> String {
        let (w, roof, floor) = (self.half_width(), self.measures.roof, self.floor_z());
        let [a, above] = self.measures.panel;
        let (top, base) = ([0.45, -roof], a + 0.46);
        let sheet = [[top[0], top[1]], [rear, top[1]], [rear, top[1] - 0.06], [top[0], top[1] - 0.06]];
        let wall = [[rear, top[1]], [rear, floor + 0.10], [rear - 0.10, floor + 0.10], [rear - 0.10, top[1]]];
        let mut text = prism("roof", "padding", &sheet, [0.0, w - 0.09], "");
        text += &prism("rear_end", "padding", &wall, [0.0, w + 0.05], "");
        // the sill of the windows, and how far they lean in
        let (sill, lean) = (-0.44, 0.10);
        for (side, y) in [("left", -1.0), ("right", 1.0)] {
            let middle = [(rear + base) / 2.0, y * (w + DOOR_M / 2.0), (sill + floor) / 2.0];
            _ = write!(
                text,
                "[solids.{side}_door]\nkind = \"box\"\nmaterial = \"frame\"\ncentre = {}\nlengths = {}\nrounding = \"0.02 m\"\n\n",
                list(&middle),
                list(&[base - rear, DOOR_M, floor - sill]),
            );
            let (low, high) = (y * (w + 0.03), y * (w + 0.03 - lean));
            let window = [[base, low, sill], [top[0], high, top[1]], [rear, high, top[1]], [rear, low, sill]];
            _ = write!(
                text,
                "[solids.{side}_window]\nkind = \"prism\"\nmaterial = \"window\"\npoints = {}\nhalf_width = \"0.01 m\"\n\n",
                points(&window),
            );
            let front = [[base, low * 0.99, -above + 0.02], [top[0], high, top[1] + 0.02]];
            let middle = [[-0.30, low, floor], [-0.38, high, top[1] + 0.02]];
            for (name, ends, radius) in [("front", front, 0.04), ("middle", middle, 0.05)] {
                _ = write!(
                    text,
                    "[solids.{side}_{name}_pillar]\nkind = \"capsule\"\nmaterial = \"padding\"\nends = {}\nradius = {}\n\n",
                    points(&ends),
                    m(radius),
                );
            }
        }
        text
    }

    /// Where the rim's middle is, and the direction of the column away from the driver.
    fn rim(&self) -> ([f64; 3], [f64; 3]) {
        let [ahead, above] = self.measures.wheel;
        let (sin, cos) = sin_cos(self.measures.wheel_angle_deg.to_radians());
        let y = si_or(&self.seat("driver").y, self.drivers_side() * self.measures.seat_offset);
        ([ahead, y, -above], [cos, 0.0, sin])
    }

    /// Rim, hub and column.
    fn wheel(&self) -> String {
        let (centre, along) = self.rim();
        let (force, stroke) =
            (si_or(&self.section.wheel.column_force, 2500.0), si_or(&self.section.wheel.column_stroke, 0.1));
        let beyond = |by: f64| [0, 1, 2].map(|i| centre[i] + by * along[i]);
        let tilt = self.measures.wheel_angle_deg;
        format!(
            "[frames.column]\nkind = \"column\"\naxis = [{}, 0, {}]\norigin = {}\nmass = \"3 kg\"\n\
             stroke = [\"0 m\", \"1 mm\", \"3 mm\", \"{stroke} m\", \"{} m\", \"{} m\"]\nforce = [\"0 N\", \"{} N\", \"{force} N\", \"{force} N\", \"{} N\", \"{} N\"]\n\n\
             [solids.wheel_rim]\nkind = \"rim\"\nframe = \"column\"\nmaterial = \"wheel\"\ncentre = {}\ntilt = \"{tilt} deg\"\nradius = {}\ntube_radius = \"0.015 m\"\n\n\
             [solids.wheel_hub]\nkind = \"disc\"\nframe = \"column\"\nmaterial = \"wheel\"\ncentre = {}\ntilt = \"{tilt} deg\"\nradius = \"0.10 m\"\n\
             thickness = \"0.20 m\"\nrounding = \"0.02 m\"\n\n",
            along[0],
            along[2],
            list(&beyond(0.04)),
            stroke + 0.01,
            stroke + 0.06,
            1.2 * force,
            force + 10_000.0,
            force + 60_000.0,
            list(&centre),
            m(self.measures.wheel_diameter / 2.0),
            list(&beyond(0.13)),
        )
    }

    /// The bags of those who sit in front.
    fn bags(&self, seats: &[Seat]) -> String {
        let bags = &self.section.bags;
        let taken = |name: &str| seats.iter().any(|seat| seat.name == name && seat.is_taken());
        let mut text = String::new();
        if taken("driver") && bags.driver != Some(false) {
            let (centre, along) = self.rim();
            let mount = [0, 1, 2].map(|i| centre[i] - 0.01 * along[i]);
            text += &self.bag(
                "driver",
                "frame = \"column\"\n",
                mount,
                [-along[0], 0.0, -along[2]],
                [80.0, 0.30, 0.33, 0.55],
            );
        }
        if let Some(seat) = seats.iter().find(|seat| seat.name == "passenger" && seat.is_taken())
            && bags.passenger != Some(false)
        {
            let [a, above] = self.measures.panel;
            let mount = [a + 0.08, seat.h[1], -above];
            text += &self.bag("passenger", "", mount, [-0.94, 0.0, -0.342], [120.0, 0.45, 0.33, 0.60]);
        }
        if !text.is_empty() {
            text.insert_str(0, "[gases.generator]\nmolar_mass = \"33 kg/kmol\"\ncp = \"1070 J/(kg K)\"\n\n");
        }
        text + &self.bags_beside(seats)
    }

    /// Curtains, from the front pillar to behind the last heads, and bags between doors and those who sit beside them.
    fn bags_beside(&self, seats: &[Seat]) -> String {
        let (bags, w, roof) = (&self.section.bags, self.half_width(), self.measures.roof);
        let mut text = String::new();
        for (side, y) in bags.curtain.unwrap_or_default().each() {
            let rear = seats.iter().filter(|seat| seat.is_taken()).map(|seat| seat.h[0]).fold(0.0, f64::min) - 0.55;
            let at = |x: f64| [x, y * (w - 0.10), CURTAIN_UP_M - roof];
            let mount = [0.5 * (rear + 0.25), y * (w - 0.08), 0.05 - roof];
            text += &self.bag_beside(&format!("{side}_curtain"), "curtain", mount, [at(0.25), at(rear)], 0.07);
        }
        for (_, y) in bags.side.unwrap_or_default().each() {
            for seat in seats.iter().filter(|seat| seat.is_taken() && seat.h[1] * y > 0.1) {
                let at = |up: f64, ahead: f64| {
                    let [x, z] = seat.along([up, ahead]);
                    [x, y * (w - 0.085), z]
                };
                let ends = [at(0.12, 0.02), at(0.42, 0.06)];
                text += &self.bag_beside(&format!("{}_side", seat.name), "side", at(0.30, -0.10), ends, 0.075);
            }
        }
        text
    }

    /// A bag of the library round a line, with as much more gas as it is larger than that.
    fn bag_beside(&self, name: &str, of: &str, mount: [f64; 3], ends: [[f64; 3]; 2], radius: f64) -> String {
        let long = (0..3).map(|i| (ends[1][i] - ends[0][i]).powi(2)).sum::<f64>().sqrt();
        let litres = 1e3 * std::f64::consts::PI * radius * radius * (long + 4.0 / 3.0 * radius);
        let (times, flow) = match of {
            "curtain" => ("[\"0 ms\", \"3 ms\", \"18 ms\"]", 5.0 / 26.5 * litres),
            _ => ("[\"0 ms\", \"2 ms\", \"10 ms\"]", 3.4 / 10.7 * litres),
        };
        let delay = si_or(&self.section.bags.delay, 0.004);
        format!(
            "[bags.{name}]\nlibrary = \"{of}\"\ntrigger = \"crash\"\ndelay = \"{delay} s\"\nmount = {}\n\
             capsule = {{ ends = {}, radius = {} }}\ninflators = [{{ gas = {{ argon = 0.95, helium = 0.05 }}, times = {times}, \
             flow = [\"0 kg/s\", \"{flow} kg/s\", \"0 kg/s\"], temperature = [\"330 K\", \"330 K\", \"300 K\"] }}]\n\n",
            list(&mount),
            points(&ends),
            m(radius),
        )
    }

    /// A bag of so many litres, of this depth, radius and radius of its face, m.
    fn bag(
        &self,
        name: &str,
        frame: &str,
        mount: [f64; 3],
        axis: [f64; 3],
        [litres, depth, radius, face]: [f64; 4],
    ) -> String {
        let bags = &self.section.bags;
        let (delay, vent) = (si_or(&bags.delay, 0.009), 1800.0 * litres / 80.0 * si_or(&bags.vent, 1.0));
        let flow = [4.0, 2.5].map(|flow| flow * litres / 80.0);
        format!(
            "[bags.{name}]\n{frame}trigger = \"crash\"\ndelay = \"{delay} s\"\ndeploy = \"25 ms\"\nmount = {}\n\
             dome = {{ axis = [{}, {}, {}], depth = {}, radius = {}, face_radius = {}, edge = \"0.08 m\" }}\nvolume = \"{litres} l\"\n\
             vents = [{{ area = \"{vent} mm^2\", discharge = 0.7, opens_at = \"20 kPa\" }}]\nleakage = 0.001\nfriction = 0.3\ncover = \"0.3 kg\"\n\
             spheres = [\"head\", \"chest\", \"left_shoulder\", \"right_shoulder\"]\n\
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
            flow[0],
            flow[1],
        )
    }
}
