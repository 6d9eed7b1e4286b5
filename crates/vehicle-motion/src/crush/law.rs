//! Force per width of a face over its crush, and two faces in series.

use crate::body::{Reading, Stiffness};

/// A face: force per width p over crush x, piecewise linear.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Crush, m, and force per width, N/m; from (0, 0), both increasing; the last slope continues.
    knots: Vec<[f64; 2]>,
    /// Shares of energy returned, below the toe and above.
    returned: [f64; 2],
    /// Ratio of crush to that of the residual interpretation.
    stretch: f64,
    /// Crush without residual damage, residual interpretation, m.
    elastic_m: f64,
}

/// Crush at which the knots end; the last slope continues.
const FAR_M: f64 = 10.0;

impl Law {
    /// Law p = B x/s², with s the stretch of the interpretation: the same energy at corresponding crush.
    pub fn of(stiffness: Stiffness, reading: Reading, returned: [f64; 2]) -> Self {
        let stretch = reading.stretch();
        let slope = stiffness.b_n_per_m2 / (stretch * stretch);
        let toe_m = stiffness.elastic_m() * stretch;
        let far_m = FAR_M.max(2.0 * toe_m);
        Law {
            knots: vec![[0.0, 0.0], [toe_m, slope * toe_m], [far_m, slope * far_m]],
            returned,
            stretch,
            elastic_m: stiffness.elastic_m(),
        }
    }

    /// Crush at a force per width, m.
    pub fn crush_m(&self, force_n_per_m: f64) -> f64 {
        let i = self.knots[1..self.knots.len() - 1].partition_point(|knot| knot[1] < force_n_per_m);
        let [from, to] = [self.knots[i], self.knots[i + 1]];
        from[0] + (to[0] - from[0]) * (force_n_per_m - from[1]) / (to[1] - from[1])
    }

    /// Energy per width for a residual crush, J/m: AC + ½BC² + A²/2B, for any interpretation.
    pub fn damage_j_per_m(&self, residual_m: f64) -> f64 {
        let depth_m = residual_m + self.elastic_m;
        let slope = self.knots[1][1] * self.stretch / self.elastic_m;
        0.5 * slope * depth_m * depth_m
    }

    /// Residual crush after a largest force per width, m.
    pub fn residual_m(&self, force_n_per_m: f64) -> f64 {
        (self.crush_m(force_n_per_m) / self.stretch - self.elastic_m).max(0.0)
    }
}

/// Two faces in series, or one against a rigid partner.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    knots: Vec<Knot>,
    returned: [f64; 2],
    /// Energy per width below the first knot after the origin, J/m.
    toe: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    /// Depth of both, m.
    depth_m: f64,
    /// Force per width, N/m.
    force: f64,
    /// Depth of the first face, m.
    first_m: f64,
    /// Energy per width absorbed so far, J/m.
    energy: f64,
}

/// Force per width of a pair at a depth, and the first face's share of the depth rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pressure {
    /// N/m.
    pub force_n_per_m: f64,
    /// Share of the first face.
    pub first: f64,
    /// Whether the depth is the largest so far.
    pub is_loading: bool,
}

impl Series {
    /// Two faces in series; one against a rigid partner.
    pub fn of(first: &Law, second: Option<&Law>) -> Self {
        let both = [Some(first), second];
        let mut forces: Vec<f64> =
            both.into_iter().flatten().flat_map(|law| law.knots.iter().map(|knot| knot[1])).collect();
        forces.sort_by(f64::total_cmp);
        forces.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
        let mut knots: Vec<Knot> = Vec::with_capacity(forces.len());
        for force in forces {
            let first_m = first.crush_m(force);
            let depth_m = first_m + second.map_or(0.0, |law| law.crush_m(force));
            let energy = knots.last().map_or(0.0, |k| k.energy + 0.5 * (k.force + force) * (depth_m - k.depth_m));
            knots.push(Knot { depth_m, force, first_m, energy });
        }
        let mut series = Series { knots, returned: first.returned, toe: 0.0 };
        series.toe = series.energy(series.knots[1].depth_m);
        series
    }

    /// The piece behind the last inner knot that comes before; there are no more than a few.
    fn piece(&self, is_before: impl Fn(&Knot) -> bool) -> [&Knot; 2] {
        let mut i = 0;
        while i + 2 < self.knots.len() && is_before(&self.knots[i + 1]) {
            i += 1;
        }
        [&self.knots[i], &self.knots[i + 1]]
    }

    /// Force per width at a depth on loading, N/m.
    pub fn load(&self, depth_m: f64) -> f64 {
        load_in(self.piece(|knot| knot.depth_m < depth_m), depth_m)
    }

