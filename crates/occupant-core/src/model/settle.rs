//! Settling: the seated body moves as one piece until contacts and belts carry it. With `limp` its joints are released
//! too.
//!
//! Our decision (the report has none): joints locked, posture kept; the six degrees of freedom of the rigid body are
//! found by a damped quasi-Newton iteration on the resultant force and moment of contacts, belts and weight, every
//! contact on its loading curve, at rest relative to the vehicle. Directions without resistance, and those that
//! friction holds, stay unchanged. If this finds no rest, for example because the feet do not yet reach the floor, the
//! body descends in potential energy until something carries it.

use std::mem::take;

use nalgebra::{DVector, Matrix3, Matrix6, Vector3, Vector6};
use serde::{Serialize, Serializer};

use crate::body::Body;
use crate::forces::joint::JointMoments;
use crate::forces::joint::limit::JointLimits;
use crate::forces::joint::muscle::Muscles;
use crate::forces::{Data, Element, History, Instant, Memory};
use crate::kernel::{Scratch, Situation, System};
use crate::model::descent::{Movable, REST, descend};
use crate::model::frames;
use crate::model::limp;
use crate::model::setup::Setup;
use crate::motion::dynamics::Wrench;
use crate::motion::frame::Frames;
use crate::motion::kinematics::Kinematics;
use crate::motion::layout::{Freedom, MOST_SEGMENTS};
use crate::motion::report_coordinates::quaternion;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::State;
use crate::motion::vector::{V3, v3};
use crate::vehicle::FrameMotion;
use occupant_units::trig;
use placed_text::Problems;

/// Lever that converts moments to comparable forces, m.
pub(super) const LEVER_M: f64 = 0.3;
/// Largest number of iterations.
const ITERATIONS: usize = 200;
/// Fraction of the load left by a step above which the slopes are computed anew.
const POOR: f64 = 0.5;
/// Displacement for difference quotients, m.
const DIFFERENCE_M: f64 = 1e-6;
/// Fraction of the load left by a step within [`DIFFERENCE_M`] above which the load jumps there: nothing is gained.
const STUCK: f64 = 0.999;
/// Largest number of element evaluations in search of rest: about a second's work. The remaining load is reported as
/// usual.
pub(super) const MOST_LOOKS: usize = 2_000_000;

/// Outcome of settling.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Settled {
    /// Displacement of T1, m.
    pub moved_m: f64,
    /// Rotation of the body, rad.
    #[serde(rename = "turned_deg", serialize_with = "in_degrees")]
    pub turned_rad: f64,
    /// Remaining force, N.
    pub residual_force_n: f64,
    /// Remaining moment about T1, N·m.
    pub residual_moment_n_m: f64,
    /// Weight of the body, N.
    pub weight_n: f64,
    /// Joint with the largest moment missing to hold the posture, of a body whose joints can hold any.
    pub lack: Option<Lack>,
}

/// Moment missing in a joint at the start to hold the posture: without it, the body sags.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Lack {
    /// Name of the joint.
    pub joint: &'static str,
    /// Moment beyond that of its springs, limits, locks and muscles, N·m.
    pub moment_n_m: f64,
}

fn in_degrees<S: Serializer>(angle_rad: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_f64(angle_rad.to_degrees())
}

impl Settled {
    /// Time for which a remaining load affects the results of a run, s.
    pub const FADES_S: f64 = 0.05;

    /// Whether the remaining load, above a tenth of the weight, affects results.
    pub fn is_unbalanced(&self) -> bool {
        self.residual_force_n > 0.1 * self.weight_n
    }

    /// Warns if the body is not at rest.
    pub(crate) fn warn(&self, problems: &mut Problems) {
        if self.residual_force_n > 0.01 * self.weight_n || self.residual_moment_n_m > 0.01 * self.weight_n * LEVER_M {
            problems.warning(
                "posture.settle",
                format!(
                    "the body does not come to rest: {:.1} N and {:.1} N·m remain, for a weight of {:.1} N",
                    self.residual_force_n, self.residual_moment_n_m, self.weight_n
                ),
                "a posture that seat, floor and belts can carry with locked joints",
            );
        }
    }
}

