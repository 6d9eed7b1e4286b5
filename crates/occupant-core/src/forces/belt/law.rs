//! Belts: one loop round one sphere, in the plane of its centre and the two anchors.
//!
//! Report: Figs 17 and 18. With l₁, l₂ the distances from the centre c to the anchors, θ_i = acos(r/l_i) and θ₃
//! the angle between the anchors seen from c: wrap W = 2π − θ₁ − θ₂ − θ₃, length = l₁ sin θ₁ + l₂ sin θ₂ + rW. The force
//! on the sphere is −F_L times the gradient of the length: F_L times the sum of the unit vectors along the two free
//! lengths, which lies along their bisector with magnitude 2F_L cos α (Eq. 103). It acts at the centre (our decision).

use std::array::from_fn;
use std::f64::consts::{PI, TAU};

use crate::forces::belt::{Belt, RestLength};
use crate::forces::spring::Spring;
use crate::motion::scalar::Scalar;
use crate::motion::vector::V3;

/// Constants of a belt.
#[derive(Clone, Copy, Debug)]
pub struct BeltLaw<S> {
    /// Index of the sphere.
    pub sphere: usize,
    /// Index of the anchors' frame.
    pub frame: usize,
    anchors: [V3<S>; 2],
    radius: S,
    /// L₀, m.
    pub rest_length: S,
    webbing: Spring<S>,
}

/// Stored state of a belt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeltHistory<S> {
    /// Normal of the belt's plane, vehicle axes; it keeps its sense when the centre crosses the anchors' line.
    pub normal: V3<S>,
    /// Largest elongation so far, m.
    pub greatest: S,
}

/// A belt's shape and force at one instant.
#[derive(Clone, Copy, Debug)]
pub struct BeltAction<S> {
    /// Length of the belt on the body, m.
    pub length: S,
    /// Length − L₀, m.
    pub elongation: S,
    /// F_L, N.
    pub loop_force: S,
    /// Force on the sphere at its centre, vehicle axes, N.
    pub force: V3<S>,
    /// Recoverable energy, J.
    pub stored: S,
    /// Unit vectors along the free lengths, from the sphere to each anchor, vehicle axes.
    pub free: [V3<S>; 2],
    /// W, rad.
    pub wrap: S,
    /// Normal of the plane with the sense of the history.
    normal: V3<S>,
}

impl<S: Copy> BeltLaw<S> {
    /// f applied to every number and its counterpart in `other`, which goes around the same sphere.
    pub(crate) fn zip<A: Copy, T>(&self, other: &BeltLaw<A>, f: &impl Fn(S, A) -> T) -> BeltLaw<T> {
        BeltLaw {
            sphere: self.sphere,
            frame: self.frame,
            anchors: from_fn(|i| self.anchors[i].zip(&other.anchors[i], f)),
            radius: f(self.radius, other.radius),
            rest_length: f(self.rest_length, other.rest_length),
            webbing: self.webbing.zip(&other.webbing, f),
        }
    }
}

impl<S: Scalar> BeltLaw<S> {
    /// Constants from data, for the sphere's radius and a known L₀.
    pub(crate) fn new(belt: &Belt, radius_m: f64, rest_length_m: f64) -> Self {
        BeltLaw {
            sphere: belt.sphere,
            frame: belt.frame.index(&[]),
            anchors: [V3::of(&belt.anchors_m[0].coords), V3::of(&belt.anchors_m[1].coords)],
            radius: S::of(radius_m),
            rest_length: S::of(rest_length_m),
            webbing: Spring::new(&belt.webbing),
        }
    }

    /// The initial normal of the plane through the anchors and `centre`, for which θ₃ is in (0, π).
    pub fn initial_history(&self, centre: V3<S>) -> BeltHistory<S> {
        let normal = (self.anchors[0] - centre).cross(self.anchors[1] - centre);
        BeltHistory { normal: unit(normal), greatest: S::zero() }
    }

