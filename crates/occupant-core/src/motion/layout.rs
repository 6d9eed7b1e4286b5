//! What the kernel loops over, derived from the body's tree when the kernel is compiled.
//!
//! Segments are indices here; a segment's joint is the one that carries it. How [`super::dynamics`] reduces a segment to
//! what it asks of its joint follows from the shape of the tree: a limb (a ball joint, one hinged segment beyond) and a
//! leaf (a ball joint, nothing beyond) have closed forms, a trunk segment carries any subtrees on ball joints.
//!
//! The kernel is compiled for one tree. A second one makes these constants, and the lengths of the arrays that have their
//! lengths, a parameter of it; a segment that fits none of the three kinds needs a reduction of its own.

use crate::body::SEGMENTS;
use crate::body::tree::{Joint, JointRow, Place, Tree};
use crate::body::tti12::TTI12;

/// The tree.
pub(crate) const TREE: Tree = TTI12;
const JOINTS: usize = TREE.joint_rows().len();

/// The values, at all `$n` below `$bound` for which the condition holds, as a constant slice.
macro_rules! collect {
    ($type:ty: $value:expr, for $n:ident in $bound:expr, if $keep:expr) => {{
        const COUNT: usize = {
            let (mut count, mut $n) = (0, 0);
            while $n < $bound {
                count += ($keep) as usize;
                $n += 1;
            }
            count
        };
        const KEPT: [$type; COUNT] = {
            let (mut at, mut $n) = (0, 0);
            let mut kept = [$value; COUNT];
            while $n < $bound {
                if $keep {
                    kept[at] = $value;
                    at += 1;
                }
                $n += 1;
            }
            kept
        };
        &KEPT
    }};
}

/// Segments whose orientation is free, in the order of [`super::state::State::orientation`].
pub const FREE: &[usize] = collect!(usize: n, for n in SEGMENTS, if !is_hinged(n));
/// Hinged segments, in the order of [`super::state::State::hinge`].
pub(crate) const HINGED: &[usize] = collect!(usize: n, for n in SEGMENTS, if is_hinged(n));
/// Upper and lower segment of each limb, in the order of `HINGED`.
pub const LIMBS: &[(usize, usize)] = collect!((usize, usize): (parent(n), n), for n in SEGMENTS, if is_hinged(n));
/// Segments on a ball joint that carry nothing.
pub(crate) const LEAVES: &[usize] =
    collect!(usize: n, for n in SEGMENTS, if !is_hinged(n) && !carries(n, false) && !carries(n, true));
/// Segments on a ball joint that carry others on ball joints.
pub(crate) const TRUNKS: &[usize] = collect!(usize: n, for n in SEGMENTS, if !is_hinged(n) && carries(n, false));
/// Segments whose joint is T1.
pub(crate) const ROOTS: &[usize] = collect!(usize: n, for n in SEGMENTS, if parent(n) == AT_T1);
/// All other segments, each with the one that carries it: those that one segment carries stand together, and none stands
/// before the one that carries it.
pub(crate) const HUNG: &[(usize, usize)] = collect!(
    (usize, usize): (n % SEGMENTS, n / SEGMENTS), for n in SEGMENTS * SEGMENTS, if parent(n % SEGMENTS) == n / SEGMENTS
);

/// Ball joints, in the order of [`crate::forces::joint::JointSystem::balls`].
pub const BALL_JOINTS: &[Joint] = collect!(Joint: TREE.joint(n), for n in JOINTS, if !row(n).is_hinge());
/// Proximal and distal segment of [`BALL_JOINTS`].
pub const BALLS: &[(usize, usize)] = collect!(
    (usize, usize): (row(n).proximal.index(), row(n).distal.index()), for n in JOINTS, if !row(n).is_hinge()
);
/// Hinges, in the order of `HINGED`.
pub const HINGE_JOINTS: &[Joint] = collect!(
    Joint: TREE.joint(n % JOINTS), for n in HINGED.len() * JOINTS, if row(n % JOINTS).distal.index() == HINGED[n / JOINTS]
);

/// Stands for the segment that carries one whose joint is T1.
const AT_T1: usize = usize::MAX;

/// Every segment is reduced with its limb, as a leaf or as part of the trunk.
const _: () = assert!(
    TRUNKS.len() + LEAVES.len() + 2 * LIMBS.len() == SEGMENTS && HINGED.len() + BALLS.len() + 1 == SEGMENTS,
    "a tree with a segment that has no reduction yet"
);

/// Place of a free segment in [`FREE`], if it is one.
pub fn free_slot(segment: usize) -> Option<usize> {
    FREE.iter().position(|&n| n == segment)
}

/// Place of a hinged segment in [`HINGED`], if it is one.
pub(crate) fn hinge_slot(segment: usize) -> Option<usize> {
    HINGED.iter().position(|&n| n == segment)
}

/// The part of [`HUNG`] that a segment carries.
#[inline(always)]
pub(crate) fn hung_from(segment: usize) -> &'static [(usize, usize)] {
    const FIRST: [usize; SEGMENTS + 1] = {
        let (mut first, mut n) = ([0; SEGMENTS + 1], 0);
        while n < SEGMENTS {
            let mut at = first[n];
            while at < HUNG.len() && HUNG[at].1 == n {
                at += 1;
            }
            first[n + 1] = at;
            n += 1;
        }
        first
    };
    &HUNG[FIRST[segment]..FIRST[segment + 1]]
}

const fn row(joint: usize) -> &'static JointRow {
    &TREE.joint_rows()[joint]
}

/// The joint that carries a segment.
const fn carrier(segment: usize) -> Option<&'static JointRow> {
    match TREE.carrier(TREE.segment(segment)) {
        Some(joint) => Some(row(joint.index())),
        None => None,
    }
}

const fn is_hinged(segment: usize) -> bool {
    matches!(carrier(segment), Some(joint) if joint.is_hinge())
}

/// The segment that carries another, or [`AT_T1`].
const fn parent(segment: usize) -> usize {
    match carrier(segment) {
        Some(joint) if !matches!(joint.place, Place::Root) => joint.proximal.index(),
        _ => AT_T1,
    }
}

/// Whether a segment carries one on a hinge, or one on a ball joint.
const fn carries(segment: usize, on_hinge: bool) -> bool {
    let mut n = 0;
    while n < SEGMENTS {
        if parent(n) == segment && is_hinged(n) == on_hinge {
            return true;
        }
        n += 1;
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reports_body_is_laid_out_as_its_figures_say() {
        assert_eq!(FREE, [0, 1, 2, 3, 4, 5, 8, 9]);
        assert_eq!(LIMBS, [(4, 6), (5, 7), (8, 10), (9, 11)]);
        assert_eq!((TRUNKS, LEAVES, ROOTS), (&[0, 1, 3][..], &[2][..], &[0, 1][..]));
        assert_eq!(BALLS, [(1, 2), (1, 5), (1, 4), (0, 1), (0, 3), (3, 9), (3, 8)]);
        assert_eq!(hung_from(1), [(2, 1), (4, 1), (5, 1)]);
        assert_eq!(hung_from(11), []);
        for (joint, hinged) in HINGE_JOINTS.iter().zip(HINGED) {
            assert_eq!(TTI12[*joint].distal.index(), *hinged);
        }
    }
}
