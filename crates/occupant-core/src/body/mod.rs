//! The occupant's body: rigid segments, the tree of their joints, and their contact spheres.
//!
//! Report: "Body Geometry and Coordinate Systems", Figs 1 and 5. Segment axes are X forward, Y to the occupant's left
//! and Z up when the occupant stands upright with hanging arms; they are principal axes.

mod mounted;
pub mod named;
pub mod people;
mod plates;
pub mod shape;
mod together;
pub(crate) mod tree;
pub mod tti12;

use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector2, Vector3};

pub use people::Sex;
pub use plates::{Chest, Plate, Ride, Shares, Sides};
pub(crate) use together::called;
pub use tree::{
    BodyRow, End, Joint, JointKind, JointRow, Landmarks, Limb, Pair, Place, Segment, SegmentRow, Side, SphereRow, Tree,
    Width, both_sides,
};

/// Number of rigid segments of the report's body.
pub const SEGMENTS: usize = tti12::TTI12.segment_rows().len();

/// Mass and geometry of one segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentProperties {
    /// L, distance between the segment's ends, which lie on its Z axis.
    pub length_m: f64,
    /// M.
    pub mass_kg: f64,
    /// ρ, distance of the centre of gravity from the lower end (the distal end of a limb) along Z.
    pub cg_from_lower_end_m: f64,
    /// X and Y of the centre of gravity; 0 in the report.
    pub cg_beside_m: Vector2<f64>,
    /// Principal moments of inertia about the centre of gravity; I_x, I_y, I_z in the report.
    pub inertia_kg_m2: Vector3<f64>,
    /// Rotation of the principal axes to the segment's axes; identity in the report.
    pub principal: UnitQuaternion<f64>,
}

impl SegmentProperties {
    /// Properties of a missing segment.
    const NONE: SegmentProperties = {
        let none = f64::NAN;
        SegmentProperties {
            length_m: none,
            mass_kg: none,
            cg_from_lower_end_m: none,
            cg_beside_m: Vector2::new(none, none),
            inertia_kg_m2: Vector3::new(none, none, none),
            principal: UnitQuaternion::new_unchecked(Quaternion::new(none, none, none, none)),
        }
    };

    /// Properties as in the report: the centre of gravity on the line between the ends, the segment's axes principal.
    pub fn new(length_m: f64, mass_kg: f64, cg_from_lower_end_m: f64, inertia_kg_m2: Vector3<f64>) -> Self {
        SegmentProperties {
            length_m,
            mass_kg,
            cg_from_lower_end_m,
            cg_beside_m: Vector2::zeros(),
            inertia_kg_m2,
            principal: UnitQuaternion::identity(),
        }
    }

    /// Centre of gravity from the lower end, segment axes, m.
    pub fn cg_m(&self) -> Vector3<f64> {
        self.cg_beside_m.push(self.cg_from_lower_end_m)
    }
}

/// Location of a joint on one of its segments: a point from the segment's lower end, and the joint's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointSite {
    /// From the lower end, segment axes, m.
    pub point_m: Vector3<f64>,
    /// Rotation of the joint's axes to the segment's. In the zero posture those of both segments coincide.
    pub axes: UnitQuaternion<f64>,
}

impl JointSite {
    /// A location with the segment's own axes.
    pub(crate) fn at(point_m: Vector3<f64>) -> Self {
        JointSite { point_m, axes: UnitQuaternion::identity() }
    }
}

/// Location of a joint on its proximal and its distal segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointPlace {
    /// On the segment nearer to the root.
    pub proximal: JointSite,
    /// On the segment that it carries.
    pub distal: JointSite,
}

/// A sphere fixed to a segment; only spheres touch surfaces and belts.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactSphere {
    /// Unique name, e.g. `head`, `left_knee`.
    pub name: String,
    /// Its segment.
    pub segment: Segment,
    /// Centre in segment axes, measured from the segment's lower end.
    pub centre_from_lower_end_m: Point3<f64>,
    /// r.
    pub radius_m: f64,
    /// Body part that it belongs to, such as `head` or `left_shin`; results combine the forces on all its spheres. A
    /// single sphere is a part with its own name.
    pub part: String,
    /// Factor on its contact forces, for a material measured on the whole part; 1 by default.
    pub share: f64,
    /// The same on bars thinner than itself that cross a limb: capsules and rims; 1 by default.
    pub bar_share: f64,
    /// Deformable parts that it rides on; none by default.
    pub ride: Ride,
}

