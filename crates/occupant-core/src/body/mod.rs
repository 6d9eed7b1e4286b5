//! The occupant's body: rigid segments, the tree that their joints make of them, and the spheres that can touch things.
//!
//! Report: "Body Geometry and Coordinate Systems", Figs 1 and 5. Segment axes are X ahead, Y to the
//! occupant's left and Z up when the occupant stands upright with hanging arms; they are principal axes.

pub(crate) mod people;
pub(crate) mod shape;
pub(crate) mod tree;
pub mod tti12;

use nalgebra::{Point3, Vector3};

pub use people::Sex;
pub use tree::{
    End, Joint, JointKind, JointRow, Landmarks, Limb, Pair, Place, Segment, SegmentRow, Side, SphereRow, Tree, Width,
    both_sides,
};

/// Number of rigid segments of the bodies that the kernel is compiled for.
pub const SEGMENTS: usize = tti12::TTI12.segment_rows().len();

/// Mass and geometry of one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentProperties {
    /// L, distance between the segment's ends.
    pub length_m: f64,
    /// M.
    pub mass_kg: f64,
    /// ρ, distance of the centre of gravity from the lower end (the distal end of a limb).
    pub cg_from_lower_end_m: f64,
    /// I_x, I_y, I_z about the centre of gravity, principal.
    pub inertia_kg_m2: Vector3<f64>,
}

/// A sphere fixed to a segment, the only part of the body that touches surfaces and belts.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSphere {
    /// Unique name, e.g. `head`, `left_knee`.
    pub name: String,
    /// The segment that carries it.
    pub segment: Segment,
    /// Centre in segment axes, measured from the segment's lower end.
    pub centre_from_lower_end_m: Point3<f64>,
    /// r.
    pub radius_m: f64,
    /// The part of the body that it belongs to, such as `head` or `left_shin`: results speak of the forces on all its spheres
    /// as one. A sphere alone is a part by its own name.
    pub part: String,
    /// What its contact forces are multiplied by, for a material that was measured on the whole part; 1 by default.
    pub share: f64,
}

impl ContactSphere {
    /// A sphere that is a part of its own.
    pub fn new(name: impl Into<String>, segment: Segment, centre_from_lower_end_m: Point3<f64>, radius_m: f64) -> Self {
        let name = name.into();
        ContactSphere { part: name.clone(), name, segment, centre_from_lower_end_m, radius_m, share: 1.0 }
    }
}

/// A whole body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Where it comes from, e.g. `male50`.
    pub name: String,
    /// Its segments, joints and standard spheres.
    pub tree: &'static Tree,
    /// Properties of the segments, in the tree's order.
    pub segments: [SegmentProperties; SEGMENTS],
    /// L_s, distance of a shoulder joint from the upper end of segment 2 along Y₂.
    pub shoulder_half_width_m: f64,
    /// L_H, distance of a hip joint from the lower end of segment 4 along Y₄.
    pub hip_half_width_m: f64,
    /// Height of the neck's joint above the line of the shoulders along Z₂; 0 in the report.
    pub neck_height_m: f64,
    /// Contact spheres; the tree's standard ones unless a scenario says otherwise.
    pub spheres: Vec<ContactSphere>,
}

impl Body {
    /// Properties of one segment.
    pub fn segment(&self, segment: Segment) -> &SegmentProperties {
        &self.segments[segment.index()]
    }

    /// Σ M.
    pub fn mass_kg(&self) -> f64 {
        self.segments.iter().map(|s| s.mass_kg).sum()
    }

    /// Index of the sphere with this name.
    pub fn sphere(&self, name: &str) -> Option<usize> {
        self.spheres.iter().position(|s| s.name == name)
    }

    /// Indices of the spheres of the part with this name, or else of the sphere.
    pub(crate) fn spheres_called(&self, name: &str) -> Vec<usize> {
        let part = (0..self.spheres.len()).filter(|i| self.spheres[*i].part == name);
        let part: Vec<usize> = part.collect();
        if part.is_empty() { self.sphere(name).into_iter().collect() } else { part }
    }

    /// Names of the parts, each once.
    pub fn parts(&self) -> impl Iterator<Item = &str> {
        let is_first = |i: &usize| self.spheres[..*i].iter().all(|other| other.part != self.spheres[*i].part);
        (0..self.spheres.len()).filter(is_first).map(|i| self.spheres[i].part.as_str())
    }

    /// Centres of the spheres of a body that stands upright with hanging arms; from T1 ahead, to the left and up, m.
    pub(crate) fn standing_m(&self) -> Vec<Point3<f64>> {
        let mut joints_m = vec![Vector3::zeros(); self.segments.len()];
        for segment in self.tree.segments() {
            if let Some(carrier) = self.tree.carrier(segment) {
                let [y, z] = self.joint_m(segment);
                joints_m[segment.index()] = joints_m[self.tree[carrier].proximal.index()] + Vector3::new(0.0, y, z);
            }
        }
        let place = |sphere: &ContactSphere| {
            let lower_end_m = self.far_m(sphere.segment).min(0.0);
            let joint_m = joints_m[sphere.segment.index()];
            sphere.centre_from_lower_end_m + joint_m + Vector3::new(0.0, 0.0, lower_end_m)
        };
        self.spheres.iter().map(place).collect()
    }

    /// Y of what is beside the middle plane, m.
    pub(crate) fn beside_m(&self, width: Width, side: Side) -> f64 {
        let half_width_m = match width {
            Width::Shoulder => self.shoulder_half_width_m,
            Width::Hip => self.hip_half_width_m,
        };
        if side == Side::Left { half_width_m } else { -half_width_m }
    }

    /// Y and Z of the joint that carries a segment, seen from the joint end of its proximal segment along that one's axes,
    /// m; 0 for both segments that meet at T1.
    pub(crate) fn joint_m(&self, segment: Segment) -> [f64; 2] {
        let Some(joint) = self.tree.carrier(segment) else {
            return [0.0; 2];
        };
        let joint = &self.tree[joint];
        let far_m = self.far_m(joint.proximal);
        match joint.place {
            Place::Root => [0.0; 2],
            Place::FarEnd => [0.0, far_m],
            Place::Neck => [0.0, far_m + self.neck_height_m],
            Place::Beside(width, side) => [self.beside_m(width, side), far_m],
        }
    }

    /// Z of the far end of a segment, seen from its joint end, m.
    pub(crate) fn far_m(&self, segment: Segment) -> f64 {
        let length_m = self.segment(segment).length_m;
        if self.tree[segment].hangs() { -length_m } else { length_m }
    }

    /// The tree's spheres (Fig. 5) on this body's segments; `radius_m` in the tree's order.
    pub fn standard_spheres(&self, radius_m: &[f64]) -> Vec<ContactSphere> {
        let sphere = |(row, &radius_m): (&SphereRow, &f64)| {
            let y_m = row.beside.map_or(0.0, |(width, side)| self.beside_m(width, side));
            let z_m = row.lengths * self.segment(row.segment).length_m + row.radii * radius_m;
            ContactSphere::new(row.name, row.segment, Point3::new(0.0, y_m, z_m), radius_m)
        };
        self.tree.spheres().iter().zip(radius_m).map(sphere).collect()
    }
}
