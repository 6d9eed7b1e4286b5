//! A chain at one instant: its positions, its tensions, and its memory of an accepted step.

use super::MOST_NODES;
use super::data::Chain;
use super::past::{ChainPast, NodePast};
use super::path::{self, Bend, Place, turn};
use super::site::NodeLaw;
use super::tension::{Course, Straps, Taut, Web};
use crate::body::Body;
use crate::forces::element::Instant;
use crate::motion::frame::Moving;
use crate::motion::mobility::Mobility;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Constants of a chain.
#[derive(Clone, Debug)]
pub struct ChainLaw<S> {
    pub(super) nodes: Vec<NodeLaw<S>>,
    pub(super) straps: Straps<S>,
    /// Index of its belt.
    pub(super) belt: usize,
    /// Index of the frame of its nodes off the body.
    pub(super) frame: usize,
}

/// Geometry of a chain.
#[derive(Clone, Debug)]
pub(super) struct Lies<S> {
    pub(super) ways: [S; MOST_NODES],
    pub(super) places: [Place<S>; MOST_NODES],
    pub(super) bends: [Bend<S>; MOST_NODES],
    pub(super) course: Course<S>,
}

/// Room for a chain at one instant, reused by the next: it is large to clear and to copy.
#[derive(Clone, Debug)]
pub struct Room<S> {
    lies: Lies<S>,
    web: Web<S>,
}

impl<S: Scalar> Room<S> {
    pub(super) fn new() -> Self {
        Room { lies: Lies::nowhere(), web: Web::new() }
    }
}

/// A chain at one instant.
pub(super) struct Now<'a, S: Scalar> {
    pub(super) lies: &'a Lies<S>,
    pub(super) taut: Taut<'a, S>,
}

/// Changes at an accepted step.
pub(super) struct Committed<S: Scalar> {
    /// Where the geometry changes.
    pub(super) moved: S::Mask,
    /// Where a sphere came into or out of contact next to another: the length jumps, as its plane rotates.
    pub(super) refits: S::Mask,
    /// Where energy was lost by that, or webbing left a node or was released.
    pub(super) lost: S::Mask,
    /// Lengths before, m, and recoverable energy, J.
    lengths: [S; MOST_NODES],
    stored: S,
}

impl<S: Scalar> Lies<S> {
    /// No changes.
    pub(super) fn nowhere() -> Self {
        let (places, bends) = ([Place::nowhere(); MOST_NODES], [Bend::none(); MOST_NODES]);
        Lies { ways: [S::zero(); MOST_NODES], places, bends, course: Course::none() }
    }
}

impl ChainLaw<f64> {
    pub(super) fn new(chain: &Chain, belt: usize, body: &Body) -> Self {
        let last = chain.nodes.len().saturating_sub(1);
        let new = |(i, node)| NodeLaw::new(node, body, i == 0 || i == last);
        let nodes: Vec<NodeLaw<f64>> = chain.nodes.iter().take(MOST_NODES).enumerate().map(new).collect();
        let starts = (0..last.min(MOST_NODES)).filter(|i| *i == 0 || nodes[*i].rubs).collect();
        ChainLaw { straps: Straps::new(chain, starts), nodes, belt, frame: chain.frame.index(&[]) }
    }

    /// Length of the webbing in the present position of the body, m, and its stored geometry.
    pub(super) fn lie(&self, at: &Instant<'_, f64>) -> (f64, ChainPast<f64>) {
        let mut past = ChainPast::none();
        past.device.time = at.frames.time;
        for (node, past) in self.nodes.iter().zip(&mut past.nodes) {
            (past.on, past.way) = (1.0, node.start());
        }
        let mut lies = Lies::nowhere();
        let bends = loop {
            self.lay(at, &past, &mut lies);
            let bends = &lies.bends;
            let worst = (0..self.nodes.len())
                .filter(|&k| self.nodes[k].is_sphere() && past.nodes[k].on > 0.0 && bends[k].arc <= 0.0)
                .min_by(|&a, &b| bends[a].arc.total_cmp(&bends[b].arc));
            let own = worst.map_or(0..self.nodes.len(), |k| k..k + 1);
            for k in own {
                self.nodes[k].remember(at, &lies.places[k], &bends[k], 0.5 * bends[k].arc, &mut past.nodes[k]);
            }
            let Some(k) = worst else { break lies.bends };
            past.nodes[k].on = 0.0;
        };
        (bends.iter().fold(0.0, |sum, bend| sum + bend.span + bend.arc), past)
    }

