//! Overlap of a disc with ground that is cut by its plane.
//!
//! The disc has its centre at the origin; x points forward in its plane and z up. The ground is everything below a
//! polyline.

use libm::{acos, asin};

/// Contribution of a segment of the polyline to the overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Overlap {
    /// Area, m².
    pub area_m2: f64,
    /// Run of the ground's line inside the disc, m.
    pub run_m: f64,
    /// Rise of the ground's line inside the disc, m.
    pub rise_m: f64,
}

impl Overlap {
    /// Both together.
    pub fn and(self, other: Self) -> Self {
        Overlap {
            area_m2: self.area_m2 + other.area_m2,
            run_m: self.run_m + other.run_m,
            rise_m: self.rise_m + other.rise_m,
        }
    }
}

/// Contribution of the ground from one point (x, z) to another further ahead to the overlap with a disc, m.
pub(super) fn overlap(radius_m: f64, from_m: [f64; 2], to_m: [f64; 2]) -> Overlap {
    let (x0, x1) = (from_m[0].max(-radius_m), to_m[0].min(radius_m));
    if x1 <= x0 {
        return upright(radius_m, from_m, to_m);
    }
    let slope = (to_m[1] - from_m[1]) / (to_m[0] - from_m[0]);
    let height = |x: f64| from_m[1] + slope * (x - from_m[0]);
    // where z = height(x) crosses x² + z² = r²
    let (a, foot) = (1.0 + slope * slope, from_m[1] - slope * from_m[0]);
    let (half, rest) = (slope * foot, foot * foot - radius_m * radius_m);
    let root = (half * half - a * rest).max(0.0).sqrt();
    let crossings = [(-half - root) / a, (-half + root) / a].map(|x| x.clamp(x0, x1));
    let mut sum = Overlap::default();
    for [from, to] in [[x0, crossings[0]], crossings, [crossings[1], x1]] {
        if to <= from {
            continue;
        }
        let middle = 0.5 * (from + to);
        let (z, arc) = (height(middle), half_chord(radius_m, middle));
        if z <= -arc {
            continue;
        }
        let under_arc = arc_area(radius_m, to) - arc_area(radius_m, from);
        if z >= arc {
            sum.area_m2 += 2.0 * under_arc;
        } else {
            sum.area_m2 += z * (to - from) + under_arc;
            sum.run_m += to - from;
            sum.rise_m += slope * (to - from);
        }
    }
    sum
}

/// An upright piece has no area, but its rise inside the disc pushes back.
fn upright(radius_m: f64, from_m: [f64; 2], to_m: [f64; 2]) -> Overlap {
    if from_m[0].abs() >= radius_m || from_m[0] != to_m[0] {
        return Overlap::default();
    }
    let arc = half_chord(radius_m, from_m[0]);
    let rise_m = to_m[1].clamp(-arc, arc) - from_m[1].clamp(-arc, arc);
    Overlap { rise_m, ..Overlap::default() }
}

fn half_chord(radius_m: f64, x_m: f64) -> f64 {
    (radius_m * radius_m - x_m * x_m).max(0.0).sqrt()
}

/// ∫√(r² − x²) dx = ½(x√(r² − x²) + r² asin(x/r))
fn arc_area(radius_m: f64, x_m: f64) -> f64 {
    0.5 * (x_m * half_chord(radius_m, x_m) + radius_m * radius_m * asin((x_m / radius_m).clamp(-1.0, 1.0)))
}

/// Depth of level ground with this overlap, m; at most 1.9 radii.
pub(super) fn level_depth(radius_m: f64, area_m2: f64) -> f64 {
    let most_m = 1.9 * radius_m;
    // A ≈ (4/3)√(2r) Δ^{3/2} for shallow depths
    let power = 0.75 * area_m2 / (2.0 * radius_m).sqrt();
    let mut depth_m = libm::cbrt(power * power).min(most_m);
    for _ in 0..5 {
        let chord_m = level_chord(radius_m, depth_m);
        if chord_m > 0.0 {
            depth_m = (depth_m - (segment(radius_m, depth_m) - area_m2) / chord_m).clamp(1e-3 * depth_m, most_m);
        }
    }
    depth_m
}

/// Chord that level ground cuts at a depth, m.
pub(super) fn level_chord(radius_m: f64, depth_m: f64) -> f64 {
    2.0 * (depth_m * (2.0 * radius_m - depth_m)).max(0.0).sqrt()
}

