//! The simulator's body on its own: no surface, no belt, only gravity and joints, stepped by its Runge–Kutta method.

use crate::core_side;
use crate::reference::System;
use nalgebra::Vector3;
use occupant_core::forces::joint::{DAMPING, JointSystem};
use occupant_core::forces::sphere::Site;
use occupant_core::forces::{Forces, History, Memory};
use occupant_core::kernel::{self, Situation};
use occupant_core::motion::frame::Frames;
use occupant_core::motion::frame::Moving;
use occupant_core::motion::integrate::rk4;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::skeleton::Skeleton;
use occupant_core::motion::state::State;
use occupant_core::motion::vector::V3;
use occupant_core::results::energy;

/// A body in empty space.
pub struct FreeRun {
    system: kernel::System<f64>,
    history: History<f64>,
    frames: Frames<f64>,
}

/// What a closed system keeps.
#[derive(Clone, Copy, Debug)]
pub struct Conserved {
    /// Kinetic, gravity and spring energy plus what the joints have dissipated.
    pub energy: f64,
    /// Σ M v.
    pub linear: Vector3<f64>,
    /// Σ (M x × v + I ω) about the origin.
    pub angular: Vector3<f64>,
}

impl FreeRun {
    /// `system` without its forces.
    pub fn new(system: &System) -> FreeRun {
        assert_eq!(system.gravity.xy().norm(), 0.0);
        let skeleton = Skeleton::new(&system.body, -system.gravity.z);
        let joints = JointSystem::new(&system.joints, &skeleton, |_| f64::NAN);
        let forces = Forces { joints, ..Forces::none() };
        let history = History::new(&forces, Memory::none());
        let system = kernel::System::new(skeleton, Site::all(&system.body), forces);
        FreeRun { system, history, frames: Frames::still(0.0) }
    }

    /// The state after `steps` steps of `h` seconds.
    pub fn run(&mut self, state: &State<f64>, h: f64, steps: usize) -> State<f64> {
        let FreeRun { system, history, frames } = self;
        let mut state = *state;
        for _ in 0..steps {
            state =
                rk4::step(&state, h, |_, s, rate| *rate = system.rate(Situation::within(s, frames), history, &mut ()));
        }
        state
    }

    /// Energy and momenta of a state.
    pub fn conserved(&self, state: &State<f64>) -> Conserved {
        let body = &self.system.skeleton;
        let k = Kinematics::new(body, state);
        let (linear, angular) = core_side::momentum(body, &k, V3::zero());
        let energy = energy::kinetic(body, &k, &Moving::space())
            + energy::gravity(body, &k)
            + self.system.forces.joints.stored(&k)
            + state.work(0).sums[DAMPING];
        Conserved { energy, linear: linear.to_vector(), angular: angular.to_vector() }
    }

    /// Total mass and centre of gravity.
    pub fn centre(&self, state: &State<f64>) -> (f64, Vector3<f64>) {
        let body = &self.system.skeleton;
        let k = Kinematics::new(body, state);
        let mass: f64 = body.links.iter().map(|l| l.mass).sum();
        let moment = |n: usize| k.cg(body, n).to_vector() * body.links[n].mass;
        (mass, (0..12).map(moment).sum::<Vector3<f64>>() / mass)
    }
}

/// Root mean square of all components' differences.
pub fn distance(a: &State<f64>, b: &State<f64>) -> f64 {
    let (a, b) = (moving(a), moving(b));
    (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / 66.0).sqrt()
}

/// All numbers but the work sums.
fn moving(state: &State<f64>) -> &[f64] {
    &state.numbers()[..state.shape().moving()]
}
