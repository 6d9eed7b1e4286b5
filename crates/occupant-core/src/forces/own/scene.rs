//! Input and output of a program's own force.

use nalgebra::{Point3, Vector3};

use super::MOST_CHANNELS;
use super::element::OwnPlain;
use crate::body::Segment;
use crate::forces::contact::surface::Frame;
use crate::forces::element::Load;
use crate::forces::sphere::Use;
use crate::motion::frame::{Frames, MOST_FRAMES};
use crate::motion::kinematics::Kinematics;
use crate::motion::vector::V3;
use crate::vehicle::FrameMotion;

/// A point that forces act on.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Place {
    /// A point of a segment, from its lower end, segment axes, m.
    Segment(Segment, Point3<f64>),
    /// The centre of a sphere of the body (index).
    Sphere(usize),
    /// A point of a frame, m: space, a vehicle, a panel.
    Frame(Frame, Point3<f64>),
}

/// Position and velocity of a point, space axes (X′ forward, Y′ left, Z′ up).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointMotion {
    /// Position, m.
    pub place_m: Vector3<f64>,
    /// Velocity, m/s.
    pub velocity_m_s: Vector3<f64>,
}

impl PointMotion {
    /// Motion of a point that does not exist.
    fn nowhere() -> Self {
        PointMotion { place_m: Vector3::repeat(f64::NAN), velocity_m_s: Vector3::repeat(f64::NAN) }
    }
}

/// The bodies and the frames at one instant, as seen by a force.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    pub(super) law: &'a OwnPlain,
    pub(super) k: &'a Kinematics<f64>,
    pub(super) frames: &'a Frames<f64>,
}

impl Scene<'_> {
    /// Time of the scenario, s.
    pub fn time_s(&self) -> f64 {
        self.frames.time
    }

    /// Position and velocity of a point; NaN for points that the model lacks.
    pub fn motion(&self, place: &Place) -> PointMotion {
        match place {
            Place::Frame(frame, point_m) => {
                let frame = self.frame(*frame);
                let place_m = frame.point_to_space(point_m.coords);
                PointMotion { place_m, velocity_m_s: frame.velocity_at(place_m) }
            }
            body => match self.arm(body) {
                Some((segment, arm)) => PointMotion {
                    place_m: (self.k.joint[segment] + arm).to_vector(),
                    velocity_m_s: self.velocity(body, segment, arm).to_vector(),
                },
                None => PointMotion::nowhere(),
            },
        }
    }

    /// Velocity of a point of a segment, or of a sphere, which may move with a plate.
    fn velocity(&self, place: &Place, segment: usize, arm: V3<f64>) -> V3<f64> {
        match place {
            Place::Sphere(sphere) => self.law.spheres[*sphere].place(self.k, Use::Contact).2,
            _ => self.k.joint_velocity[segment] + self.k.omega[segment].cross(arm),
        }
    }

    /// Pose and velocities of a frame, space axes; NaN for frames that the model lacks.
    pub fn frame(&self, frame: Frame) -> FrameMotion {
        match frame {
            Frame::Segment(n) if n < self.law.joints.len() => self.k.moving(n).motion(),
            Frame::Other(i) if i >= self.law.others => FrameMotion::nowhere(),
            Frame::Segment(_) => FrameMotion::nowhere(),
            frame => self.frames[frame.index(&[]) % MOST_FRAMES].motion(),
        }
    }

    /// Pose and velocities of a segment, space axes, with its joint as origin; NaN for segments that the model lacks.
    pub fn segment(&self, segment: Segment) -> FrameMotion {
        self.frame(Frame::Segment(segment.index()))
    }

    /// Segment of a point of the body, and the vector from the segment's joint to the point, space axes.
    pub(super) fn arm(&self, place: &Place) -> Option<(usize, V3<f64>)> {
        match place {
            Place::Segment(segment, from_lower_end) => {
                let joint = self.law.joints.get(segment.index())?;
                let from_joint = V3::of(&(from_lower_end.coords - joint));
                Some((segment.index(), self.k.axes[segment.index()].out(from_joint)))
            }
            Place::Sphere(sphere) => {
                let site = self.law.spheres.get(*sphere)?;
                Some((site.segment, site.place(self.k, Use::Contact).0))
            }
            Place::Frame(..) => None,
        }
    }
}

