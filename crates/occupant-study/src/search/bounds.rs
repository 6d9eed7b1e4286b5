//! The walls of the unit cube.

/// Signs of the two directions of a coordinate: towards 0, towards 1.
pub(super) const SIDES: [f64; 2] = [-1.0, 1.0];

/// Distance of a coordinate to the bound on a side.
pub(super) fn room(side: f64, u: f64) -> f64 {
    let room = if side < 0.0 { u } else { 1.0 - u };
    room.max(0.0)
}

/// The point of [0, 1] onto which an unbounded coordinate is folded at 0, 1, 2, …: continuous, so that an unconstrained
/// search may pass a bound.
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