    /// Depth at a force per width, m.
    pub fn depth_m(&self, force: f64) -> f64 {
        let [from, to] = self.piece(|knot| knot.force < force);
        from.depth_m + (to.depth_m - from.depth_m) * (force - from.force) / (to.force - from.force)
    }

    /// Energy per width absorbed at a depth, J/m.
    pub fn energy(&self, depth_m: f64) -> f64 {
        let piece = self.piece(|knot| knot.depth_m < depth_m);
        piece[0].energy + 0.5 * (piece[0].force + load_in(piece, depth_m)) * (depth_m - piece[0].depth_m)
    }

    /// Force per width at a depth after a maximum of `most` N/m. Unloading is linear and returns the given shares of
    /// the energy below the first knot and above.
    pub fn pressure(&self, depth_m: f64, most: f64) -> Pressure {
        let [from, to] = self.piece(|knot| knot.depth_m < depth_m);
        let loading = load_in([from, to], depth_m);
        if loading >= most {
            let first = (to.first_m - from.first_m) / (to.depth_m - from.depth_m);
            return Pressure { force_n_per_m: loading, first, is_loading: true };
        }
        let [from, to] = self.piece(|knot| knot.force < most);
        let deepest_m = from.depth_m + (to.depth_m - from.depth_m) * (most - from.force) / (to.force - from.force);
        let first_m = from.first_m + (to.first_m - from.first_m) * (most - from.force) / (to.force - from.force);
        let taken = self.energy(deepest_m);
        let toe = if deepest_m < self.knots[1].depth_m { taken } else { self.toe };
        let returns = self.returned[0] * toe + self.returned[1] * (taken - toe);
        let way_m = 2.0 * returns / most;
        let left = (1.0 - (deepest_m - depth_m) / way_m).max(0.0);
        Pressure { force_n_per_m: most * left, first: first_m / deepest_m, is_loading: false }
    }
}

/// Force per width at a depth within a piece on loading, N/m.
fn load_in([from, to]: [&Knot; 2], depth_m: f64) -> f64 {
    from.force + (to.force - from.force) * (depth_m - from.depth_m) / (to.depth_m - from.depth_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRONT: Stiffness = Stiffness { a_n_per_m: 59_259.3, b_n_per_m2: 711_111.0 };
    const RETURNED: [f64; 2] = [0.2, 0.015];

    fn front(reading: Reading) -> Law {
        Law::of(FRONT, reading, RETURNED)
    }

    /// E = ½B x² per width; the residual crush is that from which A and B were drawn; stretched, energy and residual stay.
    #[test]
    fn energy_and_residual_are_those_of_the_tests() {
        for (reading, stretch) in [(Reading::Residual, 1.0), (Reading::Dynamic { longer: 0.2 }, 1.2)] {
            let law = front(reading);
            let wall = Series::of(&law, None);
            for residual_m in [0.1, 0.3, 0.5] {
                let depth_m = (residual_m + FRONT.elastic_m()) * stretch;
                let energy =
                    0.5 * FRONT.b_n_per_m2 * (residual_m + FRONT.elastic_m()) * (residual_m + FRONT.elastic_m());
                assert!((wall.energy(depth_m) / energy - 1.0).abs() < 1e-12);
                assert!((law.residual_m(wall.load(depth_m)) - residual_m).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn unloading_gives_back_the_shares() {
        let wall = Series::of(&front(Reading::Residual), None);
        for depth_m in [0.05, 0.3, 0.6] {
            let most = wall.load(depth_m);
            let n = 200_000;
            let step = depth_m / f64::from(n);
            let back: f64 = (0..n).map(|i| step * wall.pressure((f64::from(i) + 0.5) * step, most).force_n_per_m).sum();
            let toe = wall.energy(depth_m.min(FRONT.elastic_m()));
            let expected = 0.2 * toe + 0.015 * (wall.energy(depth_m) - toe);
            assert!((back / expected - 1.0).abs() < 1e-3, "{depth_m}: {back} {expected}");
        }
    }

    #[test]
    fn two_faces_share_force_and_split_depth() {
        let [a, b] = [front(Reading::Residual), Law::of(FRONT.scaled(0.6, 0.8), Reading::Residual, RETURNED)];
        let pair = Series::of(&a, Some(&b));
        for force in [1e4, 5e4, 3e5] {
            let depth_m = a.crush_m(force) + b.crush_m(force);
            assert!((pair.load(depth_m) / force - 1.0).abs() < 1e-12);
            assert!((pair.depth_m(force) / depth_m - 1.0).abs() < 1e-12);
            let first = pair.pressure(depth_m, 0.0).first;
            // springs 1/B₁ and 1/B₂ in series
            assert!((first - 0.8 / 1.8).abs() < 1e-9, "{first}");
        }
        // what a partner pressed in before, another feels
        assert!(!pair.pressure(pair.depth_m(2e5) - 1e-6, 2e5).is_loading);
    }
}