/// Receives the loads of a force at one instant. All vectors are in space axes (X′ forward, Y′ left, Z′ up).
#[derive(Debug)]
pub struct Pushes<'s, 'l> {
    pub(super) scene: Scene<'s>,
    pub(super) load: &'l mut Load<f64>,
    /// First loaded segment, whose body's ledger contains the energy.
    pub(super) home: Option<usize>,
    /// Power that goes into the force, W.
    pub(super) taken_w: f64,
    pub(super) force_n: f64,
    pub(super) stored_j: f64,
    pub(super) shown: [f64; MOST_CHANNELS],
}

impl Pushes<'_, '_> {
    /// Force on a point, N. On a frame, it moves yielding frames only; its work is the vehicle's.
    pub fn force(&mut self, on: &Place, force_n: Vector3<f64>) {
        let motion = self.scene.motion(on);
        let power_w = force_n.dot(&motion.velocity_m_s);
        self.taken_w -= power_w;
        self.force_n = self.force_n.max(force_n.norm());
        let force = V3::of(&force_n);
        match (on, self.scene.arm(on)) {
            (_, Some((segment, arm))) => {
                let wrench = &mut self.load.wrench[segment];
                wrench.force += force;
                wrench.moment += arm.cross(force);
                if let Place::Sphere(sphere) = on {
                    self.load.press(&self.scene.law.spheres[*sphere], Use::Contact, force, true);
                }
                self.belongs_to(segment, power_w);
            }
            (Place::Frame(frame, _), None) => {
                let home = self.home.unwrap_or_default();
                self.load.power_at(home).vehicle -= power_w;
                if let Some(segment) = self.home.filter(|_| frame.segment().is_none()) {
                    let at = V3::of(&motion.place_m);
                    self.load.push([frame.index(&[]), segment], -force, at, V3::zero(), true);
                }
            }
            // of what there is not: the run ends with it
            (_, None) => self.taken_w = f64::NAN,
        }
    }

    /// Moment on a segment, N·m.
    pub fn moment(&mut self, on: Segment, moment_n_m: Vector3<f64>) {
        let n = on.index();
        if n >= self.scene.law.joints.len() {
            self.taken_w = f64::NAN;
            return;
        }
        let power_w = moment_n_m.dot(&self.scene.k.omega[n].to_vector());
        self.taken_w -= power_w;
        self.load.wrench[n].moment += V3::of(&moment_n_m);
        self.belongs_to(n, power_w);
    }

    /// Force on one point and its reaction on another, N.
    pub fn between(&mut self, one: &Place, other: &Place, force_on_one_n: Vector3<f64>) {
        let is_frame = |place: &Place| matches!(place, Place::Frame(..));
        // what is pushed first is the home of the books
        if is_frame(one) && !is_frame(other) {
            self.force(other, -force_on_one_n);
            self.force(one, force_on_one_n);
        } else {
            self.force(one, force_on_one_n);
            self.force(other, -force_on_one_n);
        }
    }

    /// Energy that the force has absorbed and could return, J.
    pub fn stored_j(&mut self, energy_j: f64) {
        self.stored_j += energy_j;
    }

    /// Present value of one of its channels, by its index in [`Force::channels`](super::Force::channels).
    pub fn show(&mut self, channel: usize, value: f64) {
        if let Some(shown) = self.shown.get_mut(channel) {
            *shown = value;
        }
    }

    /// Books the power that a segment receives: a segment of another body receives it from the first body.
    fn belongs_to(&mut self, segment: usize, power_w: f64) {
        match self.home {
            None => self.home = Some(segment),
            Some(home) => self.load.hand_over([home, segment], power_w, true),
        }
    }
}
