//! A body mounted at any of its segments, with parts omitted: for a rig.

use super::tree::{JointRow, Place, SphereRow};
use super::{Body, ContactSphere, Joint, Plate, Ride, Segment, Tree};

impl Body {
    /// The same with `root` for its first segment, without the segments `left_out` and those distal to them.
    /// Segments are numbered from the root outwards; joints, spheres and landmarks keep their names and their order. Plates
    /// stay where all of their segments do, else none. A root that is none of the body's changes nothing.
    pub fn hung_on(&self, root: Segment, left_out: &[Segment]) -> Body {
        if root.index() >= self.segments.len() {
            return self.clone();
        }
        let kept = self.reached_from(root, left_out);
        let now = |segment: Segment| kept.iter().position(|old| *old == segment).map(Segment);
        let rows = self.tree.joints().filter_map(|joint| {
            let JointRow { proximal, distal, .. } = self.tree[joint];
            let row =
                JointRow { proximal: now(proximal)?, distal: now(distal)?, place: Place::Given, ..self.tree[joint] };
            Some((joint, row))
        });
        let (old, joints): (Vec<Joint>, Vec<JointRow>) = rows.unzip();
        let marks = self.tree.landmarks();
        let landmarks = marks.map(now, |joint| old.iter().position(|old| *old == joint).map(Joint));
        let segments: Vec<_> = kept.iter().map(|segment| self.tree[*segment]).collect();
        let spheres =
            self.tree.spheres().iter().filter_map(|row| Some(SphereRow { segment: now(row.segment)?, ..*row }));
        let own = self.spheres.iter().filter_map(|s| Some(ContactSphere { segment: now(s.segment)?, ..s.clone() }));
        let whole = self.plates.iter().all(|plate| now(plate.segment).is_some());
        let plates = self.plates.iter().filter(|_| whole);
        let own = own.map(|sphere| if whole { sphere } else { ContactSphere { ride: Ride::default(), ..sphere } });
        Body {
            tree: Tree::interned(&segments, &joints, &spheres.collect::<Vec<_>>(), landmarks, &[]),
            segments: kept.iter().map(|segment| *self.segment(*segment)).collect(),
            places: old.iter().map(|joint| self.place(*joint)).collect(),
            spheres: own.collect(),
            plates: plates.filter_map(|p| Some(Plate { segment: now(p.segment)?, ..p.clone() })).collect(),
            chests: self.chests.iter().filter(|_| whole).cloned().collect(),
            sides: self.sides.iter().filter(|_| whole).cloned().collect(),
            ..self.clone()
        }
    }

    /// The segments connected to `root` after some are left out, each after its parent.
    fn reached_from(&self, root: Segment, left_out: &[Segment]) -> Vec<Segment> {
        let mut kept = vec![root];
        let mut at = 0;
        while let Some(&from) = kept.get(at) {
            let beyond = self.tree.joint_rows().iter().filter_map(|row| match from {
                _ if from == row.proximal => Some(row.distal),
                _ if from == row.distal => Some(row.proximal),
                _ => None,
            });
            let new: Vec<Segment> = beyond.filter(|s| !kept.contains(s) && !left_out.contains(s)).collect();
            kept.extend(new);
            at += 1;
        }
        kept
    }
}

#[cfg(test)]
mod tests {
    use crate::body::Body;
    use crate::body::tti12::{HEAD, LEFT_FOREARM, LEFT_KNEE, LEFT_UPPER_ARM, LOWER_TORSO, MIDDLE_TORSO, UPPER_TORSO};

    #[test]
    fn a_head_and_neck_keep_what_they_are() {
        let whole = Body::male50();
        let body = whole.hung_on(UPPER_TORSO, &[MIDDLE_TORSO, LEFT_UPPER_ARM]);
        let names: Vec<&str> = body.tree.segment_rows().iter().map(|row| row.name).collect();
        assert_eq!(names, ["upper_torso", "head", "right_upper_arm", "right_forearm"]);
        let marks = body.tree.landmarks();
        assert_eq!((marks.pelvis, marks.neck.map(|neck| body.tree[neck].name)), (None, Some("neck")));
        assert_eq!((marks.arms().count(), marks.legs().count()), (1, 0));
        assert_eq!(body.segment(body.tree.segment(1)), whole.segment(HEAD));
        assert_eq!(body.spheres.len(), 6);
        assert!(body.tree.joint_rows().iter().all(|row| !row.is_reversed()));
    }

    /// A body has the same position with any root segment, and laws keep their proximal and distal segments.
    #[test]
    fn the_way_to_a_mount_turns_joints_round() {
        let whole = Body::male50();
        let standing = whole.standing_m();
        for root in [LOWER_TORSO, LEFT_FOREARM, HEAD] {
            let body = whole.hung_on(root, &[]);
            assert_eq!(body.tree.segments().len(), 12);
            let knee = body.tree.joint_named("left_knee").expect("a knee");
            let row = &body.tree[knee];
            assert_eq!([row.proximal, row.distal].map(|s| body.tree[s].name), ["left_thigh", "left_lower_leg"]);
            assert_eq!(body.place(knee), whole.place(LEFT_KNEE));
            assert!(body.tree.segments().skip(1).all(|segment| body.tree.bearer(segment).is_some()));
            let turned = body.tree.joint_rows().iter().filter(|row| row.is_reversed()).count();
            assert_eq!(turned, whole.tree.inwards(root).count() - 1);
            let moved = body.standing_m();
            let index = |name: &str| body.sphere(name).expect("a sphere");
            let shift = moved[index("head")] - standing[whole.sphere("head").expect("a head")];
            for (sphere, place) in whole.spheres.iter().zip(&standing) {
                assert!((moved[index(&sphere.name)] - shift - place).norm() < 1e-14, "{}", sphere.name);
            }
        }
    }
}
