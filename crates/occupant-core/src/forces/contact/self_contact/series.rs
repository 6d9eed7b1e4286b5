//! Two skins in series as one spring.
//!
//! Given loading curves F₁(Δ₁) and F₂(Δ₂), Δ = Δ₁ + Δ₂ at F₁ = F₂: the inverse functions add. One bilinear spring has the
//! same curve up to the first knee of the two, at F_b, and meets it again at 3F_b:
//!
//! 1/K₁ = 1/K₁₁ + 1/K₁₂,   F_b = min(K₁ᵢ Δ_bᵢ),   Δ_b = F_b/K₁,   K₂ = 2F_b/(Δ(3F_b) − Δ(F_b))
//!
//! Unloading compliances μ/K add too, so μ₁ = (μ₁₁/K₁₁ + μ₁₂/K₁₂) K₁ is exact; μ₂ is the share that both return of the
//! work between F_b and 3F_b. If one of the two is a force function of rising straight lines, both are treated as such,
//! and nothing is approximated: between two forces at which one of them has a corner Δ is linear in F, and the returned
//! share, (μ₁ΔΔ₁ + μ₂ΔΔ₂)/ΔΔ, is constant.

use crate::forces::contact::material::Force;
use crate::forces::function::{Beyond, ForceDeflection, Function, Shape, Unloading};
use crate::forces::spring::{BilinearSpring, LEAST_FRACTION};

/// Two skins, the forces of each multiplied by its share.
pub(super) fn series(both: [(&Force, f64); 2]) -> Force {
    let [one, other] = both;
    if let (Some(a), Some(b)) = (one.0.bilinear(), other.0.bilinear()) {
        return springs(&a.times(one.1), &b.times(other.1)).into();
    }
    let lines = both.map(|(force, share)| rising(force, share));
    let mut forces: Vec<f64> = lines.iter().flat_map(|line| line.points.iter().map(|point| point[1])).collect();
    forces.sort_by(f64::total_cmp);
    forces.dedup_by(|a, b| *a - *b <= 1e-12 * *a);
    // one more beyond both, which has the last slopes
    forces.push(2.0 * forces.last().copied().unwrap_or(1.0));
    let mut sum = Function { points: vec![[0.0; 2]], ..Function::lines(Vec::new(), 1.0) };
    for pair in forces.windows(2) {
        let parts = lines.each_ref().map(|line| between(line, pair[0], pair[1]));
        let way: f64 = parts.iter().map(|(way, _)| way).sum();
        let returned: f64 = parts.iter().map(|(way, mu)| mu * way).sum();
        let from = sum.points[sum.points.len() - 1][0];
        sum.points.push([from + way, pair[1]]);
        sum.returned.push(returned / way);
    }
    ForceDeflection { loading: sum, ..ForceDeflection::lines(Vec::new(), 1.0) }.into()
}

/// Whether a skin can be one of two in series: straight lines that rise, back by stretch, without factors.
pub(crate) fn is_skin(force: &Force) -> bool {
    match force {
        Force::Bilinear(spring) => spring.k1_n_per_m.min(spring.k2_n_per_m) > 0.0,
        Force::Deflection(law) => {
            let plain = ForceDeflection { loading: law.loading.clone(), ..ForceDeflection::lines(Vec::new(), 1.0) };
            **law == plain
                && law.loading.shape == Shape::Lines
                && law.loading.beyond != Beyond::Limits
                && law.unloading == Unloading::Stretch
                && law.loading.points.windows(2).all(|p| p[1][1] > p[0][1])
        }
    }
}

/// The loading curve of a skin as straight lines.
fn rising(force: &Force, share: f64) -> Function {
    let mut function = match force {
        Force::Deflection(law) => law.loading.clone(),
        Force::Bilinear(spring) => {
            let knee = (spring.break_m, spring.k1_n_per_m * spring.break_m);
            let first = (knee.0 > 0.0).then_some(([knee.0, knee.1], spring.returned_1));
            // any point of the second line will do
            let second = ([knee.0 + 0.1, knee.1 + 0.1 * spring.k2_n_per_m], spring.returned_2);
            let (points, returned): (Vec<_>, Vec<_>) = first.into_iter().chain([second]).unzip();
            Function { points: [vec![[0.0; 2]], points].concat(), returned, ..Function::lines(Vec::new(), 1.0) }
        }
    };
    function.points.iter_mut().for_each(|point| point[1] *= share);
    function
}

/// How far a curve gives way from one force to another between which it does not bend, m, and μ there.
fn between(line: &Function, low: f64, high: f64) -> (f64, f64) {
    let count = line.returned.len();
    let at = line.points.iter().skip(1).position(|point| point[1] > low * (1.0 + 1e-9)).unwrap_or(count - 1);
    let [[x, force], [next_x, next_force]] = [line.points[at], line.points[at + 1]];
    ((high - low) * (next_x - x) / (next_force - force), line.returned[at].max(LEAST_FRACTION))
}

/// The straight pieces of a loading curve: from which force on, stiffness and returned fraction.
fn pieces(spring: &BilinearSpring) -> [(f64, f64, f64); 2] {
    let [mu_1, mu_2] = [spring.returned_1, spring.returned_2].map(|mu| mu.max(LEAST_FRACTION));
    [(0.0, spring.k1_n_per_m, mu_1), (knee_n(spring), spring.k2_n_per_m, mu_2)]
}

/// Force at which the slope changes; without end where it does not.
fn knee_n(spring: &BilinearSpring) -> f64 {
    let is_straight = spring.k1_n_per_m == spring.k2_n_per_m && spring.returned_1 == spring.returned_2;
    if is_straight { f64::INFINITY } else { spring.k1_n_per_m * spring.break_m }
}

/// Both springs, whose stiffnesses are positive, pressed with one force.
pub(super) fn springs(one: &BilinearSpring, other: &BilinearSpring) -> BilinearSpring {
    let both = [pieces(one), pieces(other)];
    let at_zero = both.map(|[first, second]| if second.0 > 0.0 { first } else { second });
    let give: f64 = at_zero.iter().map(|(_, k, _)| 1.0 / k).sum();
    let returned = at_zero.iter().map(|(_, k, mu)| mu / k).sum::<f64>() / give;
    let linear = BilinearSpring::linear(1.0 / give, returned);
    let knees_n = both.map(|[_, (knee_n, ..)]| knee_n).into_iter().filter(|knee_n| *knee_n > 0.0);
    let knee_n = knees_n.fold(f64::INFINITY, f64::min);
    if knee_n == f64::INFINITY {
        return linear;
    }
    // of each piece between F_b and 3F_b: deformation, work and returned work (twice each)
    let (mut way_m, mut work, mut back) = (0.0, 0.0, 0.0);
    for [(_, k1, mu_1), (knee, k2, mu_2)] in both {
        let from_to = |low: f64, high: f64| [low.clamp(knee_n, 3.0 * knee_n), high.clamp(knee_n, 3.0 * knee_n)];
        for ([low, high], k, mu) in [(from_to(0.0, knee), k1, mu_1), (from_to(knee, f64::INFINITY), k2, mu_2)] {
            way_m += (high - low) / k;
            work += (high * high - low * low) / k;
            back += mu * (high * high - low * low) / k;
        }
    }
    BilinearSpring { returned_2: back / work, ..linear.then(knee_n * give, 2.0 * knee_n / way_m) }
}
