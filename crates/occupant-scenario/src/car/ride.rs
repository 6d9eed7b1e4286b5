//! Whoever sits in a car: body, posture and belt where the scenario does not say them, and the belt's parts.

use super::seats::Seat;
use super::{Car, Rider, SEATS, list, m};
use crate::sections::{AnchorSection, CarBelt, CarClass, si_or};

/// Belt places from the H-point: behind, outboard, above, m. Ours, of a usual car, but for the D-ring's place behind and above: after that of a
/// mid-size car, 416 and 616 mm, on the sled of G. Shaw et al.: Impact Response of Restrained PMHS in Frontal Sled Tests, Stapp Car Crash
/// J. 53 (2009). It stands on the pillar: seats slide past it.
const D_RING_M: [f64; 3] = [0.42, 0.27, 0.62];
/// D-ring in the rear, where backs lean more and there is no height adjuster; ours.
const REAR_D_RING_M: [f64; 3] = [0.46, 0.27, 0.56];
/// Stature for this position of the D-ring, slope of its height adjuster over the stature, its notches and its range
/// down and up, m; ours.
const ADJUSTED_FOR_M: f64 = 1.75;
const ADJUSTS: f64 = 0.35;
const NOTCH_M: f64 = 0.02;
const ADJUSTS_M: [f64; 2] = [-0.06, 0.02];
/// The same in the back of a seat: up along it and ahead of it from the H-point, outboard; ours: above the shoulder of a tall man.
const BACK_RING_M: [f64; 3] = [0.60, -0.13, 0.20];
const BUCKLE_M: [f64; 3] = [0.10, -0.19, -0.12];
pub(super) const ANCHOR_M: [f64; 3] = [0.16, 0.25, -0.22];
/// The inner anchor of a lap belt.
const INNER_ANCHOR_M: [f64; 3] = [0.16, -0.23, -0.22];

/// Name of the only belt.
const BELT: &str = "belt";

/// Height of a heel above the floor, m.
pub(super) const SOLE_M: f64 = 0.03;

/// Heels of passengers forward of and below their H-point, m.
const PASSENGER_HEELS_M: f64 = 0.70;
/// Distance of a driver's heels forward of the H-point in a seat too far from the pedals for any leg, m.
const FARTHEST_HEELS_M: f64 = 0.9;
/// Least distance of rear passengers' heels behind the H-points of the row in front, m.
const REAR_FEET_M: f64 = 0.41;

