//! Trees of any shape, and their motion by Newton's and Euler's equations of every segment alone: each joint is a set of
//! constraints with a multiplier each, and all accelerations and multipliers come from one dense system. Nothing of it is
//! the simulator's but the data.

use crate::random::Random;
use nalgebra::{DMatrix, DVector, Matrix3, Rotation3, Unit, UnitQuaternion, Vector3};
use occupant_core::forces::{Forces, History, Memory};
use occupant_core::kernel::System;
use occupant_core::motion::layout::{Axis, Freedom, Layout, MOST_OF_TREE};
use occupant_core::motion::skeleton::{Part, Skeleton};
use occupant_core::motion::state::{Quat, Shape, State};
use occupant_core::motion::vector::{V3, v3};

/// A kernel with nothing but a tree.
pub fn bare(skeleton: Skeleton<f64>) -> (System<f64>, History<f64>) {
    let forces = Forces::none();
    let history = History::new(&forces, Memory::none());
    (System::new(skeleton, Vec::new(), forces), history)
}

/// A tree by its rows.
#[derive(Clone, Debug)]
pub struct AnyTree {
    /// The segment that carries each, and the freedom of its joint.
    pub rows: Vec<(Option<usize>, Freedom)>,
    /// What they are made of.
    pub parts: Vec<Part>,
    /// g, m/s².
    pub gravity: f64,
}

/// Motion or acceleration of a segment, space axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rates {
    /// Of its joint.
    pub joint: Vector3<f64>,
    /// Angular.
    pub turn: Vector3<f64>,
}

/// Where a segment is and how it moves, space axes.
#[derive(Clone, Debug)]
pub struct Pose {
    /// Its joint.
    pub joint: Vector3<f64>,
    /// Its axes.
    pub axes: Matrix3<f64>,
    /// Velocities.
    pub rates: Rates,
    /// Axes and rates of its joint's hinges, from the inside to the outside.
    hinges: Vec<(Vector3<f64>, f64)>,
}

/// Every freedom that a joint can have.
const JOINTS: [Freedom; 8] = [
    Freedom::Ball,
    Freedom::Hinges(&[]),
    Freedom::Hinges(&[Axis::X]),
    Freedom::Hinges(&[Axis::Y]),
    Freedom::Hinges(&[Axis::Z]),
    Freedom::Hinges(&[Axis::Y, Axis::X]),
    Freedom::Hinges(&[Axis::X, Axis::Z]),
    Freedom::Hinges(&[Axis::Z, Axis::Y]),
];

fn unit(axis: Axis) -> Unit<Vector3<f64>> {
    match axis {
        Axis::X => Vector3::x_axis(),
        Axis::Y => Vector3::y_axis(),
        Axis::Z => Vector3::z_axis(),
    }
}

fn axes_of(freedom: Freedom) -> &'static [Axis] {
    if let Freedom::Hinges(axes) = freedom { axes } else { &[] }
}

impl AnyTree {
    /// A tree of `count` segments on a root of this freedom.
    pub fn random(random: &mut Random, count: usize, root: Freedom) -> AnyTree {
        let mut rows = vec![(None, root)];
        let mut hinges = 0;
        while rows.len() < count {
            let freedom = JOINTS[random.bits() as usize % JOINTS.len()];
            if hinges + axes_of(freedom).len() <= MOST_OF_TREE {
                hinges += axes_of(freedom).len();
                rows.push((Some(random.bits() as usize % rows.len()), freedom));
            }
        }
        AnyTree { parts: (0..count).map(|_| part(random)).collect(), rows, gravity: 9.806_65 }
    }

    /// For the simulator.
    pub fn layout(&self) -> Layout {
        Layout::new(&self.rows).unwrap()
    }

    /// For the simulator.
    pub fn skeleton(&self) -> Skeleton<f64> {
        Skeleton::of(self.layout(), &self.parts, self.gravity)
    }

    /// Everything turned and turning.
    pub fn state(&self, random: &mut Random) -> State<f64> {
        let mut state = State::zero(Shape::of(&self.layout()));
        state.set_t1(V3::of(&random.vector(1.0)));
        state.set_velocity(V3::of(&random.vector(3.0)));
        for slot in state.turns() {
            let q = random.turn();
            state.set_orientation(slot, Quat { w: q.w, v: v3(q.i, q.j, q.k) });
            state.set_omega(slot, V3::of(&random.vector(5.0)));
        }
        state.hinge_mut().iter_mut().for_each(|angle| *angle = random.between(-2.0, 2.0));
        state.hinge_rate_mut().iter_mut().for_each(|rate| *rate = random.between(-5.0, 5.0));
        state
    }

