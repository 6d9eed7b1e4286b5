//! The piece of a path that answered the last query.

use super::live::LiveFrames;

/// Stores the piece of a path that was found last, so that the next look-up, usually in the same piece or the next,
/// needs no search.
///
/// It affects only the speed: any cursor, fresh or from another path, gives the same bits. For a live path it contains
/// the motion given so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PathCursor {
    piece: usize,
    pub(crate) live: Option<Box<LiveFrames>>,
}

impl PathCursor {
    /// Index of the last piece that starts at or before `at`, or 0 before the first. `starts` gives the start of
    /// each of `count` pieces in increasing order; `count` is at least 1.
    pub(super) fn locate(&mut self, count: usize, at: f64, starts: impl Fn(usize) -> f64) -> usize {
        let holds = |piece: usize| {
            piece < count && (piece == 0 || starts(piece) <= at) && (piece + 1 == count || at < starts(piece + 1))
        };
        let hint = self.piece;
        self.piece = if holds(hint) {
            hint
        } else if holds(hint + 1) {
            hint + 1
        } else if hint > 0 && holds(hint - 1) {
            hint - 1
        } else {
            search(count, at, starts)
        };
        self.piece
    }
}

/// Bisection for the last piece that starts at or before `at`.
fn search(count: usize, at: f64, starts: impl Fn(usize) -> f64) -> usize {
    let (mut low, mut high) = (0, count);
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if starts(middle) <= at {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cursor_finds_the_same_piece() {
        let starts = [0.0, 0.5, 0.7, 2.0, 2.5];
        let at_and_piece =
            [(-1.0, 0), (0.0, 0), (0.49, 0), (0.5, 1), (0.7, 2), (1.99, 2), (2.0, 3), (2.5, 4), (9.0, 4)];
        for (at, piece) in at_and_piece {
            for hint in 0..8 {
                let mut cursor = PathCursor { piece: hint, live: None };
                assert_eq!(cursor.locate(starts.len(), at, |i| starts[i]), piece, "at {at} from {hint}");
            }
        }
    }
}
