//! Results of a run at one output time (report, "Output", items 1–7), computed on request.

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

use crate::body::Joint;
use crate::body::Segment;
use crate::body::tti12::TTI12;
use crate::forces::contact::Touch;
use crate::forces::contact::surface::Frame;
use crate::forces::shown::Pull;
use crate::forces::sphere::Use;
use crate::forces::{Actions, History};
use crate::kernel::Evaluation;
use crate::kernel::instruments::Reading;
use crate::model::Model;
use crate::motion::frame::{Frames, MOST_FRAMES, VEHICLE};
use crate::motion::layout::Trunk;
use crate::motion::report_coordinates::ReportCoordinates;
use crate::motion::state::State;
use crate::motion::vector::{M3, V3};
use crate::results::checkpoint::{Checkpoint, Progress, StepUnderWay};
use crate::results::energy::EnergyLedger;
use crate::results::fine::Fine;
use crate::results::outcome::FirstTouch;
use crate::results::peaks::Peaks;
use crate::results::unknown::Unknown;
use crate::vehicle::{FrameMotion, VehiclePose};

/// Work of the integrator so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Effort {
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and rejected by the error control.
    pub rejected: u64,
    /// Evaluations of the derivative by the integrator.
    pub evaluations: u64,
    /// Last accepted step, s.
    pub step_s: f64,
}

/// All results at one output time. Positions are in vehicle axes, motions in segment axes, as the report prints them.
#[derive(Clone, Copy)]
pub struct Sample<'a> {
    /// Time, s.
    pub time_s: f64,
    /// Index of the output, from 0.
    pub index: usize,
    /// The model.
    pub model: &'a Model,
    /// Integrated state.
    pub state: &'a State<f64>,
    /// History of the force elements.
    pub history: &'a History<f64>,
    /// Frames.
    pub frames: &'a Frames<f64>,
    /// Motion of the first vehicle, space axes.
    pub vehicle: &'a FrameMotion,
    /// Motions of the home frames of the bodies.
    pub homes: &'a [FrameMotion],
    /// Energies by body.
    pub ledgers: &'a [EnergyLedger],
    /// Body (index) for instruments and summary: [`Sample::of_body`].
    pub of: usize,
    /// Frame of reported positions; by default each body's home: [`Sample::seen_by_vehicle`].
    pub watcher: Option<&'a FrameMotion>,
    /// Position and attitude of the vehicle in vehicle-space, as given by the path.
    pub vehicle_pose: VehiclePose,
    /// Derived motion, loads and accelerations.
    pub evaluation: &'a Evaluation<f64>,
    /// Actions of the force elements, each kind in the model's order.
    pub actions: &'a Actions<f64>,
    /// Energies.
    pub energy: EnergyLedger,
    /// Work of the integrator so far.
    pub effort: Effort,
    /// Sums and extremes so far, this output included.
    pub progress: Progress,
    /// First contacts so far, in order of time.
    pub first_touches: &'a [FirstTouch],
    /// Elements that have switched since the output before, in order of time, except in a step that leads beyond this
    /// output.
    pub switched: &'a [Switched],
    /// Largest values at the accepted steps so far.
    pub step_peaks: &'a Peaks,
    /// Values at this output only.
    pub now: &'a Peaks,
    /// Readings of the instruments since the output before.
    pub fine: &'a Fine,
    /// Instrument readings at this output, by body.
    pub(crate) readings: &'a [Reading<f64>],
    /// Step of the error control that contains this output, if it continues beyond it.
    pub under_way: Option<StepUnderWay<'a>>,
}

/// An element that has switched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Switched {
    /// End of the step in which it switched, s.
    pub time_s: f64,
    /// Kind of element, in the singular.
    pub of: &'static str,
    /// Index of its action among those of its kind.
    pub element: usize,
    /// Event, as text that follows its name.
    pub what: &'static str,
}

