//! The law that is fitted: straight lines and a way back, as a material of a scenario has them, and an impactor that meets it.

use super::{Agreement, Contact, Impactor};

/// Force over depth of an undamaged surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Depth, m, and force, N, from (0, 0).
    pub points: Vec<[f64; 2]>,
    /// Unloading.
    pub back: Option<Back>,
}

/// Unloading after a greatest depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Back {
    /// `returned`: share of the work returned; the loading curve compressed to that share of its length.
    Share(f64),
    /// `unload_slope`, N/m.
    Slope(f64),
}

impl Law {
    /// Force while the depth grows, N; beyond the last point with the last slope.
    pub fn loading(&self, depth_m: f64) -> f64 {
        if depth_m <= 0.0 {
            return 0.0;
        }
        let at = self.points.partition_point(|point| point[0] < depth_m).clamp(1, self.points.len() - 1);
        let ([x, f], [next_x, next_f]) = (self.points[at - 1], self.points[at]);
        f + (next_f - f) * (depth_m - x) / (next_x - x)
    }

    /// Force at a depth after a greatest one, N.
    pub fn force(&self, depth_m: f64, greatest_m: f64) -> f64 {
        if depth_m >= greatest_m {
            return self.loading(depth_m);
        }
        let way = greatest_m - depth_m;
        match self.back {
            None => self.loading(depth_m),
            Some(Back::Share(share)) => self.loading(greatest_m - way / share),
            Some(Back::Slope(slope)) => (self.loading(greatest_m) - slope * way).max(0.0),
        }
    }

    /// The steepest slope of loading, N/m.
    pub fn steepest(&self) -> f64 {
        self.points.windows(2).map(|p| (p[1][1] - p[0][1]) / (p[1][0] - p[0][0])).fold(0.0, f64::max)
    }

    /// Work up to the last point, J.
    pub fn work(&self) -> f64 {
        self.points.windows(2).map(|p| 0.5 * (p[0][1] + p[1][1]) * (p[1][0] - p[0][0])).sum()
    }

    /// Forces along a sequence of depths, N.
    pub fn along(&self, depth_m: &[f64]) -> Vec<f64> {
        let mut greatest = 0.0_f64;
        let mut force = |depth: &f64| {
            greatest = greatest.max(*depth);
            self.force(*depth, greatest)
        };
        depth_m.iter().map(&mut force).collect()
    }
}

/// Steps between two samples.
const STEPS: u32 = 20;

/// Depth and force of an impactor that touches the surface at `times[0]`, at these times, by midpoint steps.
fn met(law: &Law, impactor: &Impactor, [mass, speed]: [f64; 2], times: &[f64]) -> Vec<[f64; 2]> {
    let (mut x, mut v, mut greatest) = (0.0_f64, speed, 0.0_f64);
    let mut rows = vec![[0.0, 0.0]];
    for pair in times.windows(2) {
        let dt = (pair[1] - pair[0]) / f64::from(STEPS);
        for _ in 0..STEPS {
            let middle = x + 0.5 * dt * v;
            greatest = greatest.max(middle);
            v += dt * (impactor.gravity_m_s2 - law.force(middle, greatest) / mass);
            x = middle + 0.5 * dt * v;
        }
        rows.push([x, law.force(x, greatest.max(x))]);
    }
    rows
}

/// Computed depth and force of the impactor; along the measured depth if mass or speed are unknown.
pub(super) fn computed(law: &Law, contact: &Contact, impactor: &Impactor) -> Vec<[f64; 2]> {
    match (impactor.mass_kg, contact.speed_m_s) {
        (Some(mass), Some(speed)) => met(law, impactor, [mass, speed], &contact.time_s),
        _ => contact.depth_m.iter().copied().zip(law.along(&contact.depth_m)).map(|(x, f)| [x, f]).collect(),
    }
}

/// Agreement of computed depths and forces with the record.
pub(super) fn agreement(law: &Law, contact: &Contact, rows: &[[f64; 2]]) -> Agreement {
    let most = |column: usize| rows.iter().map(|row| row[column]).fold(0.0, f64::max);
    let depth_m: Vec<f64> = rows.iter().map(|row| row[0]).collect();
    let force_n: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    let squares: f64 = force_n.iter().zip(&contact.force_n).map(|(a, b)| (a - b).powi(2)).sum();
    let lost = work(&depth_m, &force_n);
    Agreement {
        peak_ratio: most(1) / contact.peak_n(),
        depth_ratio: most(0) / contact.greatest_m(),
        lost_ratio: law.back.map(|_| lost / work(&contact.depth_m, &contact.force_n)),
        residual: (squares / force_n.len() as f64).sqrt() / contact.peak_n(),
    }
}

/// ∫F dx, J.
pub(super) fn work(depth_m: &[f64], force_n: &[f64]) -> f64 {
    depth_m.windows(2).zip(force_n.windows(2)).map(|(x, f)| 0.5 * (f[0] + f[1]) * (x[1] - x[0])).sum()
}

/// Unloading that returns the measured work: by a share or by a slope, whichever fits better.
pub(super) fn back(law: &Law, contact: &Contact, falls: bool) -> Back {
    let [taken, returned] = contact.works();
    let share = Back::Share((returned / taken).clamp(0.01, 1.0));
    let top = law.points.last().map_or(0.0, |point| point[1]);
    let slope = 0.5 * top * top / returned.max(1e-3 * taken);
    let steepest = law.steepest();
    if falls {
        return Back::Slope(slope.max(1.001 * steepest));
    }
    if slope < 1.001 * steepest {
        return share;
    }
    let off = |back: Back| {
        let law = Law { back: Some(back), ..law.clone() };
        let own = law.along(&contact.depth_m);
        let after = own.iter().zip(&contact.force_n).skip(contact.turn);
        after.map(|(a, b)| (a - b).powi(2)).sum::<f64>()
    };
    // of equals the one that needs no second number
    if off(Back::Slope(slope)) < 0.8 * off(share) { Back::Slope(slope) } else { share }
}