impl Car<'_> {
    /// All parts of one occupant.
    pub(super) fn ride(&self, rider: &Rider, riders: usize) -> String {
        let Some((name, row, side)) = SEATS.iter().find(|(name, ..)| *name == rider.seat) else { return String::new() };
        let seat = self.placed(name, *row, *side, Some(rider));
        let mut text = self.body(rider, riders);
        if rider.lacks.posture {
            text += &self.posture(rider, &seat, riders);
        }
        text + &self.belt(rider, &seat)
    }

    fn posture(&self, rider: &Rider, seat: &Seat, riders: usize) -> String {
        let lean = seat.recline_deg;
        let is_driver = seat.name == "driver" && self.section.class != Some(CarClass::Sled);
        let heels = if is_driver {
            [self.measures.heels.min(seat.h[0] + FARTHEST_HEELS_M), self.measures.seat_height]
        } else {
            // rows behind the front have the seats ahead before their shins
            let room = if seat.row == 0 { self.measures.flat_heels } else { self.measures.couple - REAR_FEET_M };
            let ahead = PASSENGER_HEELS_M.min(room);
            [seat.h[0] + ahead, self.measures.seat_height]
        };
        let arms = if is_driver && rider.lacks.arms {
            let [ahead, above] = self.measures.wheel;
            format!("hands = {}\n", list(&[ahead - HANDS_BEFORE_RIM_M, -above]))
        } else {
            // hands on the thighs, elbows clear of the back
            format!("upper_arms = \"{} deg\"\nelbows = \"-75 deg\"\n", (lean - 5.0).max(15.0))
        };
        format!(
            "[{}posture]\nseat = \"{}\"\nlower_torso = \"{} deg\"\nmiddle_torso = \"{} deg\"\nupper_torso = \"{} deg\"\n{}head = \"{} deg\"\n\
             {arms}heels = {}\n\n",
            rider.prefix,
            seat.id,
            lean,
            lean - 3.0,
            lean - 2.0,
            if rider.lacks.flesh && segment_count(riders) > 12 {
                format!("neck = \"{} deg\"\n", 0.45 * lean)
            } else {
                String::new()
            },
            (lean - 30.0).max(5.0),
            list(&heels),
        )
    }

    fn belt(&self, rider: &Rider, seat: &Seat) -> String {
        let (prefix, own) = (&rider.prefix, &seat.own);
        let name = if prefix.is_empty() { seat.name } else { BELT };
        // outboard is where the nearer door is; a middle seat's belt comes from the right
        let out = if seat.h[1] < 0.0 { -1.0 } else { 1.0 };
        let at = |said: &AnchorSection, [behind, outboard, above]: [f64; 3]| {
            let [x, y, z] = seat.h;
            let place = placed_m(said, [behind, outboard, above]);
            [x - place[0], y + out * place[1], z - place[2]]
        };
        let kind = own.belt.unwrap_or_default();
        let (buckle, anchor) = (at(&own.buckle, buckle_m(kind)), at(&own.anchor, ANCHOR_M));
        match kind {
            CarBelt::None => String::new(),
            CarBelt::Lap => format!(
                "[{prefix}belts.{name}]\nsphere = \"pelvis\"\nanchors = [{}, {}]\nk1 = \"110 kN/m\"\nmu1 = 0.5\nslack = {}\n\n",
                list(&anchor),
                list(&buckle),
                m(si_or(&own.slack, 0.0)),
            ),
            CarBelt::ThreePoint | CarBelt::Seat => {
                let side = if out < 0.0 { "left" } else { "right" };
                let d_ring = d_ring_m(rider.stature_m, seat);
                let mut belt = format!(
                    "[{prefix}belts.{name}]\npreset = \"three_point\"\nside = \"{side}\"\nretractor = \"{name}\"\nd_ring = {}\nbuckle = {}\nanchor = {}\n",
                    list(&at(&own.d_ring, d_ring)),
                    list(&buckle),
                    list(&anchor),
                );
                if let Some(back) = seat.back_frame().filter(|_| kind == CarBelt::Seat) {
                    belt += &format!("d_ring_frame = \"{back}\"\n");
                }
                if rider.lacks.pelvis {
                    belt += "lap = \"wings\"\n";
                }
                if let Some(above) = &own.lap_above {
                    belt += &format!("lap_above = {}\n", m(above.si()));
                }
                if own.locking_tongue == Some(true) {
                    belt += "locking_tongue = true\n";
                }
                belt + "\n" + &self.retractor(prefix, seat)
            }
        }
    }
}

/// Position of a belt point, given by the scenario or by default: behind, outboard, above, m.
pub(super) fn placed_m(said: &AnchorSection, [behind, outboard, above]: [f64; 3]) -> [f64; 3] {
    [si_or(&said.behind, behind), si_or(&said.outboard, outboard), si_or(&said.above, above)]
}

/// The buckle; for a lap belt its inner anchor.
pub(super) fn buckle_m(kind: CarBelt) -> [f64; 3] {
    if kind == CarBelt::Lap { INNER_ANCHOR_M } else { BUCKLE_M }
}

/// Position of the D-ring relative to a seat whose design position is this far ahead of it: behind, outboard, above, m.
pub(super) fn d_ring_m(stature_m: f64, seat: &Seat) -> [f64; 3] {
    if seat.own.belt == Some(CarBelt::Seat) {
        let [up, ahead, outboard] = BACK_RING_M;
        let [x, z] = seat.along([up, ahead]);
        return [seat.h[0] - x, outboard, seat.h[2] - z];
    }
    let [down, up] = ADJUSTS_M;
    let notches = (ADJUSTS * (stature_m - ADJUSTED_FOR_M) / NOTCH_M).round();
    let ([behind, outboard, above], adjusted) = match seat.row {
        0 => (D_RING_M, (NOTCH_M * notches).clamp(down, up)),
        _ => (REAR_D_RING_M, 0.0),
    };
    [behind - seat.track, outboard, above + adjusted]
}

/// Distance of the hands' centres behind the plane of the rim, m.
const HANDS_BEFORE_RIM_M: f64 = 0.05;

