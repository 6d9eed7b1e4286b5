//! A belt as data: nodes in order, webbing, and the device at its first node.

use nalgebra::{Point3, Vector3};

use crate::body::Shares;
use crate::forces::contact::surface::Frame;
use crate::forces::function::Function;

/// A time after every run, s; a force that no belt reaches, N.
pub const NEVER: f64 = 1e30;

/// A belt that runs from its first node over others to its last.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Its name, which other parts of the belt share where it is sewn fast to something.
    pub belt: String,
    /// What its nodes off the body are fixed to.
    pub frame: Frame,
    /// What the webbing passes, in order; at least two, the ends points.
    pub nodes: Vec<Node>,
    /// Names of its straps: from one place where the webbing is held or rubs to the next.
    pub straps: Vec<String>,
    /// Force over strain.
    pub webbing: Function,
    /// Maxwell branch beside it: stiffness in N per unit of strain, and time constant in s.
    pub viscous: Option<[f64; 2]>,
    /// What the unstretched length follows from.
    pub rest: Rest,
    /// What holds its first node.
    pub device: Device,
    /// What frees it for good.
    pub release: Cue,
    /// Tension at which it tears, N.
    pub strength_n: f64,
}

/// What the unstretched length of a belt follows from; all its straps begin with the same strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rest {
    /// Unstretched length less the length at the start, m.
    Slack(f64),
    /// Tension at the start, N.
    Pretension(f64),
    /// Unstretched length, m.
    Length(f64),
}

/// A place that the webbing passes.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub site: Site,
    /// μ along the webbing.
    pub friction: f64,
    /// Force at which the webbing comes out of it, N.
    pub strength_n: f64,
    /// Of a node of a segment: how it rides on parts of it that yield; a sphere says so itself.
    pub ride: Shares,
    /// Of a point of the belt's frame: what carries it instead, in whose axes it is then, such as a back on its hinge.
    pub frame: Option<Frame>,
}

impl Node {
    /// Whether a strap ends at it where it is not an end itself: webbing rubs on it, or what it bears is told of.
    pub fn parts(&self) -> bool {
        self.friction > 0.0 || matches!(&self.site, Site::Track(_, track) if track.then.is_some())
    }
}

/// Where a node is.
#[derive(Clone, Debug, PartialEq)]
pub enum Site {
    /// A point of the belt's frame or of the node's own, m, and what pulls it.
    Vehicle(Point3<f64>, Option<Stroke>),
    /// A point of a segment (index), from its lower end, m, and the direction away from the body: webbing that pulls that way
    /// comes off.
    Segment(usize, Point3<f64>, Option<Vector3<f64>>),
    /// A point that slides along an arc of a segment.
    Track(usize, Track),
    /// A sphere of the body (index), which the webbing wraps.
    Sphere(usize),
}

/// An arc of a segment across which webbing slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its inner end, its crown where the webbing begins, and its outer end, from the segment's lower end, m.
    pub points_m: [Point3<f64>; 3],
    /// Friction across the webbing.
    pub friction: f64,
    /// Drag across the webbing, N·s/m.
    pub drag_n_s_m: f64,
    /// Whose bone it is, if the webbing submarines where it comes off.
    pub wing: Option<Wing>,
    /// Where the webbing lies once it has come off; none: it lies nowhere.
    pub then: Option<Next>,
}

/// A wing of the pelvis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wing {
    /// The left one.
    Left,
    /// The right one.
    Right,
}

/// A point of a segment that takes webbing over which has come off a track.
#[derive(Clone, Debug, PartialEq)]
pub struct Next {
    /// Segment (index).
    pub segment: usize,
    /// From its lower end, segment axes, m.
    pub point_m: Point3<f64>,
    /// How it rides on parts of that segment that yield.
    pub ride: Shares,
}