/// Remaining load in the present position.
pub(crate) fn kept(
    setup: &Setup,
    data: &Data<'_>,
    system: &mut System<f64>,
    vehicle: &FrameMotion,
    state: &State<f64>,
) -> Settled {
    settled(setup, &Vector6::zeros(), &Resting::new(setup, *data, system, vehicle).load(state))
}

fn settled(setup: &Setup, x: &Vector6<f64>, r: &Vector6<f64>) -> Settled {
    Settled {
        moved_m: x.fixed_rows::<3>(0).norm(),
        turned_rad: (x.fixed_rows::<3>(3) / LEVER_M).norm(),
        residual_force_n: r.fixed_rows::<3>(0).norm(),
        residual_moment_n_m: r.fixed_rows::<3>(3).norm() * LEVER_M,
        weight_n: setup.body.mass_kg() * setup.gravity_m_s2,
        lack: None,
    }
}

/// Search range above and below the given position of a standing body, m.
const STAND_M: f64 = 0.5;
/// First search step, m: less than the penetration at which a foot is behind a surface.
const STAND_STEP_M: f64 = 0.005;

/// Raises or lowers `state` until the ground carries its weight; both feet share it if they reach down equally far.
pub(crate) fn stand(
    setup: &Setup,
    data: &Data<'_>,
    system: &mut System<f64>,
    vehicle: &FrameMotion,
    state: State<f64>,
    problems: &mut Problems,
) -> State<f64> {
    let mut body = Resting::new(setup, *data, system, vehicle);
    let raised = |by_m: f64| {
        let mut raised = state;
        raised.set_t1(state.t1() + v3(0.0, 0.0, by_m));
        raised
    };
    let mut lift = |by_m: f64| body.load(&raised(by_m))[2];
    // from above: far behind a surface nothing carries
    let steps = (2.0 * STAND_M / STAND_STEP_M) as i32;
    let carried = (0..=steps).map(|i| STAND_M - STAND_STEP_M * f64::from(i)).find(|by_m| lift(*by_m) > 0.0);
    let (mut low, mut high) = (carried.unwrap_or(0.0), carried.unwrap_or(0.0) + STAND_STEP_M);
    if setup.gravity_m_s2 == 0.0 || carried.is_none() {
        let found = format!("nothing within {STAND_M} m below or above the feet that carries the body");
        problems.error("posture.stance", found, "`[ground]`, or surfaces under the feet");
        return state;
    }
    while high - low > 1e-12 {
        let middle = 0.5 * (low + high);
        if lift(middle) > 0.0 { low = middle } else { high = middle }
    }
    raised(0.5 * (low + high))
}

/// Moves `state` as a rigid body until contacts and belts balance its weight.
pub(crate) fn settle(
    setup: &Setup,
    data: &Data<'_>,
    system: &mut System<f64>,
    vehicle: &FrameMotion,
    state: State<f64>,
) -> (State<f64>, Settled) {
    let weight_n = setup.body.mass_kg() * setup.gravity_m_s2;
    let mut body = Resting::new(setup, *data, system, vehicle);
    let r = body.load(&state);
    let free = not_held(&r, weight_n, vehicle);
    let (x, r) = balanced(free * r, 1e-9 * weight_n.max(1.0), |x| {
        let load = free * body.load(&moved(&state, &(free * x)));
        (body.looks <= MOST_LOOKS).then_some(load)
    });
    let (end, found) = (moved(&state, &x), settled(setup, &x, &r));
    let lower = || lowered(Locked { body, free }, &state, weight_n);
    let rests = r.amax() < REST * weight_n.max(1.0);
    if rests { None } else { lower() }.unwrap_or((end, found))
}

