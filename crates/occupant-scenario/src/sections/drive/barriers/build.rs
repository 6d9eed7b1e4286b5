//! The barriers of `[drive.barriers]`.

use occupant_units::trig;
use std::f64::consts::PI;

use vehicle_motion::barrier::{Barrier, Block, End, Pole, Rail, Slider, Wall};

use super::super::super::builder::Builder;
use super::super::super::quantity::{NOT_NEGATIVE, Quantity, all_si, si_or};
use super::super::super::{Force, Length};
use super::super::parts::put;
use super::{BarrierSection, BlockSection, CushionSection, Hand, RailSection, SignSection, WallSection};
use placed_text::with_key;

/// Friction of a car's end on rigid obstacles, and along smooth concrete.
const ROUGH: f64 = 0.55;
const CONCRETE: f64 = 0.2;
/// Diameter of the pole of 49 CFR 571.214, m.
const POLE_M: f64 = 0.254;

impl BarrierSection {
    /// Its name in reports.
    pub(in super::super) fn kind(&self) -> &'static str {
        match self {
            BarrierSection::Wall(_) => "wall",
            BarrierSection::Pole(_) => "pole",
            BarrierSection::Block(_) => "block",
            BarrierSection::Rail(_) => "rail",
            BarrierSection::Cushion(_) => "cushion",
            BarrierSection::Sign(_) => "sign",
        }
    }

    /// The barrier; the first vehicle starts at the given position. Mistakes are reported.
    pub(in super::super) fn barrier(&self, b: &mut Builder, at: &str, first_m: [f64; 2]) -> Option<Barrier> {
        Some(match self {
            BarrierSection::Wall(s) => Barrier::Wall(s.wall()),
            BarrierSection::Pole(s) => {
                let radius_m = 0.5 * si_or(&s.diameter, POLE_M);
                Barrier::Pole(Pole { at_m: all_si(&s.at), radius_m, friction: si_or(&s.friction, ROUGH) })
            }
            BarrierSection::Block(s) => {
                Barrier::Block(Block { corners_m: s.corners_m(), friction: si_or(&s.friction, ROUGH) })
            }
            BarrierSection::Rail(s) => Barrier::Rail(s.rail(b, at, first_m)?),
            BarrierSection::Cushion(s) => Barrier::Slider(s.slider(b, at)?),
            BarrierSection::Sign(s) => Barrier::Slider(s.slider(b, at)?),
        })
    }
}

impl WallSection {
    fn wall(&self) -> Wall {
        let usual = if self.preset.is_some() { CONCRETE } else { ROUGH };
        Wall { point_m: all_si(&self.at), normal_rad: si_or(&self.facing, PI), friction: si_or(&self.friction, usual) }
    }
}

impl BlockSection {
    /// Its corners, clockwise from above.
    fn corners_m(&self) -> Vec<[f64; 2]> {
        let given = self.corners.iter().flatten().map(all_si).collect();
        let mut corners: Vec<[f64; 2]> = match (&self.centre, &self.lengths) {
            (Some(centre), Some(lengths)) => rectangle(all_si(centre), all_si(lengths), si_or(&self.yaw, 0.0)),
            _ => given,
        };
        let area: f64 = (0..corners.len())
            .map(|i| (corners[i], corners[(i + 1) % corners.len()]))
            .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
            .sum();
        if area < 0.0 {
            corners.reverse();
        }
        corners
    }
}

/// Corners of a rectangle about its middle, clockwise from above.
fn rectangle([x, y]: [f64; 2], lengths_m: [f64; 2], yaw_rad: f64) -> Vec<[f64; 2]> {
    let (sine, cosine) = trig::sin_cos(yaw_rad);
    let corner = |[along, across]: [f64; 2]| {
        let [a, c] = [0.5 * along * lengths_m[0], 0.5 * across * lengths_m[1]];
        [x + a * cosine - c * sine, y + a * sine + c * cosine]
    };
    [[1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]].map(corner).to_vec()
}

