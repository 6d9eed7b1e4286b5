//! External changes of a run: impulses, other states.

use nalgebra::{Point3, Vector3};

use super::front::Front;
use super::{Course, Rear, Run, RunError};
use crate::body::Segment;
use crate::model::Model;
use crate::motion::dynamics::Wrench;
use crate::motion::layout::MOST_SEGMENTS;
use crate::motion::mobility::Mobility;
use crate::motion::state::State;
use crate::motion::vector::V3;

impl Run<'_> {
    /// Strikes a segment: an impulse in space axes, N·s, at a point from the segment's lower end, segment axes, m. All
    /// velocities jump as the joints pass it on; places stay.
    ///
    /// # Errors
    /// A segment that the body has not; numbers that are not finite.
    pub fn kick(
        &mut self,
        segment: Segment,
        from_lower_end_m: Point3<f64>,
        impulse_n_s: Vector3<f64>,
    ) -> Result<(), RunError> {
        let (model, n) = (&*self.model, segment.index());
        if n >= model.body().segments.len() {
            return Err(RunError::input(format!("segment {n}"), "a segment of the model's body"));
        }
        if !(from_lower_end_m.coords.sum() + impulse_n_s.sum()).is_finite() {
            return Err(RunError::input("an impulse that is not finite", "finite numbers"));
        }
        let skeleton = &model.system().skeleton;
        let rest = Mobility::new(skeleton, &self.course.state);
        let from_joint = V3::of(&(from_lower_end_m.coords - model.body().joint_m(segment)));
        let (force, arm) = (V3::of(&impulse_n_s), rest.kinematics.axes[n].out(from_joint));
        let mut loads = [Wrench::zero(); MOST_SEGMENTS];
        loads[n] = Wrench { force, moment: arm.cross(force) };
        let (struck, still) = (rest.loaded(&loads), &rest.unloaded);
        let mut state = self.course.state;
        for (body, trunk) in skeleton.layout.trunks().iter().enumerate() {
            let jump = struck.joint[trunk.first] - still.joint[trunk.first];
            state.set_velocity_of(body, state.velocity_of(body) + jump);
        }
        for (slot, &n) in skeleton.layout.free().iter().enumerate() {
            state.set_omega(slot, state.omega(slot) + struck.alpha[n] - still.alpha[n]);
        }
        for (i, rate) in state.hinge_rate_mut().iter_mut().enumerate() {
            *rate += struck.hinge[i] - still.hinge[i];
        }
        self.set_state(state)
    }

    /// Continues from another state, such as [`Run::state`] with another velocity. The energy balance continues from
    /// it; its difference in energy is no error.
    ///
    /// # Errors
    /// A state of another body; numbers that are not finite.
    pub fn set_state(&mut self, mut state: State<f64>) -> Result<(), RunError> {
        if state.shape() != self.course.state.shape() {
            return Err(RunError::input("a state of another body", "one of the model's, such as `Run::state`"));
        }
        state.normalize();
        if !state.is_finite() {
            return Err(RunError::input("a state with numbers that are not finite", "finite numbers"));
        }
        let before = self.look(|sample| sample.ledgers.iter().map(|ledger| ledger.balance_j).collect::<Vec<f64>>())?;
        self.course.restart(&self.model, state);
        let after = self.look(|sample| sample.ledgers.iter().map(|ledger| ledger.balance_j).collect::<Vec<f64>>())?;
        for (start, (before, after)) in self.course.energy_starts.iter_mut().zip(before.into_iter().zip(after)) {
            start.mechanical_j += after - before;
        }
        Ok(())
    }
}

impl Course {
    /// Continues from another state at the present time, with the memory of force elements from the latest look.
    fn restart(&mut self, model: &Model, state: State<f64>) {
        self.state = state;
        self.history.look_again();
        if self.front.is_some() {
            self.front = Some(Box::new(Front::new(model, self.time_s, &self.state, &self.history)));
        }
        if self.rear.is_some() {
            self.rear = Some(Box::new(Rear::new(&self.state, &self.history)));
        }
    }
}