impl Track {
    /// The same among several bodies; segments and plates of this body begin at these indices.
    pub(crate) fn of_member(&self, segment: usize, plate: usize) -> Self {
        let moved = |shares: &Shares| shares.iter().map(|(on, share)| (plate + on, *share)).collect();
        let then = self.then.as_ref().map(|next| Next {
            segment: segment + next.segment,
            ride: moved(&next.ride),
            ..next.clone()
        });
        Track { then, ..self.clone() }
    }
}

/// A pretensioner that pulls a node of the vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// When it fires, s.
    pub due_s: f64,
    /// Which way, vehicle axes; a unit vector.
    pub direction: Vector3<f64>,
    /// Time since it fired, s, and way, m; rises from (0, 0).
    pub way: Vec<[f64; 2]>,
    /// Force against it at which it stops, N.
    pub stall_n: f64,
}

/// What holds the first node of a belt.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Force over payout of a locked spool or of a limiter that the belt carries; none: rigid.
    pub limiter: Option<Function>,
    /// A second limiter, what switches to it, and the time in which the force moves over, s.
    pub second: Option<(Function, Cue, f64)>,
    /// A spool.
    pub reel: Option<Reel>,
}

/// A retractor.
#[derive(Clone, Debug, PartialEq)]
pub struct Reel {
    /// Webbing on it at the start, m.
    pub on_spool_m: f64,
    /// Tension while it is open, N.
    pub tension_n: f64,
    /// What locks it.
    pub lock: Cue,
    /// Webbing that leaves it from then until it is locked, m, and the longest that this takes, s.
    pub lock_after: [f64; 2],
    /// Pretensioner.
    pub pull: Option<Pull>,
}

/// A pretensioner of a spool.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// What fires it.
    pub cue: Cue,
    /// Time since it fired, s, and what it gives then: webbing pulled in, m, or force, N.
    pub table: Vec<[f64; 2]>,
    /// The largest speed of webbing that it pulls in, m/s, where it gives a force.
    pub by_force: Option<f64>,
    /// Tension at which it stops, N.
    pub stall_n: f64,
}

/// What sets a device off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cue {
    /// When the device is due, delay included, s, if that is known before the run; `NEVER` if not.
    pub due_s: f64,
    /// What is watched instead.
    pub watch: Option<Watch>,
}

/// A quantity of the first strap that is watched at accepted steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch {
    /// Which.
    pub of: Watched,
    /// What it must reach, in SI units.
    pub threshold: f64,
    /// For how long without a break, s.
    pub lasting_s: f64,
    /// Time from then until the device acts, s.
    pub delay_s: f64,
}

/// What can be watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watched {
    /// Tension of the first strap.
    Tension,
    /// Webbing that has left the spool.
    Payout,
    /// Its speed.
    PayoutSpeed,
    /// Its acceleration.
    PayoutAcceleration,
}

impl Device {
    /// Deformation of the last point of its limiter, m, of two that of the longer; none without one.
    pub(crate) fn end_m(&self) -> Option<f64> {
        let laws = self.limiter.iter().chain(self.second.iter().map(|second| &second.0));
        laws.map(Function::end).reduce(f64::max)
    }
}

impl Cue {
    /// What never happens.
    pub const NEVER: Cue = Cue { due_s: NEVER, watch: None };
}

impl Chain {
    /// Times known before the run at which its force may have a corner, s.
    pub(crate) fn breaks_s(&self) -> Vec<f64> {
        let Device { second, reel, .. } = &self.device;
        let table = |due_s: f64, rows: &[[f64; 2]]| rows.iter().map(|row| due_s + row[0]).collect::<Vec<_>>();
        let mut list = vec![self.release.due_s];
        list.extend(second.iter().flat_map(|(_, cue, switch_s)| [cue.due_s, cue.due_s + switch_s]));
        if let Some(reel) = reel {
            list.push(reel.lock.due_s);
            list.extend(reel.pull.iter().flat_map(|pull| table(pull.cue.due_s, &pull.table)));
        }
        for node in &self.nodes {
            if let Site::Vehicle(_, Some(stroke)) = &node.site {
                list.extend(table(stroke.due_s, &stroke.way));
            }
        }
        list.retain(|time_s| *time_s < NEVER);
        list
    }
}
