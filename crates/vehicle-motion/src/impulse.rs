//! Impacts by impulse and momentum: two bodies in plan, restitution, friction (Kudlich and Slibar).

/// A body in plan view, rotating clockwise seen from above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planar {
    /// Mass, kg; infinite for what does not move.
    pub mass_kg: f64,
    /// Inertia about the vertical axis, kg·m².
    pub inertia_kg_m2: f64,
    /// Place of the centre of gravity, X and Y, m.
    pub at_m: [f64; 2],
    /// Velocity, m/s.
    pub velocity_m_s: [f64; 2],
    /// Yaw rate, rad/s.
    pub turning_rad_s: f64,
}

/// Result of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blow {
    /// Impulse on the first body, X and Y, N·s.
    pub impulse_n_s: [f64; 2],
    /// Change of velocity of each body, m/s.
    pub delta_v_m_s: [[f64; 2]; 2],
    /// Change of yaw rate of each, rad/s.
    pub delta_turning_rad_s: [f64; 2],
    /// Kinetic energy lost, J.
    pub lost_j: f64,
    /// Whether the bodies slid along each other to the end.
    pub slides: bool,
}

/// Rounding of the energy lost, over the work across the contact: a full restitution loses none.
const LOST_WITHIN: f64 = 1e-9;

pub(crate) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Planar {
    pub(crate) fn arm_m(&self, place_m: [f64; 2]) -> [f64; 2] {
        [place_m[0] - self.at_m[0], place_m[1] - self.at_m[1]]
    }

    fn velocity_at(&self, place_m: [f64; 2]) -> [f64; 2] {
        let arm = self.arm_m(place_m);
        [self.velocity_m_s[0] - self.turning_rad_s * arm[1], self.velocity_m_s[1] + self.turning_rad_s * arm[0]]
    }
}

/// Why an impact has no impulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoBlow {
    /// The bodies do not close along the normal: they separate, or slide past each other.
    Separate,
    /// The impulse would add energy.
    Gains,
}

/// Closing speed along the normal, over the whole, below which bodies only slide past each other.
const CLOSES: f64 = 1e-9;

/// An impact of two bodies at a place, with the direction of the contact's normal in either sense, restitution on both
/// components, and the largest ratio of the impulse along the contact to that across it. The bodies tell the sense: the
/// first lies on the side of its centre of gravity, the second on the other.
///
/// # Errors
/// The bodies separate, or the impulse would add energy.
pub fn blow(
    bodies: [&Planar; 2],
    place_m: [f64; 2],
    normal_rad: f64,
    restitution: f64,
    friction: f64,
) -> Result<Blow, NoBlow> {
    let [first, second] = bodies;
    let (a, b) = (first.velocity_at(place_m), second.velocity_at(place_m));
    let u = [a[0] - b[0], a[1] - b[1]];
    let (sine, cosine) = libm::sincos(normal_rad);
    // from the second to the first; what does not move may have no centre of gravity
    let off = |body: &Planar| if body.mass_kg.is_finite() { body.arm_m(place_m) } else { [0.0; 2] };
    let (to_first, to_second) = (off(first), off(second));
    let across = dot([to_second[0] - to_first[0], to_second[1] - to_first[1]], [cosine, sine]);
    let sense = if across < 0.0 { -1.0 } else { 1.0 };
    let n = [sense * cosine, sense * sine];
    let t = [-n[1], n[0]];
    let arms = bodies.map(|body| body.arm_m(place_m));
    let k = |p: [f64; 2], q: [f64; 2]| {
        let of =
            |i: usize| dot(p, q) / bodies[i].mass_kg + cross(arms[i], p) * cross(arms[i], q) / bodies[i].inertia_kg_m2;
        of(0) + of(1)
    };
    let (k_n, k_t, k_nt) = (k(n, n), k(t, t), k(n, t));
    let (u_n, u_t) = (dot(u, n), dot(u, t));
    if u_n >= -CLOSES * libm::hypot(u[0], u[1]) {
        return Err(NoBlow::Separate);
    }
    let det = k_n * k_t - k_nt * k_nt;
    let (mut p_n, mut p_t) = ((u_t * k_nt - u_n * k_t) / det, (u_n * k_nt - u_t * k_n) / det);
    let slides = p_t.abs() > friction * p_n;
    if slides {
        let sliding = |sign: f64| -u_n / (k_n + sign * friction * k_nt);
        let sign = p_t.signum();
        let sign = if sliding(sign) > 0.0 { sign } else { -sign };
        p_n = sliding(sign);
        p_t = sign * friction * p_n;
    }
    let [p_n, p_t] = [p_n, p_t].map(|p| p * (1.0 + restitution));
    let impulse = [p_n * n[0] + p_t * t[0], p_n * n[1] + p_t * t[1]];
    let change = |i: usize, sign: f64| {
        let Planar { mass_kg, inertia_kg_m2, .. } = *bodies[i];
        ([0, 1].map(|j| sign * impulse[j] / mass_kg), sign * cross(arms[i], impulse) / inertia_kg_m2)
    };
    let (of_first, of_second) = (change(0, 1.0), change(1, -1.0));
    // −J·(u + ½ΔU) with the change of the velocity of approach
    let (du_n, du_t) = (k_n * p_n + k_nt * p_t, k_nt * p_n + k_t * p_t);
    let lost_j = -(p_n * (u_n + 0.5 * du_n) + p_t * (u_t + 0.5 * du_t));
    if !(p_n > 0.0 && lost_j >= -LOST_WITHIN * (p_n * u_n).abs()) {
        return Err(NoBlow::Gains);
    }
    Ok(Blow {
        impulse_n_s: impulse,
        delta_v_m_s: [of_first.0, of_second.0],
        delta_turning_rad_s: [of_first.1, of_second.1],
        lost_j: lost_j.max(0.0),
        slides,
    })
}