/// Damped Newton iteration from x = 0, with load `r`, until the load is less than `enough`, N: the position and its
/// load; it ends where `load` is undefined. Difference quotients give the slopes where none are known, or where the
/// known ones lead nowhere. `free` projects steps on to the permitted directions.
fn balanced(
    mut r: Vector6<f64>,
    enough: f64,
    mut load: impl FnMut(&Vector6<f64>) -> Option<Vector6<f64>>,
) -> (Vector6<f64>, Vector6<f64>) {
    let (mut x, mut damping, mut known, mut is_fresh) = (Vector6::zeros(), 1e-3, None, true);
    for _ in 0..ITERATIONS {
        if r.norm() < enough {
            break;
        }
        is_fresh |= known.is_none();
        let Some(j) = known.take().or_else(|| slopes(&x, &r, &mut load)) else { break };
        let Some(step) = step(&j, &r, damping) else { break };
        let Some(next) = load(&(x + step)) else { break };
        let gain = next.norm() / r.norm();
        if gain < 1.0 {
            let corrected = j + (next - r - j * step) * step.transpose() / step.norm_squared();
            (known, is_fresh) = ((gain < POOR).then_some(corrected), false);
            (x, r, damping) = (x + step, next, (damping * 0.1).max(1e-12));
            if gain > STUCK && step.norm() < DIFFERENCE_M {
                break;
            }
        } else if is_fresh {
            if damping > 1e9 {
                break;
            }
            (known, damping) = (Some(j), damping * 4.0);
        }
    }
    (x, r)
}

/// Descent to rest, m, and rotation, rad, beyond which a body counts as fallen from its seat.
const FALLS: [f64; 2] = [0.3, 0.5];

/// Body at rest below its `seated` position, if it rests near it.
fn lowered(mut body: Locked<'_, '_>, seated: &State<f64>, weight_n: f64) -> Option<(State<f64>, Settled)> {
    let (state, g) = descend(&mut body, seated, weight_n);
    let found = limp::settled(seated, &state, &g, weight_n);
    let rests = g.amax() < REST * weight_n.max(1.0);
    (rests && found.moved_m < FALLS[0] && found.turned_rad < FALLS[1]).then_some((state, found))
}

/// A body with locked joints, moved by loads that friction does not hold.
struct Locked<'s, 'd> {
    body: Resting<'s, 'd>,
    free: Matrix6<f64>,
}

impl Movable for Locked<'_, '_> {
    fn gradient(&mut self, state: &State<f64>) -> DVector<f64> {
        let load = self.free * self.body.load(state);
        -DVector::from_iterator(6, load.iter().copied())
    }

    fn moved(&self, state: &State<f64>, x: &DVector<f64>) -> State<f64> {
        moved(state, &(self.free * Vector6::from_iterator(x.iter().copied())))
    }

    fn is_spent(&self) -> bool {
        self.body.looks > 2 * MOST_LOOKS
    }
}

/// Fraction of the weight that friction holds sideways: less than that of any seat.
const HELD: f64 = 0.1;

/// Projector on to the freedoms that friction does not hold: all but sideways motion and yaw, where their loads are
/// negligible. Otherwise the few newtons of a retractor's spool would turn a body by 6 degrees.
fn not_held(load: &Vector6<f64>, weight_n: f64, vehicle: &FrameMotion) -> Matrix6<f64> {
    let (mut sideways, mut turning) = (Vector6::zeros(), Vector6::zeros());
    sideways.fixed_rows_mut::<3>(0).copy_from(&vehicle.rotation.column(1));
    turning.fixed_rows_mut::<3>(3).copy_from(&vehicle.rotation.column(2));
    let is_held = [sideways, turning].iter().all(|along| along.dot(load).abs() < HELD * weight_n);
    let held = sideways * sideways.transpose() + turning * turning.transpose();
    if is_held { Matrix6::identity() - held } else { Matrix6::identity() }
}

/// Step limited to 2 cm (or the equivalent rotation): the forces are stiff and only piecewise smooth.
fn limited(step: Vector6<f64>) -> Vector6<f64> {
    let norm = step.norm();
    if norm > 0.02 { step * (0.02 / norm) } else { step }
}

/// Body moved by x[0..3] (m) and turned about T1 by the rotation vector x[3..6]/lever.
fn moved(state: &State<f64>, x: &Vector6<f64>) -> State<f64> {
    let turn = turned_by(&(x.fixed_rows::<3>(3) / LEVER_M));
    let mut out = *state;
    out.set_t1(state.t1() + V3::of(&x.fixed_rows::<3>(0).into()));
    for slot in state.turns() {
        let axes = crate::motion::kinematics::axes(&state.orientation(slot)).to_matrix();
        out.set_orientation(slot, quaternion(&(turn * axes)));
    }
    out
}

