//! The eleven joints by name and number.

/// A joint, in the report's numbering (Fig. 8).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Joint {
    /// 1, segments 2 and 3.
    Neck,
    /// 2, segments 2 and 6.
    RightShoulder,
    /// 3, segments 2 and 5.
    LeftShoulder,
    /// 4, segments 1 and 2.
    UpperBack,
    /// 5, hinge, segments 5 and 7.
    LeftElbow,
    /// 6, hinge, segments 6 and 8.
    RightElbow,
    /// 7, segments 1 and 4.
    LowerBack,
    /// 8, segments 4 and 10.
    RightHip,
    /// 9, segments 4 and 9.
    LeftHip,
    /// 10, hinge, segments 10 and 12.
    RightKnee,
    /// 11, hinge, segments 9 and 11.
    LeftKnee,
}

impl Joint {
    /// All joints in the report's order.
    pub const ALL: [Joint; 11] = [
        Joint::Neck,
        Joint::RightShoulder,
        Joint::LeftShoulder,
        Joint::UpperBack,
        Joint::LeftElbow,
        Joint::RightElbow,
        Joint::LowerBack,
        Joint::RightHip,
        Joint::LeftHip,
        Joint::RightKnee,
        Joint::LeftKnee,
    ];

    /// The report's number, 1 to 11.
    pub const fn number(self) -> usize {
        self as usize + 1
    }

    /// Name used in scenarios and result channels.
    pub const fn name(self) -> &'static str {
        [
            "neck",
            "right_shoulder",
            "left_shoulder",
            "upper_back",
            "left_elbow",
            "right_elbow",
            "lower_back",
            "right_hip",
            "left_hip",
            "right_knee",
            "left_knee",
        ][self as usize]
    }

    /// Elbows and knees turn about Y only.
    pub const fn is_hinge(self) -> bool {
        matches!(self, Joint::LeftElbow | Joint::RightElbow | Joint::RightKnee | Joint::LeftKnee)
    }
}