/// A contact pair at an output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the surface, of the solid after all surfaces, or of another sphere of the body after all solids.
    pub surface: usize,
    /// Δ, m.
    pub depth_m: f64,
    /// Thickness of a solid behind the face through which the sphere entered, m; infinite without thickness.
    pub thickness_m: f64,
    /// wF along N̂, N.
    pub normal_force_n: f64,
    /// Normal, edge and friction force on the sphere, vehicle axes, N.
    pub force_n: Vector3<f64>,
    /// Friction alone, vehicle axes, N.
    pub friction_n: Vector3<f64>,
    /// Point of application of all except the edge force: centre − r N̂, or the middle of the overlap on a solid;
    /// vehicle axes, m.
    pub point_m: Point3<f64>,
    /// Edge force, vehicle axes, N.
    pub edge_n: Vector3<f64>,
    /// Point of application of the edge force, by option `point_m` or the centre, vehicle axes, m.
    pub edge_point_m: Point3<f64>,
    /// Slip speed, m/s.
    pub slip_m_s: f64,
}

/// Value for a segment or sphere that the body does not have.
const NOWHERE: Point3<f64> = Point3::new(f64::NAN, f64::NAN, f64::NAN);

/// For a segment, sphere, joint or frame that the model does not have, every value is NaN.
impl<'a> Sample<'a> {
    /// Whether the model has a segment.
    fn has(&self, segment: Segment) -> bool {
        segment.index() < self.model.body().segments.len()
    }

    /// The same sample with the instruments and the summary of a body (index), limited to the last body.
    #[must_use]
    pub fn of_body(self, of: usize) -> Self {
        Sample { of: of.min(self.homes.len().saturating_sub(1)), ..self }
    }

    /// The same sample with all positions in axes of the first vehicle, as in pictures.
    #[must_use]
    pub fn seen_by_vehicle(self) -> Self {
        Sample { watcher: Some(self.vehicle), ..self }
    }

    /// Whether this is the last output: at the end time, or with all bodies at rest in a run that ends then.
    pub fn is_last(&self) -> bool {
        self.index + 1 == self.model.output_count() || self.progress.rest.is_over(self.time_s)
    }

    /// Motion of a frame.
    pub fn frame(&self, frame: Frame) -> FrameMotion {
        match frame {
            Frame::Vehicle => *self.vehicle,
            Frame::Space => FrameMotion::space(),
            Frame::Other(i) if i < self.model.setup().frames.len() => self.frames[frame.index(&[])].motion(),
            Frame::Segment(n) if n < self.model.body().segments.len() => self.evaluation.kinematics.moving(n).motion(),
            Frame::Other(_) | Frame::Segment(_) => FrameMotion::nowhere(),
        }
    }

