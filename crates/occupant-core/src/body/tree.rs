//! The structure of a body as one table: segments, their joints, and their spheres.
//!
//! Everything that depends on the order or the topology of a body is derived from its [`Tree`]: the loops of the kernel
//! ([`crate::motion::layout`]), the report's coordinates, names in scenarios and results. It contains no masses or
//! lengths; those are in [`super::Body`].

use std::collections::BTreeSet;
use std::ops::Index;
use std::sync::{Mutex, PoisonError};

/// A segment of a tree: its index in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Segment(pub(super) usize);

impl Segment {
    /// Index in the table, from 0.
    pub const fn index(self) -> usize {
        self.0
    }

    /// The report's number, from 1.
    pub const fn number(self) -> usize {
        self.0 + 1
    }

    /// The segment with its index shifted by `first`.
    pub(crate) const fn behind(self, first: usize) -> Self {
        Segment(first + self.0)
    }
}

/// A joint of a tree: its index in the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Joint(pub(super) usize);

impl Joint {
    /// Index in the table, from 0.
    pub(crate) const fn index(self) -> usize {
        self.0
    }

    /// The report's number, from 1.
    pub const fn number(self) -> usize {
        self.0 + 1
    }
}

/// An end of a segment, named in the standing posture with hanging arms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The proximal end of a limb.
    Upper,
    /// The distal end of a limb.
    Lower,
}

/// A side of the body, as the occupant sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// +Y.
    Left,
    /// −Y.
    Right,
}

/// A lateral distance defined by the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// L_s.
    Shoulder,
    /// L_H.
    Hip,
}

/// Row of the segment table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentRow {
    /// Name in scenarios and result channels.
    pub name: &'static str,
    /// The end with the joint that carries it.
    pub joint_end: End,
}

impl SegmentRow {
    /// Whether its joint is at its upper end.
    pub const fn hangs(&self) -> bool {
        matches!(self.joint_end, End::Upper)
    }
}

/// Degrees of freedom of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// All rotations.
    Ball,
    /// About the common Y axis only.
    Hinge,
    /// About the Y axis, then about the X axis rotated by the first; its angle is the first.
    Universal,
    /// None.
    Fixed,
}

/// Location of a joint on its proximal segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At the reference point T1, the joint end of the first segment.
    Root,
    /// At the end opposite to the joint end.
    FarEnd,
    /// Above that end, by a height defined by the body.
    Neck,
    /// Lateral to that end.
    Beside(Width, Side),
    /// Defined by the body: [`super::Body::places`].
    Given,
}

/// Row of the joint table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRow {
    /// Name in scenarios and result channels.
    pub name: &'static str,
    /// Kind of motion.
    pub kind: JointKind,
    /// The segment nearer to the root.
    pub proximal: Segment,
    /// The segment that it carries.
    pub distal: Segment,
    /// Location on the proximal segment.
    pub place: Place,
}

impl JointRow {
    /// The side of the joint.
    pub fn side(&self) -> Option<Side> {
        match self.place {
            Place::Beside(_, side) => Some(side),
            Place::Given => {
                // behind the name of one of several bodies
                let own = self.name.rsplit('.').next().unwrap_or_default();
                let sides = [("left_", Side::Left), ("right_", Side::Right)];
                sides.into_iter().find_map(|(word, side)| own.starts_with(word).then_some(side))
            }
            _ => None,
        }
    }

    /// Whether this joint is reversed, on the path to a mount beyond it: its distal segment carries the proximal one.
    pub fn is_reversed(&self) -> bool {
        self.proximal > self.distal
    }

    /// The segment nearer to the root, and the one that it carries. Laws use proximal and distal segments, which do not
    /// depend on the mount.
    pub(crate) fn carrying(&self) -> [Segment; 2] {
        if self.is_reversed() { [self.distal, self.proximal] } else { [self.proximal, self.distal] }
    }

    /// Inner and outer segment of its laws: proximal and distal; but for a hinge, whose axis belongs to the carried
    /// segment, [`JointRow::carrying`].
    pub(crate) fn between(&self) -> [Segment; 2] {
        if self.is_hinge() { self.carrying() } else { [self.proximal, self.distal] }
    }

    /// Whether it is a hinge (elbow, knee) or has two free axes.
    pub const fn is_hinge(&self) -> bool {
        matches!(self.kind, JointKind::Hinge | JointKind::Universal)
    }
}

