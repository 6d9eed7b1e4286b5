//! Constants of the multibody system: masses, inertias and joint positions, relative to each segment's own joint.
//!
//! Report: "Body Geometry and Coordinate Systems". There, relative to its proximal joint, the centre of gravity of a
//! segment is on its Z axis: at −ρ̄ for the hanging segments, at +ρ for the upper torso and the head (Eq. 15 is printed
//! with ρ₁ for ρ̄₁). In other bodies it may be anywhere, and so may the joints.

use nalgebra::{Matrix3, Vector3};

use crate::body::{Body, Plate, Segment};
use crate::motion::closed;
use crate::motion::frame::{Frames, Moving};
use crate::motion::layout::Layout;
use crate::motion::scalar::Scalar;
use crate::motion::vector::{M3, Sym3, V3};

/// Inertia and geometry of a segment; vectors are in its own axes unless noted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// M.
    pub mass_kg: f64,
    /// Centre of gravity from the segment's joint.
    pub cg_m: Vector3<f64>,
    /// Tensor of inertia about the centre of gravity.
    pub inertia_kg_m2: Matrix3<f64>,
    /// Segment's joint from the joint of the carrying segment, in that segment's axes.
    pub joint_m: Vector3<f64>,
    /// Axes X, Y, Z of the joint as columns, in axes of the carrying segment and of this one: where both agree, all
    /// hinge angles are 0.
    pub triads: [Matrix3<f64>; 2],
}

/// Constants of one segment.
#[derive(Clone, Copy, Debug)]
pub struct Link<S> {
    /// M, kg.
    pub mass: S,
    /// Centre of gravity from the proximal joint, m.
    pub cg: V3<S>,
    /// Proximal joint from that of the carrying segment, in that segment's axes, m.
    pub joint: V3<S>,
    /// Axes of the joint in the carrying segment, and in this one.
    pub triads: [M3<S>; 2],
    /// First moment of mass M·cg, kg·m.
    pub(crate) sigma: V3<S>,
    /// Inertia about the proximal joint, kg·m².
    pub(crate) inertia: Sym3<S>,
    /// 1/I_y of that inertia.
    pub(crate) inverse_iy: S,
    /// Inertia about the centre of gravity, kg·m².
    pub(crate) central: Sym3<S>,
}

/// A point mass that slides on a segment and is part of its mass, in its undeflected position.
#[derive(Clone, Copy, Debug)]
pub struct Slide<S> {
    /// Index of its segment.
    pub segment: usize,
    /// m, kg.
    pub mass: S,
    /// Undeflected position from the segment's proximal joint, segment axes, m.
    pub place: V3<S>,
    /// û, unit vector of sliding, segment axes.
    pub axis: V3<S>,
}

/// Mount of the root on a frame.
#[derive(Clone, Copy, Debug)]
pub struct Mount<S> {
    /// Index of the frame.
    pub frame: usize,
    /// Root's joint in axes of the frame, m.
    pub place: V3<S>,
    /// Root's axes in those of the frame.
    pub axes: M3<S>,
}

/// Constants of the whole body.
#[derive(Clone, Debug)]
pub struct Skeleton<S> {
    /// Tree structure.
    pub layout: Layout,
    /// By segment.
    pub links: Vec<Link<S>>,
    /// g along −Z′, m/s².
    pub gravity: S,
    /// Sliding point masses, in the order of the bodies' plates.
    pub slides: Vec<Slide<S>>,
    /// By body.
    pub(crate) roots: Vec<Root<S>>,
}

/// Mount of a body and its method of computation.
#[derive(Clone, Debug)]
pub(crate) struct Root<S> {
    /// Mount of a guided root.
    pub mount: Option<Mount<S>>,
    /// Whether the closed forms of the report's body hold.
    pub is_closed: bool,
}

impl Part {
    /// Whether it fits [`closed`]: principal axes along its own, centre of gravity and joint on Z of both segments,
    /// lateral joint offset along Y.
    fn is_plain(&self) -> bool {
        let inertia = Matrix3::from_diagonal(&self.inertia_kg_m2.diagonal());
        self.cg_m.xy() == Vector3::zeros().xy()
            && self.inertia_kg_m2 == inertia
            && self.joint_m.x == 0.0
            && self.triads == [Matrix3::identity(); 2]
    }
}

