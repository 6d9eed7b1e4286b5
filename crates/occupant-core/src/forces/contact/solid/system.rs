//! Spheres against solids: pairs, memory, and force.
//!
//! The solids of a group act on a sphere as one body: φ = min over them of φ_k (6.2), each with its remembered face,
//! and one Δ_m. With (F, U) of the spring at Δ = r − φ the sphere receives F N̂ and, at A = c − max(r − Δ/2, 0) N̂
//! (6.3), the friction; U is a function of the centre alone.

use std::collections::HashMap;
use std::sync::Arc;

use super::{Faced, Solid, build};
use crate::body::Body;
use crate::forces::contact::assembly::{frames, is_own, meets, uses};
use crate::forces::contact::encounter::Approach;
use crate::forces::contact::material::{Material, Memory};
use crate::forces::contact::shared::{Numbers, Shared};
use crate::forces::contact::zip::{OTHER_OUTLINES, OTHER_PAIRS};
use crate::forces::contact::{ContactData, Group, MaterialLaw, OPEN, PairHistory, TOUCHING, Touch};
use crate::forces::element::Unlike;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// All solids, and which spheres meet them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solids<S> {
    /// Pairs by sphere and frame, numbered on from those of faces.
    pub(crate) groups: Vec<Group>,
    /// The pairs; the same list for all runs side by side.
    pub(crate) pairs: Arc<Vec<Union>>,
    /// Their laws.
    pub(crate) laws: Shared<UnionLaw<S>>,
    /// By solid.
    pub(crate) shapes: Vec<Faced<S>>,
}

/// A sphere against the solids of a group.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Union {
    /// The solids.
    pub members: Vec<Member>,
}

/// Forces of the solids of a group on a sphere.
#[derive(Clone, Debug)]
pub(crate) struct UnionLaw<S> {
    pub law: MaterialLaw<S>,
    /// 1 where Δ_m is kept after opening, else 0.
    pub retain: S,
}

/// A solid of a union.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Member {
    /// Its index among solids.
    pub solid: usize,
    /// Its index behind all surfaces.
    pub surface: usize,
    /// Where the face stands that is remembered of it.
    pub past: usize,
}

/// The nearest of a union.
#[derive(Clone, Copy)]
pub(crate) struct Nearest<S> {
    /// Index among the members, as a number.
    pub part: S,
    /// Δ, m.
    pub depth: S,
    pub normal: V3<S>,
}

impl Solids<f64> {
    /// Those that the spheres of `body` can touch; faces have `surfaces` names and `pairs` pairs.
    pub(crate) fn new(body: &Body, data: &ContactData<'_>, carriers: &[usize], pairs: usize) -> Solids<f64> {
        let &ContactData { solids, materials, behind, .. } = data;
        let surfaces = data.surfaces.len();
        let frames = frames(solids.iter().map(|s| s.frame), carriers);
        let mut all = Solids { shapes: solids.iter().flat_map(|s| build(&s.shape)).collect(), ..Solids::default() };
        let (mut unions, mut pairs_of): (HashMap<&str, usize>, Vec<Union>) = Default::default();
        let mut numbers = Numbers::new();
        for (sphere, data) in body.spheres.iter().enumerate() {
            for &(frame, index) in &frames {
                if is_own(body, data, frame) {
                    continue;
                }
                for by in uses(data) {
                    let first = pairs_of.len();
                    unions.clear();
                    let is_met = |s: &Solid| s.frame == frame && s.spheres.as_ref().is_none_or(|s| s.contains(&sphere));
                    let meets = |i: usize, s: &Solid| is_met(s) && meets(by, data, behind, surfaces + i);
                    for (i, solid) in solids.iter().enumerate().filter(|(i, solid)| meets(*i, solid)) {
                        let member = Member { solid: i, surface: surfaces + i, past: 0 };
                        let own = pairs_of.len();
                        let place = solid.group.as_deref().map_or(own, |group| *unions.entry(group).or_insert(own));
                        match pairs_of.get_mut(place) {
                            Some(union) => union.members.push(member),
                            None => {
                                let is_thin = solid.shape.bar_radius_m().is_some_and(|bar_m| bar_m < data.radius_m);
                                let share = if is_thin { data.bar_share } else { data.share };
                                let material = &materials[solid.material];
                                // what breaks has a law of its own, which knows the pane
                                let pane = material.breaks.as_ref().map(|_| i);
                                let number = numbers.of((share.to_bits(), solid.material, pane));
                                all.laws.push(number, || UnionLaw::new(material, share));
                                pairs_of.push(Union { members: vec![member] });
                            }
                        }
                    }
                    let pairs = pairs + first..pairs + pairs_of.len();
                    if !pairs.is_empty() {
                        all.groups.push(Group { sphere, frame: index, by: *by, pairs });
                    }
                }
            }
        }
        let behind = pairs + pairs_of.len();
        for (i, member) in pairs_of.iter_mut().flat_map(|union| &mut union.members).enumerate() {
            member.past = behind + i;
        }
        all.pairs = pairs_of.into();
        all
    }
}

impl UnionLaw<f64> {
    fn new(material: &Material, share: f64) -> Self {
        let retain = if material.memory == Memory::Retain { 1.0 } else { 0.0 };
        UnionLaw { law: MaterialLaw::new(material, share), retain }
    }
}

impl<S> Solids<S> {
    /// Every sphere that meets a solid, by the group of its pair.
    pub(crate) fn met(&self) -> impl Iterator<Item = (&Group, &Member)> {
        let first = self.groups.first().map_or(0, |group| group.pairs.start);
        let unions =
            self.groups.iter().flat_map(move |group| group.pairs.clone().map(move |i| (group, &self.pairs[i - first])));
        unions.flat_map(|(group, union)| union.members.iter().map(move |member| (group, member)))
    }