/// Row of the table of standard spheres: its centre is `lengths`·L + `radii`·r above the segment's lower end, L the
/// segment's length and r the sphere's radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereRow {
    /// Name in scenarios and result channels.
    pub name: &'static str,
    /// Its segment.
    pub segment: Segment,
    /// Factor on the segment's length.
    pub lengths: f64,
    /// Factor on the sphere's own radius.
    pub radii: f64,
    /// Lateral distance from the middle plane; 0 if absent.
    pub beside: Option<(Width, Side)>,
}

/// An arm or a leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    /// Upper arm or thigh.
    pub upper: Segment,
    /// Forearm or lower leg, on a hinge.
    pub lower: Segment,
    /// Hand or foot, if it is a separate segment.
    pub end: Option<Segment>,
}

/// A left–right pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<T> {
    /// The left one.
    pub left: T,
    /// The right one.
    pub right: T,
}

/// Parts used by instruments and seating; a mounted body may lack any.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landmarks {
    /// Segment with the head accelerometer.
    pub head: Option<Segment>,
    /// Segment with the chest accelerometer.
    pub chest: Option<Segment>,
    /// Segment that sits on the cushion.
    pub pelvis: Option<Segment>,
    /// Joint whose load is that of the upper neck.
    pub neck: Option<Joint>,
    /// Arms.
    pub arms: Pair<Option<Limb>>,
    /// Legs.
    pub legs: Pair<Option<Limb>>,
}

impl Landmarks {
    /// No landmarks.
    pub const NONE: Landmarks = Landmarks {
        head: None,
        chest: None,
        pelvis: None,
        neck: None,
        arms: Pair { left: None, right: None },
        legs: Pair { left: None, right: None },
    };

    /// The landmarks with mapped indices of segments and joints, where they exist.
    pub(crate) fn map(
        &self,
        segment: impl Fn(Segment) -> Option<Segment>,
        joint: impl Fn(Joint) -> Option<Joint>,
    ) -> Landmarks {
        let limb = |limb: Limb| {
            Some(Limb { upper: segment(limb.upper)?, lower: segment(limb.lower)?, end: limb.end.and_then(&segment) })
        };
        let limbs = |of: Pair<Option<Limb>>| Pair { left: of.left.and_then(limb), right: of.right.and_then(limb) };
        Landmarks {
            head: self.head.and_then(&segment),
            chest: self.chest.and_then(&segment),
            pelvis: self.pelvis.and_then(&segment),
            neck: self.neck.and_then(joint),
            arms: limbs(self.arms),
            legs: limbs(self.legs),
        }
    }

    /// Segments that carry the accelerometers of head, chest and pelvis.
    pub(crate) fn instruments(&self) -> [Option<Segment>; 3] {
        [self.head, self.chest, self.pelvis]
    }

    /// The arms that the body has.
    pub fn arms(&self) -> impl Iterator<Item = Limb> + Clone + use<> {
        [self.arms.left, self.arms.right].into_iter().flatten()
    }

    /// The legs that the body has.
    pub fn legs(&self) -> impl Iterator<Item = Limb> + Clone + use<> {
        [self.legs.left, self.legs.right].into_iter().flatten()
    }
}

/// Tables of a body. A segment comes after its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tree {
    pub(super) segments: &'static [SegmentRow],
    pub(super) joints: &'static [JointRow],
    pub(super) spheres: &'static [SphereRow],
    pub(super) landmarks: Landmarks,
    /// First segments of several bodies; empty for a single one.
    pub(super) bodies: &'static [BodyRow],
}

/// A body among several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyRow {
    /// Its name in scenarios and results; empty for a single one.
    pub name: &'static str,
    /// Its first segment.
    pub first: Segment,
    /// Its landmarks.
    pub landmarks: Landmarks,
}

/// Joints that do not form a tree.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TreeProblem {
    /// A missing segment for a landmark, by its key in a scenario.
    #[error("no segment for the landmark `{0}`")]
    MissingLandmark(&'static str),
    /// A segment not named by an earlier joint.
    #[error("the joint `{joint}` is on `{segment}`, which no joint before it carries{}", meant(.nearest.as_deref()))]
    UnknownSegment {
        /// Name of the joint.
        joint: String,
        /// Its proximal segment.
        segment: String,
        /// The nearest existing name, if any is near.
        nearest: Option<String>,
    },
    /// A segment carried by two joints, or by itself.
    #[error("the joint `{joint}` carries `{segment}`, which is there already")]
    Twice {
        /// Name of the joint.
        joint: String,
        /// Its distal segment.
        segment: String,
    },
}

