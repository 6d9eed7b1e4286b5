//! Settling of a limp body: all joints are released until contacts, belts, springs, locks and elastic limits carry it.
//!
//! Our decision (the report has none): it rests at the minimum of the potential energy V below its seated posture,
//! without friction and damping, with muscles at rest. The degrees of freedom x are the displacement of T1, the
//! rotation of the first segment, of everything beyond a ball joint about that joint, and of everything beyond a hinge
//! about its axis. −∂V/∂x is the load there, and [`descend`] reduces V. It begins where the body has settled as one
//! piece: springs and locks are at rest there, and belts of one loop have their length and slack.

use nalgebra::{DVector, Matrix3, Vector3};

use super::descent::{Movable, descend};
use super::settle::{LEVER_M, MOST_LOOKS, Settled, loads_beyond, standing, turned_by};
use crate::forces::belt::Belts;
use crate::forces::joint::JointSystem;
use crate::forces::joint::limit::{JointLimits, LimitHistory};
use crate::forces::{Data, Element, Forces, History, Instant, Memory};
use crate::kernel::{Scratch, Situation, System};
use crate::model::setup::Setup;
use crate::motion::frame::Frames;
use crate::motion::kinematics::{Kinematics, axes};
use crate::motion::layout::{Freedom, MOST_SEGMENTS};
use crate::motion::report_coordinates::quaternion;
use crate::motion::skeleton::Skeleton;
use crate::motion::state::State;
use crate::motion::vector::V3;
use crate::vehicle::FrameMotion;
use occupant_units::trig;

/// A limp body at rest in a vehicle at rest.
struct Limp {
    system: System<f64>,
    still: Frames<f64>,
    rest: Rest,
    history: History<f64>,
    /// Trial motion, and scratch space for its evaluation.
    k: Box<Kinematics<f64>>,
    scratch: Box<Scratch<f64>>,
    /// Number of element evaluations so far.
    looks: usize,
}

/// Lets a limp body sink from the posture `seated` to rest.
pub(super) fn sink(
    setup: &Setup,
    data: &Data<'_>,
    system: &System<f64>,
    vehicle: &FrameMotion,
    seated: State<f64>,
) -> (State<f64>, Settled, Rest) {
    let still = standing(setup, vehicle);
    let rest = Rest::of(setup, data, system, &still, &seated);
    let history = History::new(&system.forces, Memory::none());
    let (k, scratch) = (Box::new(Kinematics::blank()), Box::new(Scratch::blank(system)));
    let mut limp = Limp { system: system.clone(), still, rest, history, k, scratch, looks: 0 };
    limp.system.forces.muscles.clear();
    limp.rest.keep(&mut limp.system.forces);
    let weight_n = setup.body.mass_kg() * setup.gravity_m_s2;
    let (state, g) = descend(&mut limp, &seated, weight_n);
    (state, settled(&seated, &state, &g, weight_n), limp.rest)
}

/// State of springs, locks and belts in the seated posture.
pub(super) struct Rest {
    belts: <Belts as Element>::Law<f64>,
    joints: JointSystem<f64>,
    limits: Vec<LimitHistory<f64>>,
}

impl Rest {
    fn of(setup: &Setup, data: &Data<'_>, system: &System<f64>, still: &Frames<f64>, seated: &State<f64>) -> Self {
        let skeleton = Skeleton::new(&setup.body, 0.0);
        let k = Kinematics::new(&skeleton, seated);
        let law = JointSystem::new(data.joints, &skeleton, |_| 0.0);
        let at =
            Instant { k: &k, state: seated, frames: still, carried: &[], spheres: &system.spheres, accepted: false };
        let mut belts = system.forces.belts.clone();
        Belts::lay(&mut belts, data.belts, &setup.body, &at);
        Rest {
            belts,
            joints: JointSystem::new(data.joints, &skeleton, |i| law.beta(i, &k)),
            limits: JointLimits::start(&system.forces.limits, &at),
        }
    }

