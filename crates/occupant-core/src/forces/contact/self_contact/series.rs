//! Two skins that are pressed together as one spring.
//!
//! Given loading curves F₁(Δ₁) and F₂(Δ₂), Δ = Δ₁ + Δ₂ at F₁ = F₂: the inverse functions add. One bilinear spring has the
//! same curve up to the first knee of the two, at F_b, and meets it again at 3F_b:
//!
//! 1/K₁ = 1/K₁₁ + 1/K₁₂,   F_b = min(K₁ᵢ Δ_bᵢ),   Δ_b = F_b/K₁,   K₂ = 2F_b/(Δ(3F_b) − Δ(F_b))
//!
//! Unloading compliances μ/K add too, so μ₁ = (μ₁₁/K₁₁ + μ₁₂/K₁₂) K₁ is exact; μ₂ is what both return of the work between
//! F_b and 3F_b.

use crate::forces::spring::{BilinearSpring, LEAST_FRACTION};

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
pub(super) fn series(one: &BilinearSpring, other: &BilinearSpring) -> BilinearSpring {
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