impl ContactSphere {
    /// A sphere that is its own part.
    pub fn new(name: impl Into<String>, segment: Segment, centre_from_lower_end_m: Point3<f64>, radius_m: f64) -> Self {
        let name = name.into();
        ContactSphere {
            part: name.clone(),
            name,
            segment,
            centre_from_lower_end_m,
            radius_m,
            share: 1.0,
            bar_share: 1.0,
            ride: Ride::default(),
        }
    }
}

/// A whole body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its origin, e.g. `male50`.
    pub name: String,
    /// Its segments, joints and standard spheres.
    pub tree: &'static Tree,
    /// Properties of the segments, in the tree's order.
    pub segments: Vec<SegmentProperties>,
    /// Places of joints that the tree does not define ([`Place::Given`]), in the tree's order; else empty.
    pub places: Vec<JointPlace>,
    /// L_s, distance of a shoulder joint from the upper end of segment 2 along Y₂.
    pub shoulder_half_width_m: f64,
    /// L_H, distance of a hip joint from the lower end of segment 4 along Y₄.
    pub hip_half_width_m: f64,
    /// Height of the neck's joint above the line of the shoulders along Z₂; 0 in the report.
    pub neck_height_m: f64,
    /// Position of the occipital condyles from the neck joint, axes of the head, where upper neck loads are given. If
    /// absent, they are given at the joint.
    pub condyles_m: Option<Vector3<f64>>,
    /// Contact spheres; the tree's standard ones unless a scenario says otherwise.
    pub spheres: Vec<ContactSphere>,
    /// Deformable parts; none for a rigid trunk.
    pub plates: Vec<Plate>,
    /// Chests in the results, at most one per body.
    pub chests: Vec<Chest>,
    /// Sides of trunks that yield.
    pub sides: Vec<Sides>,
}

