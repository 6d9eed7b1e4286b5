//! Ids of items of a case, each with its own type. Each knows its case.

use std::sync::atomic::{AtomicU64, Ordering};

use occupant_core::body::Segment;
use occupant_core::forces::contact::surface::Frame;
use occupant_core::forces::own::Place;

/// Identity of a case, which distinguishes ids of different cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Origin(u64);

impl Origin {
    /// A number unique in the process.
    pub(crate) fn new() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Origin(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// Ids that are indices of one case.
macro_rules! ids {
    ($($(#[$words:meta])* $Id:ident),+ $(,)?) => {
        $(
            $(#[$words])*
            #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
            pub struct $Id(pub(crate) usize, pub(crate) Origin);

            impl $Id {
                /// Its index in the lists of the [`Setup`](occupant_core::model::setup::Setup).
                pub fn index(self) -> usize {
                    self.0
                }
            }
        )+
    };
}

ids! {
    /// A contact material of a case.
    MaterialId,
    /// A surface of a case.
    SurfaceId,
    /// A solid of a case.
    SolidId,
    /// A belt around one sphere.
    BeltId,
    /// A contact sphere of the body.
    SphereId,
    /// A frame besides space and the vehicle: another vehicle, a panel.
    FrameId,
}

/// A segment of the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SegmentId(pub(crate) Segment, pub(crate) Origin);

impl SegmentId {
    /// The simulator's segment.
    pub fn segment(self) -> Segment {
        self.0
    }

    /// A point of the segment, from its lower end, segment axes, m.
    pub fn point(self, from_lower_end_m: [f64; 3]) -> Place {
        Place::Segment(self.0, from_lower_end_m.into())
    }
}

impl FrameId {
    /// The simulator's frame.
    pub fn frame(self) -> Frame {
        Frame::Other(self.0)
    }
}

impl From<SphereId> for Place {
    fn from(sphere: SphereId) -> Self {
        Place::Sphere(sphere.0)
    }
}
