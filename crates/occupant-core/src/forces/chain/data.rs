//! A belt as data: nodes in order, webbing, and the device at its first node.

use nalgebra::{Point3, Vector3};

use crate::body::Shares;
use crate::forces::contact::surface::Frame;
use crate::forces::function::Function;

/// A time after every run, s; a force beyond that of any belt, N.
pub const NEVER: f64 = 1e30;

/// A belt from its first node over others to its last.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Its name, common to all its parts between ties.
    pub belt: String,
    /// Frame of its nodes off the body.
    pub frame: Frame,
    /// Nodes in order; at least two, points at the ends.
    pub nodes: Vec<Node>,
    /// Names of its straps: each between two places where the webbing is fixed or rubs.
    pub straps: Vec<String>,
    /// Force over strain.
    pub webbing: Function,
    /// Parallel Maxwell element: stiffness in N per unit of strain, and time constant in s.
    pub viscous: Option<[f64; 2]>,
    /// Definition of the unstretched length.
    pub rest: Rest,
    /// Device at its first node.
    pub device: Device,
    /// Trigger that releases it for good.
    pub release: Cue,
    /// Tension at which it tears, N.
    pub strength_n: f64,
}

/// Definition of the unstretched length of a belt; all its straps start with the same strain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rest {
    /// Unstretched length less the length at the start, m.
    Slack(f64),
    /// Tension at the start, N.
    Pretension(f64),
    /// Unstretched length, m.
    Length(f64),
}

/// A node that the webbing passes.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its location.
    pub site: Site,
    /// μ along the webbing.
    pub friction: f64,
    /// Force at which the webbing is released from it, N.
    pub strength_n: f64,
    /// For a node on a segment: deformable parts that it rides on; a sphere has its own.
    pub ride: Shares,
    /// Of a point of the belt's frame: what carries it instead, in whose axes it is then, such as a back on its hinge.
    pub frame: Option<Frame>,
}

impl Node {
    /// Whether it divides straps although it is no end: webbing rubs on it, or its force is reported.
    pub fn parts(&self) -> bool {
        self.friction > 0.0 || matches!(&self.site, Site::Track(_, track) if track.then.is_some())
    }
}

/// Location of a node.
#[derive(Clone, Debug, PartialEq)]
pub enum Site {
    /// A point of the belt's frame, m, and a pretensioner on it.
    Vehicle(Point3<f64>, Option<Stroke>),
    /// A point of a segment (index), from its lower end, m, and the direction away from the body: webbing pulled that
    /// way lifts off.
    Segment(usize, Point3<f64>, Option<Vector3<f64>>),
    /// A point that slides along an arc of a segment.
    Track(usize, Track),
    /// A sphere of the body (index), which the webbing wraps.
    Sphere(usize),
}

/// An arc of a segment across which webbing slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Inner end, crown where the webbing begins, and outer end, from the segment's lower end, m.
    pub points_m: [Point3<f64>; 3],
    /// Friction across the webbing.
    pub friction: f64,
    /// Drag across the webbing, N·s/m.
    pub drag_n_s_m: f64,
    /// Iliac wing, if webbing that slides off it submarines.
    pub wing: Option<Wing>,
    /// Support of webbing that has slid off; none: it has none here.
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

/// A point of a segment that supports webbing that has slid off a track.
#[derive(Clone, Debug, PartialEq)]
pub struct Next {
    /// Segment (index).
    pub segment: usize,
    /// From its lower end, segment axes, m.
    pub point_m: Point3<f64>,
    /// Deformable parts of that segment that it rides on.
    pub ride: Shares,
}

impl Track {
    /// The point in a model of several bodies, in which segments and plates of this body begin at these indices.
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

/// A pretensioner that pulls a vehicle node.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    /// Firing time, s.
    pub due_s: f64,
    /// Direction of the pull, vehicle axes; a unit vector.
    pub direction: Vector3<f64>,
    /// Time since firing, s, and travel, m; nondecreasing from (0, 0).
    pub way: Vec<[f64; 2]>,
    /// Opposing force at which it stops, N.
    pub stall_n: f64,
}

/// Device at the first node of a belt.
#[derive(Clone, Debug, PartialEq)]
pub struct Device {
    /// Force over payout of a locked spool or of a limiter in the belt; none: rigid.
    pub limiter: Option<Function>,
    /// A second limiter, its trigger, and the transition time, s.
    pub second: Option<(Function, Cue, f64)>,
    /// Spool.
    pub reel: Option<Reel>,
}

/// A retractor.
#[derive(Clone, Debug, PartialEq)]
pub struct Reel {
    /// Webbing on it at the start, m.
    pub on_spool_m: f64,
    /// Tension while it is open, N.
    pub tension_n: f64,
    /// Trigger of the lock.
    pub lock: Cue,
    /// Webbing paid out between trigger and lock, m, and the longest time for it, s.
    pub lock_after: [f64; 2],
    /// Pretensioner.
    pub pull: Option<Pull>,
}

/// A pretensioner of a spool.
#[derive(Clone, Debug, PartialEq)]
pub struct Pull {
    /// Its trigger.
    pub cue: Cue,
    /// Time since firing, s, and its output: webbing pulled in, m, or force, N.
    pub table: Vec<[f64; 2]>,
    /// Largest pull-in speed, m/s, if it is given by force.
    pub by_force: Option<f64>,
    /// Tension at which it stops, N.
    pub stall_n: f64,
}

/// Trigger condition of a device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cue {
    /// Due time of the device, including delays, s, if known before the run; `NEVER` if not.
    pub due_s: f64,
    /// Watched quantity instead.
    pub watch: Option<Watch>,
}

/// A quantity of the first strap, watched at accepted steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Watch {
    /// The quantity.
    pub of: Watched,
    /// Threshold, SI units.
    pub threshold: f64,
    /// Least uninterrupted duration, s.
    pub lasting_s: f64,
    /// Delay until the device acts, s.
    pub delay_s: f64,
}

/// Quantities that can be watched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Watched {
    /// Tension of the first strap.
    Tension,
    /// Payout of the spool.
    Payout,
    /// Its speed.
    PayoutSpeed,
    /// Its acceleration.
    PayoutAcceleration,
}

impl Device {
    /// Deformation at the last point of its limiter, m, the longer of two; none without one.
    pub(crate) fn end_m(&self) -> Option<f64> {
        let laws = self.limiter.iter().chain(self.second.iter().map(|second| &second.0));
        laws.map(Function::end).reduce(f64::max)
    }
}

impl Cue {
    /// A condition that is never met.
    pub const NEVER: Cue = Cue { due_s: NEVER, watch: None };
}

impl Chain {
    /// Times known before the run at which its force may have a kink, s.
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
