//! Checks of a force–deflection law: a curve that unloading cannot follow, or one that creates energy.
//!
//! The loss up to δ_m, D = ∫f + ∫s − U(δ_m), must not fall with δ_m; everything else is reversible. By stretch D′ = (1
//! − μ)f, by slope D′ = (K − f′)(δ_m − δ*) where δ* is the end of unloading; both are safe by their conditions. D is
//! evaluated at many points for all laws, and so for the quadratic and for spikes.

use super::cubic::Cubic;
use super::data::{ForceDeflection, Function, Goes, PLACES, Unloading, check_points};
use super::deflection::DeflectionLaw;
use placed_text::Problems;

impl ForceDeflection {
    /// Law of straight lines with one returned fraction.
    pub fn lines(points: Vec<[f64; 2]>, returned: f64) -> Self {
        let loading = Function::lines(points, returned);
        ForceDeflection { loading, unloading: Unloading::Stretch, spike: Vec::new(), rate: Vec::new(), viscous: None }
    }

    /// Reports problems of the law.
    pub(crate) fn check(&self, path: &str, all: &mut Problems) {
        let problems = &mut Problems::new();
        let by_slope = matches!(self.unloading, Unloading::Slope { .. });
        let goes = if by_slope && self.spike.is_empty() { Goes::Anywhere } else { Goes::NotDownFromGap };
        let falls = "a force that does not fall; one that falls needs `unload_slope`";
        self.loading.check(&format!("{path}.force"), goes, falls, problems);
        self.check_factors(path, problems);
        if !self.spike.is_empty() {
            check_points(&self.spike, &format!("{path}.spike"), Goes::Anywhere, "forces of at least 0", problems);
            if self.spike.last().is_some_and(|[_, force]| *force != 0.0) {
                problems.error(format!("{path}.spike"), "a force at its end", "a force of 0 at its last point");
            }
        }
        match &self.unloading {
            Unloading::Stretch => {}
            Unloading::Slope { n_per_m, least } => self.check_slope(*n_per_m, least, path, problems),
            Unloading::Quadratic { returned, set } => {
                let rises = |rows: &[[f64; 2]]| !rows.is_empty() && rows.windows(2).all(|rows| rows[1][0] > rows[0][0]);
                let fractions = returned.iter().all(|row| (0.0..=1.0).contains(&row[1]));
                if !(fractions && set.iter().all(|row| (0.0..1.0).contains(&row[1])) && rises(returned) && rises(set)) {
                    let expected = "r from 0 to 1, g from 0 to less than 1, over depths that rise";
                    problems.error(format!("{path}.atb"), "other numbers", expected);
                }
            }
        }
        if !problems.has_errors() {
            self.check_loss(path, problems);
        }
        all.extend(std::mem::take(problems));
    }

    fn check_factors(&self, path: &str, problems: &mut Problems) {
        let path_of = |key: &str| format!("{path}.{key}");
        if !self.rate.is_empty() {
            let rises = self.rate.windows(2).all(|rows| rows[1][0] > rows[0][0] && rows[1][1] >= rows[0][1]);
            let at_rest = self.rate.contains(&[0.0, 1.0]);
            if !(rises && at_rest && self.rate.iter().flatten().all(|x| x.is_finite()) && self.rate[0][1] >= 0.0) {
                let expected = "speeds that rise, with factors that do not fall, none below 0, and 1 at speed 0";
                problems.error(path_of("rate"), "another table", expected);
            }
        }
        if let Some([damping, depth]) = self.viscous {
            problems.check_at_least_zero(&path_of("viscous.damping"), damping, "N*s/m");
            problems.check_positive(&path_of("viscous.depth"), depth, "m");
        }
    }

    fn check_slope(&self, slope: f64, least: &[[f64; 2]], path: &str, problems: &mut Problems) {
        let (found, place) = (format!("{slope:.6} N/m"), format!("{path}.unload_slope"));
        let own = self.loading.steepest_loading();
        if slope.is_nan() || slope < own {
            problems.error(place, found, format!("at least the largest slope of loading, {own:.6} N/m"));
            return;
        }
        if least.is_empty() {
            return;
        }
        let place = format!("{path}.unload_force");
        check_points(least, &place, Goes::NotDown, "forces that do not fall", problems);
        if Cubic::lines(least).iter().any(|line| line.c[1] >= slope) {
            problems.error(&place, "a curve as steep as `unload_slope`", "one that is flatter everywhere");
        }
        let [own, other] = [&self.loading, &Function::lines(least.to_vec(), 1.0)].map(super::FunctionLaw::new);
        // between the points of both nothing can be hidden but what a smooth curve bends by
        let places = self.loading.points.iter().chain(least).map(|point| point[0]);
        if let Some(x) = places.into_iter().find(|x| other.value(*x) > own.value(*x) * (1.0 + 1e-9)) {
            let found = format!("{:.3} N above the {:.3} N of loading at {x:.6} m", other.value(x), own.value(x));
            problems.error(&place, found, "a curve below that of loading");
        }
    }

    /// Checks that D falls nowhere, and whether R is the returned fraction.
    fn check_loss(&self, path: &str, problems: &mut Problems) {
        let law = DeflectionLaw::new(&ForceDeflection { rate: Vec::new(), viscous: None, ..self.clone() }, 1.0);
        let end = self.spike.last().map_or(0.0, |point| point[0]).max(self.loading.end());
        let (mut lost, mut share) = (0.0, 0.0);
        for i in 1..=PLACES {
            let x = end * f64::from(i) / f64::from(PLACES);
            let ([_, work], (_, energy)) = (law.loading(x), law.respond(x, x, 0.0));
            share = energy / work;
            if work - energy < lost - 1e-9 * work {
                let found =
                    format!("a way back that makes energy at {x:.6} m, where it returns {share:.3} of the work");
                problems.error(path, found, "a law whose loss never falls: a smaller share, or another way back");
                return;
            }
            lost = work - energy;
        }
        if let Unloading::Quadratic { returned, .. } = &self.unloading
            && let Some([_, returned]) = returned.last()
            && (share - returned).abs() > 0.01
        {
            let found = format!("r = {returned}, of which ATB's quadratic makes {share:.3} at the last point");
            problems.warning(format!("{path}.atb.r"), found, "an r within its range, or `returned`, which is exact");
        }
    }

    /// Largest damping of the rate factor and the damper up to the last point, N·s/m.
    pub(crate) fn damping(&self) -> f64 {
        let slope = |rows: &[[f64; 2]]| (rows[1][1] - rows[0][1]) / (rows[1][0] - rows[0][0]);
        let steepest = self.rate.windows(2).map(slope).fold(0.0, f64::max);
        self.loading.greatest_n() * steepest + self.viscous.map_or(0.0, |[damping, _]| damping)
    }

    /// Largest slope of loading and unloading up to the last point, N/m, by differences.
    pub(crate) fn steepest(&self) -> f64 {
        let law = DeflectionLaw::new(self, 1.0);
        let (end, step) = (self.loading.end(), 1e-6 * self.loading.end());
        let at = |i: u32| end * f64::from(i) / f64::from(PLACES);
        let slope = |x: f64| (law.respond(x, x, 0.0).0 - law.respond(x - step, x, 0.0).0) / step;
        (1..=PLACES).map(|i| slope(at(i))).fold(self.loading.steepest_loading(), f64::max)
    }
}
