//! Trees made at run time, from joints that name their segments.
//!
//! Names have the meaning of the report's body: a `left_thigh` below the pelvis is the upper part of a leg, and the
//! sphere `left_knee` is at its lower end.

use std::collections::HashSet;

use placed_text::nearest;

pub use super::tree::TreeProblem;
use super::tree::kept;
use super::tree::{
    End, Joint, JointKind, JointRow, Landmarks, Limb, Pair, Place, Segment, SegmentRow, SphereRow, Tree,
};
use super::tti12::TTI12;

/// A joint, with its segments by name.
#[derive(Clone, Copy, Debug)]
pub struct NamedJoint<'a> {
    /// Name.
    pub name: &'a str,
    /// Kind of motion.
    pub kind: JointKind,
    /// Segment nearer to the trunk.
    pub proximal: &'a str,
    /// The other segment.
    pub distal: &'a str,
    /// Whether the distal segment is attached at its upper end.
    pub hangs: bool,
}

/// Names of the segments for head, chest and pelvis, where they are not the usual ones.
#[derive(Clone, Copy, Debug, Default)]
pub struct NamedLandmarks<'a> {
    /// Default `head`.
    pub head: Option<&'a str>,
    /// Default `upper_torso` or `chest`.
    pub chest: Option<&'a str>,
    /// Default `lower_torso` or `pelvis`.
    pub pelvis: Option<&'a str>,
    /// Whether it is a partial body, which may lack any.
    pub is_part: bool,
}

/// Position of the shin's sphere on a lower leg that ends at the ankle, relative to its length: as on one with a foot.
const SHIN_ABOVE_ANKLE: f64 = 0.534;

/// The tree of joints, each of which attaches a segment to an earlier one; the first one's proximal segment is the
/// root, at T1.
///
/// # Errors
/// A joint that hangs on a segment which no joint before it carries; a segment that two joints carry; a landmark for which
/// there is no segment.
pub fn tree(joints: &[NamedJoint<'_>], marks: &NamedLandmarks<'_>) -> Result<&'static Tree, TreeProblem> {
    let row = |name: &str, hangs: bool| SegmentRow {
        name: kept(name),
        joint_end: if hangs { End::Upper } else { End::Lower },
    };
    let root = joints.first().map(|joint| row(joint.proximal, true));
    let segments: Vec<SegmentRow> =
        root.into_iter().chain(joints.iter().map(|joint| row(joint.distal, joint.hangs))).collect();
    check(joints)?;
    let named = |name: &str| segments.iter().position(|row| row.name == name).map(Segment);
    let joint_rows = joints.iter().filter_map(|joint| {
        let (proximal, distal) = (named(joint.proximal)?, named(joint.distal)?);
        Some(JointRow { name: kept(joint.name), kind: joint.kind, proximal, distal, place: Place::Given })
    });
    let joint_rows: Vec<JointRow> = joint_rows.collect();
    let landmarks = landmarks(&joint_rows, marks, &named)?;
    Ok(Tree::interned(&segments, &joint_rows, &spheres(&named), landmarks, &[]))
}

/// Checks that every joint attaches a new segment to an existing one.
fn check(joints: &[NamedJoint<'_>]) -> Result<(), TreeProblem> {
    let mut known: HashSet<&str> = joints.first().map(|joint| joint.proximal).into_iter().collect();
    for NamedJoint { name, proximal, distal, .. } in joints {
        let joint = (*name).to_owned();
        if !known.contains(proximal) {
            let mut names: Vec<&str> = known.into_iter().collect();
            names.sort_unstable();
            let nearest = nearest(proximal, names.into_iter()).map(str::to_owned);
            return Err(TreeProblem::UnknownSegment { joint, segment: (*proximal).to_owned(), nearest });
        }
        if !known.insert(distal) {
            return Err(TreeProblem::Twice { joint, segment: (*distal).to_owned() });
        }
    }
    Ok(())
}

/// A single segment without joints.
pub(crate) fn lone(name: &str) -> &'static Tree {
    let segment = SegmentRow { name: kept(name), joint_end: End::Lower };
    Tree::interned(&[segment], &[], &[], Landmarks::NONE, &[])
}

