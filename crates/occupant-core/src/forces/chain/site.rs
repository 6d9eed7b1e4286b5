//! Nodes of a chain: positions, sliding, pulling, and release of the webbing.

use super::data::{NEVER, Next, Node, Site, Stroke, Track, Wing};
use super::past::{DevicePast, NodePast, STALLED};
use super::path::Place;
use super::wing::LEAST_N;
use crate::body::Body;
use crate::forces::element::{Instant, passes};
use crate::forces::function::steps::Steps;
use crate::forces::sphere::{Riding, Site as Sphere, Use};
use crate::motion::frame::Moving;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use nalgebra::{Point3, Vector3};

/// Constants of a node.
#[derive(Clone, Debug)]
pub(super) struct NodeLaw<S> {
    pub(super) site: SiteLaw<S>,
    /// μ.
    pub(super) friction: S,
    /// Whether a strap ends here.
    pub(super) rubs: bool,
    strength: S,
    pub(super) may_leave: bool,
    /// Ride of a segment point on deformable parts.
    ride: Option<Riding<S>>,
    /// What carries a point of the vehicle instead of the belt's frame, among the frames.
    pub(super) frame: Option<usize>,
}

#[derive(Clone, Debug)]
pub(super) enum SiteLaw<S> {
    /// Point in vehicle axes.
    Vehicle(V3<S>, Option<StrokeLaw<S>>),
    /// Point from the segment's joint, with the direction away from the body, segment axes.
    Segment(usize, V3<S>, Option<V3<S>>),
    Track(usize, TrackLaw<S>),
    Sphere(usize),
}

#[derive(Clone, Debug)]
pub(super) struct StrokeLaw<S> {
    due: S,
    direction: V3<S>,
    way: Steps<S>,
    stall: S,
}

/// An arc: centre, directions to its inner end and along it there, radius, length, segment axes from the joint.
#[derive(Clone, Debug)]
pub(super) struct TrackLaw<S> {
    centre: V3<S>,
    out: V3<S>,
    along: V3<S>,
    radius: S,
    pub(super) length: S,
    /// Initial position of the webbing.
    pub(super) start: S,
    friction: S,
    drag: S,
    pub(super) wing: Option<Wing>,
    /// Support of webbing that has slid off it.
    pub(super) then: Option<NextLaw<S>>,
}

/// A point of a segment, from its joint, that supports webbing.
#[derive(Clone, Debug)]
pub(super) struct NextLaw<S> {
    pub(super) segment: usize,
    point: V3<S>,
    pub(super) ride: Option<Riding<S>>,
}

impl<S: Copy> NextLaw<S> {
    fn zip<A: Copy, T>(&self, other: &NextLaw<A>, f: &impl Fn(S, A) -> T) -> NextLaw<T> {
        NextLaw {
            segment: self.segment,
            point: self.point.zip(&other.point, f),
            ride: self.ride.zip(other.ride).map(|(a, b)| a.zip(&b, f)),
        }
    }
}

impl TrackLaw<f64> {
    /// The circle through three points, from the joint; none if they are collinear. `joint` gives that of a segment.
    pub(super) fn new(track: &Track, segment: usize, joint: &dyn Fn(usize) -> Vector3<f64>) -> Option<Self> {
        let from = joint;
        let joint = from(segment);
        let next = |next: &Next| NextLaw {
            segment: next.segment,
            point: V3::of(&(next.point_m.coords - from(next.segment))),
            ride: (!next.ride.is_empty()).then(|| Riding::new(&next.ride)),
        };
        let [a, b, c] = track.points_m.map(|p| p.coords - joint);
        let (u, v) = (b - a, c - a);
        let normal = u.cross(&v);
        let square = normal.norm_squared();
        if square <= 1e-12 * u.norm_squared() * v.norm_squared() {
            return None;
        }
        let to_centre = (normal.cross(&u) * v.norm_squared() + v.cross(&normal) * u.norm_squared()) / (2.0 * square);
        let (centre, radius) = (a + to_centre, to_centre.norm());
        let out = -to_centre / radius;
        let along = normal.normalize().cross(&out);
        let way = |p: Vector3<f64>| {
            let arm = p - centre;
            let angle = occupant_units::trig::atan2(arm.dot(&along), arm.dot(&out));
            radius * if angle < 0.0 { angle + std::f64::consts::TAU } else { angle }
        };
        Some(TrackLaw {
            centre: V3::of(&centre),
            out: V3::of(&out),
            along: V3::of(&along),
            radius,
            length: way(c),
            start: way(b),
            friction: track.friction,
            drag: track.drag_n_s_m,
            wing: track.wing,
            then: track.then.as_ref().map(next),
        })
    }
}