    /// Restores it for a body in another position; must be called before any memory of that position is set.
    pub(super) fn keep(&self, forces: &mut Forces<f64>) {
        forces.belts.clone_from(&self.belts);
        forces.joints = self.joints.clone();
    }

    /// Makes locks hold the seated posture.
    pub(super) fn hold(&self, history: &mut History<f64>) {
        history.memory.limits.iter_mut().zip(&self.limits).for_each(|(past, seated)| past.hold_as(seated));
    }
}

impl Movable for Limp {
    /// ∂V/∂x at a position, in the order of [`moved`]: N, and N·m over the lever.
    fn gradient(&mut self, state: &State<f64>) -> DVector<f64> {
        let Limp { system, still, rest, history, k, scratch, looks } = self;
        k.follow(&system.skeleton, state, None);
        let at = Instant { k, state, frames: still, carried: &[], spheres: &system.spheres, accepted: false };
        *looks += system.forces.restart(&at, history);
        rest.hold(history);
        let (k, loads) = system.loads(scratch, Situation::within(state, still), history);
        let loads = loads_beyond(&system.skeleton, k, loads);
        let mut g = Vec::with_capacity(6 + 3 * MOST_SEGMENTS);
        g.extend([loads[0].force.x, loads[0].force.y, loads[0].force.z]);
        for (row, load) in system.skeleton.layout.rows().iter().zip(&loads) {
            let turning = load.moment * (1.0 / LEVER_M);
            match row.freedom {
                Freedom::Hinges(_) => g.extend(row.hinges().map(|hinge| k.hinge_axis[hinge].dot(turning))),
                _ => g.extend([turning.x, turning.y, turning.z]),
            }
        }
        -DVector::from_vec(g)
    }

    fn moved(&self, state: &State<f64>, x: &DVector<f64>) -> State<f64> {
        moved(&self.system.skeleton, state, x)
    }

    fn is_spent(&self) -> bool {
        self.looks > 2 * MOST_LOOKS
    }
}

/// Outcome of sinking from the state `seated`.
pub(super) fn settled(seated: &State<f64>, state: &State<f64>, g: &DVector<f64>, weight_n: f64) -> Settled {
    let [from, to] = [seated, state].map(|state| axes(&state.orientation(0)).to_matrix());
    let turn = quaternion(&(to * from.transpose()));
    Settled {
        moved_m: (state.t1() - seated.t1()).norm_squared().sqrt(),
        turned_rad: 2.0 * trig::atan2(turn.v.norm_squared().sqrt(), turn.w.abs()),
        residual_force_n: g.rows(0, 3).norm(),
        residual_moment_n_m: g.rows_range(3..).amax() * LEVER_M,
        weight_n,
        lack: None,
    }
}

/// Body with T1 moved by x[0..3] (m) and each joint turned by the following values (rad times the lever), with all that
/// is distal to it.
fn moved(skeleton: &Skeleton<f64>, state: &State<f64>, x: &DVector<f64>) -> State<f64> {
    let (k, mut out) = (Kinematics::new(skeleton, state), *state);
    out.set_t1(state.t1() + V3 { x: x[0], y: x[1], z: x[2] });
    let mut turns = [Matrix3::<f64>::identity(); MOST_SEGMENTS];
    let mut angles = x.iter().skip(3).map(|x| x / LEVER_M);
    let mut next = || angles.next().unwrap_or_default();
    for (n, row) in skeleton.layout.rows().iter().enumerate() {
        let carried = row.parent.map_or(Matrix3::identity(), |parent| turns[parent]);
        if let Freedom::Hinges(_) = row.freedom {
            turns[n] = row.hinges().fold(carried, |turn, hinge| {
                let angle = next();
                out.hinge_mut()[hinge] += angle;
                turn * turned_by(&(k.hinge_axis[hinge].to_vector() * angle))
            });
        } else {
            turns[n] = carried * turned_by(&Vector3::new(next(), next(), next()));
            out.set_orientation(row.slot, quaternion(&(turns[n] * k.axes[n].to_matrix())));
        }
    }
    out
}
