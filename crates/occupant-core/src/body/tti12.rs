//! The body of the report: 12 segments, 11 joints, 31 degrees of freedom, 17 spheres (Figs 1, 5 and 8).
//!
//! Segment, joint and sphere numbers of the report are places in these tables, counted from 1.

use super::tree::{
    End, Joint, JointKind, JointRow, Landmarks, Limb, Pair, Place, Segment, SegmentRow, Side, SphereRow, Tree, Width,
};
use Side::{Left, Right};
use Width::{Hip, Shoulder};

/// The tree of the report's body.
pub const TTI12: Tree = Tree {
    segments: &[
        segment("middle_torso", End::Upper),
        segment("upper_torso", End::Lower),
        segment("head", End::Lower),
        segment("lower_torso", End::Upper),
        segment("left_upper_arm", End::Upper),
        segment("right_upper_arm", End::Upper),
        segment("left_forearm", End::Upper),
        segment("right_forearm", End::Upper),
        segment("left_thigh", End::Upper),
        segment("right_thigh", End::Upper),
        segment("left_lower_leg", End::Upper),
        segment("right_lower_leg", End::Upper),
    ],
    joints: &[
        ball("neck", UPPER_TORSO, HEAD, Place::Neck),
        ball("right_shoulder", UPPER_TORSO, RIGHT_UPPER_ARM, Place::Beside(Shoulder, Right)),
        ball("left_shoulder", UPPER_TORSO, LEFT_UPPER_ARM, Place::Beside(Shoulder, Left)),
        ball("upper_back", MIDDLE_TORSO, UPPER_TORSO, Place::Root),
        hinge("left_elbow", LEFT_UPPER_ARM, LEFT_FOREARM),
        hinge("right_elbow", RIGHT_UPPER_ARM, RIGHT_FOREARM),
        ball("lower_back", MIDDLE_TORSO, LOWER_TORSO, Place::FarEnd),
        ball("right_hip", LOWER_TORSO, RIGHT_THIGH, Place::Beside(Hip, Right)),
        ball("left_hip", LOWER_TORSO, LEFT_THIGH, Place::Beside(Hip, Left)),
        hinge("right_knee", RIGHT_THIGH, RIGHT_LOWER_LEG),
        hinge("left_knee", LEFT_THIGH, LEFT_LOWER_LEG),
    ],
    spheres: &[
        sphere("head", HEAD, 1.0, -1.0),
        sphere("chest", UPPER_TORSO, 1.0, -0.9),
        sphere("pelvis", LOWER_TORSO, 0.0, 0.0),
        shoulder("right_shoulder", Right),
        shoulder("left_shoulder", Left),
        sphere("right_elbow", RIGHT_UPPER_ARM, 0.0, 0.0),
        sphere("left_elbow", LEFT_UPPER_ARM, 0.0, 0.0),
        sphere("right_hand", RIGHT_FOREARM, 0.0, 1.0),
        sphere("left_hand", LEFT_FOREARM, 0.0, 1.0),
        sphere("right_thigh", RIGHT_THIGH, 0.6, 0.0),
        sphere("left_thigh", LEFT_THIGH, 0.6, 0.0),
        sphere("right_knee", RIGHT_THIGH, 0.0, 0.0),
        sphere("left_knee", LEFT_THIGH, 0.0, 0.0),
        sphere("right_shin", RIGHT_LOWER_LEG, 0.6, 0.0),
        sphere("left_shin", LEFT_LOWER_LEG, 0.6, 0.0),
        sphere("right_foot", RIGHT_LOWER_LEG, 0.0, 1.0),
        sphere("left_foot", LEFT_LOWER_LEG, 0.0, 1.0),
    ],
    bodies: &[],
    landmarks: Landmarks {
        head: Some(HEAD),
        chest: Some(UPPER_TORSO),
        pelvis: Some(LOWER_TORSO),
        neck: Some(NECK),
        arms: Pair { left: limb(LEFT_UPPER_ARM, LEFT_FOREARM), right: limb(RIGHT_UPPER_ARM, RIGHT_FOREARM) },
        legs: Pair { left: limb(LEFT_THIGH, LEFT_LOWER_LEG), right: limb(RIGHT_THIGH, RIGHT_LOWER_LEG) },
    },
};

/// Ids in the order of the tables; a test compares them with the names.
macro_rules! ids {
    ($id:ident: $($name:ident = $index:literal),*) => {
        $(#[doc = stringify!($name)] pub const $name: $id = $id($index);)*

        #[cfg(test)]
        impl $id {
            /// All ids with the names of their constants.
            const NAMED: &[($id, &str)] = &[$(($name, stringify!($name))),*];
        }
    };
}

ids! { Segment:
    MIDDLE_TORSO = 0, UPPER_TORSO = 1, HEAD = 2, LOWER_TORSO = 3,
    LEFT_UPPER_ARM = 4, RIGHT_UPPER_ARM = 5, LEFT_FOREARM = 6, RIGHT_FOREARM = 7,
    LEFT_THIGH = 8, RIGHT_THIGH = 9, LEFT_LOWER_LEG = 10, RIGHT_LOWER_LEG = 11
}

ids! { Joint:
    NECK = 0, RIGHT_SHOULDER = 1, LEFT_SHOULDER = 2, UPPER_BACK = 3, LEFT_ELBOW = 4, RIGHT_ELBOW = 5,
    LOWER_BACK = 6, RIGHT_HIP = 7, LEFT_HIP = 8, RIGHT_KNEE = 9, LEFT_KNEE = 10
}

const fn limb(upper: Segment, lower: Segment) -> Option<Limb> {
    Some(Limb { upper, lower, end: None })
}

const fn segment(name: &'static str, joint_end: End) -> SegmentRow {
    SegmentRow { name, joint_end }
}

const fn ball(name: &'static str, proximal: Segment, distal: Segment, place: Place) -> JointRow {
    JointRow { name, kind: JointKind::Ball, proximal, distal, place }
}

const fn hinge(name: &'static str, proximal: Segment, distal: Segment) -> JointRow {
    JointRow { name, kind: JointKind::Hinge, proximal, distal, place: Place::FarEnd }
}

const fn sphere(name: &'static str, segment: Segment, lengths: f64, radii: f64) -> SphereRow {
    SphereRow { name, segment, lengths, radii, beside: None }
}

const fn shoulder(name: &'static str, side: Side) -> SphereRow {
    SphereRow { name, segment: UPPER_TORSO, lengths: 1.0, radii: 0.0, beside: Some((Shoulder, side)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_the_rows_of_their_names() {
        for (segment, name) in Segment::NAMED {
            assert_eq!(TTI12[*segment].name, name.to_lowercase());
        }
        for (joint, name) in Joint::NAMED {
            assert_eq!(TTI12[*joint].name, name.to_lowercase());
        }
        assert_eq!((Segment::NAMED.len(), Joint::NAMED.len()), (TTI12.segments().len(), TTI12.joints().len()));
    }

    #[test]
    fn every_segment_but_the_first_has_one_joint_to_a_segment_before_it() {
        for segment in TTI12.segments() {
            let carriers: Vec<_> = TTI12.joints().filter(|j| TTI12[*j].distal == segment).collect();
            assert_eq!(carriers.len(), usize::from(segment.index() > 0));
            assert!(carriers.iter().all(|j| TTI12[*j].proximal < segment));
            assert_eq!(TTI12.carrier(segment), carriers.first().copied());
        }
    }
}