impl<S: Copy> TrackLaw<S> {
    fn zip<A: Copy, T>(&self, other: &TrackLaw<A>, f: &impl Fn(S, A) -> T) -> TrackLaw<T> {
        TrackLaw {
            centre: self.centre.zip(&other.centre, f),
            out: self.out.zip(&other.out, f),
            along: self.along.zip(&other.along, f),
            radius: f(self.radius, other.radius),
            length: f(self.length, other.length),
            start: f(self.start, other.start),
            friction: f(self.friction, other.friction),
            drag: f(self.drag, other.drag),
            wing: self.wing,
            then: self.then.as_ref().zip(other.then.as_ref()).map(|(a, b)| a.zip(b, f)),
        }
    }
}

impl<S: Scalar> TrackLaw<S> {
    /// The point at a distance along the arc, and the directions along it and away from its centre.
    #[inline(always)]
    pub(super) fn at(&self, way: S) -> (V3<S>, V3<S>, V3<S>) {
        let (sine, cosine) = (way / self.radius).sin_cos();
        let out = self.out * cosine + self.along * sine;
        (self.centre + out * self.radius, self.along * cosine - self.out * sine, out)
    }
}

impl NodeLaw<f64> {
    pub(super) fn new(node: &Node, body: &Body, is_end: bool) -> Self {
        let joint = |segment: usize| body.joint_m(body.tree.segment(segment));
        let from_joint = |segment: usize, point: &Point3<f64>| V3::of(&(point.coords - joint(segment)));
        let stroke = |stroke: &Stroke| StrokeLaw {
            due: stroke.due_s,
            direction: V3::of(&stroke.direction),
            way: Steps::new(&stroke.way),
            stall: stroke.stall_n,
        };
        let site = match &node.site {
            Site::Vehicle(point, pulled) => SiteLaw::Vehicle(V3::of(&point.coords), pulled.as_ref().map(stroke)),
            Site::Segment(segment, point, away) => {
                SiteLaw::Segment(*segment, from_joint(*segment, point), away.as_ref().map(V3::of))
            }
            Site::Track(segment, track) => match TrackLaw::new(track, *segment, &joint) {
                Some(law) => SiteLaw::Track(*segment, law),
                None => SiteLaw::Segment(*segment, from_joint(*segment, &track.points_m[1]), None),
            },
            Site::Sphere(sphere) => SiteLaw::Sphere(*sphere),
        };
        let always = matches!(site, SiteLaw::Vehicle(..) | SiteLaw::Segment(_, _, None));
        NodeLaw {
            site,
            friction: node.friction,
            rubs: node.parts() && !is_end,
            strength: node.strength_n,
            may_leave: !is_end && (!always || node.strength_n < NEVER),
            ride: (!node.ride.is_empty()).then(|| Riding::new(&node.ride)),
            frame: node.frame.map(|frame| frame.index(&[])),
        }
    }
}