impl Link<f64> {
    fn new(part: &Part) -> Self {
        let sigma = part.cg_m * part.mass_kg;
        // I + M (cg² 1 − cg cgᵀ)
        let c = &part.cg_m;
        let product = sigma * c.transpose();
        let others = |i: usize| product[((i + 1) % 3, (i + 1) % 3)] + product[((i + 2) % 3, (i + 2) % 3)];
        let shift = Matrix3::from_fn(|i, j| if i == j { others(i) } else { -product[(i, j)] });
        let inertia = Sym3::of(&(part.inertia_kg_m2 + shift));
        Link {
            mass: part.mass_kg,
            cg: V3::of(c),
            joint: V3::of(&part.joint_m),
            triads: part.triads.map(|triad| M3::of(&triad)),
            sigma: V3::of(&sigma),
            inertia,
            inverse_iy: 1.0 / inertia.yy,
            central: Sym3::of(&part.inertia_kg_m2),
        }
    }
}

impl<S: Copy> Link<S> {
    /// f applied to corresponding numbers of this and `other`.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Link<A>, f: &impl Fn(S, A) -> T) -> Link<T> {
        let ([inner, outer], [others_inner, others_outer]) = (&self.triads, &other.triads);
        Link {
            mass: f(self.mass, other.mass),
            cg: self.cg.zip(&other.cg, f),
            joint: self.joint.zip(&other.joint, f),
            triads: [inner.zip(others_inner, f), outer.zip(others_outer, f)],
            sigma: self.sigma.zip(&other.sigma, f),
            inertia: self.inertia.zip(&other.inertia, f),
            inverse_iy: f(self.inverse_iy, other.inverse_iy),
            central: self.central.zip(&other.central, f),
        }
    }
}

impl<S: Scalar> Link<S> {
    /// I v about the centre of gravity, segment axes.
    pub fn by_inertia(&self, v: V3<S>) -> V3<S> {
        self.central.mul(v)
    }
}

impl<S: Scalar> Mount<S> {
    /// Motion of the root in the frame that carries it.
    #[inline(always)]
    pub(crate) fn of(&self, frames: &Frames<S>) -> Moving<S> {
        frames[self.frame].carried(self.place, &self.axes)
    }
}

impl<S: Copy> Slide<S> {
    /// f applied to corresponding numbers of this and `other`.
    fn zip<A: Copy, T>(&self, other: &Slide<A>, f: &impl Fn(S, A) -> T) -> Slide<T> {
        let (place, axis) = (self.place.zip(&other.place, f), self.axis.zip(&other.axis, f));
        Slide { segment: self.segment, mass: f(self.mass, other.mass), place, axis }
    }
}

impl<S: Copy> Skeleton<S> {
    /// Whether another has the same trees on the same frames and is computed in the same way.
    pub(crate) fn is_like<A>(&self, other: &Skeleton<A>) -> bool {
        let roots = self.roots.iter().map(Root::structure);
        let slides = self.slides.iter().map(|slide| slide.segment);
        let same_slides = slides.eq(other.slides.iter().map(|slide| slide.segment));
        same_slides && self.layout == other.layout && roots.eq(other.roots.iter().map(Root::structure))
    }

    /// f applied to corresponding numbers of this and `other`, which [is like](Skeleton::is_like) it.
    pub(crate) fn zip<A: Copy, T>(&self, other: &Skeleton<A>, f: &impl Fn(S, A) -> T) -> Skeleton<T> {
        let mount = |(a, b): (&Mount<S>, &Mount<A>)| Mount {
            frame: a.frame,
            place: a.place.zip(&b.place, f),
            axes: a.axes.zip(&b.axes, f),
        };
        let root = |(a, b): (&Root<S>, &Root<A>)| Root {
            mount: a.mount.as_ref().zip(b.mount.as_ref()).map(mount),
            is_closed: a.is_closed,
        };
        Skeleton {
            layout: self.layout.clone(),
            links: self.links.iter().zip(&other.links).map(|(a, b)| a.zip(b, f)).collect(),
            gravity: f(self.gravity, other.gravity),
            slides: self.slides.iter().zip(&other.slides).map(|(a, b)| a.zip(b, f)).collect(),
            roots: self.roots.iter().zip(&other.roots).map(root).collect(),
        }
    }
}