impl Body {
    /// Properties of a segment; NaN for a segment that the body lacks.
    pub fn segment(&self, segment: Segment) -> &SegmentProperties {
        self.segments.get(segment.index()).unwrap_or(&SegmentProperties::NONE)
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
    pub fn spheres_called(&self, name: &str) -> Vec<usize> {
        let part = (0..self.spheres.len()).filter(|i| self.spheres[*i].part == name);
        let part: Vec<usize> = part.collect();
        if part.is_empty() { self.sphere(name).into_iter().collect() } else { part }
    }

    /// Names of the parts, each once.
    pub(crate) fn parts(&self) -> impl Iterator<Item = &str> {
        let is_first = |i: &usize| self.spheres[..*i].iter().all(|other| other.part != self.spheres[*i].part);
        (0..self.spheres.len()).filter(is_first).map(|i| self.spheres[i].part.as_str())
    }

    /// Centres of the spheres of a body standing upright with hanging arms; from T1 forward, left and up, m.
    pub fn standing_m(&self) -> Vec<Point3<f64>> {
        let mut placed = vec![(UnitQuaternion::identity(), Vector3::zeros()); self.segments.len()];
        for segment in self.tree.segments() {
            if let Some(bearer) = self.tree.bearer(segment) {
                let (turn, joint_m) = placed[self.tree[bearer].carrying()[0].index()];
                let [carrying, carried] = self.sites(bearer);
                let turned = turn * carrying.axes * carried.axes.inverse();
                placed[segment.index()] = (turned, joint_m + turn * self.offset_m(segment));
            }
        }
        let place = |sphere: &ContactSphere| {
            let (turn, joint_m) = placed[sphere.segment.index()];
            Point3::from(joint_m + turn * (sphere.centre_from_lower_end_m.coords - self.joint_m(sphere.segment)))
        };
        self.spheres.iter().map(place).collect()
    }

    /// Y of a point beside the middle plane, m.
    pub(crate) fn beside_m(&self, width: Width, side: Side) -> f64 {
        let half_width_m = match width {
            Width::Shoulder => self.shoulder_half_width_m,
            Width::Hip => self.hip_half_width_m,
        };
        if side == Side::Left { half_width_m } else { -half_width_m }
    }

    /// Location of a joint on both of its segments.
    pub fn place(&self, joint: Joint) -> JointPlace {
        let row = &self.tree[joint];
        let at = |y: f64, above_m: f64| {
            let far_m = if self.tree[row.proximal].hangs() { 0.0 } else { self.segment(row.proximal).length_m };
            JointSite::at(Vector3::new(0.0, y, far_m + above_m))
        };
        let proximal = match row.place {
            Place::Given => return self.places[joint.index()],
            Place::Root => JointSite::at(self.end_m(row.proximal)),
            Place::FarEnd => at(0.0, 0.0),
            Place::Neck => at(0.0, self.neck_height_m),
            Place::Beside(width, side) => at(self.beside_m(width, side), 0.0),
        };
        JointPlace { proximal, distal: JointSite::at(self.end_m(row.distal)) }
    }

    /// Location of a joint on the segment nearer to the root, and on the one that it carries.
    pub(crate) fn sites(&self, joint: Joint) -> [JointSite; 2] {
        let JointPlace { proximal, distal } = self.place(joint);
        if self.tree[joint].is_reversed() { [distal, proximal] } else { [proximal, distal] }
    }

    /// Joint point of a segment for the kernel, from its lower end, segment axes, m: that of the joint which carries
    /// it; for the first segment the end at T1.
    pub fn joint_m(&self, segment: Segment) -> Vector3<f64> {
        self.tree.bearer(segment).map_or_else(|| self.end_m(segment), |joint| self.sites(joint)[1].point_m)
    }

    /// Location, on the proximal segment, of the joint whose distal segment is given, from the proximal one's lower
    /// end, m; zero for the middle of the trunk.
    pub fn socket_m(&self, segment: Segment) -> Vector3<f64> {
        self.tree.carrier(segment).map_or_else(Vector3::zeros, |joint| self.place(joint).proximal.point_m)
    }

    /// Height above the upper end of a segment of the joint towards the head, m.
    pub fn neck_above_m(&self, segment: Segment) -> Option<f64> {
        let joint = |n: &Segment| self.tree.carrier(*n).is_some_and(|joint| self.tree[joint].proximal == segment);
        let next = self.tree.inwards(self.tree.landmarks().head?).find(joint)?;
        Some(self.socket_m(next).z - self.segment(segment).length_m)
    }

    /// Position of the joint that carries a segment, from the joint of its parent, in the parent's axes, m; zero for
    /// the first segment.
    pub(crate) fn offset_m(&self, segment: Segment) -> Vector3<f64> {
        let Some(joint) = self.tree.bearer(segment) else { return Vector3::zeros() };
        self.sites(joint)[0].point_m - self.joint_m(self.tree[joint].carrying()[0])
    }

    /// Z of the far end of a segment, seen from its joint end, m.
    pub(crate) fn far_m(&self, segment: Segment) -> f64 {
        let length_m = self.segment(segment).length_m;
        if self.tree[segment].hangs() { -length_m } else { length_m }
    }

    /// Z of the end with the joint that carries a segment, from the lower end, m.
    fn end_m(&self, segment: Segment) -> Vector3<f64> {
        let hangs = self.tree[segment].hangs();
        Vector3::z() * if hangs { self.segment(segment).length_m } else { 0.0 }
    }

    /// The tree's standard spheres (Fig. 5) on this body's segments; `radius_m` in the tree's order.
    pub fn standard_spheres(&self, radius_m: &[f64]) -> Vec<ContactSphere> {
        let sphere = |(row, &radius_m): (&SphereRow, &f64)| {
            let y_m = row.beside.map_or(0.0, |(width, side)| self.beside_m(width, side));
            let z_m = row.lengths * self.segment(row.segment).length_m + row.radii * radius_m;
            ContactSphere::new(row.name, row.segment, Point3::new(0.0, y_m, z_m), radius_m)
        };
        self.tree.spheres().iter().zip(radius_m).map(sphere).collect()
    }
}