fn meant(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

/// A name with static lifetime, interned.
pub(crate) fn kept(name: &str) -> &'static str {
    static NAMES: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut names = NAMES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = names.get(name) {
        return known;
    }
    let kept: &'static str = Box::leak(name.into());
    names.insert(kept);
    kept
}

impl Tree {
    /// The tree of these tables, in which a segment comes after its parent. It has static lifetime and is interned:
    /// runs that differ only in numbers share it.
    pub(crate) fn interned(
        segments: &[SegmentRow],
        joints: &[JointRow],
        spheres: &[SphereRow],
        landmarks: Landmarks,
        bodies: &[BodyRow],
    ) -> &'static Tree {
        static TREES: Mutex<Vec<&'static Tree>> = Mutex::new(Vec::new());
        let is_it = |tree: &Tree| {
            (tree.segments, tree.joints, tree.spheres) == (segments, joints, spheres)
                && (tree.landmarks, tree.bodies) == (landmarks, bodies)
        };
        let mut trees = TREES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = trees.iter().find(|tree| is_it(tree)) {
            return known;
        }
        let kept: &'static Tree = Box::leak(Box::new(Tree {
            segments: segments.to_vec().leak(),
            joints: joints.to_vec().leak(),
            spheres: spheres.to_vec().leak(),
            landmarks,
            bodies: bodies.to_vec().leak(),
        }));
        trees.push(kept);
        kept
    }

    /// Rows of the segments.
    pub const fn segment_rows(&self) -> &'static [SegmentRow] {
        self.segments
    }

    /// Rows of the joints.
    pub const fn joint_rows(&self) -> &'static [JointRow] {
        self.joints
    }

    /// Rows of the standard spheres.
    pub const fn spheres(&self) -> &'static [SphereRow] {
        self.spheres
    }

    /// 6 per first segment, plus those of the joints.
    pub(crate) fn degrees_of_freedom(&self) -> usize {
        let free = |row: &JointRow| match row.kind {
            JointKind::Ball => 3,
            JointKind::Hinge => 1,
            JointKind::Universal => 2,
            JointKind::Fixed => 0,
        };
        6 * self.bodies.len().max(1) + self.joints.iter().map(free).sum::<usize>()
    }

    /// Names of the standard spheres, in the table's order.
    pub fn sphere_names(&self) -> Vec<&'static str> {
        self.spheres.iter().map(|row| row.name).collect()
    }

    /// Landmarks of the first body.
    pub const fn landmarks(&self) -> &Landmarks {
        &self.landmarks
    }

    /// The landmarks of the body of a segment.
    pub fn landmarks_at(&self, segment: Segment) -> &Landmarks {
        let body = self.bodies.iter().rfind(|body| body.first <= segment);
        body.map_or(&self.landmarks, |body| &body.landmarks)
    }

    /// All bodies; for a single one that one without a name.
    pub fn bodies(&self) -> Vec<BodyRow> {
        let alone = BodyRow { name: "", first: Segment(0), landmarks: self.landmarks };
        if self.bodies.is_empty() { vec![alone] } else { self.bodies.to_vec() }
    }

    /// The body (index) that a segment belongs to.
    pub fn body_of(&self, segment: Segment) -> usize {
        self.bodies.iter().rposition(|body| body.first <= segment).unwrap_or(0)
    }

    /// The segment with an index. For an invalid index, its row has no name, and a model refuses it.
    pub const fn segment(&self, index: usize) -> Segment {
        Segment(index)
    }

    /// The joint with an index; for an invalid index as for [`Tree::segment`].
    pub const fn joint(&self, index: usize) -> Joint {
        Joint(index)
    }

    /// All segments in the table's order.
    pub fn segments(&self) -> impl ExactSizeIterator<Item = Segment> + Clone + use<> {
        (0..self.segments.len()).map(Segment)
    }

    /// All joints in the table's order.
    pub fn joints(&self) -> impl ExactSizeIterator<Item = Joint> + Clone + use<> {
        (0..self.joints.len()).map(Joint)
    }

    /// The segment with this name.
    pub fn segment_named(&self, name: &str) -> Option<Segment> {
        self.segments().find(|s| self[*s].name == name)
    }

    /// The joint with this name.
    pub fn joint_named(&self, name: &str) -> Option<Joint> {
        self.joints().find(|j| self[*j].name == name)
    }

    /// The joint to the segment's parent; none for the root. Usually the segment is its distal side; on the path from
    /// the root to a mount it is the proximal one.
    pub fn bearer(&self, segment: Segment) -> Option<Joint> {
        self.joints().find(|joint| self[*joint].carrying()[1] == segment)
    }

    /// The joint whose distal segment is given; none for the middle of the trunk.
    pub(crate) const fn carrier(&self, segment: Segment) -> Option<Joint> {
        let mut j = 0;
        while j < self.joints.len() {
            if self.joints[j].distal.0 == segment.0 {
                return Some(Joint(j));
            }
            j += 1;
        }
        None
    }
}

