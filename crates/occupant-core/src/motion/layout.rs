//! The loops of the kernel: parents of the segments of a tree, and the positions of their numbers in a state.
//!
//! Segments are indices here; a segment's joint is the one that carries it. A segment comes after its parent.

use crate::body::tree::{JointKind, JointRow, Tree};

/// Largest number of segments of all bodies together.
pub const MOST_SEGMENTS: usize = 48;
/// Largest number of hinge axes of all bodies together.
pub(crate) const MOST_HINGES: usize = 48;
/// Largest number of sliding point masses of all bodies together.
pub(crate) const MOST_SLIDES: usize = 20;
/// Largest number of bodies.
pub(crate) const MOST_BODIES: usize = 8;
/// Largest number of segments, and of hinge axes, of one tree.
pub const MOST_OF_TREE: usize = 20;

/// An axis of a joint's triads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// X.
    X,
    /// Y.
    Y,
    /// Z.
    Z,
}

/// Freedom of a segment's joint relative to the carrying segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Free rotation; for the root: free motion.
    Ball,
    /// Rotation about axes of the triads, each carried by those before: none for a fixed joint, one for a pin, two for
    /// a universal joint.
    Hinges(&'static [Axis]),
    /// The root follows a frame on a given path.
    Guided,
}

/// Position of a segment in the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Row {
    /// Carrying segment; none for the root.
    pub parent: Option<usize>,
    pub freedom: Freedom,
    /// Index of its orientation in a state, or of its first hinge.
    pub slot: usize,
    /// Its body.
    pub body: usize,
}

/// A tree among others: indices of its first segment, orientation and hinge in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Trunk {
    /// The root.
    pub first: usize,
    /// Number of segments.
    pub count: usize,
    pub free: usize,
    pub hinge: usize,
}

impl Trunk {
    /// Its segments.
    #[inline(always)]
    pub(crate) fn segments(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.count
    }
}

impl Row {
    /// Axes of the hinges of its joint.
    #[inline(always)]
    pub(crate) fn axes(&self) -> &'static [Axis] {
        if let Freedom::Hinges(axes) = self.freedom { axes } else { &[] }
    }

    /// Indices of its hinges in a state.
    #[inline(always)]
    pub(crate) fn hinges(&self) -> std::ops::Range<usize> {
        self.slot..self.slot + self.axes().len()
    }
}

/// A tree that the kernel does not support.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("segment {segment}: {found}; expected {expected}")]
pub struct TreeError {
    /// Index of the segment, from 0.
    pub segment: usize,
    /// Problems of it.
    pub found: &'static str,
    /// What is supported.
    pub expected: &'static str,
}

/// Trees of all bodies for the kernel, one after another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    trunks: Vec<Trunk>,
    rows: Vec<Row>,
    free: Vec<usize>,
    hinged: Vec<usize>,
}

impl Layout {
    /// Layout of segments by the carrying segment of each and the freedom of its joint.
    ///
    /// # Errors
    /// A tree that the kernel cannot carry.
    pub fn new(segments: &[(Option<usize>, Freedom)]) -> Result<Self, TreeError> {
        let hinges = |(_, freedom): &(_, Freedom)| if let Freedom::Hinges(axes) = freedom { axes.len() } else { 0 };
        let mut turns = 0;
        for (n, segment @ &(parent, freedom)) in segments.iter().enumerate() {
            let error = |found, expected| Err(TreeError { segment: n, found, expected });
            turns += hinges(segment);
            match parent {
                None if n > 0 => return error("carried by none", "one root, the first segment"),
                Some(parent) if parent >= n => return error("carried by one that comes after it", "one before it"),
                _ => {}
            }
            match freedom {
                Freedom::Hinges(_) if n == 0 => return error("a root on hinges", "a free root, or one on a mount"),
                Freedom::Hinges([first, second]) if first == second => {
                    return error("two hinges about one axis", "two axes");
                }
                Freedom::Hinges([_, _, _, ..]) => return error("more than two hinges", "a ball joint"),
                Freedom::Guided if n > 0 => return error("a mount beyond the root", "a joint"),
                _ => {}
            }
            if n >= MOST_OF_TREE || turns > MOST_OF_TREE {
                return error("too many segments or hinges", "20 segments and 20 axes of hinges at most");
            }
        }
        if segments.is_empty() {
            return Err(TreeError { segment: 0, found: "no segments", expected: "a root" });
        }
        Ok(Layout::of_rows(segments.iter().copied()))
    }

    /// Layout of a body's tree.
    pub fn of(tree: &Tree) -> Self {
        let freedom = |joint: &JointRow| match joint.kind {
            JointKind::Ball => Freedom::Ball,
            JointKind::Hinge => Freedom::Hinges(&[Axis::Y]),
            JointKind::Universal => Freedom::Hinges(&[Axis::Y, Axis::X]),
            JointKind::Fixed => Freedom::Hinges(&[]),
        };
        let rows = tree.segments().map(|segment| tree.bearer(segment).map(|joint| &tree[joint]));
        Layout::of_rows(
            rows.map(|joint| (joint.map(|joint| joint.carrying()[0].index()), joint.map_or(Freedom::Ball, freedom))),
        )
    }