    /// Frame of positions and forces on a segment.
    pub(crate) fn seen_from(&self, segment: usize) -> &'a FrameMotion {
        let of = |segment| self.model.body().tree.body_of(self.model.body().tree.segment(segment));
        self.watcher.unwrap_or_else(|| &self.homes[of(segment)])
    }

    /// Checkpoint from which the run can continue.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            index: self.index,
            time_s: self.time_s,
            state: self.state.numbers().to_vec(),
            memory: self.history.memory.clone(),
            first_touches: self.first_touches.to_vec(),
            peaks: self.step_peaks.numbers(),
            readings_before: self.fine.numbers(),
            readings: self.fine.singles(),
            events: self.switched.to_vec(),
            progress: self.progress,
            under_way: self.under_way.map(|step| step.to_start()),
        }
    }

    /// Upper and lower end of a segment, vehicle axes, m (item 1).
    pub fn end_points_m(&self, segment: Segment) -> [Point3<f64>; 2] {
        if !self.has(segment) {
            return [NOWHERE; 2];
        }
        let k = &self.evaluation.kinematics;
        let n = segment.index();
        let body = self.model.body();
        let ends = [Vector3::z() * body.segment(segment).length_m, Vector3::zeros()];
        let seen = ends.map(|end| k.axes[n].out(V3::of(&(end - body.joint_m(segment)))));
        seen.map(|end| self.place_m(n, k.joint[n] + end))
    }

    /// Centre of gravity of a segment, vehicle axes, m.
    pub fn cg_m(&self, segment: Segment) -> Point3<f64> {
        if !self.has(segment) {
            return NOWHERE;
        }
        let k = &self.evaluation.kinematics;
        self.place_m(segment.index(), k.cg(&self.model.system().skeleton, segment.index()))
    }

    /// Orientation of a segment relative to the vehicle: turns segment axes into vehicle axes.
    pub fn orientation(&self, segment: Segment) -> UnitQuaternion<f64> {
        if !self.has(segment) {
            return UnitQuaternion::new_unchecked(Quaternion::new(f64::NAN, f64::NAN, f64::NAN, f64::NAN));
        }
        let axes = self.evaluation.kinematics.axes[segment.index()].to_matrix();
        let relative = self.seen_from(segment.index()).rotation.tr_mul(&axes);
        UnitQuaternion::from_rotation_matrix(&nalgebra::Rotation3::from_matrix_unchecked(relative))
    }

    /// Centre of gravity of a whole body (index) and its velocity, space axes, m and m/s.
    pub fn centre_of_body(&self, body: usize) -> (Vector3<f64>, Vector3<f64>) {
        let (k, skeleton) = (&self.evaluation.kinematics, &self.model.system().skeleton);
        let (mut mass, mut place, mut moving) = (0.0, Vector3::zeros(), Vector3::zeros());
        for n in skeleton.layout.trunks().get(body).into_iter().flat_map(Trunk::segments) {
            let own = skeleton.links[n].mass;
            mass += own;
            place += own * k.cg(skeleton, n).to_vector();
            moving += own * k.cg_velocity(skeleton, n).to_vector();
        }
        (place / mass, moving / mass)
    }

    /// Kinematic acceleration of the centre of gravity, segment axes, m/s² (item 2).
    pub fn cg_acceleration_m_s2(&self, segment: Segment) -> Vector3<f64> {
        if !self.has(segment) {
            return NOWHERE.coords;
        }
        self.in_segment(segment, self.cg_acceleration_space(segment))
    }

    /// Reading of an accelerometer at the centre of gravity: acceleration minus gravity, segment axes, m/s² (item 2).
    pub fn specific_force_m_s2(&self, segment: Segment) -> Vector3<f64> {
        if !self.has(segment) {
            return NOWHERE.coords;
        }
        let mut a = self.cg_acceleration_space(segment);
        a.z += self.model.setup().gravity_m_s2;
        self.in_segment(segment, a)
    }

    /// Angular acceleration, segment axes, rad/s² (item 3).
    pub fn angular_acceleration_rad_s2(&self, segment: Segment) -> Vector3<f64> {
        if !self.has(segment) {
            return NOWHERE.coords;
        }
        self.in_segment(segment, self.evaluation.accelerations.alpha[segment.index()])
    }

    /// Absolute angular velocity, segment axes, rad/s (item 4).
    pub fn angular_velocity_rad_s(&self, segment: Segment) -> Vector3<f64> {
        if !self.has(segment) {
            return NOWHERE.coords;
        }
        self.in_segment(segment, self.evaluation.kinematics.omega[segment.index()])
    }

    /// Velocity of the centre of gravity, space axes, m/s.
    pub fn cg_velocity_m_s(&self, segment: Segment) -> Vector3<f64> {
        if !self.has(segment) {
            return NOWHERE.coords;
        }
        let k = &self.evaluation.kinematics;
        k.cg_velocity(&self.model.system().skeleton, segment.index()).to_vector()
    }

    /// Contact pairs (item 5).
    pub fn contacts(&self) -> impl Iterator<Item = Contact> + 'a {
        let sample = *self;
        self.touches().map(move |t| sample.contact(&t))
    }

    /// Contacts by sphere; a contact of two spheres of the body is listed with both.
    pub(crate) fn touches(&self) -> impl Iterator<Item = Touch<f64>> + use<'a> {
        let contacts = &self.model.system().forces.contacts;
        self.actions.contacts.iter().flat_map(move |touch| contacts.sides(touch))
    }

    /// Sum of contact and friction forces on a sphere, vehicle axes, N, without other elements (item 5).
    pub fn sphere_force_n(&self, sphere: usize) -> Vector3<f64> {
        if sphere >= self.model.body().spheres.len() {
            return NOWHERE.coords;
        }
        self.touches().filter(|t| t.sphere == sphere).map(|t| self.contact(&t).force_n).sum()
    }

    /// Sum of contact and friction forces of a surface or solid on all bodies, N: in axes of its carrier (vehicle or
    /// space), and for a surface on a segment in those of its body's home.
    pub(crate) fn surface_force_n(&self, surface: usize, carrier: Frame) -> Vector3<f64> {
        let force = |t: Touch<f64>| self.axes_of(t.frame).out(t.normal * t.normal_force + t.edge + t.friction);
        let space: Vector3<f64> = self.touches_of(surface).map(|t| force(t).to_vector()).sum();
        match carrier {
            Frame::Segment(segment) => self.seen_from(segment).vector_to_frame(space),
            carrier => self.frame(carrier).vector_to_frame(space),
        }
    }

    /// Largest Δ in a surface or solid, m; 0 without contact.
    pub(crate) fn surface_depth_m(&self, surface: usize) -> f64 {
        self.touches_of(surface).map(|t| t.depth).fold(0.0, f64::max)
    }

    fn touches_of(&self, surface: usize) -> impl Iterator<Item = Touch<f64>> + use<'a> {
        let contacts = &self.model.system().forces.contacts;
        self.touches().filter(move |t| contacts.surface(t.pair, t.part as usize) == surface)
    }

    /// Largest Δ of a sphere, m; 0 without contact.
    pub(crate) fn penetration_m(&self, sphere: usize) -> f64 {
        self.touches().filter(|t| t.sphere == sphere).map(|t| t.depth).fold(0.0, f64::max)
    }

    /// Force of all elements except contacts on a sphere, vehicle axes, N: of one kind (`belt`, `bag`), or of the
    /// element with one name (`lap`).
    ///
    /// # Errors
    /// No such sphere; a name that is neither that of a kind nor that of an element of the model.
    pub fn sphere_pull_n(&self, sphere: usize, of: Option<&str>) -> Result<Vector3<f64>, Unknown> {
        let spheres = &self.model.body().spheres;
        if sphere >= spheres.len() {
            return Err(Unknown::new("sphere", sphere, spheres.iter().map(|s| s.name.as_str())));
        }
        let names = of.map(|of| (of, self.model.element_names()));
        if let Some((of, names)) = names.filter(|(of, names)| names.iter().all(|name| name != of)) {
            return Err(Unknown::new("force element", of, names.into_iter()));
        }
        Ok(self.pull_n(sphere, |pull| of.is_none_or(|of| pull.of == of || pull.name == of)))
    }

    /// Sum of the selected forces on a sphere, vehicle axes, N.
    pub(crate) fn pull_n(&self, sphere: usize, is_asked: impl Fn(&Pull<'_>) -> bool) -> Vector3<f64> {
        let mut sum_n = Vector3::zeros();
        self.pulls(&mut |pull| {
            if pull.sphere == sphere && is_asked(pull) {
                sum_n += pull.force_n;
            }
        });
        sum_n
    }

    /// Centre of a sphere for contacts, vehicle axes, m.
    pub fn sphere_centre_m(&self, sphere: usize) -> Point3<f64> {
        self.sphere_under_m(sphere, Use::Contact)
    }

    /// Centre of a sphere for a use, vehicle axes, m.
    pub(crate) fn sphere_under_m(&self, sphere: usize, by: Use) -> Point3<f64> {
        let Some(site) = self.model.system().spheres.get(sphere) else { return NOWHERE };
        self.place_m(site.segment, site.place(&self.evaluation.kinematics, by).1)
    }

    /// Displacement of a sphere's centre by plates, for contacts, segment axes, m; none for a sphere that does not move
    /// with plates.
    pub fn sphere_carried_m(&self, sphere: usize) -> Option<Vector3<f64>> {
        let site = self.model.system().spheres.get(sphere)?;
        let riding = site.riding(Use::Contact).filter(|riding| riding.numbers().next().is_some())?;
        let k = &self.evaluation.kinematics;
        Some(k.axes[site.segment].into_frame(riding.carried(k)[0]).to_vector())
    }

    /// Point of application of a sphere's contact force relative to its centre, segment axes, m: the mean over the faces
    /// touched, weighted by wF (item 6). `None` without contact.
    pub fn application_point_m(&self, sphere: usize) -> Option<Vector3<f64>> {
        let site = self.model.system().spheres.get(sphere)?;
        let (mut sum, mut total) = (Vector3::zeros(), 0.0);
        for t in self.touches().filter(|t| t.sphere == sphere) {
            let normal = self.axes_of(t.frame).out(t.normal);
            let lever = self.model.system().forces.contacts.lever(&t, site.radius);
            sum -= normal.to_vector() * (lever * t.normal_force);
            total += t.normal_force;
        }
        let mean = self.evaluation.kinematics.axes[site.segment].into_frame(V3::of(&sum)).to_vector();
        (total > 0.0).then(|| mean / total)
    }

    /// β of a ball joint or α of a hinge, rad.
    pub fn joint_angle_rad(&self, joint: Joint) -> f64 {
        let joints = &self.model.system().forces.joints;
        let ball = joints.balls.iter().position(|ball| ball.joint == joint);
        let hinge = joints.hinges.iter().position(|hinge| hinge.joint == joint);
        match (ball, hinge) {
            (Some(i), _) => joints.beta(i, &self.evaluation.kinematics),
            (None, Some(i)) => self.state.hinge()[i],
            (None, None) => f64::NAN,
        }
    }

    /// The report's generalized coordinates and rates; none for a body other than the report's 12 segments.
    pub fn report_coordinates(&self) -> Option<ReportCoordinates> {
        ReportCoordinates::from_state(self.state).filter(|_| *self.model.body().tree == TTI12)
    }

    fn contact(&self, t: &Touch<f64>) -> Contact {
        let system = self.model.system();
        let site = &system.spheres[t.sphere];
        let to_vehicle = |v: V3<f64>| {
            if t.frame == self.seen_frame(site.segment) {
                v.to_vector()
            } else {
                let space = self.axes_of(t.frame).out(v).to_vector();
                self.seen_from(site.segment).vector_to_frame(space)
            }
        };
        let contacts = &system.forces.contacts;
        let (lever, surface) = (contacts.lever(t, site.radius), contacts.surface(t.pair, t.part as usize));
        let (normal, centre_m) = (to_vehicle(t.normal), self.sphere_centre_m(t.sphere));
        Contact {
            sphere: t.sphere,
            surface,
            depth_m: t.depth,
            thickness_m: contacts.thickness_m(t, &self.history.memory.contacts),
            normal_force_n: t.normal_force,
            force_n: to_vehicle(t.normal * t.normal_force + t.edge + t.friction),
            friction_n: to_vehicle(t.friction),
            point_m: centre_m - normal * lever,
            edge_n: to_vehicle(t.edge),
            edge_point_m: centre_m - normal * (lever * contacts.edge_lever),
            slip_m_s: t.slip.norm_squared().sqrt(),
        }
    }

    /// Frame in which contacts of a segment are given.
    fn seen_frame(&self, segment: usize) -> usize {
        let tree = self.model.body().tree;
        let member = self.model.setup().members.get(tree.body_of(tree.segment(segment)));
        member.filter(|_| self.watcher.is_none()).map_or(VEHICLE, |member| member.home.index(&[]))
    }

    /// Axes of a frame, or of a segment that carries faces.
    fn axes_of(&self, frame: usize) -> M3<f64> {
        let carrier = frame.checked_sub(MOST_FRAMES).map(|i| self.model.system().carriers[i]);
        carrier.map_or_else(|| self.frames[frame].axes, |segment| self.evaluation.kinematics.axes[segment])
    }

    fn cg_acceleration_space(&self, segment: Segment) -> V3<f64> {
        let e = self.evaluation;
        e.accelerations.cg(&self.model.system().skeleton, &e.kinematics, segment.index())
    }

    fn in_segment(&self, segment: Segment, v: V3<f64>) -> Vector3<f64> {
        self.evaluation.kinematics.axes[segment.index()].into_frame(v).to_vector()
    }

    fn place_m(&self, segment: usize, space: V3<f64>) -> Point3<f64> {
        self.seen_from(segment).point_to_frame(space.to_vector()).into()
    }
}