    /// Shape and force for the sphere's centre in vehicle axes.
    #[inline(always)]
    pub fn act(&self, centre: V3<S>, history: &BeltHistory<S>) -> BeltAction<S> {
        let (to_1, to_2) = (self.anchors[0] - centre, self.anchors[1] - centre);
        let cross = to_1.cross(to_2);
        let backward = cross.dot(history.normal).lt(S::zero());
        let (l_1, l_2) = (to_1.norm_squared().sqrt(), to_2.norm_squared().sqrt());
        let area = cross.norm_squared().sqrt();
        // on the anchors' line the plane is undetermined: it stays what it was
        let on_the_line = area.lt(l_1 * l_2 * S::of(1e-12));
        let normal = unit(V3::select(backward, -cross, cross));
        let normal = V3::select(on_the_line, history.normal, normal);
        // θ₃ (97), measured about the remembered normal: from 0 to 2π
        let sine = S::select(backward, -area, area);
        let angle = sine.atan2(to_1.dot(to_2));
        let theta_3 = S::select(angle.lt(S::zero()), angle + S::of(TAU), angle);

        let side_1 = Side::new(self.radius, l_1, to_1, normal.cross(to_1));
        let side_2 = Side::new(self.radius, l_2, to_2, to_2.cross(normal));
        // W = 2β (98), L_Bt (101), ΔL_B (102)
        let wrap = S::of(TAU) - side_1.theta - side_2.theta - theta_3;
        let length = side_1.free_length + side_2.free_length + self.radius * wrap;
        let elongation = length - self.rest_length;
        let (force, stored) = self.webbing.respond(elongation, history.greatest);
        let pulls = elongation.gt(S::zero()) & wrap.gt(S::zero());
        let loop_force = S::select(pulls, force, S::zero());
        BeltAction {
            length,
            elongation,
            loop_force,
            force: (side_1.direction + side_2.direction) * loop_force, // of length 2F_L cos α (103)
            stored: S::select(pulls, stored, S::zero()),
            free: [side_1.direction, side_2.direction],
            wrap,
            normal,
        }
    }

    /// Stores an accepted step.
    #[inline(always)]
    pub fn commit(&self, action: &BeltAction<S>, history: &mut BeltHistory<S>) {
        history.normal = action.normal;
        let pulls = action.wrap.gt(S::zero());
        history.greatest = S::select(pulls, history.greatest.max(action.elongation), history.greatest);
    }

    /// α = ½|θ₁ + θ₂ + θ₃ − π| of Eq. 99, from the wrap angle, rad.
    pub fn half_angle(wrap: S) -> S {
        (S::of(PI) - wrap).abs() * S::of(0.5)
    }
}

impl BeltLaw<f64> {
    /// The belt around a sphere with its centre at `centre` (vehicle axes), which determines its unstretched length.
    pub fn laid(belt: &Belt, radius_m: f64, centre: V3<f64>) -> Self {
        let mut law = BeltLaw::new(belt, radius_m, 0.0);
        let length = law.act(centre, &law.initial_history(centre)).length;
        law.rest_length = match belt.rest {
            RestLength::Slack { slack_m } => length + slack_m,
            RestLength::Given { length_m } => length_m,
        };
        law
    }
}

/// One free length: tangent from an anchor to the circle.
struct Side<S> {
    theta: S,
    free_length: S,
    direction: V3<S>,
}

impl<S: Scalar> Side<S> {
    /// `towards_other` is perpendicular to `to_anchor`, of the same length, on the other anchor's side.
    #[inline(always)]
    fn new(radius: S, distance: S, to_anchor: V3<S>, towards_other: V3<S>) -> Self {
        // with max(l, r) for l: an anchor inside the circle has no free length
        let l = distance.max(radius);
        let cosine = radius / l;
        let sine = (S::one() - cosine * cosine).max(S::zero()).sqrt();
        let inverse = S::one() / distance.max(S::of(1e-12));
        Side {
            theta: cosine.acos(), // (95), (96)
            free_length: l * sine,
            direction: to_anchor * (sine * inverse) + towards_other * (cosine * inverse),
        }
    }
}

/// v/|v|; v if it is zero.
#[inline(always)]
fn unit<S: Scalar>(v: V3<S>) -> V3<S> {
    v * (S::one() / v.norm_squared().max(S::of(1e-60)).sqrt())
}