    fn of_rows(segments: impl Iterator<Item = (Option<usize>, Freedom)>) -> Self {
        let mut layout = Layout { trunks: Vec::new(), rows: Vec::new(), free: Vec::new(), hinged: Vec::new() };
        for (n, (parent, freedom)) in segments.enumerate() {
            if parent.is_none() {
                let (free, hinge) = (layout.free.len(), layout.hinged.len());
                layout.trunks.push(Trunk { first: n, count: 0, free, hinge });
            }
            // a segment stands behind the one that carries it, and so in the last tree
            let body = layout.trunks.len() - 1;
            layout.trunks[body].count += 1;
            let slot = if let Freedom::Hinges(axes) = freedom {
                layout.hinged.extend(axes.iter().map(|_| n));
                layout.hinged.len() - axes.len()
            } else {
                layout.free.push(n);
                layout.free.len() - 1
            };
            layout.rows.push(Row { parent, freedom, slot, body });
        }
        layout
    }

    /// All these trees, in their order.
    pub(crate) fn together<'a>(all: impl IntoIterator<Item = &'a Layout>) -> Self {
        let mut segments = Vec::new();
        for layout in all {
            let first = segments.len();
            segments.extend(layout.rows.iter().map(|row| (row.parent.map(|n| first + n), row.freedom)));
        }
        Layout::of_rows(segments.into_iter())
    }

    /// The same with a first root that follows a given path.
    pub(crate) fn guided(mut self) -> Self {
        self.rows[0].freedom = Freedom::Guided;
        self
    }

    /// By body.
    #[inline(always)]
    pub(crate) fn trunks(&self) -> &[Trunk] {
        &self.trunks
    }

    /// By segment.
    #[inline(always)]
    pub(crate) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Whether the root of a body follows a given path.
    #[inline(always)]
    pub(crate) fn is_guided(&self, body: usize) -> bool {
        matches!(self.rows[self.trunks[body].first].freedom, Freedom::Guided)
    }

    /// Number of segments.
    #[expect(clippy::len_without_is_empty, reason = "a tree has a root")]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Segments with an orientation in the state, in the order of the state's orientations.
    #[inline(always)]
    pub fn free(&self) -> &[usize] {
        &self.free
    }

    /// Segments on hinges, in the order of the state's hinges; a segment on two is listed twice.
    #[inline(always)]
    pub fn hinged(&self) -> &[usize] {
        &self.hinged
    }

    /// Index of a segment's orientation in a state, if it has one.
    pub fn free_slot(&self, segment: usize) -> Option<usize> {
        self.free.iter().position(|&n| n == segment)
    }

    /// Index of a segment's first hinge in a state, if it has one.
    pub fn hinge_slot(&self, segment: usize) -> Option<usize> {
        self.hinged.iter().position(|&n| n == segment)
    }

    /// Carrying segment.
    pub fn parent(&self, segment: usize) -> Option<usize> {
        self.rows[segment].parent
    }

    /// A segment and all that are distal to it, in that order.
    pub(crate) fn subtree(&self, segment: usize) -> impl Iterator<Item = usize> + '_ {
        let is_beyond = move |n: &usize| {
            let mut inner = *n;
            while inner > segment {
                inner = self.rows[inner].parent.unwrap_or(0);
            }
            inner == segment && (*n == segment || self.rows[*n].parent.is_some())
        };
        (segment..self.rows.len()).filter(is_beyond)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::tti12::TTI12;
    use Freedom::{Ball, Guided, Hinges};

    #[test]
    fn the_reports_body_is_laid_out_as_its_figures_say() {
        let layout = Layout::of(&TTI12);
        assert_eq!(layout.free(), [0, 1, 2, 3, 4, 5, 8, 9]);
        assert_eq!(layout.hinged(), [6, 7, 10, 11]);
        assert_eq!(layout.subtree(1).filter(|n| layout.parent(*n) == Some(1)).collect::<Vec<_>>(), [2, 4, 5]);
        assert_eq!((layout.free_slot(8), layout.hinge_slot(8)), (Some(6), None));
        assert_eq!((layout.free_slot(11), layout.hinge_slot(11)), (None, Some(3)));
    }

    #[test]
    fn a_tree_that_cannot_be_carried_is_refused_where_it_is_wrong() {
        let one = [(None, Ball)];
        let with = |row| Layout::new(&[&one[..], &[row]].concat()).map(|_| ()).map_err(|e| e.segment);
        assert_eq!(with((Some(0), Hinges(&[Axis::X, Axis::Z]))), Ok(()));
        assert_eq!(with((None, Ball)), Err(1));
        assert_eq!(with((Some(1), Ball)), Err(1));
        assert_eq!(with((Some(0), Guided)), Err(1));
        assert_eq!(with((Some(0), Hinges(&[Axis::X, Axis::X]))), Err(1));
        assert_eq!(with((Some(0), Hinges(&[Axis::X, Axis::Y, Axis::Z]))), Err(1));
        assert_eq!(Layout::new(&[(None, Hinges(&[]))]).map_err(|e| e.segment), Err(0));
        assert_eq!(Layout::new(&[]).map_err(|e| e.segment), Err(0));
        let chain = |count| std::iter::once((None, Guided)).chain((1..count).map(|n| (Some(n - 1), Ball)));
        assert!(Layout::new(&chain(MOST_OF_TREE).collect::<Vec<_>>()).is_ok());
        let many = Layout::new(&chain(MOST_OF_TREE + 1).collect::<Vec<_>>());
        assert_eq!(many.map_err(|e| e.segment), Err(MOST_OF_TREE));
    }
}
