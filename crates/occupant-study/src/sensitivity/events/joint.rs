//! Events of joints.

use super::{Happening, Notes};
use occupant_core::body::joint::Joint;
use occupant_core::forces::joint::Joints;
use occupant_core::model::Model;
use occupant_core::motion::kinematics::Kinematics;
use occupant_core::motion::state::State;

/// Ball joints in the kernel's order, then hinges.
const JOINTS: [Joint; 11] = [
    Joint::Neck,
    Joint::RightShoulder,
    Joint::LeftShoulder,
    Joint::UpperBack,
    Joint::LowerBack,
    Joint::RightHip,
    Joint::LeftHip,
    Joint::LeftElbow,
    Joint::RightElbow,
    Joint::LeftKnee,
    Joint::RightKnee,
];

/// In words: `neck enters the range of its stop`.
pub(super) fn words(joint: Joint, enters: bool) -> String {
    let verb = if enters { "enters" } else { "leaves" };
    format!("{} {verb} the range of its stop", joint.name())
}

/// Which joints were last seen in the range of a stop.
#[derive(Default)]
pub(super) struct Lookout([Option<bool>; 11]);

impl Lookout {
    pub fn look<const N: usize>(&mut self, model: &Model, state: &State<f64>, notes: &mut Notes<N>) {
        let system = model.system();
        let k = Kinematics::new(&system.skeleton, state);
        for (i, joint) in JOINTS.into_iter().enumerate() {
            let angle_rad = match i.checked_sub(7) {
                None => system.forces.joints.beta(i, &k),
                Some(hinge) => state.hinge[hinge],
            };
            let inside = in_stop(&model.setup().joints, joint, angle_rad);
            let before = self.0[i].replace(inside);
            if before.is_some_and(|b| b != inside) {
                notes.note(Happening::Stop { joint, enters: inside }, None);
            }
        }
    }
}

/// Whether a joint is in the range of one of its stops.
fn in_stop(joints: &Joints, joint: Joint, angle_rad: f64) -> bool {
    let ball = match joint {
        Joint::Neck => &joints.neck,
        Joint::RightShoulder => &joints.right_shoulder,
        Joint::LeftShoulder => &joints.left_shoulder,
        Joint::UpperBack => &joints.upper_back,
        Joint::LowerBack => &joints.lower_back,
        Joint::RightHip => &joints.right_hip,
        Joint::LeftHip => &joints.left_hip,
        Joint::LeftElbow | Joint::RightElbow | Joint::LeftKnee | Joint::RightKnee => {
            let hinge = match joint {
                Joint::LeftElbow => &joints.left_elbow,
                Joint::RightElbow => &joints.right_elbow,
                Joint::LeftKnee => &joints.left_knee,
                _ => &joints.right_knee,
            };
            let lower = hinge.lower_stop.is_some_and(|s| angle_rad < s.begin_rad);
            return lower || hinge.upper_stop.is_some_and(|s| angle_rad > s.begin_rad);
        }
    };
    ball.stop.is_some_and(|s| angle_rad > s.begin_rad)
}