    /// Poses of all segments.
    pub fn poses(&self, state: &State<f64>) -> Vec<Pose> {
        let mut poses: Vec<Pose> = Vec::new();
        let (mut slot, mut hinge) = (0, 0);
        for (&(parent, freedom), part) in self.rows.iter().zip(&self.parts) {
            let carrier = parent.map(|parent: usize| poses[parent].clone());
            let (joint, velocity) = match &carrier {
                None => (state.t1().to_vector(), state.velocity().to_vector()),
                Some(carrier) => {
                    let arm = carrier.axes * part.joint_m;
                    (carrier.joint + arm, carrier.rates.joint + carrier.rates.turn.cross(&arm))
                }
            };
            let mut hinges = Vec::new();
            let (axes, turn) = if let (Freedom::Hinges(list), Some(carrier)) = (freedom, carrier) {
                let (mut triad, mut turn) = (carrier.axes * part.triads[0], carrier.rates.turn);
                for axis in list {
                    let (angle, rate) = (state.hinge()[hinge], state.hinge_rate()[hinge]);
                    hinges.push((triad * unit(*axis).into_inner(), rate));
                    turn += hinges[hinges.len() - 1].0 * rate;
                    triad *= Rotation3::from_axis_angle(&unit(*axis), angle).into_inner();
                    hinge += 1;
                }
                (triad * part.triads[1].transpose(), turn)
            } else {
                let q = state.orientation(slot);
                let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(q.w, q.v.x, q.v.y, q.v.z));
                slot += 1;
                (q.to_rotation_matrix().into_inner(), state.omega(slot - 1).to_vector())
            };
            poses.push(Pose { joint, axes, rates: Rates { joint: velocity, turn }, hinges });
        }
        poses
    }

    /// Accelerations under forces at the joints and moments about them, space axes; of a guided root they are given.
    pub fn accelerations(&self, poses: &[Pose], loads: &[(Vector3<f64>, Vector3<f64>)], guide: Rates) -> Vec<Rates> {
        let mut dense = Dense::new(poses.len());
        for (n, (pose, part)) in poses.iter().zip(&self.parts).enumerate() {
            let (arm, omega) = (pose.axes * part.cg_m, pose.rates.turn);
            let inertia = pose.axes * part.inertia_kg_m2 * pose.axes.transpose();
            let (force, moment) = loads[n];
            let weight = Vector3::z() * (-self.gravity * part.mass_kg);
            dense.body(
                n,
                part.mass_kg,
                &inertia,
                force + weight,
                moment - arm.cross(&force) - omega.cross(&(inertia * omega)),
            );
        }
        for (n, &(parent, freedom)) in self.rows.iter().enumerate() {
            let at_joint = |n: usize, joint: Vector3<f64>| {
                let (pose, part) = (&poses[n], &self.parts[n]);
                let arm = joint - (pose.joint + pose.axes * part.cg_m);
                let w = pose.rates.turn;
                (n, arm, w.cross(&w.cross(&arm)))
            };
            let own = at_joint(n, poses[n].joint);
            match (parent, freedom) {
                (None, Freedom::Guided) => {
                    dense.hold(own, None, guide.joint);
                    (0..3).for_each(|i| dense.lock(n, None, Vector3::ith(i, 1.0), guide.turn));
                }
                (Some(parent), _) => {
                    let other = at_joint(parent, poses[n].joint);
                    dense.hold(own, Some(other), Vector3::zeros());
                    if matches!(freedom, Freedom::Hinges(_)) {
                        self.lock_hinges(&mut dense, poses, n, parent);
                    }
                }
                (None, _) => {}
            }
        }
        let found = dense.solve();
        let rates = |n: usize| {
            let (pose, part) = (&poses[n], &self.parts[n]);
            let (at_cg, alpha, w) = (found[n].joint, found[n].turn, pose.rates.turn);
            let arm = -(pose.axes * part.cg_m);
            Rates { joint: at_cg + alpha.cross(&arm) + w.cross(&w.cross(&arm)), turn: alpha }
        };
        (0..poses.len()).map(rates).collect()
    }

    /// α_n − α_parent = Σ u q̈ + Σ ω × u q̇, ω what turns each axis: no part across all axes is free.
    fn lock_hinges(&self, dense: &mut Dense, poses: &[Pose], n: usize, parent: usize) {
        let mut omega = poses[parent].rates.turn;
        let mut drift = Vector3::zeros();
        for &(axis, rate) in &poses[n].hinges {
            drift += omega.cross(&axis) * rate;
            omega += axis * rate;
        }
        let mut directions = vec![Vector3::x(), Vector3::y(), Vector3::z()];
        match poses[n].hinges[..] {
            [] => {}
            [(axis, _)] => {
                let one = axis.cross(&Vector3::ith(axis.iamin(), 1.0)).normalize();
                directions = vec![one, axis.cross(&one)];
            }
            [(first, _), (second, _), ..] => directions = vec![first.cross(&second)],
        }
        directions.into_iter().for_each(|along| dense.lock(n, Some(parent), along, drift));
    }
}

