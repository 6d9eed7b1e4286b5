//! The walls of the unit cube.

/// One of the two directions of a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Towards 0.
    Down,
    /// Towards 1.
    Up,
}

impl Side {
    /// Both, down first.
    pub const BOTH: [Side; 2] = [Side::Down, Side::Up];

    /// −1 or 1.
    pub fn sign(self) -> f64 {
        match self {
            Side::Down => -1.0,
            Side::Up => 1.0,
        }
    }

    /// How much room a coordinate has on this side.
    pub fn room(self, u: f64) -> f64 {
        match self {
            Side::Down => u.max(0.0),
            Side::Up => (1.0 - u).max(0.0),
        }
    }
}

/// The point of [0, 1] that a coordinate stands for whose line is folded at 0, 1, 2, …: continuous, so that a search without
/// bounds may walk on beyond a wall.
pub fn fold(x: f64) -> f64 {
    let t = x.rem_euclid(2.0);
    if t > 1.0 { 2.0 - t } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_reflect() {
        for (x, u) in [(0.3, 0.3), (0.0, 0.0), (1.0, 1.0), (1.25, 0.75), (-0.25, 0.25), (2.5, 0.5), (-3.0, 1.0)] {
            assert_eq!(fold(x), u, "{x}");
        }
    }
}
