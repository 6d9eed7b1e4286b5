//! Damage of a vehicle at the end of a run.

use crate::V3;
use crate::body::Side;
use crate::car::Car;
use crate::crush::law::Law;
use crate::crush::outline::{Face, Node, Outline, SIDES};

/// Damage of a vehicle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Damage {
    /// Deepest dynamic crush, m.
    pub dynamic_m: f64,
    /// Deepest residual crush, m.
    pub residual_m: f64,
    /// Deepest crush of the roof by the ground, m.
    pub roof_m: f64,
    /// Dents of the outline.
    pub dents: Vec<Dent>,
    /// Damaged sides.
    pub profiles: Vec<Profile>,
    /// Energy-equivalent speed √(2E/M), m/s.
    pub ees_m_s: f64,
}

/// A dent of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dent {
    /// Of which side.
    pub side: Side,
    /// Initial position, and outward normal, body axes, m.
    pub place_m: V3,
    /// Normal.
    pub normal: V3,
    /// Largest dynamic crush, m.
    pub depth_m: f64,
}

/// Thickness between outline and compartment that does not crush, m: a door, an engine. Guesses.
const DOOR_M: f64 = 0.2;
const ENGINE_M: f64 = 0.4;

/// Crush of a side.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// Which.
    pub side: Side,
    /// Range along it, m: forward of the centre of gravity on the left and right, to the right in front and rear.
    pub span_m: [f64; 2],
    /// C₁ to C₆: residual crush at equal distances over the span, m.
    pub depths_m: [f64; 6],
    /// Mean residual crush over the span, m.
    pub mean_m: f64,
    /// ∫ (A C + ½B C² + A²/2B) over the span for this profile, J.
    pub energy_j: f64,
}

/// Crush along a side: place, residual crush, width.
type Depths = Vec<[f64; 3]>;

impl Damage {
    pub(crate) fn of(
        nodes: &[Node],
        most: &[f64],
        laws: &[Law],
        outline: &Outline,
        taken_j: f64,
        mass_kg: f64,
    ) -> Self {
        let hit = || nodes.iter().zip(most).filter(|(node, most)| **most > 0.0 && is_of_its_side(node, outline));
        let deepest = |of: &dyn Fn(&Law, f64) -> f64| hit().map(|(n, p)| of(&laws[n.law], *p)).fold(0.0, f64::max);
        let profiles = SIDES.iter().enumerate().filter_map(|(face, side)| {
            let depths = along(outline, face, nodes.iter().zip(most).map(|(n, p)| (n, laws[n.law].residual_m(*p))));
            profile(*side, &depths, &laws[face])
        });
        Damage {
            dynamic_m: deepest(&Law::crush_m),
            dents: hit().map(|(node, most)| Dent::of(node, laws[node.law].crush_m(*most))).collect(),
            residual_m: deepest(&Law::residual_m),
            roof_m: 0.0,
            profiles: profiles.collect(),
            ees_m_s: (2.0 * taken_j.max(0.0) / mass_kg).sqrt(),
        }
    }
}

impl Damage {
    /// Largest dynamic crush of the front, m.
    pub fn front_m(&self) -> f64 {
        self.dents.iter().filter(|dent| dent.side == Side::Front).map(|dent| dent.depth_m).fold(0.0, f64::max)
    }

    /// Intrusion into a sphere at a position in the compartment, body axes, m, including the structure behind the
    /// sheet; negative if clear. None outside the range of all dents.
    pub fn reaches_m(&self, place_m: &V3, radius_m: f64, car: &Car) -> Option<f64> {
        let up_m = car.height_m - place_m.z;
        let [low_m, high_m] = car.body.band_m;
        if up_m + radius_m < low_m || up_m - radius_m > high_m {
            return None;
        }
        let reach = |dent: &Dent| {
            let way = place_m - dent.place_m;
            let aside_m = (way.x * dent.normal.y - way.y * dent.normal.x).abs();
            let is_end = matches!(dent.side, Side::Front | Side::Rear);
            let behind_m = if is_end { ENGINE_M } else { DOOR_M };
            let is_beside = aside_m <= 0.5 * car.body.crush.spacing_m + radius_m;
            is_beside.then_some(dent.depth_m + behind_m + way.dot(&dent.normal) + radius_m)
        };
        self.dents.iter().filter_map(reach).max_by(f64::total_cmp)
    }
}

impl Dent {
    fn of(node: &Node, depth_m: f64) -> Self {
        Dent { side: SIDES[node.face], place_m: node.place_m, normal: node.normal, depth_m }
    }
}

/// Whether a node's dent is damage of its face: a cut corner also pushes for the side, but what a frontal wall dents
/// there is damage of the end.
fn is_of_its_side(node: &Node, outline: &Outline) -> bool {
    let Face { normal: [x, y], .. } = outline.faces[node.face];
    let over_m = |place: &[f64]| place[0] * x + place[1] * y;
    let farthest_m = outline.edges.iter().map(|edge| over_m(&edge.corner_m)).fold(f64::NEG_INFINITY, f64::max);
    x != 0.0 || over_m(node.place_m.as_slice()) > farthest_m - 1e-6
}

/// Mean residual crush over the rows, by place along a face, from its less end to its greater.
fn along<'a>(outline: &Outline, face: usize, nodes: impl Iterator<Item = (&'a Node, f64)>) -> Depths {
    let is_end = outline.faces[face].normal[0] != 0.0;
    let place = |node: &Node| if is_end { node.place_m.y } else { node.place_m.x };
    let own = nodes.filter(|(node, _)| node.face == face && is_of_its_side(node, outline));
    let mut depths: Depths = own.map(|(node, depth)| [place(node), depth * node.width_m, node.width_m]).collect();
    depths.sort_by(|a, b| a[0].total_cmp(&b[0]));
    depths.dedup_by(|next, kept| {
        let is_same = (next[0] - kept[0]).abs() < 1e-9;
        if is_same {
            (kept[1], kept[2]) = (kept[1] + next[1], kept[2] + next[2]);
        }
        is_same
    });
    depths.iter().map(|[at, sum, width]| [*at, sum / width, *width]).collect()
}

fn profile(side: Side, depths: &Depths, law: &Law) -> Option<Profile> {
    let is_hit = |depth: &&[f64; 3]| depth[1] > 0.0;
    let (first, last) = (depths.iter().position(|d| d[1] > 0.0)?, depths.iter().rposition(|d| d[1] > 0.0)?);
    let span_m = [depths[first][0] - 0.5 * depths[first][2], depths[last][0] + 0.5 * depths[last][2]];
    let at = |place_m: f64| {
        let next = depths.partition_point(|d| d[0] <= place_m).clamp(1, depths.len() - 1);
        let [from, to] = [depths[next - 1], depths[next]];
        let share = ((place_m - from[0]) / (to[0] - from[0])).clamp(0.0, 1.0);
        from[1] + (to[1] - from[1]) * share
    };
    let within = &depths[first..=last];
    let width: f64 = within.iter().map(|d| d[2]).sum();
    Some(Profile {
        side,
        span_m,
        depths_m: [0, 1, 2, 3, 4, 5].map(|i| at(span_m[0] + 0.2 * f64::from(i) * (span_m[1] - span_m[0]))),
        mean_m: within.iter().map(|d| d[1] * d[2]).sum::<f64>() / width,
        energy_j: within.iter().filter(is_hit).map(|d| d[2] * law.damage_j_per_m(d[1])).sum(),
    })
}
