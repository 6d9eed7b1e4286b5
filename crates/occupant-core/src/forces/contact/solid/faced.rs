//! A solid with the face that each sphere remembers.
//!
//! Past the middle of a body N̂ flips, and a sphere deep inside would be thrown out on the far side. So from first
//! contact on a sphere remembers a face k, the one whose normal is nearest to N̂, and φ is replaced by φ_k, the
//! distance from K_k. K_k is the body without the faces far from k: those that share no corner with it and face away
//! from it by more than 120°. k is chosen again at a commit only where φ = φ_k, so force and stored energy do not jump
//! there. Between commits φ_k is a function of the centre alone: a frictionless sphere gets back all the energy that it
//! has put in.

use super::distance::{Distance, Form};
use crate::forces::contact::{FACE, OPEN, TOUCHING};
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;
use nalgebra::Vector3;

/// φ and φ_k are the same within this, m.
const SAME_M: f64 = 1e-12;

/// A solid and its faces.
#[derive(Clone, Debug)]
pub(crate) struct Faced<S> {
    /// K.
    pub whole: Form<S>,
    /// Those that a sphere may remember; of any other place it remembers that it touches.
    pub faces: Vec<Face<S>>,
    /// How thick the solid is where no face is remembered, m.
    pub thickness: S,
    /// A box along the axes of the frame that holds K.
    bounds: [V3<S>; 2],
}

/// A face k.
#[derive(Clone, Debug)]
pub(crate) struct Face<S> {
    pub normal: V3<S>,
    /// K_k.
    pub rest: Form<S>,
    /// N̂·x of its points, m.
    pub offset: S,
    /// How thick the solid is behind it, m.
    pub thickness: S,
}

impl Faced<f64> {
    /// A solid with these faces.
    pub(super) fn new(whole: Form<f64>, faces: Vec<Face<f64>>, thickness: f64) -> Self {
        let bounds = whole.bounds();
        Faced { whole, faces, thickness, bounds }
    }
}

impl<S: Scalar> Faced<S> {
    /// What φ of `centre` is at least, m, for a fraction of its cost.
    #[inline(always)]
    pub(crate) fn at_least(&self, centre: V3<S>) -> S {
        Form::off_box(&self.bounds, centre)
    }

    /// φ_k of `centre` where a face is remembered, else φ; axes of the frame.
    #[inline(always)]
    pub(crate) fn distance(&self, centre: V3<S>, phase: S) -> Distance<S> {
        let is_whole = phase.lt(S::of(FACE - 0.5));
        let mut found = Distance { phi: S::zero(), normal: V3::zero() };
        if S::any(is_whole) {
            found = self.whole.distance(centre);
        }
        for (k, face) in self.faces.iter().enumerate() {
            let here = is(phase, FACE + k as f64);
            if S::any(here) {
                found = Distance::select(here, face.rest.distance(centre), found);
            }
        }
        found
    }

    /// Takes the place of an accepted step over into what a sphere remembers of the solid.
    #[inline(always)]
    pub(crate) fn commit(&self, centre: V3<S>, radius: S, phase: &mut S) -> Distance<S> {
        let whole = self.whole.distance(centre);
        let remembers = !phase.lt(S::of(FACE - 0.5));
        let known = if S::any(remembers) { self.distance(centre, *phase) } else { whole };
        let touches = known.phi.lt(radius);
        if !S::any(touches) {
            *phase = S::of(OPEN);
            return whole;
        }
        let anew = phase.lt(S::of(TOUCHING)) | !(whole.phi - known.phi).gt(S::of(SAME_M));
        let chosen = S::select(anew, self.nearest_face(whole.normal), *phase);
        let before = *phase;
        *phase = S::select(touches, chosen, S::of(OPEN));
        if S::any(!is(before - *phase, 0.0)) { self.distance(centre, *phase) } else { known }
    }

    /// The face whose normal is nearest to N̂, as what is remembered.
    #[inline(always)]
    fn nearest_face(&self, normal: V3<S>) -> S {
        let (mut nearest, mut phase) = (self.whole.round(normal), S::of(TOUCHING));
        for (k, face) in self.faces.iter().enumerate() {
            let along = face.normal.dot(normal);
            let is_nearer = nearest.lt(along);
            nearest = S::select(is_nearer, along, nearest);
            phase = S::select(is_nearer, S::of(FACE + k as f64), phase);
        }
        phase
    }
}

/// Where a whole number is this one.
#[inline(always)]
fn is<S: Scalar>(number: S, this: f64) -> S::Mask {
    S::of(this - 0.5).lt(number) & number.lt(S::of(this + 0.5))
}

impl Faced<f64> {
    /// Normal and offset of the flat face that looks most into a direction, which may depend on the solid's middle; none of
    /// one without flat faces.
    pub(crate) fn plane_towards(&self, looks: &dyn Fn(Vector3<f64>) -> Vector3<f64>) -> Option<(Vector3<f64>, f64)> {
        let (centre, axis) = (self.whole.centre.to_vector(), self.whole.axes.z.to_vector());
        if self.whole.is_half_space() {
            return Some((axis, axis.dot(&centre)));
        }
        let direction = looks(centre);
        let towards = |face: &&Face<f64>| face.normal.to_vector().dot(&direction);
        let face = self.faces.iter().max_by(|a, b| towards(a).total_cmp(&towards(b)))?;
        Some((face.normal.to_vector(), face.offset))
    }

    /// Whether a sphere that goes through its axis comes out beyond: a capsule or a rim.
    pub(crate) fn is_bar(&self) -> bool {
        self.faces.is_empty() && !self.whole.is_half_space()
    }

    /// How thick it is behind the remembered face, m.
    pub(crate) fn thickness_m(&self, phase: f64) -> f64 {
        self.faces.get((phase - FACE) as usize).filter(|_| phase >= FACE).map_or(self.thickness, |face| face.thickness)
    }
}

impl<S: Copy> Faced<S> {
    /// f applied to every number and the one in the same place of `other`; none for one of another form.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Faced<A>, f: &impl Fn(S, A) -> T) -> Option<Faced<T>> {
        if self.faces.len() != other.faces.len() {
            return None;
        }
        let face = |(a, b): (&Face<S>, &Face<A>)| {
            let normal = a.normal.zip(&b.normal, f);
            let (offset, thickness) = (f(a.offset, b.offset), f(a.thickness, b.thickness));
            Some(Face { normal, rest: a.rest.zip(&b.rest, f)?, offset, thickness })
        };
        Some(Faced {
            whole: self.whole.zip(&other.whole, f)?,
            faces: self.faces.iter().zip(&other.faces).map(face).collect::<Option<_>>()?,
            thickness: f(self.thickness, other.thickness),
            bounds: [0, 1].map(|i: usize| self.bounds[i].zip(&other.bounds[i], f)),
        })
    }
}
