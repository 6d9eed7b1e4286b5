//! How a column moves, and what holds it.
//!
//! ```text
//! m_h ẍ = Q·â − S(x) − m_h â·(a_P − g)
//! S = f(x_m) − K (x_m − x),   x_m the greatest stroke, the present one included
//! ```
//!
//! Q is the force of bodies and bags on the frame, a_P the acceleration of the parent's axes where the hub is. S²/2K is stored,
//! ∫f − f²/2K at x_m is lost.

use super::data::{Column, ColumnData};
use super::past::ColumnPast;
use crate::forces::element::Instant;
use crate::forces::function::FunctionLaw;
use crate::motion::frame::{Frames, Moving, VEHICLE};
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::motion::vector::{M3, V3};

/// What its numbers are 1 of: x, m; ẋ, m/s; the work that it takes up, J. With that of ẋ the error control bounds x and ẋ as places
/// and speeds of the body.
const UNITS: [f64; 3] = [1.0, 100.0, 1000.0];

/// Constants of a column.
#[derive(Clone, Debug)]
pub struct ColumnLaw<S> {
    /// Where its numbers stand among those that force elements own.
    first: usize,
    /// Its frame among those of an instant.
    pub(crate) frame: usize,
    /// â and the hub's place, axes of the frame.
    axis: V3<S>,
    hub: V3<S>,
    mass: S,
    gravity: S,
    force: FunctionLaw<S>,
    /// K.
    pub(super) stiffness: S,
    /// The stroke at which it ends.
    end: S,
}

/// What a column does at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Now<S> {
    /// x, ẋ and the work taken up.
    pub(super) own: [S; 3],
    /// S.
    pub(super) force: S,
    /// f(x_m) and x_m − f/K, what stays of the stroke.
    pub(super) set: S,
    /// ½m_hẋ² + S²/2K, and what is lost, J.
    pub(super) stored: S,
    pub(super) lost: S,
    /// 1 from the end of its stroke on.
    pub(super) bottoms: S,
}

impl ColumnLaw<f64> {
    pub(super) fn new(column: &Column, data: &ColumnData<'_>) -> Self {
        ColumnLaw {
            first: 0,
            frame: VEHICLE + 1 + column.frame,
            axis: V3::of(&column.axis.normalize()),
            hub: V3::of(&column.hub_m.coords),
            mass: column.mass_kg,
            gravity: data.gravity_m_s2,
            force: FunctionLaw::new(&column.force),
            stiffness: column.stiffness_n_per_m(),
            end: column.end_m(),
        }
    }

    /// Appends its numbers as they begin: it stands.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        self.first = numbers.len();
        numbers.extend([0.0; 3]);
    }

    /// What ended a run, if it went beyond the end of its force.
    pub(super) fn overrun(&self, name: &str, past: &ColumnPast<f64>) -> Option<String> {
        self.force.overrun(&format!("the stroke of {name}"), past.greatest, |x| format!("{:.1} mm", 1e3 * x))
    }
}

impl<S: Copy> ColumnLaw<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &ColumnLaw<A>, f: &impl Fn(S, A) -> T) -> Option<ColumnLaw<T>> {
        let is_like = self.frame == other.frame && self.force.len() == other.force.len();
        is_like.then(|| ColumnLaw {
            first: self.first,
            frame: self.frame,
            axis: self.axis.zip(&other.axis, f),
            hub: self.hub.zip(&other.hub, f),
            mass: f(self.mass, other.mass),
            gravity: f(self.gravity, other.gravity),
            force: self.force.zip(&other.force, f),
            stiffness: f(self.stiffness, other.stiffness),
            end: f(self.end, other.end),
        })
    }
}

impl<S: Scalar> ColumnLaw<S> {
    /// x, ẋ and the work taken up; none of a body that is only being placed.
    #[inline(always)]
    pub(super) fn moved(&self, state: &State<S>) -> Option<[S; 3]> {
        let own = state.own().get(self.first..self.first + 3)?;
        Some(std::array::from_fn(|i| own[i] * S::of(UNITS[i])))
    }

    /// Moves its frame, which stands among `frames` as the parent carries it, by its stroke. The acceleration stays that of the
    /// parent's axes there.
    #[inline(always)]
    pub(super) fn carry(&self, state: &State<S>, frames: &mut Frames<S>) {
        let Some([stroke, speed, _]) = self.moved(state) else { return };
        let carried = frames[self.frame].carried(self.axis * stroke, &M3::identity());
        let velocity = carried.velocity + carried.axes.out(self.axis) * speed;
        frames[self.frame] = Moving { velocity, ..carried };
    }

    /// What holds it, with the stroke that it remembers.
    #[inline(always)]
    pub(super) fn now(&self, own: [S; 3], past: &ColumnPast<S>) -> Now<S> {
        let (half, [stroke, speed, _]) = (S::of(0.5), own);
        let greatest = past.greatest.max(stroke);
        let top = self.force.value(greatest) + self.force.unknown(greatest);
        let give = S::one() / self.stiffness;
        let force = top - self.stiffness * (greatest - stroke);
        let [_, kept, given] = self.force.returned_to(greatest);
        Now {
            own,
            force,
            set: greatest - top * give,
            stored: half * (self.mass * speed * speed + force * force * give),
            lost: kept + given - half * top * top * give,
            bottoms: S::select(greatest.lt(self.end), S::zero(), S::one()),
        }
    }

    /// â in space.
    #[inline(always)]
    pub(super) fn axis(&self, at: &Instant<'_, S>) -> V3<S> {
        at.frames[self.frame].axes.out(self.axis)
    }

    /// m_h â·(a_P − g), N.
    #[inline(always)]
    pub(super) fn drag(&self, at: &Instant<'_, S>) -> S {
        let frame = &at.frames[self.frame];
        let arm = frame.axes.out(self.hub);
        let mut felt = frame.acceleration + frame.alpha.cross(arm) + frame.omega.cross(frame.omega.cross(arm));
        felt.z += self.gravity;
        self.mass * self.axis(at).dot(felt)
    }

    /// Writes the rates of its numbers where the forces of bodies push it along its axis and the motion of the parent drags it.
    #[inline(always)]
    pub(super) fn flow(&self, now: &Now<S>, push: S, drag: S, rates: &mut [S]) {
        let speed = now.own[1];
        let rate = [speed, (push - now.force - drag) / self.mass, (push - drag) * speed];
        for ((to, rate), unit) in rates[self.first..].iter_mut().zip(rate).zip(UNITS) {
            *to = rate * S::of(1.0 / unit);
        }
    }
}