/// Webbing paid out by a locked spool (film spool), m; ours.
pub(super) const FILM_M: f64 = 0.03;

/// Force of a spool at the end of the film spool-out, and 5 cm later without a limiter; ours.
const FILM_N: f64 = 3000.0;
const UNLIMITED_N: f64 = 15_000.0;

/// Number of segments of one or two occupants.
pub(super) const SEGMENTS: usize = 19;

/// Number of segments per occupant: all together at most 48.
fn segment_count(riders: usize) -> usize {
    match riders {
        0..=2 => SEGMENTS,
        3 => 15,
        _ => 12,
    }
}

impl Car<'_> {
    fn body(&self, rider: &Rider, riders: usize) -> String {
        let (prefix, lacks) = (&rider.prefix, rider.lacks);
        let mut text = String::new();
        if let Some(own) = prefix.strip_suffix('.') {
            text += &format!("[{own}]\nvehicle = \"{}\"\n\n", self.frame());
        }
        text += &format!("[{prefix}body]\n");
        if lacks.spheres {
            text += "sphere_set = \"even\"\n";
        }
        if lacks.body {
            text += "preset = \"male50\"\n";
        }
        if lacks.flesh {
            text += &format!("segment_count = {}\n", segment_count(riders));
            text += "chest = \"person\"\nabdomen = \"person\"\n";
        }
        if lacks.pelvis {
            text += "pelvis = \"flesh\"\n";
        }
        text += &format!("[{prefix}joints]\n");
        if lacks.joints {
            text += "preset = \"person\"\n";
        }
        text + "\n"
    }

    /// Retractor, limiter and pretensioner of a seat's belt.
    fn retractor(&self, prefix: &str, seat: &Seat) -> String {
        let own = &seat.own;
        let name = if prefix.is_empty() { seat.name } else { BELT };
        let (limiter, [sensor, crash]) = (&seat.id, ["sensor", "crash"].map(|trigger| self.name(trigger)));
        let limited = own.limiter.as_ref().map(|force| force.si());
        let force = limited.unwrap_or(FILM_N);
        let film = si_or(&own.film, FILM_M);
        let pulls = si_or(&own.pretensioner, if seat.row == 0 { 0.1 } else { 0.0 });
        // a pretensioner takes loose webbing up first; what it leaves comes before the film, at little more than the spool's tension
        let slack = si_or(&own.slack, 0.0);
        let (loose, pulled) = ((slack - pulls).max(0.0), (pulls - slack).max(0.0));
        let (starts, held) = if loose > 0.0 {
            (format!("\"0 m\", \"{loose} m\""), "\"0 N\", \"10 N\"")
        } else {
            ("\"0 m\"".to_owned(), "\"0 N\"")
        };
        let film = loose + film;
        let pretensioner = if pulled > 0.0 {
            // it moves evenly, and pulls from when the slack is gone
            let free = if slack > 0.0 { format!("\"{} s\", ", 0.008 * slack / pulls) } else { String::new() };
            let still = if slack > 0.0 { "\"0 m\", " } else { "" };
            format!(
                "pretensioner = {{ trigger = \"{crash}\", delay = \"3 ms\", times = [\"0 s\", {free}\"8 ms\"], pull = [\"0 m\", {still}\"{pulled} m\"], \
                 stall_force = \"2 kN\" }}\n"
            )
        } else {
            String::new()
        };
        let (held_m, held_n) = match limited {
            Some(force) => ([0.47, 0.52], [force, 3.0 * force]),
            None => ([0.05, 0.10], [UNLIMITED_N, 2.0 * UNLIMITED_N]),
        };
        format!(
            "[{prefix}retractors.{name}]\non_spool = \"0.8 m\"\nspool_tension = \"6 N\"\nlock = {{ trigger = \"{sensor}\", payout = \"5 mm\" }}\nlimiter = \"{limiter}\"\n\
             {pretensioner}\n[limiters.{limiter}]\npayout = [{starts}, \"{film} m\", \"{} m\", \"{} m\"]\nforce = [{held}, \"{force} N\", \"{} N\", \"{} N\"]\n\n",
            film + held_m[0],
            film + held_m[1],
            held_n[0],
            held_n[1],
        )
    }
}