fn landmarks(
    joints: &[JointRow],
    marks: &NamedLandmarks<'_>,
    named: &impl Fn(&str) -> Option<Segment>,
) -> Result<Landmarks, TreeProblem> {
    let usual = |own: Option<&str>, names: [&str; 2], key: &'static str| {
        let found = own.map_or_else(|| names.into_iter().find_map(named), named);
        if found.is_none() && (own.is_some() || !marks.is_part) {
            Err(TreeProblem::MissingLandmark(key))
        } else {
            Ok(found)
        }
    };
    let head = usual(marks.head, ["head", "head"], "head")?;
    let pelvis = usual(marks.pelvis, ["lower_torso", "pelvis"], "pelvis")?;
    let neck = joints.iter().position(|joint| Some(joint.distal) == head).map(Joint);
    if neck.is_none() && !marks.is_part {
        return Err(TreeProblem::MissingLandmark("head"));
    }
    let hung =
        |distal: Segment, proximal: Segment| joints.iter().find(|j| j.distal == distal && j.proximal == proximal);
    let limb = |names: [&str; 3]| {
        let (upper, lower) = (named(names[0])?, named(names[1])?);
        let end = named(names[2]).filter(|end| hung(*end, lower).is_some());
        hung(lower, upper).filter(|joint| joint.is_hinge()).map(|_| Limb { upper, lower, end })
    };
    let leg = |names| limb(names).filter(|leg| pelvis.and_then(|pelvis| hung(leg.upper, pelvis)).is_some());
    Ok(Landmarks {
        head,
        chest: usual(marks.chest, ["upper_torso", "chest"], "chest")?,
        pelvis,
        neck,
        arms: Pair {
            left: limb(["left_upper_arm", "left_forearm", "left_hand"]),
            right: limb(["right_upper_arm", "right_forearm", "right_hand"]),
        },
        legs: Pair {
            left: leg(["left_thigh", "left_lower_leg", "left_foot"]),
            right: leg(["right_thigh", "right_lower_leg", "right_foot"]),
        },
    })
}

/// The report's spheres on the existing segments: on one with the sphere's own name, such as `left_foot`; for a
/// shoulder on its clavicle; else on the report's segment.
fn spheres(named: &impl Fn(&str) -> Option<Segment>) -> Vec<SphereRow> {
    let row = |row: &SphereRow| {
        let clavicle = row.name.strip_suffix("shoulder").and_then(|side| named(&format!("{side}clavicle")));
        let segment = named(row.name).or(clavicle).or_else(|| named(TTI12[row.segment].name))?;
        let ends_at_ankle = row.name.strip_suffix("shin").is_some_and(|side| named(&format!("{side}foot")).is_some());
        let lengths = if ends_at_ankle { SHIN_ABOVE_ANKLE } else { row.lengths };
        Some(SphereRow { segment, lengths, ..*row })
    };
    TTI12.spheres().iter().filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trees_that_are_alike_are_one() {
        let arm =
            |name| NamedJoint { name, kind: JointKind::Ball, proximal: "upper_torso", distal: "head", hangs: false };
        let marks = NamedLandmarks { pelvis: Some("upper_torso"), ..NamedLandmarks::default() };
        let first = tree(&[arm("neck")], &marks).expect("a tree");
        let neck = String::from("neck");
        assert!(std::ptr::eq(first, tree(&[arm(&neck)], &marks).expect("a tree")));
        assert!(!std::ptr::eq(first, tree(&[arm("other")], &marks).expect("a tree")));
        assert_eq!(
            tree(&[arm("neck")], &NamedLandmarks::default()).map(|_| ()),
            Err(TreeProblem::MissingLandmark("pelvis"))
        );
        assert_eq!(first.sphere_names(), ["head", "chest", "right_shoulder", "left_shoulder"]);
        assert_eq!(
            (first.landmarks().neck.map(|neck| first[neck].name), first.landmarks().legs().count()),
            (Some("neck"), 0)
        );
    }
}