/// A part with possible inertias whose principal axes, joint and triads lie anyhow.
fn part(random: &mut Random) -> Part {
    let turn = |random: &mut Random| random.turn().to_rotation_matrix().into_inner();
    let principal = turn(random);
    let spread = Vector3::from_fn(|_, _| random.between(0.002, 0.05));
    let inertia = Matrix3::from_diagonal(&(Vector3::repeat(spread.sum()) - spread));
    Part {
        mass_kg: random.between(0.5, 8.0),
        cg_m: random.vector(0.15),
        inertia_kg_m2: principal * inertia * principal.transpose(),
        joint_m: random.vector(0.4),
        triads: [turn(random), turn(random)],
    }
}

/// Rows of equations: accelerations of the centres of gravity and angular ones, then multipliers.
struct Dense {
    count: usize,
    matrix: DMatrix<f64>,
    right: DVector<f64>,
    used: usize,
}

/// A point of a segment, seen from its centre of gravity, and its acceleration when nothing accelerates but by turning.
type At = (usize, Vector3<f64>, Vector3<f64>);

impl Dense {
    fn new(count: usize) -> Dense {
        let size = 12 * count;
        Dense { count, matrix: DMatrix::zeros(size, size), right: DVector::zeros(size), used: 6 * count }
    }

    fn body(&mut self, n: usize, mass: f64, inertia: &Matrix3<f64>, force: Vector3<f64>, moment: Vector3<f64>) {
        self.matrix.fixed_view_mut::<3, 3>(6 * n, 6 * n).copy_from(&(Matrix3::identity() * mass));
        self.matrix.fixed_view_mut::<3, 3>(6 * n + 3, 6 * n + 3).copy_from(inertia);
        self.right.fixed_rows_mut::<3>(6 * n).copy_from(&force);
        self.right.fixed_rows_mut::<3>(6 * n + 3).copy_from(&moment);
    }

    /// A constraint Σ (l·a + m·α) = `right`, whose multiplier acts as force l and moment m.
    fn constrain(&mut self, terms: &[(usize, Vector3<f64>, Vector3<f64>)], right: f64) {
        let row = self.used;
        self.used += 1;
        for (n, linear, angular) in terms {
            for i in 0..3 {
                for (column, value) in [(6 * n + i, linear[i]), (6 * n + 3 + i, angular[i])] {
                    self.matrix[(row, column)] += value;
                    self.matrix[(column, row)] -= value;
                }
            }
        }
        self.right[row] = right;
    }

    /// Two points stay together, or one accelerates as given.
    fn hold(&mut self, (n, arm, centripetal): At, other: Option<At>, given: Vector3<f64>) {
        for i in 0..3 {
            let along: Vector3<f64> = Vector3::ith(i, 1.0);
            let mut terms = vec![(n, along, arm.cross(&along))];
            let mut right = given[i] - centripetal[i];
            if let Some((m, arm, centripetal)) = other {
                terms.push((m, -along, -arm.cross(&along)));
                right += centripetal[i];
            }
            self.constrain(&terms, right);
        }
    }

    /// α of a segment, against that of another, is `value` along a direction.
    fn lock(&mut self, n: usize, other: Option<usize>, along: Vector3<f64>, value: Vector3<f64>) {
        let mut terms = vec![(n, Vector3::zeros(), along)];
        terms.extend(other.map(|m| (m, Vector3::zeros(), -along)));
        self.constrain(&terms, along.dot(&value));
    }

    fn solve(self) -> Vec<Rates> {
        let used = self.used;
        let matrix = self.matrix.view((0, 0), (used, used)).into_owned();
        let found = matrix.full_piv_lu().solve(&self.right.rows(0, used).into_owned()).expect("a regular system");
        let three = |at: usize| found.fixed_rows::<3>(at).into_owned();
        (0..self.count).map(|n| Rates { joint: three(6 * n), turn: three(6 * n + 3) }).collect()
    }
}
