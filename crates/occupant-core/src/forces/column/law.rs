//! Motion and resistance of a column or a hinge.
//!
//! ```text
//! m_h ẍ = Q·â − S(x) − m_h â·(a_P − g)
//! S = f(x_m) − K (x_m − x),   x_m the largest stroke, the present one included
//! ```
//!
//! Q is the force of bodies and bags on the frame, a_P the acceleration of the parent's axes at the hub. S²/2K is
//! stored, ∫f − f²/2K at x_m is lost. A hinge at h with its mass at r from there turns by θ for x, against a moment:
//!
//! ```text
//! (m_h |â × r|² + J) θ̈ = M·â − S(θ) − m_h â·(r × (a_h − g + α × r + (ω × âθ̇) × r + ω' × (ω' × r))) − J â·α
//! ```
//!
//! M is the moment about h of everything that pushes it, a_h, ω, α are those of the parent, ω' = ω + âθ̇. J is the only
//! inertia about its own centre [D]; for a vehicle that turns about another axis than â the other components are
//! neglected.

use super::data::{Column, ColumnData};
use super::past::ColumnPast;
use crate::forces::element::Instant;
use crate::forces::function::FunctionLaw;
use crate::motion::dynamics::Wrench;
use crate::motion::frame::{Frames, Moving, VEHICLE};
use crate::motion::scalar::Scalar;
use crate::motion::state::State;
use crate::motion::vector::{M3, V3};

/// Unit sizes of its numbers: x, m; ẋ, m/s; absorbed work, J. With that of ẋ the error control bounds x and ẋ as
/// positions and speeds of the body.
const UNITS: [f64; 3] = [1.0, 100.0, 1000.0];

/// Constants of a column.
#[derive(Clone, Debug)]
pub struct ColumnLaw<S> {
    /// Its index among columns and hinges.
    pub(super) place: usize,
    /// Offset of its numbers among those of force elements.
    first: usize,
    /// Index of its frame.
    pub(crate) frame: usize,
    /// â and the hub's position, axes of the frame.
    axis: V3<S>,
    hub: V3<S>,
    mass: S,
    /// Inertia: m_h, or m_h |â × r|² + J.
    inertia: S,
    turns: Option<Turns<S>>,
    gravity: S,
    force: FunctionLaw<S>,
    /// K.
    pub(super) stiffness: S,
    /// End of the stroke.
    end: S,
}

/// Additional constants of a hinge.
#[derive(Clone, Copy, Debug)]
struct Turns<S> {
    /// A point of the axis, axes of the frame.
    at: V3<S>,
    /// J.
    inertia: S,
}

/// State of a column at one instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Now<S> {
    /// x, ẋ and absorbed work.
    pub(super) own: [S; 3],
    /// S.
    pub(super) force: S,
    /// f(x_m) and the permanent stroke x_m − f/K.
    pub(super) set: S,
    /// Stored energy ½m_hẋ² + S²/2K, and dissipated energy, J.
    pub(super) stored: S,
    pub(super) lost: S,
    /// 1 beyond the end of its stroke.
    pub(super) bottoms: S,
}

impl ColumnLaw<f64> {
    pub(super) fn new((place, column): (usize, &Column), data: &ColumnData<'_>) -> Self {
        ColumnLaw {
            place,
            first: 0,
            frame: VEHICLE + 1 + column.frame,
            axis: V3::of(&column.axis.normalize()),
            hub: V3::of(&column.hub_m.coords),
            mass: column.mass_kg,
            inertia: column.inertia(),
            turns: column.hinge.map(|hinge| Turns { at: V3::of(&hinge.at_m.coords), inertia: hinge.inertia_kg_m2 }),
            gravity: data.gravity_m_s2,
            force: FunctionLaw::new(&column.force),
            stiffness: column.stiffness_n_per_m(),
            end: column.end_m(),
        }
    }

    /// Appends its initial numbers: at rest.
    pub(super) fn own(&mut self, numbers: &mut Vec<f64>) {
        self.first = numbers.len();
        numbers.extend([0.0; 3]);
    }

    /// Reason of a run's end, if it exceeded its force curve.
    pub(super) fn overrun(&self, name: &str, past: &ColumnPast<f64>) -> Option<String> {
        let (of, shown): (_, fn(f64) -> String) = match self.turns {
            None => ("stroke", |x| format!("{:.1} mm", 1e3 * x)),
            Some(_) => ("turn", |x| format!("{:.1}°", x.to_degrees())),
        };
        self.force.overrun(&format!("the {of} of {name}"), past.greatest, shown)
    }
}

impl<S: Copy> ColumnLaw<S> {
    pub(super) fn zip<A: Copy, T>(&self, other: &ColumnLaw<A>, f: &impl Fn(S, A) -> T) -> Option<ColumnLaw<T>> {
        let is_like = self.frame == other.frame
            && self.force.len() == other.force.len()
            && self.turns.is_some() == other.turns.is_some();
        let turns = |(a, b): (&Turns<S>, &Turns<A>)| Turns { at: a.at.zip(&b.at, f), inertia: f(a.inertia, b.inertia) };
        is_like.then(|| ColumnLaw {
            place: self.place,
            first: self.first,
            frame: self.frame,
            axis: self.axis.zip(&other.axis, f),
            hub: self.hub.zip(&other.hub, f),
            mass: f(self.mass, other.mass),
            inertia: f(self.inertia, other.inertia),
            turns: self.turns.as_ref().zip(other.turns.as_ref()).map(turns),
            gravity: f(self.gravity, other.gravity),
            force: self.force.zip(&other.force, f),
            stiffness: f(self.stiffness, other.stiffness),
            end: f(self.end, other.end),
        })
    }
}

