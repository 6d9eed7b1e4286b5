//! The body against itself: pairs of its spheres, such as a hand and a thigh.
//!
//! Ours; the report has none. For spheres about c₁ and c₂ with n̂ from the first to the second
//!
//! Δ = r₁ + r₂ − |c₂ − c₁|,   P = c₁ + (r₁ − Δ/2) n̂                                                                (6.4)
//!
//! and both receive, at the same P, opposite forces: so linear and angular momentum are conserved. The skins of both
//! deform in series (`series`). Segments that share a joint never touch here, because its stops hold them apart.

mod law;
mod series;
#[cfg(test)]
mod tests;

pub(crate) use law::{SelfPairs, lever};
pub(crate) use series::is_skin;

use crate::body::Body;

/// Parts of the body that can touch each other, and their materials.
#[derive(Clone, Debug, PartialEq)]
pub struct SelfContact {
    /// By sphere: index of the material of its skin.
    pub skins: Vec<usize>,
    /// Pairs of spheres (indices), the first before the second.
    pub pairs: Vec<[usize; 2]>,
}

/// Parts, without sides, and those that each can touch. Of parts with sides "other" is the one of the other side, and a name
/// alone stands for both.
#[rustfmt::skip]
const MEETS: [(&str, &[&str]); 6] = [
    ("hand", &["head", "chest", "pelvis", "thigh", "knee", "other hand"]),
    ("elbow", &["pelvis", "thigh", "other elbow"]),
    ("knee", &["head", "chest", "other knee"]),
    ("thigh", &["chest", "other thigh"]),
    ("shin", &["other shin", "other foot"]),
    ("foot", &["other foot"]),
];

/// The same of a body whose ribs yield to the side: what lies between a door and them.
#[rustfmt::skip]
const MEETS_SIDES: [(&str, &[&str]); 3] = [
    ("upper_arm", &["chest", "abdomen"]),
    ("elbow", &["chest", "abdomen"]),
    ("forearm", &["chest", "abdomen"]),
];

/// Spheres that overlap by more than this in a body that stands with its arms held out to the sides are neighbours, which do not
/// meet, m. No sphere of an arm has neighbours then but those of its own joints.
const NEIGHBOURS_M: f64 = 0.005;

impl SelfContact {
    /// Everything that parts of `body` can touch, its skin of one material (index).
    pub fn of(body: &Body, material: usize) -> Self {
        let of_sides = if body.sides.is_empty() { &[][..] } else { &MEETS_SIDES[..] };
        let names = MEETS.iter().chain(of_sides).flat_map(|(part, others)| {
            [["left_", "right_"], ["right_", "left_"]].into_iter().flat_map(move |[own, other]| {
                others.iter().flat_map(move |word| {
                    let names = match word.strip_prefix("other ") {
                        Some(part) => vec![format!("{other}{part}")],
                        None => vec![(*word).to_owned(), format!("left_{word}"), format!("right_{word}")],
                    };
                    names.into_iter().map(move |name| [format!("{own}{part}"), name])
                })
            })
        });
        let pairs = SelfContact::between(body, names);
        SelfContact { skins: vec![material; body.spheres.len()], pairs }
    }

    /// Pairs of spheres of these pairs of parts, each once and in ascending order: those that share neither a segment nor a
    /// joint and are no neighbours.
    pub fn between(body: &Body, parts: impl Iterator<Item = [String; 2]>) -> Vec<[usize; 2]> {
        let standing_m = body.standing_m();
        let is_of_arm = |segment| body.tree.landmarks().arms().any(|arm| body.tree.is_of(segment, &arm));
        let can_meet = |&[a, b]: &[usize; 2]| {
            let (one, other) = (&body.spheres[a], &body.spheres[b]);
            let is_joint = |[a, b]: [_; 2]| body.tree.carrier(a).is_some_and(|joint| body.tree[joint].proximal == b);
            let (s, t) = (one.segment, other.segment);
            let overlap_m = one.radius_m + other.radius_m - (standing_m[a] - standing_m[b]).norm();
            let is_near = overlap_m > NEIGHBOURS_M && ![s, t].into_iter().any(is_of_arm);
            s != t && !is_joint([s, t]) && !is_joint([t, s]) && !is_near
        };
        let spheres =
            |name: &str| -> Vec<usize> { (0..body.spheres.len()).filter(|i| body.spheres[*i].part == name).collect() };
        let all = parts.flat_map(|[one, other]| {
            let others = spheres(&other);
            spheres(&one).into_iter().flat_map(move |a| others.clone().into_iter().map(move |b| [a.min(b), a.max(b)]))
        });
        let mut pairs: Vec<[usize; 2]> = all.filter(can_meet).collect();
        pairs.sort_unstable();
        pairs.dedup();
        pairs
    }
}