/// Area of the segment of a depth, m².
fn segment(radius_m: f64, depth_m: f64) -> f64 {
    let left_m = radius_m - depth_m;
    radius_m * radius_m * acos((left_m / radius_m).clamp(-1.0, 1.0)) - 0.5 * left_m * level_chord(radius_m, depth_m)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_all(radius_m: f64, line: &[[f64; 2]]) -> Overlap {
        line.windows(2).map(|pair| overlap(radius_m, pair[0], pair[1])).fold(Overlap::default(), Overlap::and)
    }

    /// A fine sum over strips, which shares nothing with the closed form.
    fn by_strips(radius_m: f64, line: impl Fn(f64) -> f64) -> f64 {
        let n = 200_000;
        let width = 2.0 * radius_m / f64::from(n);
        let strip = |i: i32| {
            let x = -radius_m + (f64::from(i) + 0.5) * width;
            let arc = (radius_m * radius_m - x * x).sqrt();
            (line(x).clamp(-arc, arc) + arc) * width
        };
        (0..n).map(strip).sum()
    }

    #[test]
    fn overlap_of_broken_ground_is_that_of_many_strips() {
        let lines: [&[[f64; 2]]; 5] = [
            &[[-1.0, -0.30], [1.0, -0.30]],
            &[[-1.0, -0.55], [1.0, -0.05]],
            &[[-1.0, -0.30], [0.15, -0.30], [0.16, -0.15], [1.0, -0.15]],
            &[[-1.0, 0.16], [0.0, -0.34], [1.0, 0.16]],
            &[[-1.0, -0.6], [0.1, -0.6], [0.11, 0.5], [1.0, 0.5]],
        ];
        for line in lines {
            let height = |x: f64| {
                let pair = line.windows(2).find(|pair| x <= pair[1][0]).unwrap();
                pair[0][1] + (pair[1][1] - pair[0][1]) * (x - pair[0][0]) / (pair[1][0] - pair[0][0])
            };
            let (found, strips) = (of_all(0.32, line).area_m2, by_strips(0.32, height));
            // measured 3e-9 to 2e-7
            assert!((found - strips).abs() < 1e-6, "{line:?}: {found} {strips}");
        }
    }

    /// Areas and equivalent depths worked out by hand for a wheel of 0.32 m whose centre stands 0.30 m high.
    #[test]
    fn equivalent_depths_are_those_worked_out_elsewhere() {
        let curb = |ahead: f64| [[-1.0, -0.3], [ahead, -0.3], [ahead, -0.15], [1.0, -0.15]];
        let rise = 0.3 * 1.25f64.sqrt();
        let ditch = [[-1.0, 0.5 - rise], [0.0, -rise], [1.0, 0.5 - rise]];
        let cases: [(&[[f64; 2]], f64, f64); 4] = [
            (&[[-1.0, -0.3], [1.0, -0.3]], 0.002_988_544_9, 0.02),
            (&curb(0.15), 0.013_555_02, 0.055_436_3),
            (&curb(0.25), 0.003_856_15, 0.023_732_5),
            (&ditch, 0.005_977_09, 0.031_869_2),
        ];
        for (line, area_m2, depth_m) in cases {
            let found = of_all(0.32, line);
            assert!((found.area_m2 - area_m2).abs() < 2e-8, "{line:?}: {found:?}");
            assert!((level_depth(0.32, found.area_m2) - depth_m).abs() < 1e-7, "{line:?}");
        }
        // the push against a curb 0.15 m ahead leans back by 20.5°: the gradient of the stored energy
        let Overlap { run_m, rise_m, .. } = of_all(0.32, &curb(0.15));
        let lean = libm::atan2(rise_m, run_m).to_degrees();
        assert!((lean - 20.5).abs() < 0.05, "{lean}");
    }

    /// The run and the rise are the gradient of the area over the place of the disc.
    #[test]
    fn run_and_rise_are_the_gradient_of_the_area() {
        let line =
            |x: f64, z: f64| [[-2.0, -0.35], [0.05, -0.3], [0.12, -0.1], [2.0, -0.15]].map(|p| [p[0] - x, p[1] - z]);
        let area = |x: f64, z: f64| of_all(0.32, &line(x, z)).area_m2;
        let (found, e) = (of_all(0.32, &line(0.0, 0.0)), 1e-5);
        let up = (area(0.0, -e) - area(0.0, e)) / (2.0 * e);
        let ahead = (area(e, 0.0) - area(-e, 0.0)) / (2.0 * e);
        assert!((up - found.run_m).abs() < 1e-7 && (ahead - found.rise_m).abs() < 1e-7, "{up} {ahead} {found:?}");
    }
}