impl<S: Scalar<Mask = bool>> NodeLaw<S> {
    /// Fraction between two stored states at which the webbing was due to reach or leave the node, or its stroke to
    /// stall; none if they do not tell.
    pub(super) fn due(&self, before: &NodePast<S>, now: &NodePast<S>) -> Option<S> {
        let is_torn = self.strength.lt(S::of(NEVER));
        match &self.site {
            SiteLaw::Vehicle(_, Some(stroke)) if !is_torn => Some(passes(stroke.stall, before.across, now.across)),
            SiteLaw::Segment(_, _, Some(_)) if !is_torn => Some(passes(S::zero(), before.across, now.across)),
            SiteLaw::Sphere(_) if before.is_on() => Some(passes(S::zero(), -before.across, -now.across)),
            SiteLaw::Sphere(_) => Some(passes(S::zero(), before.across, now.across)),
            SiteLaw::Track(_, track) if now.way.gt(track.length) => Some(passes(track.length, before.way, now.way)),
            _ => None,
        }
    }
}

impl NodeLaw<f64> {
    /// Whether a pretensioner pulls it.
    pub(super) fn is_pulled(&self) -> bool {
        matches!(self.site, SiteLaw::Vehicle(_, Some(_)))
    }
}

impl<S: Copy> NodeLaw<S> {
    /// Structure that must be equal for side-by-side evaluation.
    pub(super) fn shape(&self) -> (usize, usize, usize, [bool; 2], Option<Vec<usize>>) {
        let (kind, of, rows) = match &self.site {
            SiteLaw::Vehicle(_, None) => (0, self.frame.unwrap_or(0), 0),
            SiteLaw::Vehicle(_, Some(stroke)) => (1, self.frame.unwrap_or(0), stroke.way.len()),
            SiteLaw::Segment(segment, _, away) => (2, *segment, usize::from(away.is_some())),
            SiteLaw::Track(segment, track) => (3, *segment, track.then.as_ref().map_or(0, |next| 1 + next.segment)),
            SiteLaw::Sphere(sphere) => (4, *sphere, 0),
        };
        let ridden = self.ride.iter().chain(self.next().and_then(|next| next.ride.as_ref()));
        let ridden = self.has_ride().then(|| ridden.flat_map(Riding::numbers).collect());
        (kind, of, rows, [self.rubs, self.may_leave], ridden)
    }

    /// The iliac wing, if it is one.
    pub(super) fn wing(&self) -> Option<Wing> {
        if let SiteLaw::Track(_, track) = &self.site { track.wing } else { None }
    }

    /// Support of webbing that has slid off it.
    #[inline(always)]
    pub(super) fn next(&self) -> Option<&NextLaw<S>> {
        if let SiteLaw::Track(_, track) = &self.site { track.then.as_ref() } else { None }
    }

    fn has_ride(&self) -> bool {
        self.ride.is_some() || self.next().is_some_and(|next| next.ride.is_some())
    }

    pub(super) fn zip<A: Copy, T>(&self, other: &NodeLaw<A>, f: &impl Fn(S, A) -> T) -> NodeLaw<T> {
        let site = match (&self.site, &other.site) {
            (SiteLaw::Vehicle(a, from), SiteLaw::Vehicle(b, to)) => {
                let stroke = |(a, b): (&StrokeLaw<S>, &StrokeLaw<A>)| StrokeLaw {
                    due: f(a.due, b.due),
                    direction: a.direction.zip(&b.direction, f),
                    way: a.way.zip(&b.way, f),
                    stall: f(a.stall, b.stall),
                };
                SiteLaw::Vehicle(a.zip(b, f), from.as_ref().zip(to.as_ref()).map(stroke))
            }
            (SiteLaw::Segment(segment, a, from), SiteLaw::Segment(_, b, to)) => {
                SiteLaw::Segment(*segment, a.zip(b, f), from.as_ref().zip(to.as_ref()).map(|(a, b)| a.zip(b, f)))
            }
            (SiteLaw::Track(segment, a), SiteLaw::Track(_, b)) => SiteLaw::Track(*segment, a.zip(b, f)),
            (SiteLaw::Sphere(sphere), _) => SiteLaw::Sphere(*sphere),
            _ => unreachable!("shapes were compared"),
        };
        NodeLaw {
            site,
            friction: f(self.friction, other.friction),
            rubs: self.rubs,
            strength: f(self.strength, other.strength),
            may_leave: self.may_leave,
            ride: self.ride.zip(other.ride).map(|(a, b)| a.zip(&b, f)),
            frame: self.frame,
        }
    }
}