    /// How many things are remembered: Δ_m of each pair, the face of each of its members.
    pub(crate) fn count(&self) -> usize {
        self.pairs.iter().map(|union| 1 + union.members.len()).sum()
    }
}

impl<S: Scalar> Solids<S> {
    /// How far a sphere is at least from all solids of pair `j`, m, if it is farther than `enough` in all lanes; for a
    /// fraction of what [`Solids::nearest`] costs.
    #[inline(always)]
    pub(crate) fn farther(&self, j: usize, centre: V3<S>, radius: S, enough: S) -> Option<S> {
        let mut least = S::of(f64::INFINITY);
        for member in &self.pairs[j].members {
            least = least.min(self.shapes[member.solid].at_least(centre));
            if S::any(!enough.lt(least - radius)) {
                return None;
            }
        }
        Some(least - radius)
    }

    /// Whether the solids of pair `j` remember a touch, in any lane.
    #[inline(always)]
    pub(crate) fn remember(&self, j: usize, past: &[PairHistory<S>]) -> S::Mask {
        let mut any = S::truth(false);
        for member in &self.pairs[j].members {
            any = any | past[member.past].phase.gt(S::of(OPEN));
        }
        any
    }

    /// The nearest solid of pair `j` to a sphere. At an accepted step the remembered faces first take over its
    /// place.
    #[inline(always)]
    pub(crate) fn nearest(
        &self,
        j: usize,
        centre: V3<S>,
        radius: S,
        past: &mut [PairHistory<S>],
        accepted: bool,
    ) -> Nearest<S> {
        let mut nearest = Nearest { part: S::zero(), depth: S::of(f64::NEG_INFINITY), normal: V3::zero() };
        for (i, member) in self.pairs[j].members.iter().enumerate() {
            let (shape, phase) = (&self.shapes[member.solid], &mut past[member.past].phase);
            let distance = if accepted { shape.commit(centre, radius, phase) } else { shape.distance(centre, *phase) };
            let depth = radius - distance.phi;
            let is_nearer = nearest.depth.lt(depth);
            nearest = Nearest {
                part: S::select(is_nearer, S::of(i as f64), nearest.part),
                depth: S::select(is_nearer, depth, nearest.depth),
                normal: V3::select(is_nearer, distance.normal, nearest.normal),
            };
        }
        nearest
    }
}

impl<S: Scalar> UnionLaw<S> {
    /// Takes the depth at an accepted step over into what the pair remembers.
    #[inline(always)]
    pub(crate) fn commit(&self, depth: S, pair: &mut PairHistory<S>) {
        let touches = depth.gt(S::zero());
        pair.phase = S::select(touches, S::of(TOUCHING), S::of(OPEN));
        pair.greatest = S::select(touches, pair.greatest.max(depth), pair.greatest * self.retain);
    }

    /// Whether a commit of a sphere that is apart changes nothing of what the pair remembers.
    #[inline(always)]
    pub(crate) fn stays(&self, pair: &PairHistory<S>) -> S::Mask {
        !(pair.phase.gt(S::of(OPEN)) | (pair.greatest * self.retain).lt(pair.greatest))
    }

    /// Forces on a sphere, in the lanes where the pair is `live`.
    #[inline(always)]
    pub(crate) fn press(
        &self,
        group: &Group,
        pair: usize,
        nearest: Nearest<S>,
        live: S::Mask,
        approach: &Approach<S>,
        past: &[PairHistory<S>],
    ) -> Touch<S> {
        let Nearest { part, depth, normal } = nearest;
        let weight = S::select(live, S::one(), S::zero());
        let meeting = approach.meeting(normal, lever(depth, approach.radius), depth, past[pair].greatest, weight);
        let law = self.law.at(&meeting, past);
        Touch {
            sphere: group.sphere,
            frame: group.frame,
            pair,
            part,
            weight,
            normal,
            depth,
            closing: meeting.closing,
            velocity: approach.velocity,
            normal_force: law.force,
            edge: V3::zero(),
            friction: law.rubbing(&meeting),
            stored: weight * law.energy,
            slip: meeting.slip,
            force: V3::zero(),
        }
    }
}

/// How far A is from the centre against N̂: half-way into the overlap, never beyond the centre (6.3).
#[inline(always)]
pub(crate) fn lever<S: Scalar>(depth: S, radius: S) -> S {
    (radius - depth * S::of(0.5)).max(S::zero())
}

impl<S: Copy> Solids<S> {
    pub(crate) fn zip<A: Copy, T>(&self, other: &Solids<A>, f: &impl Fn(S, A) -> T) -> Result<Solids<T>, Unlike> {
        let is_like = self.groups == other.groups && self.pairs == other.pairs;
        if !is_like || self.shapes.len() != other.shapes.len() {
            return Err(OTHER_PAIRS);
        }
        let law = |a: &UnionLaw<S>, b: &UnionLaw<A>| {
            Ok(UnionLaw { law: a.law.zip(&b.law, f)?, retain: f(a.retain, b.retain) })
        };
        let shapes = self.shapes.iter().zip(&other.shapes).map(|(a, b)| a.zip(b, f).ok_or(OTHER_OUTLINES));
        Ok(Solids {
            groups: self.groups.clone(),
            pairs: self.pairs.clone(),
            laws: self.laws.zip(&other.laws, OTHER_PAIRS, law)?,
            shapes: shapes.collect::<Result<_, _>>()?,
        })
    }
}