/// Rotation by a rotation vector (rad).
pub(super) fn turned_by(vector: &Vector3<f64>) -> Matrix3<f64> {
    let angle = vector.norm();
    if angle == 0.0 {
        return Matrix3::identity();
    }
    let (sine, cosine) = trig::sin_cos(angle);
    let cross = (vector / angle).cross_matrix();
    Matrix3::identity() + cross * sine + cross * cross * (1.0 - cosine)
}

/// A body tried in one position after another, at rest relative to the vehicle. What acts between segments moves no
/// body whose joints are locked: it is taken out of the system until the end.
struct Resting<'s, 'd> {
    setup: &'s Setup,
    data: Data<'d>,
    system: &'s mut System<f64>,
    within: Within,
    still: Frames<f64>,
    history: History<f64>,
    /// Trial motion, and scratch space for its evaluation.
    k: Box<Kinematics<f64>>,
    scratch: Box<Scratch<f64>>,
    /// Number of element evaluations so far.
    looks: usize,
}

impl<'s, 'd> Resting<'s, 'd> {
    fn new(setup: &'s Setup, data: Data<'d>, system: &'s mut System<f64>, vehicle: &FrameMotion) -> Self {
        let still = standing(setup, vehicle);
        let within = swap_within(system, Within::default());
        let history = History::new(&system.forces, Memory::none());
        let (k, scratch) = (Box::new(Kinematics::blank()), Box::new(Scratch::blank(system)));
        Resting { setup, data, system, within, still, history, k, scratch, looks: 0 }
    }

    /// Resultant force (N) and moment about T1 over the lever (N) of contacts, belts and weight, with belts laid
    /// accordingly.
    fn load(&mut self, state: &State<f64>) -> Vector6<f64> {
        let Resting { setup, data, system, still, history, k, scratch, looks, .. } = self;
        k.follow(&system.skeleton, state, None);
        let at = Instant { k, state, frames: still, carried: &[], spheres: &system.spheres, accepted: false };
        system.forces.lay(data, &setup.body, &at);
        *looks += system.forces.restart(&at, history);
        let (_, loads) = system.loads(scratch, Situation::within(state, still), history);
        let (mut force, mut moment) = (V3::zero(), V3::zero());
        for (n, (wrench, link)) in loads.iter().zip(&system.skeleton.links).enumerate() {
            let weight = V3 { x: 0.0, y: 0.0, z: -link.mass * system.skeleton.gravity };
            force += wrench.force + weight;
            moment += wrench.moment + (k.joint[n] - state.t1()).cross(wrench.force);
            moment += (k.cg(&system.skeleton, n) - state.t1()).cross(weight);
        }
        let lever = 1.0 / LEVER_M;
        Vector6::new(force.x, force.y, force.z, moment.x * lever, moment.y * lever, moment.z * lever)
    }
}

impl Drop for Resting<'_, '_> {
    fn drop(&mut self) {
        swap_within(self.system, take(&mut self.within));
    }
}

/// Joints, their limits and muscles.
type Within = (<JointMoments as Element>::Law<f64>, <JointLimits as Element>::Law<f64>, <Muscles as Element>::Law<f64>);

/// Puts other joints, limits and muscles into a system, and returns those that it had.
fn swap_within(system: &mut System<f64>, within: Within) -> Within {
    let forces = &mut system.forces;
    let had = (take(&mut forces.joints), take(&mut forces.limits), take(&mut forces.muscles));
    (forces.joints, forces.limits, forces.muscles) = within;
    had
}

/// All frames in their initial positions at rest: no friction, no damping.
pub(super) fn standing(setup: &Setup, vehicle: &FrameMotion) -> Frames<f64> {
    let start_s = setup.time.start_s;
    let mut still = frames(start_s, &vehicle.held());
    setup.place_frames(&mut still, start_s);
    for frame in &mut still.moving {
        (frame.velocity, frame.omega) = (V3::zero(), V3::zero());
        (frame.acceleration, frame.alpha) = (V3::zero(), V3::zero());
    }
    still
}