impl<S: Scalar> ColumnLaw<S> {
    /// x, ẋ and absorbed work; none while a body is being positioned.
    #[inline(always)]
    pub(super) fn moved(&self, state: &State<S>) -> Option<[S; 3]> {
        let own = state.own().get(self.first..self.first + 3)?;
        Some(std::array::from_fn(|i| own[i] * S::of(UNITS[i])))
    }

    /// Moves its frame, which `frames` contains as carried by the parent, by its stroke. The acceleration stays that of
    /// the parent's axes there.
    #[inline(always)]
    pub(super) fn carry(&self, state: &State<S>, frames: &mut Frames<S>) {
        let Some([stroke, speed, _]) = self.moved(state) else { return };
        if let Some(turns) = &self.turns {
            let turned = rotation(self.axis, stroke);
            let carried = frames[self.frame].carried(turns.at - turned.out(turns.at), &turned);
            let spin = carried.axes.out(self.axis) * speed;
            let velocity = carried.velocity - spin.cross(carried.axes.out(turns.at));
            frames[self.frame] = Moving { velocity, omega: carried.omega + spin, ..carried };
            return;
        }
        let carried = frames[self.frame].carried(self.axis * stroke, &M3::identity());
        let velocity = carried.velocity + carried.axes.out(self.axis) * speed;
        frames[self.frame] = Moving { velocity, ..carried };
    }

    /// Its force and energies at the stored stroke.
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
            stored: half * (self.inertia * speed * speed + force * force * give),
            lost: kept + given - half * top * top * give,
            bottoms: S::select(greatest.lt(self.end), S::zero(), S::one()),
        }
    }

    /// â in space.
    #[inline(always)]
    pub(super) fn axis(&self, at: &Instant<'_, S>) -> V3<S> {
        at.frames[self.frame].axes.out(self.axis)
    }

    /// Force of a body along â, N, or its moment about the axis, N·m.
    #[inline(always)]
    pub(super) fn along(&self, at: &Instant<'_, S>, onto: &Wrench<S>) -> S {
        let (frame, axis) = (&at.frames[self.frame], self.axis(at));
        match &self.turns {
            None => axis.dot(onto.force),
            Some(turns) => axis.dot(onto.moment - (frame.origin + frame.axes.out(turns.at)).cross(onto.force)),
        }
    }

    /// m_h â·(a_P − g), N, or its moment about the axis, N·m; `speed` is ẋ.
    #[inline(always)]
    pub(super) fn drag(&self, at: &Instant<'_, S>, speed: S) -> S {
        let frame = &at.frames[self.frame];
        if let Some(turns) = &self.turns {
            let axis = self.axis(at);
            let (lever, arm) = (frame.axes.out(turns.at), frame.axes.out(self.hub - turns.at));
            let (spin, alpha) = (axis * speed, frame.alpha);
            let parent = frame.omega - spin;
            let mut felt = frame.acceleration + alpha.cross(lever) + parent.cross(parent.cross(lever));
            felt += (alpha + parent.cross(spin)).cross(arm) + frame.omega.cross(frame.omega.cross(arm));
            felt.z += self.gravity;
            return axis.dot(arm.cross(felt)) * self.mass + axis.dot(alpha) * turns.inertia;
        }
        let arm = frame.axes.out(self.hub);
        let mut felt = frame.acceleration + frame.alpha.cross(arm) + frame.omega.cross(frame.omega.cross(arm));
        felt.z += self.gravity;
        self.mass * self.axis(at).dot(felt)
    }

    /// Writes the rates of its numbers, under the push of bodies and the drag of the parent's motion.
    #[inline(always)]
    pub(super) fn flow(&self, now: &Now<S>, push: S, drag: S, rates: &mut [S]) {
        let speed = now.own[1];
        let rate = [speed, (push - now.force - drag) / self.inertia, (push - drag) * speed];
        for ((to, rate), unit) in rates[self.first..].iter_mut().zip(rate).zip(UNITS) {
            *to = rate * S::of(1.0 / unit);
        }
    }
}

/// The rotation by an angle about a unit axis: 1 + sin θ [â]× + (1 − cos θ) [â]×².
#[inline(always)]
fn rotation<S: Scalar>(axis: V3<S>, angle: S) -> M3<S> {
    let (sin, cos) = angle.sin_cos();
    let M3 { x, y, z } = M3::identity();
    M3 { x: turned(axis, x, sin, cos), y: turned(axis, y, sin, cos), z: turned(axis, z, sin, cos) }
}

/// A vector turned about a unit axis.
#[inline(always)]
fn turned<S: Scalar>(axis: V3<S>, v: V3<S>, sin: S, cos: S) -> V3<S> {
    let across = axis.cross(v);
    v + across * sin + axis.cross(across) * (S::one() - cos)
}