    /// Stored state of a belt in this geometry, with the total unstretched length `whole`, m.
    pub(super) fn start(&self, at: &Instant<'_, f64>, whole: f64, past: &ChainPast<f64>) -> ChainPast<f64> {
        let (mut lies, mut past) = (Lies::nowhere(), *past);
        self.lay(at, &past, &mut lies);
        self.straps.start(at.frames.time, self.straps.start_strain(whole), &lies.course.lengths, &mut past);
        past
    }
}

impl ChainLaw<f64> {
    /// For each strap, acceleration of its length per tension, 1/kg, and its unstretched length, m.
    pub(super) fn gives(&self, at: &Instant<'_, f64>, past: &ChainPast<f64>, mobility: &Mobility<'_>) -> Vec<[f64; 2]> {
        let mut lies = Lies::nowhere();
        self.lay(at, past, &mut lies);
        let mut list: Vec<_> = self.straps.starts.iter().map(|k| [0.0, past.nodes[*k].unstretched]).collect();
        let mut strap = 0;
        for (k, node) in self.nodes.iter().enumerate() {
            let bend = &lies.bends[k];
            let mut give = |strap: usize, pull: V3<f64>, arm: V3<f64>| {
                let Some(segment) = node.segment(at.spheres) else { return };
                let point = lies.places[k].centre + arm * lies.places[k].radius;
                let pull = pull.to_vector();
                list[strap][0] += pull.dot(&(mobility.of_point(segment, point) * pull));
            };
            if node.rubs {
                give(strap, bend.back, bend.touch);
                strap += 1;
                give(strap, bend.ahead, bend.normal.cross(bend.ahead));
            } else {
                give(strap, bend.back + bend.ahead, V3::zero());
            }
        }
        list
    }
}

impl ChainLaw<f64> {
    /// Reports a curve that was exceeded.
    pub(super) fn overrun(&self, belt: &str, past: &ChainPast<f64>) -> Option<String> {
        let strain = past.nodes.iter().fold(0.0, |most: f64, node| most.max(node.greatest));
        self.straps.overrun(belt, strain, past.device.greatest)
    }
}

impl ChainLaw<f64> {
    /// Whether it has an active device, moving nodes, or nodes that the webbing may leave or reach.
    pub(super) fn can_switch(&self) -> bool {
        let moves = |node: &NodeLaw<f64>| node.may_leave || node.is_pulled();
        self.straps.can_switch() || self.nodes.iter().any(moves)
    }
}

impl<S: Scalar<Mask = bool>> ChainLaw<S> {
    /// Fraction between two commits at which the first switch was due; none if the stored state does not tell.
    pub(super) fn due(&self, before: &ChainPast<S>, now: &ChainPast<S>) -> Option<S> {
        let mut first = self.straps.due(before, now);
        for (k, node) in self.nodes.iter().enumerate() {
            let (a, b) = (&before.nodes[k], &now.nodes[k]);
            let states = |past: &NodePast<S>| [past.is_on(), past.is_handed_over(), past.has_stalled()];
            if states(a) != states(b) {
                let due = node.due(a, b)?;
                first = Some(first.map_or(due, |first| first.min(due)));
            }
        }
        first
    }
}

impl<S: Copy> ChainLaw<S> {
    pub(super) fn is_like<A: Copy>(&self, other: &ChainLaw<A>) -> bool {
        let nodes = self.nodes.iter().map(NodeLaw::shape).eq(other.nodes.iter().map(NodeLaw::shape));
        nodes && self.straps.is_like(&other.straps)
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &ChainLaw<A>, f: &impl Fn(S, A) -> T) -> ChainLaw<T> {
        ChainLaw {
            nodes: self.nodes.iter().zip(&other.nodes).map(|(a, b)| a.zip(b, f)).collect(),
            straps: self.straps.zip(&other.straps, f),
            belt: self.belt,
            frame: self.frame,
        }
    }
}