impl RailSection {
    fn rail(&self, b: &mut Builder, at: &str, [x, y]: [f64; 2]) -> Option<Rail> {
        let line_m = [all_si(&self.line[0]), all_si(&self.line[1])];
        let [from, to] = line_m;
        let way = [to[0] - from[0], to[1] - from[1]];
        let right = way[0] * (y - from[1]) - way[1] * (x - from[0]);
        let mut rail = Rail::w_beam(line_m);
        rail.traffic_on_left = self.traffic.map_or(right < 0.0, |hand| hand == Hand::Left);
        put(&mut rail.height_m, &self.height);
        if let Some(edges) = &self.edges {
            rail.band_m = all_si(edges);
            if rail.band_m[1] <= rail.band_m[0] {
                let found = format!("edges at {} m and {} m", rail.band_m[0], rail.band_m[1]);
                b.error(&with_key(at, "edges"), found, "the lower edge, then the upper one");
                return None;
            }
        }
        put(&mut rail.spacing_m, &self.posts.spacing);
        put(&mut rail.post_n, &self.posts.force);
        put(&mut rail.post_n_per_m, &self.posts.stiffness);
        put(&mut rail.release_m, &self.posts.release);
        put(&mut rail.post_kg, &self.posts.mass);
        put(&mut rail.anchor_n_per_m, &self.anchor);
        put(&mut rail.yield_n, &self.yields);
        put(&mut rail.friction, &self.friction);
        let length_m = trig::hypot(way[0], way[1]);
        if length_m < 2.0 * rail.spacing_m {
            let found = format!("a rail of {length_m:.2} m on posts every {} m", rail.spacing_m);
            b.error(&with_key(at, "line"), found, "at least two spacings of its posts");
            return None;
        }
        Some(rail)
    }
}

impl CushionSection {
    fn slider(&self, b: &mut Builder, at: &str) -> Option<Slider> {
        let usual = yields(self.preset.as_deref());
        let [width_m, length_m, mass_kg] = sizes(
            b,
            at,
            usual,
            [
                ("width", self.width.as_ref().map(Quantity::si)),
                ("length", self.length.as_ref().map(Quantity::si)),
                ("mass", self.mass.as_ref().map(Quantity::si)),
            ],
        )?;
        let back_rad = si_or(&self.facing, PI) + PI;
        let (sine, cosine) = trig::sin_cos(back_rad);
        let [x, y] = all_si(&self.at);
        let middle = [x + 0.5 * length_m * cosine, y + 0.5 * length_m * sine];
        Some(Slider {
            corners_m: rectangle(middle, [length_m, width_m], back_rad),
            mass_kg,
            direction_rad: Some(back_rad),
            force_n: held_back(b, at, usual, self.stroke.as_deref(), self.force.as_deref())?,
            returned: si_or(&self.returned, 0.05),
            end: End::Rigid,
            friction: si_or(&self.friction, ROUGH),
        })
    }
}

impl SignSection {
    fn slider(&self, b: &mut Builder, at: &str) -> Option<Slider> {
        let friction = si_or(&self.friction, ROUGH);
        let usual = yields(self.preset.as_deref());
        let [diameter_m, _, mass_kg] = sizes(
            b,
            at,
            usual,
            [
                ("diameter", self.diameter.as_ref().map(Quantity::si)),
                ("length", Some(0.0)),
                ("mass", self.mass.as_ref().map(Quantity::si)),
            ],
        )?;
        let pole = Pole { at_m: all_si(&self.at), radius_m: 0.5 * diameter_m, friction };
        Some(Slider {
            corners_m: pole.corners_m(),
            mass_kg,
            direction_rad: None,
            force_n: held_back(b, at, usual, self.stroke.as_deref(), self.force.as_deref())?,
            returned: 0.0,
            end: End::Released,
            friction,
        })
    }
}