/// Position of a segment point, from its joint in the segment's axes; space axes.
#[inline(always)]
fn on_segment<S: Scalar>(at: &Instant<'_, S>, n: usize, offset: V3<S>) -> V3<S> {
    at.k.joint[n] + at.k.axes[n].out(offset)
}

impl<S: Scalar> NextLaw<S> {
    /// Position, space axes.
    #[inline(always)]
    fn place(&self, at: &Instant<'_, S>) -> V3<S> {
        let point = on_segment(at, self.segment, self.point);
        if let Some(riding) = &self.ride { point + riding.carried(at.k)[0] } else { point }
    }
}

impl<S: Scalar> TrackLaw<S> {
    /// Force along and across it, N, from a force in axes of its segment at a position.
    #[inline(always)]
    pub(super) fn parted(&self, way: S, force: V3<S>) -> [S; 2] {
        let (_, along, _) = self.at(way);
        let across = force.dot(along);
        [across, (force - along * across).norm_squared().max(S::of(1e-60)).sqrt()]
    }

    /// Angle between the webbing's force and the arc's normal, positive towards the outer end, rad; 0 without a force.
    #[inline(always)]
    pub(super) fn angle(&self, way: S, force: V3<S>) -> S {
        let [across, held] = self.parted(way, force);
        across.atan2(held)
    }
}

impl<S: Scalar> NodeLaw<S> {
    /// Its segment.
    #[inline(always)]
    pub(super) fn segment(&self, spheres: &[Sphere<S>]) -> Option<usize> {
        match &self.site {
            SiteLaw::Vehicle(..) => None,
            SiteLaw::Segment(segment, ..) | SiteLaw::Track(segment, _) => Some(*segment),
            SiteLaw::Sphere(sphere) => Some(spheres[*sphere].segment),
        }
    }