impl<S: Scalar> ChainLaw<S> {
    /// What carries a node that is off the body.
    #[inline(always)]
    fn carrier<'a>(&self, at: &Instant<'a, S>, node: &NodeLaw<S>) -> &'a Moving<S> {
        &at.frames[node.frame.unwrap_or(self.frame)]
    }

    /// Places of the nodes, and the webbing along them.
    #[inline(always)]
    pub(super) fn lay(&self, at: &Instant<'_, S>, past: &ChainPast<S>, lies: &mut Lies<S>) {
        let (o, count) = (S::zero(), self.nodes.len());
        let Lies { ways, places, bends, course } = lies;
        for (k, node) in self.nodes.iter().enumerate() {
            ways[k] = node.way(at.frames.time, &past.nodes[k], &past.device);
            places[k] = node.place(at, self.carrier(at, node), ways[k], &past.nodes[k]);
        }
        path::bends(&places[..count], &past.nodes, bends);
        course.clear();
        let mut strap = 0;
        for (k, node) in self.nodes.iter().enumerate().skip(1) {
            let (bend, past) = (&bends[k], &past.nodes[k]);
            course.lengths[strap] += bend.span + bend.arc;
            if node.rubs {
                strap += 1;
                let mut turns = turn(bend.back, bend.ahead);
                if node.is_sphere() {
                    let mark = node.mark(at, &places[k], bend, past);
                    (ways[k], turns) = (mark.way, bend.wrap.max(o));
                    let behind = bend.arc - S::select(past.is_on(), mark.way, bend.beside);
                    course.lengths[strap - 1] -= behind;
                    course.lengths[strap] += behind;
                    let part = mark.beyond / course.lengths[strap - 1].max(S::of(1e-12));
                    course.carried[strap] = S::select(past.is_on(), part, o);
                }
                // webbing that has left the node turns by nothing
                course.turns[strap] = S::select(past.is_on(), turns, o);
            }
        }
    }

    /// The chain at one instant, from its stored state; its geometry in `room` is recomputed unless it `is_known`.
    #[inline(always)]
    pub(super) fn now<'a>(
        &'a self,
        at: &Instant<'_, S>,
        past: &ChainPast<S>,
        room: &'a mut Room<S>,
        is_known: bool,
    ) -> Now<'a, S> {
        if S::IS_WIDE { self.within(at, past, room, is_known) } else { self.apart(at, past, room, is_known) }
    }

    #[inline(never)]
    fn apart<'a>(
        &'a self,
        at: &Instant<'_, S>,
        past: &ChainPast<S>,
        room: &'a mut Room<S>,
        is_known: bool,
    ) -> Now<'a, S> {
        self.within(at, past, room, is_known)
    }

    #[inline(always)]
    fn within<'a>(
        &'a self,
        at: &Instant<'_, S>,
        past: &ChainPast<S>,
        room: &'a mut Room<S>,
        is_known: bool,
    ) -> Now<'a, S> {
        let Room { lies, web } = room;
        if !is_known {
            self.lay(at, past, lies);
        }
        Now { taut: self.straps.taut(at.frames.time, &lies.course, past, web), lies }
    }

    /// Forces of the webbing on the nodes, space axes, N.
    #[inline(always)]
    pub(super) fn forces(&self, now: &Now<'_, S>) -> [V3<S>; MOST_NODES] {
        let (mut list, mut strap) = ([V3::zero(); MOST_NODES], 0);
        for (k, node) in self.nodes.iter().enumerate() {
            let (bend, straps) = (&now.lies.bends[k], now.taut.straps);
            let before = straps[strap].tension;
            strap += usize::from(node.rubs);
            list[k] = bend.back * before + bend.ahead * straps[strap].tension;
        }
        list
    }

    /// Moment of the webbing on a sphere with friction at the start of this strap, space axes, N·m.
    #[inline(always)]
    pub(super) fn couple(&self, now: &Now<'_, S>, k: usize, strap: usize) -> V3<S> {
        let (straps, lies) = (now.taut.straps, now.lies);
        lies.bends[k].normal * (lies.places[k].radius * (straps[strap - 1].tension - straps[strap].tension))
    }

    /// Stores an accepted step.
    #[inline(always)]
    pub(super) fn commit(&self, at: &Instant<'_, S>, now: &Now<'_, S>, past: &mut ChainPast<S>) -> Committed<S> {
        let mut next = *past;
        self.straps.commit(at.frames.time, &now.taut, past, &mut next);
        self.commit_nodes(at, now, &mut next);
        next.device.time = at.frames.time;
        let fresh = at.frames.time.gt(past.device.time);
        let found = self.changed(now, past, &next, fresh);
        past.each(&mut next, &mut |a, b| *a = S::select(fresh, *b, *a));
        found
    }

    /// Changes in `fresh` lanes.
    #[inline(always)]
    fn changed(&self, now: &Now<'_, S>, past: &ChainPast<S>, next: &ChainPast<S>, fresh: S::Mask) -> Committed<S> {
        let (course, mut strap) = (&now.lies.course, 0);
        let (mut moved, mut refits) = (S::truth(false), S::truth(false));
        let mut lost = next.device.free.gt(past.device.free);
        for (k, node) in self.nodes.iter().enumerate() {
            strap += usize::from(node.rubs);
            if !node.may_leave {
                continue;
            }
            let (was, is) = (past.nodes[k].on, next.nodes[k].on);
            let changes = is.lt(was) | was.lt(is);
            if !node.is_sphere() {
                lost = lost | changes;
                refits = refits | (changes & next.nodes[k].is_handed_over());
            } else if node.rubs {
                moved = moved | course.carried[strap].abs().gt(S::zero());
            } else if self.spheres(strap) > 1 {
                refits = refits | changes;
            }
            moved = moved | changes;
        }
        let (moved, refits, lost) = (moved & fresh, refits & fresh, (lost | refits) & fresh);
        let stored = if S::any(lost) { self.straps.stored_in_all(&now.taut) } else { S::zero() };
        Committed { moved, refits, lost, lengths: course.lengths, stored }
    }

    /// Number of frictionless spheres in a strap.
    fn spheres(&self, strap: usize) -> usize {
        let starts = &self.straps.starts;
        let end = starts.get(strap + 1).copied().unwrap_or(self.nodes.len());
        self.nodes[starts[strap]..end].iter().filter(|node| node.is_sphere() && !node.rubs).count()
    }

    /// Whether the length of a strap can jump: neighbouring spheres come and go, or a track at either end hands over.
    fn jumps(&self, strap: usize) -> bool {
        let starts = &self.straps.starts;
        let ends = [Some(&starts[strap]), starts.get(strap + 1)];
        self.spheres(strap) > 1 || ends.into_iter().flatten().any(|node| self.nodes[*node].next().is_some())
    }

    /// Where the length has jumped, adjusts N so that no tension jumps.
    #[inline(always)]
    pub(super) fn refit(&self, found: &mut Committed<S>, lies: &Lies<S>, past: &mut ChainPast<S>) {
        for (strap, &node) in self.straps.starts.iter().enumerate().filter(|(strap, _)| self.jumps(*strap)) {
            let own = &mut past.nodes[node].unstretched;
            let grown = *own * (lies.course.lengths[strap] / found.lengths[strap]);
            *own = S::select(found.refits, grown, *own);
        }
        found.refits = S::truth(false);
    }

    /// Energy lost at the first node where webbing has left a node, jumped in length or was released, except what is
    /// booked as passing through nodes with the next step.
    #[inline(always)]
    pub(super) fn settle(&self, found: &Committed<S>, now: &Now<'_, S>, past: &mut ChainPast<S>) {
        let gone = found.stored - self.straps.stored_in_all(&now.taut) - self.straps.passing(&now.taut, past);
        let lost = &mut past.nodes[0].lost;
        *lost = S::select(found.lost, *lost + gone, *lost);
    }

    /// Updates the nodes at an accepted step. At most one sphere comes into or out of contact: the most overdue.
    #[inline(always)]
    fn commit_nodes(&self, at: &Instant<'_, S>, now: &Now<'_, S>, next: &mut ChainPast<S>) {
        let (o, mut most) = (S::zero(), S::zero());
        let beyond = |k: usize, next: &ChainPast<S>| {
            let bend = &now.lies.bends[k];
            S::select(next.nodes[k].is_on(), -bend.wrap, bend.wrap)
        };
        for k in (0..self.nodes.len()).filter(|k| self.nodes[*k].is_sphere()) {
            most = most.max(beyond(k, next));
        }
        for (k, force) in self.forces(now).into_iter().enumerate().take(self.nodes.len()) {
            if self.nodes[k].is_sphere() {
                let changes = most.gt(o) & !beyond(k, next).lt(most);
                let (lies, own) = (now.lies, &mut next.nodes[k]);
                self.nodes[k].remember(at, &lies.places[k], &lies.bends[k], lies.ways[k], own);
                own.on = S::select(changes, S::one() - own.on, own.on);
                most = S::select(changes, o, most);
            } else {
                let (frame, own) = (self.carrier(at, &self.nodes[k]), (&mut next.nodes[k], next.device.time));
                let work = self.nodes[k].commit(at, frame, now.lies.ways[k], force, own);
                next.device.driven += work;
            }
        }
    }
}
