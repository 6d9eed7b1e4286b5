//! Memory of a chain between steps: plain numbers that change only at accepted steps.

use super::MOST_NODES;
use super::data::NEVER;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{V3, v3};

/// Largest extrapolation of a speed change along a track, in lengths of the step that showed it.
const MOST_AHEAD: f64 = 2.0;

/// Strain rate at which webbing counts as unloading, 1/s: above rounding errors.
pub(super) const BACK_PER_S: f64 = 1e-4;

/// Marker for the length of the last step when the payout has changed its course since.
const ANEW: f64 = -1.0;

/// State of a track whose webbing has slid off and is supported elsewhere.
const HANDED_OVER: f64 = 2.0;

/// Speed of a stalled stroke.
pub(super) const STALLED: f64 = -1.0;

/// A struct of numbers with iteration in a fixed order.
macro_rules! numbers {
    ($(#[$doc:meta])* $Name:ident { $($(#[$field_doc:meta])* $field:ident),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(super) struct $Name<S> {
            $($(#[$field_doc])* pub(super) $field: S),+
        }

        impl<S> $Name<S> {
            #[inline(always)]
            pub(super) fn each<A>(&mut self, other: &mut $Name<A>, f: &mut impl FnMut(&mut S, &mut A)) {
                $(f(&mut self.$field, &mut other.$field);)+
            }
        }

        impl<A: Copy> $Name<A> {
            pub(super) fn map<S>(&self, f: &mut impl FnMut(A) -> S) -> $Name<S> {
                $Name { $($field: f(self.$field)),+ }
            }
        }

        impl<S: Scalar> $Name<S> {
            pub(super) fn none() -> Self {
                $Name { $($field: S::zero()),+ }
            }
        }
    };
}

numbers! {
    /// Stored state of a node and of the strap that starts there.
    NodePast {
        /// 1 while the webbing passes it, 2 once it has slid off a track and is supported elsewhere.
        on,
        /// Remembered normal of a sphere's plane, and direction from its centre to where the webbing comes onto it, segment axes;
        /// of the first node for the normal the mean speed of the payout in the last step, m/s, how long that lasted, s, and
        /// whether its limiter goes back; of a track for the direction by how much its speed changed in the last step, m/s, how long that lasted, s, and whether there
        /// was one.
        normal_x,
        normal_y,
        normal_z,
        touch_x,
        touch_y,
        touch_z,
        /// N of the strap, m.
        unstretched,
        /// Largest loading strain x* of the strap.
        greatest,
        /// Strain of the strap, and that of its viscous branch.
        strain,
        viscous,
        /// Strain rate of lossy webbing, 1/s: average of the last step, the duration of that step, s, and at its end; 1
        /// where it unloads.
        mean,
        lasted,
        rate,
        back,
        /// P of the strap, energy carried by a metre of unstretched webbing, N.
        carried,
        /// s, webbing fed into the strap here since the start, unstretched, m; at the first node the payout.
        fed,
        /// z, −1 to 1.
        play,
        /// Travel of a node along its track or stroke, or of the mark on a sphere, m, and its speed, m/s.
        way,
        speed,
        /// Force of the webbing along a track, N; for other nodes the quantity that decides a switch: W of a sphere,
        /// rad, the pull away from the body or against a stroke, N.
        across,
        /// Dissipated here since the start, J: friction along and across, limiter and spool, and the strap's webbing.
        lost,
    }
}

numbers! {
    /// Stored state of the belt's device.
    DevicePast {
        /// Time of the last accepted step, s.
        time,
        /// Solution x of the march.
        solution,
        /// One of [`super::device::Phase`].
        phase,
        /// p − δ of a locked spool, m.
        base,
        /// Largest loading deformation of the limiter, m.
        greatest,
        /// Average speed of the payout, and its last, m/s.
        average,
        speed,
        /// Payout when the spool began to lock, or when the pretensioner fired, m.
        mark,
        /// Due times of lock, pretensioner, second limiter and release, s.
        lock_due,
        pull_due,
        switch_due,
        release_due,
        /// Times since when their conditions hold, s.
        lock_since,
        pull_since,
        switch_since,
        release_since,
        /// 1 once the pretensioner has finished.
        pulled,
        /// 1 once the belt is released.
        free,
        /// Work of actuators since the start, J.
        driven,
        /// Recoverable energy of the limiter, J.
        stored,
        /// Residual webbing, m, if the tensions were not found: the run ends.
        unsolved,
    }
}

/// Stored state of a chain. Nodes beyond its own are 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPast<S> {
    pub(super) device: DevicePast<S>,
    pub(super) nodes: [NodePast<S>; MOST_NODES],
}

impl<S> ChainPast<S> {
    #[inline(always)]
    pub(super) fn each<A>(&mut self, other: &mut ChainPast<A>, f: &mut impl FnMut(&mut S, &mut A)) {
        self.device.each(&mut other.device, f);
        for (one, other) in self.nodes.iter_mut().zip(&mut other.nodes) {
            one.each(other, f);
        }
    }
}

impl ChainPast<f64> {
    /// Largest loading deformation of the limiter, m.
    pub(crate) fn limiter_m(&self) -> f64 {
        self.device.greatest
    }
}

impl<A: Copy> ChainPast<A> {
    pub(super) fn map<S>(&self, f: &mut impl FnMut(A) -> S) -> ChainPast<S> {
        ChainPast { device: self.device.map(f), nodes: self.nodes.each_ref().map(|node| node.map(f)) }
    }
}

impl<S: Scalar> ChainPast<S> {
    /// Discrete state: phase of the device, due or pending triggers, nodes passed, stalled strokes.
    #[inline(always)]
    pub(super) fn switches(&self) -> S {
        let (o, soon, device) = (S::zero(), S::of(0.5 * NEVER), &self.device);
        let mut sum = device.phase;
        let mut bit = 8.0;
        let mut note = |is: S::Mask| {
            sum += S::select(is, S::of(bit), o);
            bit *= 2.0;
        };
        note(device.pulled.gt(o));
        note(device.free.gt(o));
        note(self.nodes[0].pays_anew());
        note(self.nodes[0].goes_back());
        for time in [device.lock_due, device.pull_due, device.switch_due, device.release_due] {
            note(time.lt(soon));
        }
        for time in [device.lock_since, device.pull_since, device.switch_since, device.release_since] {
            note(time.lt(soon));
        }
        for node in &self.nodes {
            note(node.is_on());
            // no place along a track has just this speed
            note(node.has_stalled() | node.is_handed_over());
            note(node.back.gt(o));
        }
        sum
    }

    pub(super) fn none() -> Self {
        ChainPast { device: DevicePast::none(), nodes: [NodePast::none(); MOST_NODES] }
    }
}

impl<S: Scalar> NodePast<S> {
    /// Difference of the mean speed along a track over a time h after the last commit from that at the commit: half of
    /// its change, if it continues as in the step before. This makes the travel second-order accurate.
    #[inline(always)]
    pub(super) fn half_change(&self, h: S) -> S {
        let [change, lasted] = [self.touch_x, self.touch_y];
        let part = (h / lasted.max(S::of(1e-30))).min(S::of(MOST_AHEAD));
        S::select(lasted.gt(S::zero()), change * part * S::of(0.5), S::zero())
    }

    /// Slides along a track with this speed after an accepted step of length h.
    #[inline(always)]
    pub(super) fn slide(&mut self, speed: S, h: S) {
        let (o, is_known) = (S::zero(), self.touch_z.gt(S::zero()));
        self.touch_x = S::select(is_known, speed - self.speed, o);
        self.touch_y = S::select(is_known, h, o);
        (self.touch_z, self.speed) = (S::one(), speed);
    }

    /// Payout speed at the end of a step of length h with the average `mean`: from the parabola through this step and
    /// the last; the mean if there was none.
    #[inline(always)]
    pub(super) fn pay(&mut self, mean: S, h: S) -> S {
        let (before, lasted) = (self.normal_x, self.normal_y);
        (self.normal_x, self.normal_y) = (mean, h);
        mean + S::select(lasted.gt(S::zero()), (mean - before) * (h / (h + lasted)), S::zero())
    }

    /// Marks where the payout changes its course, so that its speed is unknown.
    #[inline(always)]
    pub(super) fn pay_anew(&mut self, anew: S::Mask) {
        self.normal_y = S::select(anew, S::of(ANEW), self.normal_y);
    }

    /// Whether the payout has changed its course since the last step.
    #[inline(always)]
    pub(super) fn pays_anew(&self) -> S::Mask {
        self.normal_y.lt(S::zero())
    }

    /// Whether the limiter unloads: δ decreases, or has decreased and is not back at its maximum.
    #[inline(always)]
    pub(super) fn goes_back(&self) -> S::Mask {
        self.normal_z.gt(S::zero())
    }

    /// Notes at an accepted step of length h whether the strap with this strain unloads: the strain decreases, or has
    /// decreased and is not back at its maximum.
    #[inline(always)]
    pub(super) fn turn(&mut self, strain: S, h: S) {
        let (o, mean) = (S::zero(), (strain - self.strain) / h);
        let change = (mean - self.mean) * (h / (h + self.lasted));
        self.rate = mean + S::select(self.lasted.gt(o), change, o);
        let (was_back, is_less) = (self.back.gt(o), strain.lt(self.greatest));
        let is_back = (was_back & is_less) | (!was_back & self.rate.lt(S::of(-BACK_PER_S)));
        (self.mean, self.lasted, self.back) = (mean, h, S::select(is_back, S::one(), o));
    }

    /// Whether a pulled node has stalled.
    #[inline(always)]
    pub(super) fn has_stalled(&self) -> S::Mask {
        !self.speed.lt(S::of(STALLED)) & !self.speed.gt(S::of(STALLED))
    }

    /// Whether webbing has slid off this track and is supported elsewhere.
    #[inline(always)]
    pub(super) fn is_handed_over(&self) -> S::Mask {
        self.on.gt(S::of(HANDED_OVER - 0.5))
    }

    /// Hands over webbing that `leaves` a track, for good; it slides no more. Whether it has no support left.
    #[inline(always)]
    pub(super) fn hand_over(&mut self, leaves: S::Mask) -> S::Mask {
        let (o, passes) = (S::zero(), self.is_on());
        self.on = S::select(leaves & passes, S::of(HANDED_OVER), self.on);
        let is_over = self.is_handed_over();
        for number in [&mut self.speed, &mut self.touch_x, &mut self.touch_y, &mut self.across] {
            *number = S::select(is_over, o, *number);
        }
        S::truth(false)
    }

    #[inline(always)]
    pub(super) fn is_on(&self) -> S::Mask {
        self.on.gt(S::zero())
    }

    #[inline(always)]
    pub(super) fn normal(&self) -> V3<S> {
        v3(self.normal_x, self.normal_y, self.normal_z)
    }

    #[inline(always)]
    pub(super) fn touch(&self) -> V3<S> {
        v3(self.touch_x, self.touch_y, self.touch_z)
    }

    #[inline(always)]
    pub(super) fn set_touch(&mut self, touch: V3<S>) {
        (self.touch_x, self.touch_y, self.touch_z) = (touch.x, touch.y, touch.z);
    }

    #[inline(always)]
    pub(super) fn set_normal(&mut self, normal: V3<S>) {
        (self.normal_x, self.normal_y, self.normal_z) = (normal.x, normal.y, normal.z);
    }
}
