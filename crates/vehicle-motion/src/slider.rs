//! A mass on a straight slide with a resisting force: cushions and breakaway bases.

use crate::barrier::{End, Slider};

/// Travel over which the force builds up, m.
const BUILDS_M: f64 = 0.005;
/// Stiffness at the end of a rigid path, N/m.
const RIGID_N_PER_M: f64 = 5e7;
/// Stiffness of the stop behind a cushion, N/m: it stores little, so that it adds no rebound.
const BEHIND_N_PER_M: f64 = 1e9;

/// A slider ready to run.
#[derive(Clone, Debug)]
pub(crate) struct Slide {
    pub mass_kg: f64,
    pub direction_rad: Option<f64>,
    force_n: Vec<[f64; 2]>,
    returned: f64,
    end: End,
}

/// Its stored state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SlideMemory {
    /// Largest travel, m.
    pub most_m: f64,
    /// Direction, once it is known, rad.
    pub direction_rad: Option<f64>,
}

impl Slide {
    pub fn new(slider: &Slider) -> Result<Self, &'static str> {
        let table = &slider.force_n;
        if slider.mass_kg.is_nan() || slider.mass_kg <= 0.0 {
            return Err("its mass must be above 0");
        }
        let rises = table.windows(2).all(|pair| pair[1][0] > pair[0][0]);
        if table.len() < 2 || table[0][0] != 0.0 || !rises || !table.iter().all(|[_, force]| *force >= 0.0) {
            return Err("its force needs at least two points, ways rising from 0, forces of at least 0");
        }
        Ok(Slide {
            mass_kg: slider.mass_kg,
            direction_rad: slider.direction_rad,
            force_n: table.clone(),
            returned: slider.returned,
            end: slider.end,
        })
    }

    fn end_m(&self) -> f64 {
        self.force_n[self.force_n.len() - 1][0]
    }

    fn table_n(&self, way_m: f64) -> f64 {
        let i = self.force_n[1..self.force_n.len() - 1].partition_point(|point| point[0] <= way_m);
        let [from, to] = [self.force_n[i], self.force_n[i + 1]];
        from[1] + (to[1] - from[1]) * (way_m.min(to[0]) - from[0]) / (to[0] - from[0])
    }

    /// Force on loading, N.
    fn load_n(&self, way_m: f64) -> f64 {
        let beyond_m = way_m - self.end_m();
        if beyond_m > 0.0 && self.end == End::Released {
            return 0.0;
        }
        self.table_n(way_m) * (way_m / BUILDS_M).clamp(0.0, 1.0) + RIGID_N_PER_M * beyond_m.max(0.0)
    }

    /// Energy absorbed by the table, J.
    pub fn energy_j(&self, way_m: f64) -> f64 {
        let upto = way_m.clamp(0.0, self.end_m());
        let whole: f64 = self
            .force_n
            .windows(2)
            .map(|p| {
                let to = upto.min(p[1][0]);
                if to <= p[0][0] { 0.0 } else { 0.5 * (p[0][1] + self.table_n(to)) * (to - p[0][0]) }
            })
            .sum();
        // ∫F min(1, u/u₀) du: less half of the first 5 mm
        let build = upto.min(BUILDS_M);
        whole - self.table_n(0.0) * (build - 0.5 * build * build / BUILDS_M)
    }

    /// Energy absorbed or stored at a travel after a maximum, J.
    pub fn taken_j(&self, way_m: f64, most_m: f64) -> f64 {
        let most_m = most_m.max(way_m);
        let (top_n, left_n) = (self.load_n(most_m), self.force_n(way_m.max(0.0), most_m));
        let left = if top_n > 0.0 { left_n / top_n } else { 1.0 };
        let behind_n = self.behind_n(way_m);
        let behind_j = 0.5 * behind_n * behind_n / BEHIND_N_PER_M;
        self.loaded_j(most_m) * (1.0 - self.returned * (1.0 - left * left)) + behind_j
    }

    /// Energy on loading, J.
    fn loaded_j(&self, way_m: f64) -> f64 {
        let beyond_m = if self.end == End::Rigid { (way_m - self.end_m()).max(0.0) } else { 0.0 };
        let end_n = self.table_n(self.end_m());
        self.energy_j(way_m) + end_n * beyond_m + 0.5 * RIGID_N_PER_M * beyond_m * beyond_m
    }

    /// Force of the stop at which a cushion starts, N: it goes no farther back. A sign has none.
    fn behind_n(&self, way_m: f64) -> f64 {
        if self.end == End::Rigid { BEHIND_N_PER_M * way_m.min(0.0) } else { 0.0 }
    }

    /// Retaining force after a maximum travel, N.
    pub fn force_n(&self, way_m: f64, most_m: f64) -> f64 {
        if way_m < 0.0 {
            return self.behind_n(way_m);
        }
        if way_m >= most_m {
            return self.load_n(way_m);
        }
        if most_m > self.end_m() && self.end == End::Released {
            return 0.0;
        }
        let top_n = self.load_n(most_m);
        let back_m = 2.0 * self.returned * self.loaded_j(most_m) / top_n.max(1e-9);
        top_n * (1.0 - (most_m - way_m) / back_m.max(1e-9)).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slide(end: End) -> Slide {
        let slider = Slider {
            corners_m: Vec::new(),
            mass_kg: 50.0,
            direction_rad: None,
            force_n: vec![[0.0, 20e3], [1.0, 60e3]],
            returned: 0.05,
            end,
            friction: 0.5,
        };
        Slide::new(&slider).unwrap()
    }

    #[test]
    fn the_energy_is_the_sum_of_the_force() {
        let slide = slide(End::Rigid);
        for way_m in [0.002, 0.3, 1.0] {
            let n = 100_000;
            let step = way_m / f64::from(n);
            let sum: f64 = (0..n).map(|i| step * slide.load_n((f64::from(i) + 0.5) * step)).sum();
            // the table rises a little within the first 5 mm
            assert!((slide.energy_j(way_m) - sum).abs() < 1.0, "{way_m}: {} {sum}", slide.energy_j(way_m));
        }
    }

    #[test]
    fn a_base_that_broke_holds_no_more() {
        let slide = slide(End::Released);
        assert_eq!((slide.force_n(1.01, 1.0), slide.force_n(0.5, 1.1)), (0.0, 0.0));
        assert!(slide.force_n(0.5, 0.4) > 30e3 && slide.force_n(0.3, 0.4) == 0.0);
    }
}
