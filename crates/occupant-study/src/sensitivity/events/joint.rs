//! Events of joints.

use super::{Happening, Notes};
use occupant_core::body::Joint;
use occupant_core::forces::joint::JointLaw;
use occupant_core::model::Model;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::state::State;

/// Description, such as `neck enters the range of its stop`.
pub(super) fn words(model: &Model, joint: Joint, enters: bool) -> String {
    let verb = if enters { "enters" } else { "leaves" };
    format!("{} {verb} the range of its stop", model.body().tree[joint].name)
}

/// Whether each joint was in the range of a stop at the last look.
#[derive(Default)]
pub(super) struct Lookout(Vec<Option<bool>>);

impl Lookout {
    pub fn look<const N: usize>(&mut self, model: &Model, state: &State<f64>, notes: &mut Notes<N>) {
        let system = model.system();
        let k = Kinematics::new(&system.skeleton, state);
        let joints = &system.forces.joints;
        let balls = joints.balls.iter().enumerate().map(|(i, ball)| (ball.joint, joints.beta(i, &k)));
        let hinges = joints.hinges.iter().zip(state.hinge()).map(|(hinge, angle_rad)| (hinge.joint, *angle_rad));
        self.0.resize(joints.balls.len() + joints.hinges.len(), None);
        for (seen, (joint, angle_rad)) in self.0.iter_mut().zip(balls.chain(hinges)) {
            let inside = in_stop(&model.setup().joints[joint], angle_rad);
            let before = seen.replace(inside);
            if before.is_some_and(|b| b != inside) {
                notes.note(Happening::Stop { joint, enters: inside }, None);
            }
        }
    }
}

/// Whether a joint is in the range of one of its stops.
fn in_stop(law: &JointLaw, angle_rad: f64) -> bool {
    match law {
        JointLaw::Ball(ball) => ball.stop.is_some_and(|s| angle_rad > s.begin_rad),
        JointLaw::Hinge(hinge) => {
            hinge.lower_stop.is_some_and(|s| angle_rad < s.begin_rad)
                || hinge.upper_stop.is_some_and(|s| angle_rad > s.begin_rad)
        }
    }
}