impl<S> Root<S> {
    /// The frame of its mount, and whether closed forms hold.
    fn structure(&self) -> (Option<usize>, bool) {
        (self.mount.as_ref().map(|mount| mount.frame), self.is_closed)
    }
}

impl Skeleton<f64> {
    /// Constants of `body` under gravity `gravity_m_s2`.
    pub fn new(body: &Body, gravity_m_s2: f64) -> Self {
        let parts: Vec<Part> = body.tree.segments().map(|segment| part(body, segment)).collect();
        let mut skeleton = Skeleton::of(Layout::of(body.tree), &parts, gravity_m_s2);
        skeleton.slides = body.plates.iter().map(|plate| slide(body, plate)).collect();
        // joints that a body places itself may be where no closed form has them, which know no plates
        if body.places.is_empty() && body.plates.is_empty() { skeleton } else { skeleton.without_closed_forms() }
    }

    /// Constants of a tree of `parts`, in the layout's order. A guided root is at rest without a [`Mount`].
    pub fn of(layout: Layout, parts: &[Part], gravity_m_s2: f64) -> Self {
        debug_assert_eq!(layout.len(), parts.len());
        let is_closed = closed::holds(&layout) && parts.iter().all(Part::is_plain);
        let links = parts.iter().map(Link::new).collect();
        Skeleton {
            layout,
            links,
            gravity: gravity_m_s2,
            slides: Vec::new(),
            roots: vec![Root { mount: None, is_closed }],
        }
    }

    /// Several bodies under the gravity of the first.
    pub(crate) fn together(all: &[&Skeleton<f64>]) -> Self {
        Skeleton {
            layout: Layout::together(all.iter().map(|one| &one.layout)),
            links: all.iter().flat_map(|one| one.links.iter().copied()).collect(),
            gravity: all.first().map_or(0.0, |one| one.gravity),
            slides: slides_together(all),
            roots: all.iter().flat_map(|one| one.roots.iter().cloned()).collect(),
        }
    }

    /// The same, mounted on a frame.
    pub fn mounted(self, mount: Mount<f64>) -> Self {
        Skeleton { layout: self.layout.guided(), roots: vec![Root { mount: Some(mount), is_closed: false }], ..self }
    }

    /// The same, computed as a general tree: equal to the closed forms within rounding.
    pub fn without_closed_forms(mut self) -> Self {
        self.roots.iter_mut().for_each(|root| root.is_closed = false);
        self
    }
}

fn slide(body: &Body, plate: &Plate) -> Slide<f64> {
    let place = plate.place_from_lower_end_m.coords - body.joint_m(plate.segment);
    let axis = plate.inward.try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
    Slide { segment: plate.segment.index(), mass: plate.mass_kg, place: V3::of(&place), axis: V3::of(&axis) }
}

/// Slides of several bodies, one after another.
fn slides_together(all: &[&Skeleton<f64>]) -> Vec<Slide<f64>> {
    let (mut slides, mut first) = (Vec::new(), 0);
    for one in all {
        slides.extend(one.slides.iter().map(|slide| Slide { segment: first + slide.segment, ..*slide }));
        first += one.links.len();
    }
    slides
}

fn part(body: &Body, segment: Segment) -> Part {
    let p = body.segment(segment);
    let turn = p.principal.to_rotation_matrix().into_inner();
    let triads = body.tree.bearer(segment).map(|joint| {
        let triads = body.sites(joint).map(|site| site.axes.to_rotation_matrix().into_inner());
        let row = &body.tree[joint];
        // a pin on which the proximal segment hangs turns by the same angle the other way, about −Y
        let turned = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        if row.is_reversed() && row.is_hinge() { triads.map(|triad| triad * turned) } else { triads }
    });
    Part {
        mass_kg: p.mass_kg,
        cg_m: p.cg_m() - body.joint_m(segment),
        inertia_kg_m2: turn * Matrix3::from_diagonal(&p.inertia_kg_m2) * turn.transpose(),
        joint_m: body.offset_m(segment),
        triads: triads.unwrap_or([Matrix3::identity(); 2]),
    }
}