/// Sets the moments that muscles carry at the start, for a settled body at rest in frames at rest.
pub(crate) fn carry(system: &mut System<f64>, state: &State<f64>, still: &Frames<f64>, history: &History<f64>) {
    let mut scratch = Scratch::blank(system);
    let (k, loads) = system.loads(&mut scratch, Situation::within(state, still), &mut history.clone());
    let loads = loads_beyond(&system.skeleton, k, loads);
    for muscle in &mut system.forces.muscles {
        muscle.carry(k, |outer| -turning(&system.skeleton, k, &loads, outer));
    }
}

/// Joint of a resting body with the largest moment missing to hold its posture; none if all hold it.
pub(super) fn lack(
    system: &System<f64>,
    body: &Body,
    state: &State<f64>,
    still: &Frames<f64>,
    history: &History<f64>,
) -> Option<Lack> {
    let mut scratch = Scratch::blank(system);
    let (k, loads) = system.loads(&mut scratch, Situation::within(state, still), &mut history.clone());
    let loads = loads_beyond(&system.skeleton, k, loads);
    let lacks = body.tree.segments().filter_map(|segment| {
        let moment = turning(&system.skeleton, k, &loads, segment.index());
        Some(Lack { joint: body.tree[body.tree.bearer(segment)?].name, moment_n_m: moment.norm_squared().sqrt() })
    });
    lacks.max_by(|a, b| a.moment_n_m.total_cmp(&b.moment_n_m)).filter(|lack| lack.moment_n_m > 0.0)
}

/// Force and moment at the proximal joint of each segment of a resting body from the loads on it and all that is
/// distal, N and N·m.
pub(super) fn loads_beyond(
    skeleton: &Skeleton<f64>,
    k: &Kinematics<f64>,
    loads: &[Wrench<f64>; MOST_SEGMENTS],
) -> [Wrench<f64>; MOST_SEGMENTS] {
    let mut loads = *loads;
    for (n, row) in skeleton.layout.rows().iter().enumerate().rev() {
        let weight = v3(0.0, 0.0, -skeleton.links[n].mass * skeleton.gravity);
        loads[n].force += weight;
        loads[n].moment += (k.cg(skeleton, n) - k.joint[n]).cross(weight);
        if let Some(parent) = row.parent {
            let Wrench { force, moment } = loads[n];
            loads[parent].force += force;
            loads[parent].moment += moment + (k.joint[n] - k.joint[parent]).cross(force);
        }
    }
    loads
}

/// Part of the moment on the distal body that turns the joint: the rest, of a pin, is carried by the segments.
fn turning(
    skeleton: &Skeleton<f64>,
    k: &Kinematics<f64>,
    loads: &[Wrench<f64>; MOST_SEGMENTS],
    outer: usize,
) -> V3<f64> {
    let moment = loads[outer].moment;
    match skeleton.layout.rows()[outer].freedom {
        Freedom::Hinges(_) => {
            let axes = skeleton.layout.rows()[outer].hinges().map(|hinge| k.hinge_axis[hinge]);
            axes.fold(V3::zero(), |sum, axis| sum + axis * axis.dot(moment))
        }
        _ => moment,
    }
}

/// −(JᵀJ + λ1)⁻¹Jᵀr, limited in length.
fn step(j: &Matrix6<f64>, r: &Vector6<f64>, damping: f64) -> Option<Vector6<f64>> {
    let normal = j.tr_mul(j);
    let shift = Matrix6::from_diagonal_element(damping * normal.diagonal().max() + 1e-9);
    (normal + shift).lu().solve(&j.tr_mul(r)).map(|s| limited(-s))
}

/// Difference quotients over a thousandth of a millimetre (or the equivalent rotation) from x, with the load `r` there.
fn slopes(
    x: &Vector6<f64>,
    r: &Vector6<f64>,
    load: &mut impl FnMut(&Vector6<f64>) -> Option<Vector6<f64>>,
) -> Option<Matrix6<f64>> {
    let mut j = Matrix6::zeros();
    for i in 0..6 {
        let mut beside = *x;
        beside[i] += DIFFERENCE_M;
        j.set_column(i, &((load(&beside)? - r) / DIFFERENCE_M));
    }
    Some(j)
}

#[cfg(test)]
mod tests;