impl Tree {
    /// A segment and those between it and the middle of the trunk, which comes last.
    pub(crate) fn inwards(&self, segment: Segment) -> impl Iterator<Item = Segment> + Clone + '_ {
        let proximal = |n: &Segment| Some(self[self.carrier(*n)?].proximal);
        std::iter::successors(Some(segment), proximal)
    }

    /// The joints from one segment to another, in this order.
    pub fn joints_between(&self, from: Segment, to: Segment) -> Vec<Joint> {
        let ways = [from, to].map(|end| self.inwards(end).collect::<Vec<_>>());
        let apart = |way: &[Segment], other: &[Segment]| {
            let own = way.iter().filter(|segment| !other.contains(segment));
            own.filter_map(|segment| self.carrier(*segment)).collect::<Vec<_>>()
        };
        let (down, up) = (apart(&ways[0], &ways[1]), apart(&ways[1], &ways[0]));
        down.into_iter().chain(up.into_iter().rev()).collect()
    }

    /// Whether a segment belongs to a limb, including hands, feet and anything they carry.
    pub fn is_of(&self, segment: Segment, limb: &Limb) -> bool {
        self.inwards(segment).any(|n| n == limb.upper)
    }

    /// Whether a segment belongs to an arm or a leg.
    pub fn is_limb(&self, segment: Segment) -> bool {
        let marks = self.landmarks_at(segment);
        marks.arms().chain(marks.legs()).any(|limb| self.is_of(segment, &limb))
    }

    /// Whether a joint attaches the second segment to the first.
    pub fn carries(&self, proximal: Segment, distal: Segment) -> bool {
        self.joints.iter().any(|row| (row.proximal, row.distal) == (proximal, distal))
    }

    /// Whether a segment lies between chest and pelvis or is one of them.
    pub fn is_trunk(&self, segment: Segment) -> bool {
        let marks = self.landmarks_at(segment);
        let (Some(chest), Some(pelvis)) = (marks.chest, marks.pelvis) else {
            return [marks.chest, marks.pelvis].contains(&Some(segment));
        };
        let [from_chest, from_pelvis] = [chest, pelvis].map(|n| self.inwards(n));
        let meet = from_chest.clone().find(|n| from_pelvis.clone().any(|m| m == *n));
        let [above, below] = [from_chest, from_pelvis].map(|mut way| way.any(|n| n == segment));
        meet == Some(segment) || above != below
    }
}

/// The word for a left–right pair: "feet" for "left_foot"; none for a single segment.
pub fn both_sides(name: &str) -> Option<String> {
    let one = name.strip_prefix("left_").or(name.strip_prefix("right_"))?;
    Some(one.strip_suffix("foot").map_or_else(|| format!("{one}s"), |stem| format!("{stem}feet")))
}

/// Rows of missing segments and joints.
const NOBODY: Segment = Segment(usize::MAX);
static NO_SEGMENT: SegmentRow = SegmentRow { name: "", joint_end: End::Lower };
static NO_JOINT: JointRow =
    JointRow { name: "", kind: JointKind::Fixed, proximal: NOBODY, distal: NOBODY, place: Place::Root };

impl Index<Segment> for Tree {
    type Output = SegmentRow;

    fn index(&self, segment: Segment) -> &SegmentRow {
        self.segments.get(segment.0).unwrap_or(&NO_SEGMENT)
    }
}

impl Index<Joint> for Tree {
    type Output = JointRow;

    fn index(&self, joint: Joint) -> &JointRow {
        self.joints.get(joint.0).unwrap_or(&NO_JOINT)
    }
}