    /// Its sphere.
    #[inline(always)]
    pub(super) fn sphere<'s>(&self, spheres: &'s [Sphere<S>]) -> Option<&'s Sphere<S>> {
        if let SiteLaw::Sphere(sphere) = self.site { Some(&spheres[sphere]) } else { None }
    }

    pub(super) fn is_sphere(&self) -> bool {
        matches!(self.site, SiteLaw::Sphere(_))
    }

    /// Its ride on deformable parts of its segment.
    #[inline(always)]
    pub(super) fn riding<'s>(&'s self, spheres: &'s [Sphere<S>]) -> Option<&'s Riding<S>> {
        self.sphere(spheres).map_or(self.ride.as_ref(), |sphere| sphere.riding(Use::Belt))
    }

    /// Initial travel.
    pub(super) fn start(&self) -> S {
        if let SiteLaw::Track(_, track) = &self.site { track.start } else { S::zero() }
    }

    /// Travel along track or stroke at a time.
    #[inline(always)]
    pub(super) fn way(&self, time: S, past: &NodePast<S>, device: &DevicePast<S>) -> S {
        match &self.site {
            SiteLaw::Track(..) => {
                let h = time - device.time;
                (past.way + (past.speed + past.half_change(h)) * h).max(S::zero())
            }
            SiteLaw::Vehicle(_, Some(stroke)) => {
                S::select(past.speed.lt(S::zero()), past.way, stroke.way.at(time - stroke.due))
            }
            _ => S::zero(),
        }
    }

    /// Position of a point of segment `n` that rides as this node does, space axes.
    #[inline(always)]
    fn on_segment(&self, at: &Instant<'_, S>, n: usize, offset: V3<S>) -> V3<S> {
        let point = on_segment(at, n, offset);
        if let Some(riding) = &self.ride { point + riding.carried(at.k)[0] } else { point }
    }

    /// Position on the body or in `frame`, space axes.
    #[inline(always)]
    pub(super) fn place(&self, at: &Instant<'_, S>, frame: &Moving<S>, way: S, past: &NodePast<S>) -> Place<S> {
        let (mut sense, none) = (V3::zero(), S::zero());
        let (centre, radius) = match &self.site {
            SiteLaw::Vehicle(point, stroke) => {
                let mut pulled = V3::zero();
                if let Some(stroke) = stroke {
                    pulled = stroke.direction * way;
                }
                (frame.origin + frame.axes.out(*point + pulled), none)
            }
            SiteLaw::Segment(segment, offset, _) => (self.on_segment(at, *segment, *offset), none),
            SiteLaw::Track(segment, track) => {
                let on_track = self.on_segment(at, *segment, track.at(way).0);
                let place = track.then.as_ref().map(|next| V3::select(past.is_handed_over(), next.place(at), on_track));
                (place.unwrap_or(on_track), none)
            }
            SiteLaw::Sphere(sphere) => {
                let sphere = &at.spheres[*sphere];
                sense = at.k.axes[sphere.segment].out(past.normal());
                (sphere.place(at.k, Use::Belt).1, sphere.radius)
            }
        };
        Place { centre, radius, is_sphere: self.is_sphere(), rubs: self.rubs, may_leave: self.may_leave, sense }
    }

    /// Continuation from an accepted step with this force (space axes) of the webbing on it: its way and speed, whether the
    /// webbing still passes it, and the work of what pulls it; `since` is the time of the step before. A stroke that has stalled has a speed below 0.
    #[inline(always)]
    pub(super) fn commit(
        &self,
        at: &Instant<'_, S>,
        frame: &Moving<S>,
        way: S,
        force: V3<S>,
        (past, since): (&mut NodePast<S>, S),
    ) -> S {
        let (o, mut work) = (S::zero(), S::zero());
        let leaves = match &self.site {
            SiteLaw::Vehicle(_, Some(stroke)) => {
                let against = -frame.axes.into_frame(force).dot(stroke.direction);
                work = against * (way - past.way);
                past.across = against;
                let stalls = !against.lt(stroke.stall) & stroke.due.lt(at.frames.time);
                past.speed = S::select(stalls, S::of(STALLED), past.speed);
                S::truth(false)
            }
            SiteLaw::Segment(segment, _, Some(away)) => {
                past.across = at.k.axes[*segment].out(*away).dot(force);
                past.across.gt(o)
            }
            SiteLaw::Track(segment, track) => {
                let (_, _, out) = track.at(way);
                let force = at.k.axes[*segment].into_frame(force);
                let [across, held] = track.parted(way, force);
                let speed = (across.abs() - track.friction * held).max(o) / track.drag;
                past.lost += (across + past.across) * (way - past.way) * S::of(0.5);
                past.across = across;
                past.slide(S::select(across.lt(o), -speed, speed), at.frames.time - since);
                // a light pull, such as that of a belt that tightens in rebound, lifts none off a wing
                let least = S::of(if track.wing.is_some() { LEAST_N } else { 0.0 });
                let leaves = out.dot(force).gt(least) | way.gt(track.length);
                match &track.then {
                    Some(_) => past.hand_over(leaves),
                    None => leaves,
                }
            }
            _ => S::truth(false),
        };
        past.way = way;
        let torn = force.norm_squared().gt(self.strength * self.strength);
        if self.may_leave && !self.is_sphere() {
            past.on = S::select(leaves | torn, o, past.on);
        }
        work
    }
}