/// A barrier that yields: width or diameter, m, length, m, mass, kg, and force over its stroke, m and N.
#[derive(Clone, Copy)]
struct Yields {
    sizes: [f64; 3],
    force_n: &'static [[f64; 2]],
}

/// All are estimates. Signs: a car of 900 kg that strikes at 100 km/h leaves at 85, 57 and 14 km/h; the categories of EN 12767 are 70 to
/// 100, 50 to 70, and at most 50 km/h. Cushions stop 900 and 1300 kg at the speed of their name within 80 % of their stroke.
fn yields(preset: Option<&str>) -> Option<Yields> {
    let (sizes, force_n): (_, &[[f64; 2]]) = match preset? {
        "en12767-ne" => ([0.114, 0.0, 40.0], &[[0.0, 40e3], [0.5, 40e3]]),
        "en12767-le" => ([0.14, 0.0, 40.0], &[[0.0, 40e3], [4.5, 40e3]]),
        "en12767-he" => ([0.14, 0.0, 40.0], &[[0.0, 60e3], [4.5, 60e3]]),
        "en1317-3-80" => ([0.9, 4.6, 120.0], &[[0.0, 50e3], [2.0, 50e3], [2.5, 100e3], [4.0, 120e3]]),
        _ => ([0.9, 6.6, 150.0], &[[0.0, 50e3], [2.0, 50e3], [2.5, 100e3], [6.0, 120e3]]),
    };
    Some(Yields { sizes, force_n })
}

/// Sizes that are given, or those of the preset; reports one that neither has.
fn sizes(b: &mut Builder, at: &str, usual: Option<Yields>, given: [(&str, Option<f64>); 3]) -> Option<[f64; 3]> {
    let of = |i: usize| given[i].1.or(usual.map(|own| own.sizes[i]));
    if let Some((key, _)) = (0..3).find(|&i| of(i).is_none()).map(|i| given[i]) {
        b.error(at, format!("no `{key}`, and no preset"), format!("{key} = a number with its unit, or a preset"));
        return None;
    }
    Some([0, 1, 2].map(|i| of(i).unwrap_or_default()))
}

/// Force over stroke, m and N; reports lists that are missing or of unequal length, and strokes that do not rise from 0.
fn held_back(
    b: &mut Builder,
    at: &str,
    usual: Option<Yields>,
    stroke: Option<&[Length<NOT_NEGATIVE>]>,
    force: Option<&[Force<NOT_NEGATIVE>]>,
) -> Option<Vec<[f64; 2]>> {
    let (stroke, force) = match (stroke, force, usual) {
        (Some(stroke), Some(force), _) => (stroke, force),
        (None, None, Some(usual)) => return Some(usual.force_n.to_vec()),
        (Some(_), None, _) => {
            b.error(at, "`stroke` without `force`", "a force for each stroke");
            return None;
        }
        (None, Some(_), _) => {
            b.error(at, "`force` without `stroke`", "a stroke for each force");
            return None;
        }
        (None, None, None) => {
            b.error(at, "neither `stroke` and `force` nor a preset", "stroke and force, or a preset");
            return None;
        }
    };
    let at_stroke = with_key(at, "stroke");
    if stroke.len() != force.len() || stroke.len() < 2 {
        let found = format!("{} strokes and {} forces", stroke.len(), force.len());
        b.error(&at_stroke, found, "a force for each stroke, at least two");
        return None;
    }
    let table: Vec<[f64; 2]> = stroke.iter().zip(force).map(|(way, force)| [way.si(), force.si()]).collect();
    if table[0][0] != 0.0 {
        b.error(&format!("{at_stroke}[0]"), format!("a first stroke of {} m", table[0][0]), "0");
        return None;
    }
    if let Some(i) = (1..table.len()).find(|&i| table[i][0] <= table[i - 1][0]) {
        let found = format!("stroke {} is {} m, after {} m", i + 1, table[i][0], table[i - 1][0]);
        b.error(&format!("{at_stroke}[{i}]"), found, "strokes that rise");
        return None;
    }
    Some(table)
}
